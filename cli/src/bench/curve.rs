//! `piola curve`: test curves of a material, compared with measured ones.

use std::path::PathBuf;

use clap::Args;
use piola::Inversion;
use piola_laboratory::Specimen;
use piola_laboratory::chart;
use piola_laboratory::curve::{Mode, Volume, sweep};
use piola_laboratory::data::Measured;
use piola_scenes::error::Error as SceneError;

use super::data::{self, Data};
use super::{FINE, Material, as_options, at_constant_volume, at_rest, draw, ranking, spaced, titled};
use crate::error::Error;

/// Stresses are in Pa.
///
/// `piola curve all --data FILE` fits every rubber of the catalogue to the data instead and ranks them by R²,
/// the share of the variance of all measured stresses, those at rest among them, that the fitted energy
/// explains.
#[derive(Debug, Args)]
#[command(after_help = format!("{}\n\n{}", ranking::HELP, data::HELP))]
pub(crate) struct Curve {
    #[command(flatten)]
    material: Material,

    #[command(flatten)]
    data: Data,

    /// Least stretch (simple shear: γ, volumetric: J) [default: of the data, or else 0.5 (0, 0.8)].
    #[arg(long, value_name = "A", allow_negative_numbers = true)]
    from: Option<f64>,

    /// Greatest stretch [default: of the data, or else 3 (2, 1.2)].
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    to: Option<f64>,

    /// Rows of the table of each test [default: the points of the data, or else 11].
    #[arg(long, value_name = "N")]
    rows: Option<usize>,

    /// Points of the table of each test, in place of rows from one stretch to another; separated by commas.
    #[arg(long, value_name = "STRETCH,STRETCH", value_delimiter = ',', allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["from", "to", "rows"])]
    at: Vec<f64>,

    /// Keep the volume constant, regardless of the bulk modulus; a compressibility may be 0, as in D1=0/MPa.
    #[arg(long)]
    incompressible: bool,

    /// Draw the curves.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
}

/// Rows of a table unless another number is given.
const ROWS: usize = 11;
/// More rows than anybody reads, and few enough to be computed in seconds.
const MAX_ROWS: usize = 100_000;
/// Stretches, and shears, beyond which stresses of most materials leave the range of f64.
const MAX_STRETCH: f64 = 1e6;

impl Curve {
    pub(crate) fn run(self) -> Result<String, Error> {
        if self.material.material.as_deref() == Some(ranking::ALL) {
            return self.rank();
        }
        let volume = if self.incompressible { Volume::Kept } else { Volume::Free };
        let given = self.material.spec(volume)?.with_inversion(Inversion::Refuse);
        let material = if self.incompressible { at_constant_volume(&given)? } else { given.clone() };
        let info = material.build()?;
        let specimen = &material.interpreted()?;
        let (data, notes) = self.data.read()?;
        let is_asked = |mode: &Mode| self.data.tests.contains(mode);
        let modes = match Mode::ALL.into_iter().filter(is_asked).collect::<Vec<_>>() {
            asked if !asked.is_empty() => asked,
            _ if data.points.is_empty() => vec![Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear],
            _ => data.modes().collect(),
        };
        let has_range = self.from.or(self.to).is_some() || self.rows.is_some();
        let rows = self.rows.unwrap_or(ROWS);
        if !(1..=MAX_ROWS).contains(&rows) {
            let (value, requirement) = (rows as f64, "from 1 to 100000");
            return Err(SceneError::OutOfRange { quantity: "--rows", value, requirement }.into());
        }

        let title = titled(&info.name, volume);
        let options = as_options(&given)?;
        let (mut text, mut curves) = (format!("{title}\n  {options}\n"), Vec::new());
        text += &at_rest(info.moduli, volume);
        text += &notes;
        for mode in modes {
            // Points at rest alone have neither a range nor a curve.
            let has_curve = data.modes().any(|measured| measured == mode);
            let measured: Vec<Measured> = data.of(mode).filter(|_| has_curve).copied().collect();
            let [least, greatest] = match mode {
                _ if has_curve => data.range(mode),
                Mode::SimpleShear => [0.0, 2.0],
                Mode::Volumetric => [0.8, 1.2],
                _ => [0.5, 3.0],
            };
            let (from, to) = (self.from.unwrap_or(least), self.to.unwrap_or(greatest));
            let at = self.at.iter().map(|at| ("--at", *at));
            check(mode, [("--from", from), ("--to", to)].into_iter().chain(at))?;
            if from >= to {
                let requirement = "above --from";
                return Err(SceneError::OutOfRange { quantity: "--to", value: to, requirement }.into());
            }
            if has_range || !self.at.is_empty() || measured.is_empty() {
                let controls = if self.at.is_empty() { spaced(from, to, rows) } else { self.at.clone() };
                let decimals = self.at.is_empty().then_some(DECIMALS);
                text += &table(specimen, volume, mode, (&controls, decimals), &[]);
            } else {
                let controls: Vec<_> = measured.iter().map(|point| point.control).collect();
                text += &table(specimen, volume, mode, (&controls, Some(DECIMALS)), &measured);
            }
            let points = sweep(specimen, mode, volume, &spaced(from, to, FINE));
            curves.push(chart::Curve { mode, points });
        }
        let agreement = (!data.points.is_empty()).then(|| data.agreement(specimen, volume));
        match &agreement {
            None => {}
            Some(Ok(agreement)) => text += &format!("R²: {agreement}\n"),
            Some(Err(unanswered)) => text += &format!("R²: none, since there is no stress in {unanswered}\n"),
        }
        if let Some(file) = &self.svg {
            let compared = agreement.as_ref().and_then(|found| found.as_ref().ok());
            draw(file, &title, &options, &curves, compared.map(|agreement| (&data, agreement)))?;
        }
        Ok(text)
    }

