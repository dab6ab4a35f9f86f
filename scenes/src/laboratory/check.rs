//! `piola check`: where a material is stable.

use std::fmt;
use std::path::PathBuf;

use piola_laboratory::stability::{Report, SurveySettings, map, survey};

use crate::energy::Energy;
use crate::error::Error;
use crate::output::write_whole;

/// What is to be checked.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckSettings {
    /// The material, every parameter given.
    pub energy: Energy,
    /// Which stretches are looked at.
    pub stretches: SurveySettings,
    /// File for the map.
    pub svg: Option<PathBuf>,
}

/// A report with the material that it is about.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckReport {
    /// Name and parameters, as they are given on the command line.
    pub material: String,
    /// ψ in one line.
    pub formula: &'static str,
    /// What was found.
    pub report: Report,
}

/// Looks at the material and writes the map where one is wanted.
///
/// # Errors
/// Where the material or the stretches make no sense, and where the file cannot be written.
pub fn check(settings: &CheckSettings) -> Result<CheckReport, Error> {
    let CheckSettings { energy, stretches, svg } = settings;
    let description = energy.description()?;
    let parameters = description.parameters.iter().map(|parameter| {
        let values: Vec<_> = energy.values_of(parameter.name).iter().map(short).collect();
        format!(" {}={}", parameter.name, values.join(","))
    });
    let material = description.name.to_owned() + &parameters.collect::<String>();
    let specimen = energy.specimen()?;
    let refused = |reason: String| Error::Bench { reason };
    let report = survey(&*specimen, stretches).map_err(|error| refused(error.to_string()))?;
    if let Some(path) = svg {
        let picture = map(&*specimen, stretches, &material).map_err(|error| refused(error.to_string()))?;
        write_whole(path, picture.as_bytes())?;
    }
    Ok(CheckReport { material, formula: description.formula, report })
}

impl fmt::Display for CheckReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { material, formula, report } = self;
        write!(f, "{material}\n  ψ = {formula}\n\n{report}")
    }
}

/// The shorter of 2.04e5 and 204000, or the latter.
fn short(number: &f64) -> String {
    let (plain, scientific) = (number.to_string(), format!("{number:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}
