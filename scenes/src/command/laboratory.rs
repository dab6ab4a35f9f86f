//! The commands that put a material on the bench.

use std::path::PathBuf;

use clap::Parser;
use piola::Inversion;
use piola_laboratory::curve::{Mode, Volume};
use piola_laboratory::fit::Difference;
use piola_laboratory::stability;

use piola_scenes::energy::Energy;
use piola_scenes::error::Error;
use piola_scenes::laboratory::{CheckSettings, CurveSettings, FitSettings, Source};

use super::{inversion, parameter};

/// Stresses are in Pa.
#[derive(Debug, Parser)]
pub(crate) struct Curve {
    #[command(flatten)]
    material: Material,

    /// Tests, separated by commas: uniaxial, equibiaxial, pure_shear, simple_shear, volumetric
    /// [default: those of the data, or else the first three].
    #[arg(long = "mode", value_name = "MODE,MODE", value_delimiter = ',')]
    modes: Vec<Mode>,

    /// Least stretch (simple shear: γ, volumetric: J) [default: of the data, or else 0.5 (0, 0.8)].
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    from: Option<f64>,

    /// Greatest stretch [default: of the data, or else 3 (2, 1.2)].
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    to: Option<f64>,

    /// Rows of the table of each test [default: the points of the data, or else 11].
    #[arg(long, value_name = "N")]
    rows: Option<usize>,

    /// Keep the volume, whatever the bulk modulus.
    #[arg(long)]
    incompressible: bool,

    /// Measured points to compare with: a file with the columns mode,stretch,nominal_stress_MPa, or `treloar`.
    #[arg(long, value_name = "FILE|treloar", value_parser = source)]
    data: Option<Source>,

    /// Draw the curves.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Prints the parameters in a form to be pasted, R² of each test, and why other parameters might do as well.
#[derive(Debug, Parser)]
pub(crate) struct Fit {
    #[command(flatten)]
    material: Material,

    /// Measured points: a file with the columns mode,stretch,nominal_stress_MPa (or _kPa, _Pa), or `treloar`.
    #[arg(long, value_name = "FILE|treloar", value_parser = source)]
    data: Source,

    /// Keep a parameter, all entries of a list, or one as NAME_1; may be repeated.
    #[arg(long = "hold", value_name = "NAME")]
    held: Vec<String>,

    /// Make differences by the measured stress small, so that small strains count as much as large ones: the default.
    #[arg(long)]
    relative: bool,

    /// Make differences by the greatest stress of all small, so that large stresses decide.
    #[arg(long, conflicts_with = "relative")]
    absolute: bool,

    /// Keep the volume, whatever the bulk modulus: the default unless the data have a volumetric test.
    #[arg(long)]
    incompressible: bool,

    /// Let the sides go where the energy says.
    #[arg(long, conflicts_with = "incompressible")]
    compressible: bool,

    /// Descents from random parameters beside the one from those given.
    #[arg(long, value_name = "N", default_value_t = 20)]
    starts: usize,

    /// Of the random parameters: the same seed gives the same fit.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// Draw the fitted curves with the points.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Over a box of stretches, and in uniaxial, equibiaxial, pure shear, confined and hydrostatic tests from rest.
#[derive(Debug, Parser)]
pub(crate) struct Check {
    #[command(flatten)]
    material: Material,

    /// Beyond the domain of a material: `refuse` leaves stretches out, a number is the stretch below which the energy is
    /// extended by polynomials.
    #[arg(long, value_name = "refuse|STRETCH", value_parser = inversion, default_value = "refuse", allow_negative_numbers = true)]
    inversion: Inversion,

    /// The least stretch of the box and of the tests.
    #[arg(long, value_name = "A", default_value_t = 0.3, allow_negative_numbers = true)]
    from: f64,

    /// The greatest stretch of the box and of the tests.
    #[arg(long, value_name = "B", default_value_t = 3.0, allow_negative_numbers = true)]
    to: f64,

    /// Stretches along each axis of the box.
    #[arg(long, value_name = "N", default_value_t = 41)]
    resolution: usize,

    /// Draw a map over the stretches in a sheet and in plane strain.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// A material of the catalogue.
#[derive(Debug, Parser)]
pub(crate) struct Material {
    /// The material, as listed by `piola materials`.
    material: String,

    /// Value of a parameter; lists as NAME=V,V,V [default: the typical one of `piola materials`].
    #[arg(long = "param", value_name = "NAME=V", value_parser = parameter)]
    parameters: Vec<(String, Vec<f64>)>,
}

impl Material {
    /// The material with these parameters and else typical ones.
    pub(crate) fn energy(self) -> Result<Energy, Error> {
        let typical = Energy::typical(&self.material)?;
        Ok(self.parameters.into_iter().fold(typical, |energy, (name, values)| energy.with(&name, values)))
    }
}

impl Curve {
    /// What is asked for.
    pub(crate) fn settings(self) -> Result<CurveSettings, Error> {
        let Self { material, modes, from, to, rows, incompressible, data, svg } = self;
        let volume = if incompressible { Volume::Kept } else { Volume::Free };
        Ok(CurveSettings { energy: material.energy()?, modes, from, to, rows, volume, data, svg })
    }
}

impl Fit {
    /// What is asked for.
    pub(crate) fn settings(self) -> Result<FitSettings, Error> {
        Ok(FitSettings {
            energy: self.material.energy()?,
            data: self.data,
            volume: match (self.incompressible, self.compressible) {
                (true, _) => Some(Volume::Kept),
                (_, true) => Some(Volume::Free),
                _ => None,
            },
            difference: if self.absolute { Difference::Absolute } else { Difference::Relative },
            held: self.held,
            restarts: self.starts,
            seed: self.seed,
            svg: self.svg,
        })
    }
}

impl Check {
    /// What is asked for.
    pub(crate) fn settings(self) -> Result<CheckSettings, Error> {
        let energy = self.material.energy()?.inverting(self.inversion);
        let stretches = stability::SurveySettings::default()
            .with_range(self.from, self.to)
            .with_resolution(self.resolution);
        Ok(CheckSettings { energy, stretches, svg: self.svg })
    }
}

fn source(text: &str) -> Result<Source, std::convert::Infallible> {
    Ok(Source::from(text))
}
