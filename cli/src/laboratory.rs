//! A material of the catalogue on the bench: what `piola curve`, `piola fit` and `piola check` do.

mod check;
mod curve;
mod fit;

use std::fs;
use std::path::{Path, PathBuf};

use piola_laboratory::chart::{self, Curve};
use piola_laboratory::curve::Mode;
use piola_laboratory::data::{Agreement, Measurements, TRELOAR_1944};

use piola_scenes::error::Error;
use piola_scenes::output::write_whole;

pub(crate) use check::{CheckSettings, check};
pub(crate) use curve::{CurveSettings, curve};
pub(crate) use fit::{FitSettings, fit};

/// Where measured points come from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Source {
    /// [`TRELOAR_1944`].
    Treloar,
    /// A file.
    File(PathBuf),
}

impl From<&str> for Source {
    fn from(text: &str) -> Self {
        if text.eq_ignore_ascii_case("treloar") { Self::Treloar } else { Self::File(text.into()) }
    }
}

impl Source {
    fn read(&self) -> Result<Measurements, Error> {
        let path = match self {
            Self::Treloar => {
                return Measurements::read(TRELOAR_1944)
                    .map_err(|error| Error::File { reason: error.to_string() });
            }
            Self::File(path) => path,
        };
        let text = fs::read_to_string(path).map_err(|error| Error::File {
            reason: format!("{} cannot be read: {error}; give a file, or `treloar`", path.display()),
        })?;
        Measurements::read(&text).map_err(|error| Error::File {
            reason: format!("{}:{}: {}", path.display(), error.line, error.fault),
        })
    }

    fn name(&self) -> String {
        match self {
            Self::Treloar => "treloar".into(),
            Self::File(path) => path.display().to_string(),
        }
    }
}

/// The values of all parameters as options of the command line, with seven digits.
fn as_options<'a>(parameters: impl Iterator<Item = (&'a str, &'a [f64])>) -> String {
    let options = parameters.map(|(name, values)| {
        let values: Vec<_> = values.iter().map(|&value| rounded(value).to_string()).collect();
        format!("--param {name}={}", values.join(","))
    });
    options.collect::<Vec<_>>().join(" ")
}

/// To seven digits, so that rounding changes no stress that is measured.
fn rounded(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// This many numbers from one to another, evenly.
fn spaced(from: f64, to: f64, count: usize) -> Vec<f64> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(|k| from + (to - from) * (k as f64 / last)).collect()
}

/// From the least control to the greatest that was measured in a mode, rest included.
fn measured_range(data: &Measurements, mode: Mode) -> [f64; 2] {
    let controls = data.of(mode).map(|point| point.control);
    controls.fold([mode.rest(); 2], |[least, greatest], control| [least.min(control), greatest.max(control)])
}

fn draw(
    file: &Path,
    title: &str,
    note: &str,
    curves: &[Curve],
    data: Option<(&Measurements, &Agreement)>,
) -> Result<(), Error> {
    let svg = chart::draw(title, note, curves, data).map_err(|reason| Error::Chart { reason })?;
    write_whole(file, svg.as_bytes())
}

/// Points of a curve in a chart: more of them would be rounded to pixels unevenly.
const FINE: usize = 81;
