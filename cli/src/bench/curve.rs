//! `piola curve`: test curves of a material, beside measured ones.

use std::path::PathBuf;

use clap::Args;
use piola::Inversion;
use piola_laboratory::Specimen;
use piola_laboratory::chart;
use piola_laboratory::curve::{Mode, Volume, sweep};
use piola_laboratory::data::Measured;
use piola_scenes::error::Error as SceneError;

use super::{
    FINE, Material, as_options, draw, keep_data, measured_range, measurements, ranking, spaced, titled,
};
use crate::error::Error;

/// Stresses are in Pa.
///
/// `piola curve all --data FILE` fits every rubber of the catalogue to the data instead and ranks them by R²,
/// the share of the variance of all measured stresses that the fitted energy explains.
#[derive(Debug, Args)]
#[command(after_help = ranking::HELP)]
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

    /// Measured points to compare with: a file with the columns mode,stretch,nominal_stress_MPa, or
    /// `treloar`.
    #[arg(long, value_name = "FILE|treloar")]
    data: Option<PathBuf>,

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
    /// Computes test curves as tables, and draws them if wanted.
    pub(crate) fn run(self) -> Result<String, Error> {
        keep_data(self.data.as_ref(), self.svg.as_ref())?;
        if self.material.material.as_deref() == Some(ranking::ALL) {
            return self.rank();
        }
        let material = self.material.spec()?.with_inversion(Inversion::Refuse);
        let info = material.build()?;
        let specimen = &*material.specimen()?;
        let data = self.data.as_deref().map(measurements).transpose()?;
        let volume = if self.incompressible { Volume::Kept } else { Volume::Free };
        let modes = match (&data, self.modes) {
            (Some(data), modes) if modes.is_empty() => data.modes().collect(),
            (None, modes) if modes.is_empty() => vec![Mode::Uniaxial, Mode::Equibiaxial, Mode::PureShear],
            (_, modes) => modes,
        };
        let has_range = self.from.or(self.to).is_some() || self.rows.is_some();

        let title = titled(&info.name, volume);
        let names = material.description()?.parameters.iter().map(|parameter| &parameter.name);
        let options = as_options(names.map(|name| (&**name, info.parameters[name].as_slice())));
        let (mut text, mut curves) = (format!("{title}\n  {options}\n"), Vec::new());
        for mode in modes {
            let measured: Vec<Measured> = data.iter().flat_map(|data| data.of(mode)).copied().collect();
            let [least, greatest] = match (&data, mode) {
                (Some(data), _) if !measured.is_empty() => measured_range(data, mode),
                (_, Mode::SimpleShear) => [0.0, 2.0],
                (_, Mode::Volumetric) => [0.8, 1.2],
                _ => [0.5, 3.0],
            };
            let (from, to) = (self.from.unwrap_or(least), self.to.unwrap_or(greatest));
            let rows = self.rows.unwrap_or(ROWS);
            check_range(mode, from, to, rows)?;
            if has_range || measured.is_empty() {
                let controls = spaced(from, to, rows);
                text += &table(specimen, volume, mode, &controls, &[]);
            } else {
                let controls: Vec<_> = measured.iter().map(|point| point.control).collect();
                text += &table(specimen, volume, mode, &controls, &measured);
            }
            let points = sweep(specimen, mode, volume, &spaced(from, to, FINE));
            curves.push(chart::Curve { mode, points });
        }
        let agreement = data.as_ref().map(|data| data.agreement(specimen, volume));
        match &agreement {
            None => {}
            Some(Ok(agreement)) => text += &format!("R²: {agreement}\n"),
            Some(Err(unanswered)) => text += &format!("R²: none, for there is no stress in {unanswered}\n"),
        }
        if let Some(file) = &self.svg {
            let compared = data.as_ref().zip(agreement.as_ref().and_then(|found| found.as_ref().ok()));
            draw(file, &title, &options, &curves, compared)?;
        }
        Ok(text)
    }
}

impl Curve {
    /// Ranks all rubbers beside the data.
    fn rank(self) -> Result<String, Error> {
        for (is_given, option) in [
            (!self.material.parameters.is_empty(), "--param"),
            (!self.modes.is_empty(), "--mode"),
            (self.from.is_some(), "--from"),
            (self.to.is_some(), "--to"),
            (self.rows.is_some(), "--rows"),
        ] {
            if is_given {
                return Err(Error::RankedWith(option));
            }
        }
        ranking::run(&self.data.ok_or(Error::RankedWithoutData)?, self.svg.as_deref())
    }
}

fn check_range(mode: Mode, from: f64, to: f64, rows: usize) -> Result<(), SceneError> {
    let (least, allowed) = match mode {
        Mode::SimpleShear => (-MAX_STRETCH, "from -1e6 to 1e6"),
        _ => (1.0 / MAX_STRETCH, "from 1e-6 to 1e6"),
    };
    let is_allowed = |stretch: f64| (least..=MAX_STRETCH).contains(&stretch);
    for (is_in_range, quantity, value, requirement) in [
        (is_allowed(from), "--from", from, allowed),
        (is_allowed(to), "--to", to, allowed),
        (from < to, "--to", to, "above --from"),
        ((1..=MAX_ROWS).contains(&rows), "--rows", rows as f64, "from 1 to 100000"),
    ] {
        if !is_in_range {
            return Err(SceneError::OutOfRange { quantity, value, requirement });
        }
    }
    Ok(())
}

/// A test as a table, with the points measured at the same controls if there are any.
fn table(
    specimen: &dyn Specimen,
    volume: Volume,
    mode: Mode,
    controls: &[f64],
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
        text += &format!("{control:>10.4} ");
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