    fn rank(self) -> Result<String, Error> {
        for (is_given, option) in [
            (!self.material.formula.parameters.is_empty(), "--param"),
            (!self.at.is_empty(), "--at"),
            (self.from.is_some(), "--from"),
            (self.to.is_some(), "--to"),
            (self.rows.is_some(), "--rows"),
            (self.svg.is_some(), "--svg"),
        ] {
            if is_given {
                return Err(Error::usage(format!(
                    "`piola curve all` cannot use {option}: it prints a table of fits of all parameters to all points, at \
                     constant volume"
                )));
            }
        }
        ranking::run(&self.data)
    }
}

/// Checks that a table of a test has rows at controls, each with the option that it is of.
fn check(mode: Mode, mut controls: impl Iterator<Item = (&'static str, f64)>) -> Result<(), SceneError> {
    let (least, requirement) = match mode {
        Mode::SimpleShear => (-MAX_STRETCH, "from -1e6 to 1e6"),
        _ => (1.0 / MAX_STRETCH, "from 1e-6 to 1e6"),
    };
    match controls.find(|(_, control)| !(least..=MAX_STRETCH).contains(control)) {
        Some((quantity, value)) => Err(SceneError::OutOfRange { quantity, value, requirement }),
        None => Ok(()),
    }
}

/// Decimals of the controls in a table, unless they are given one by one.
const DECIMALS: usize = 4;

/// A test as a table, with the points measured at the same controls if there are any. Controls have a given
/// number of decimals, or all.
fn table(
    specimen: &dyn Specimen<f64>,
    volume: Volume,
    mode: Mode,
    (controls, decimals): (&[f64], Option<usize>),
    measured: &[Measured],
) -> String {
    let [control, stress, along, across, thickness] = match mode {
        Mode::SimpleShear => ["shear γ", "P12/Pa", "greatest", "least", "across"],
        Mode::Volumetric => ["J", "mean stress/Pa", "along", "across", "thickness"],
        _ => ["stretch", "stress/Pa", "along", "across", "thickness"],
    };
    let more = if measured.is_empty() { "" } else { "    measured/Pa difference" };
    let mut text = format!(
        "\n{mode}\n{control:>10} {stress:>14} {along:>10} {across:>10} {thickness:>10} {:>10}{more}\n",
        "J"
    );
    for (row, (control, response)) in controls.iter().zip(sweep(specimen, mode, volume, controls)).enumerate()
    {
        let shown = decimals.map_or_else(|| control.to_string(), |decimals| format!("{control:.decimals$}"));
        text += &format!("{shown:>10} ");
        match response {
            Ok(response) => {
                text += &format!("{:>14.5e}", response.stress);
                text.extend(response.stretches.map(|stretch| format!(" {stretch:>10.5}")));
                text += &format!(" {:>10.5}", response.volume());
                if let Some(point) = measured.get(row) {
                    text += &format!(" {:>14.5e}", point.stress);
                    if point.stress != 0.0 {
                        text += &format!(" {:>+8.2} %", 100.0 * (response.stress / point.stress - 1.0));
                    }
                }
                text.push('\n');
            }
            Err(reason) => text += &format!("  {reason}\n"),
        }
    }
    text
}
