//! `piola curve`: test curves of a material, beside measured ones.

use std::fmt;
use std::path::PathBuf;

use piola::Inversion;
use piola_laboratory::chart::Curve;
use piola_laboratory::curve::{Mode, Response, ResponseError, Volume, sweep};
use piola_laboratory::data::{Agreement, Measured, PointError};

use super::{FINE, Source, as_options, draw, measured_range, spaced};
use crate::energy::Energy;
use crate::error::Error;

/// What to compute.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveSettings {
    /// The material.
    pub energy: Energy,
    /// The tests; where none is named, those of the data, or else uniaxial, equibiaxial and pure shear.
    pub modes: Vec<Mode>,
    /// From which control, where it is not the least of the data, or else 0.5 (of simple shear 0, of a volumetric test 0.8).
    pub from: Option<f64>,
    /// To which control, where it is not the greatest of the data, or else 3 (of simple shear 2, of a volumetric test 1.2).
    pub to: Option<f64>,
    /// Rows of the table of each test, where they are not the points of the data.
    pub rows: Option<usize>,
    /// Whether the volume is kept.
    pub volume: Volume,
    /// To compare with.
    pub data: Option<Source>,
    /// Where to draw them.
    pub svg: Option<PathBuf>,
}

/// Rows of a table unless something else is asked for.
const ROWS: usize = 11;

/// Computes test curves and draws them where that is asked for.
///
/// # Errors
/// Where material, data or range make no sense, or the chart cannot be written.
pub fn curve(settings: &CurveSettings) -> Result<CurveReport, Error> {
    let energy = settings.energy.clone().inverting(Inversion::Refuse);
    let substance = energy.build()?;
    let specimen = energy.specimen()?;
    let data = settings.data.as_ref().map(Source::read).transpose()?;
    let modes = match (&data, settings.modes.as_slice()) {
        (Some(data), []) => data.modes().collect(),
        (None, []) => vec![Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear],
        (_, modes) => modes.to_vec(),
    };

    let (mut tables, mut curves) = (Vec::new(), Vec::new());
    for mode in modes {
        let measured: Vec<Measured> = data.iter().flat_map(|data| data.of(mode)).copied().collect();
        let [least, greatest] = match &data {
            Some(data) if !measured.is_empty() => measured_range(data, mode),
            _ => usual_range(mode),
        };
        let (from, to) = (settings.from.unwrap_or(least), settings.to.unwrap_or(greatest));
        check_range(mode, from, to)?;
        let asks_for_range = settings.from.or(settings.to).is_some() || settings.rows.is_some();
        let controls = match measured.as_slice() {
            [_, ..] if !asks_for_range => measured.iter().map(|point| point.control).collect(),
            _ => spaced(from, to, settings.rows.unwrap_or(ROWS)),
        };
        let responses = sweep(specimen.as_ref(), mode, settings.volume, &controls);
        let measured = if asks_for_range { Vec::new() } else { measured };
        tables.push(Table { mode, controls, responses, measured });
        let fine = spaced(from, to, FINE);
        curves.push(Curve { mode, points: sweep(specimen.as_ref(), mode, settings.volume, &fine) });
    }
    let agreement = data.as_ref().map(|data| data.agreement(specimen.as_ref(), settings.volume));
    let name = substance.name;
    let names = energy.description()?.parameters.iter().map(|parameter| parameter.name);
    let given = as_options(names.map(|name| (name, substance.parameters[name].as_slice())));
    if let Some(file) = &settings.svg {
        let compared = data.as_ref().zip(agreement.as_ref().and_then(|agreement| agreement.as_ref().ok()));
        let note = given.replace("--param ", "");
        draw(file, &titled(name, settings.volume), &note, &curves, compared)?;
    }
    Ok(CurveReport { title: titled(name, settings.volume), given, tables, agreement })
}

pub(super) fn titled(material: &str, volume: Volume) -> String {
    match volume {
        Volume::Free => material.to_owned(),
        Volume::Kept => format!("{material}, incompressible"),
    }
}

fn usual_range(mode: Mode) -> [f64; 2] {
    match mode {
        Mode::SimpleShear => [0.0, 2.0],
        Mode::Volumetric => [0.8, 1.2],
        _ => [0.5, 3.0],
    }
}

fn check_range(mode: Mode, from: f64, to: f64) -> Result<(), Error> {
    let requirement = match mode {
        Mode::SimpleShear => "finite",
        _ => "positive and finite",
    };
    for (quantity, value) in [("--from", from), ("--to", to)] {
        if !mode.allows(value) {
            return Err(Error::OutOfRange { quantity, value, requirement });
        }
    }
    if from < to {
        Ok(())
    } else {
        Err(Error::OutOfRange { quantity: "--to", value: to, requirement: "above --from" })
    }
}

/// Test curves as tables.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveReport {
    title: String,
    given: String,
    tables: Vec<Table>,
    agreement: Option<Result<Agreement, PointError>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Table {
    mode: Mode,
    controls: Vec<f64>,
    responses: Vec<Result<Response, ResponseError>>,
    /// At the same controls, if any.
    measured: Vec<Measured>,
}

impl fmt::Display for CurveReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n  {}", self.title, self.given)?;
        for table in &self.tables {
            write!(f, "{table}")?;
        }
        match &self.agreement {
            None => Ok(()),
            Some(Ok(agreement)) => writeln!(f, "R²: {agreement}"),
            Some(Err(unanswered)) => writeln!(f, "R²: none, for there is no stress in {unanswered}"),
        }
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (control, stress, sides) = match self.mode {
            Mode::SimpleShear => ("shear γ", "P12/Pa", ["greatest", "least", "across"]),
            Mode::Volumetric => ("J", "mean stress/Pa", ["along", "across", "thickness"]),
            _ => ("stretch", "stress/Pa", ["along", "across", "thickness"]),
        };
        let [along, across, thickness] = sides;
        write!(
            f,
            "\n{}\n{control:>10} {stress:>14} {along:>10} {across:>10} {thickness:>10} {:>10}",
            self.mode, "J"
        )?;
        writeln!(f, "{}", if self.measured.is_empty() { "" } else { "    measured/Pa difference" })?;
        for (row, (control, response)) in self.controls.iter().zip(&self.responses).enumerate() {
            match response {
                Ok(response) => {
                    let [along, across, thickness] = response.stretches;
                    let (stress, volume) = (response.stress, response.volume());
                    write!(
                        f,
                        "{control:>10.4} {stress:>14.5e} {along:>10.5} {across:>10.5} {thickness:>10.5} {volume:>10.5}"
                    )?;
                    if let Some(point) = self.measured.get(row) {
                        write!(f, " {:>14.5e}", point.stress)?;
                        if point.stress != 0.0 {
                            write!(f, " {:>+8.2} %", 100.0 * (stress / point.stress - 1.0))?;
                        }
                    }
                    writeln!(f)?;
                }
                Err(reason) => writeln!(f, "{control:>10.4}   {reason}")?,
            }
        }
        Ok(())
    }
}
