//! `piola fit`: parameters of a material from measured curves.

use std::fmt;
use std::path::PathBuf;

use piola::Inversion;
use piola_laboratory::chart::Curve;
use piola_laboratory::curve::{Mode, Volume, sweep};
use piola_laboratory::fit::{self, Candidate, Difference, Fit, Standing, Warning};

use super::curve::titled;
use super::{FINE, Source, as_options, draw, measured_range, rounded, spaced};
use crate::energy::Energy;
use crate::error::Error;

/// What to fit.
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// The material with the parameters to start from.
    pub energy: Energy,
    /// The measured points.
    pub data: Source,
    /// Whether the volume is kept; if nothing is said, it is unless a volumetric test was made.
    pub volume: Option<Volume>,
    /// What is made small.
    pub difference: Difference,
    /// Parameters that keep their values.
    pub held: Vec<String>,
    /// How many random starts beside the one given.
    pub restarts: usize,
    /// Of these.
    pub seed: u64,
    /// Where to draw the fitted curves with the points.
    pub svg: Option<PathBuf>,
}

/// Fits parameters and draws the result where that is asked for.
///
/// # Errors
/// Where material or data make no sense or do not go together, or the chart cannot be written.
pub fn fit(settings: &FitSettings) -> Result<FitReport, Error> {
    let energy = settings.energy.clone().inverting(Inversion::Refuse);
    let material = energy.build()?.name;
    let candidate = energy.candidate()?;
    let data = settings.data.read()?;
    let is_volumetric = data.modes().any(|mode| mode == Mode::Volumetric);
    let volume = settings.volume.unwrap_or(if is_volumetric { Volume::Free } else { Volume::Kept });
    let how = fit::FitSettings::default()
        .with_volume(volume)
        .with_difference(settings.difference)
        .with_held(&settings.held)
        .with_restarts(settings.restarts)
        .with_seed(settings.seed);
    let failure = |reason| Error::Fit { material: material.into(), reason };
    let fit = fit::fit_parameters(candidate.as_ref(), &data, &how).map_err(failure)?;
    let names: Vec<_> = candidate.description().parameters.iter().map(|parameter| parameter.name).collect();
    let report = FitReport {
        material,
        names,
        volume,
        data: settings.data.name(),
        difference: settings.difference,
        fit,
    };
    if let Some(file) = &settings.svg {
        let fitted = candidate.with_values(&report.fit.values);
        let fitted: Box<dyn Candidate> = fitted.map_err(|reason| Error::Inadmissible { material, reason })?;
        let curve = |mode| {
            let [from, to] = measured_range(&data, mode);
            Curve { mode, points: sweep(fitted.as_ref(), mode, volume, &spaced(from, to, FINE)) }
        };
        let curves: Vec<_> = data.modes().map(curve).collect();
        let note = report.options(&report.fit.values).replace("--param ", "");
        draw(file, &titled(material, volume), &note, &curves, Some((&data, &report.fit.agreement)))?;
    }
    Ok(report)
}

/// What a fit says, to be read and to be pasted.
#[derive(Clone, Debug, PartialEq)]
pub struct FitReport {
    material: &'static str,
    names: Vec<&'static str>,
    volume: Volume,
    data: String,
    difference: Difference,
    fit: Fit,
}

impl FitReport {
    fn options(&self, values: &[Vec<f64>]) -> String {
        as_options(self.names.iter().copied().zip(values.iter().map(Vec::as_slice)))
    }
}

impl fmt::Display for FitReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fit = &self.fit;
        let kind = match self.difference {
            Difference::Relative => "relative differences",
            Difference::Absolute => "differences by the greatest stress",
        };
        writeln!(f, "{}, fitted to {} by {kind}", titled(self.material, self.volume), self.data)?;
        writeln!(f, "  {}", self.options(&fit.values))?;
        for number in &fit.numbers {
            let value = rounded(number.value);
            write!(f, "  {:12} {value:<14}", number.name)?;
            match (number.standing, number.error) {
                (Standing::Free, Some(error)) => {
                    writeln!(f, " ± {error:.1e} ({:.1} %)", 100.0 * (error / number.value).abs())?;
                }
                (Standing::Free, None) => writeln!(f)?,
                (Standing::Held, _) => writeln!(f, " held")?,
                (Standing::Unidentifiable, _) => writeln!(f, " held: the data say nothing about it")?,
            }
        }
        writeln!(f, "  R²           {}", fit.agreement)?;
        writeln!(f, "  differences  {:.3} % (root mean square)", 100.0 * fit.difference)?;
        let start = if fit.start == 0 {
            "the parameters given".into()
        } else {
            format!("random start {}", fit.start)
        };
        writeln!(
            f,
            "  the best of {} descents, from {start}: {} after {} evaluations",
            fit.descents, fit.ended, fit.evaluations
        )?;
        for warning in &fit.warnings {
            match warning {
                Warning::OtherMinimum { values, difference, found, .. } => {
                    let options = self.options(values);
                    let [difference, found] = [difference, found].map(|difference| 100.0 * difference);
                    writeln!(
                        f,
                        "warning: another minimum has differences of {difference:.3} %, beside {found:.3} % of this one: {options}"
                    )?;
                }
                // The table says so.
                Warning::Unidentifiable { .. } => {}
                warning => writeln!(f, "warning: {warning}")?,
            }
        }
        Ok(())
    }
}
