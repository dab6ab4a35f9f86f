//! A material of the catalogue on the bench: `piola curve`, `piola fit` and `piola check`.

mod check;
mod curve;
mod data;
mod fit;
mod ranking;

use std::path::Path;

use clap::Args;
use piola::__private::message::number;
use piola::material::{Moduli, Unit};
use piola_laboratory::AtRest;
use piola_laboratory::chart;
use piola_laboratory::curve::Volume;
use piola_laboratory::data::{Agreement, Measurements};
use piola_scenes::error::Error as SceneError;
use piola_scenes::material::MaterialSpec;
use piola_scenes::options::Formula;
use piola_scenes::output::write_whole;

use crate::error::Error;

pub(crate) use check::Check;
pub(crate) use curve::Curve;
pub(crate) use fit::Fit;

/// A material of the catalogue, or one that is declared on the command line.
#[derive(Debug, Args)]
pub(crate) struct Material {
    /// The material, as listed by `piola materials`, or a file of Rust that declares one; parameters without
    /// --param have the typical values of either.
    #[arg(value_name = "NAME|FILE.rs", required_unless_present = "energy")]
    material: Option<String>,

    #[command(flatten)]
    formula: Formula,
}

impl Material {
    /// Specification of the material, for curves at such a volume, with these parameters, the others having
    /// typical values.
    pub(crate) fn spec(self, volume: Volume) -> Result<MaterialSpec, Error> {
        let listed = |name: Option<&str>| MaterialSpec::typical(name.unwrap_or_default());
        let formula = if volume == Volume::Kept { self.formula.at_constant_volume() } else { self.formula };
        Ok(formula.material(self.material.as_deref(), listed)?)
    }
}

/// The material for curves at constant volume, where compressibilities do no work: those of 0, by which
/// Abaqus means that the volume is kept, are large instead if the energy divides by them.
fn at_constant_volume(spec: &MaterialSpec) -> Result<MaterialSpec, SceneError> {
    if spec.build().is_ok() {
        return Ok(spec.clone());
    }
    let mut kept = spec.clone();
    for known in spec.description()?.parameters.iter().filter(|known| known.unit == Some(Unit::PerPascal)) {
        let values = spec.values_of(&known.name);
        if values.contains(&0.0) {
            // So large that the bulk modulus is nothing next to the shear modulus.
            let values = values.iter().map(|&value| if value == 0.0 { 1e30 } else { value });
            kept = kept.with_parameter(&known.name, values.collect::<Vec<_>>());
        }
    }
    Ok(kept)
}

/// The small-strain moduli of a material in a line, and a warning if they are odd.
pub(crate) fn at_rest(moduli: Moduli, volume: Volume) -> String {
    let at_rest = AtRest { moduli, volume };
    let warning = at_rest.warning().map(|warning| format!("warning: {warning}\n"));
    format!("  at rest  {at_rest}\n{}", warning.unwrap_or_default())
}

/// The values of all parameters as options of the command line, with seven digits: rounding changes no stress
/// that is measured.
pub(crate) fn as_options(spec: &MaterialSpec) -> Result<String, SceneError> {
    let rounded = |&value: &f64| number(format!("{value:.6e}").parse().unwrap_or(value));
    let options = spec.description()?.parameters.iter().map(|parameter| {
        let values: Vec<_> = spec.values_of(&parameter.name).iter().map(rounded).collect();
        format!("--param {}={}", parameter.name, values.join(","))
    });
    Ok(options.collect::<Vec<_>>().join(" "))
}

/// Evenly spaced values, both ends among them.
fn spaced(from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(|k| from + (to - from) * (k as f64 / last)).collect()
}

fn titled(material: &str, volume: Volume) -> String {
    match volume {
        Volume::Free => material.to_owned(),
        Volume::Kept => format!("{material}, incompressible"),
    }
}

/// Draws curves under their title, with the options that describe the material below it.
fn draw(
    file: &Path,
    title: &str,
    options: &str,
    curves: &[chart::Curve],
    data: Option<(&Measurements, &Agreement)>,
) -> Result<(), Error> {
    let svg = chart::draw(title, &options.replace("--param ", ""), curves, data).map_err(Error::usage)?;
    Ok(write_whole(file, svg.as_bytes())?)
}

/// Points of a curve in a chart: more of them would be rounded to pixels unevenly.
const FINE: usize = 81;
