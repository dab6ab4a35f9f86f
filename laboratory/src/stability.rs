//! Stability of a material: the stretches at which it keeps the inequalities of a stable solid.
//!
//! An energy that fits its measurements may still be one that no solid has: a specimen of it would narrow
//! under a growing pull, or fold into bands as fine as the mesh allows. Three inequalities exclude that,
//! [`Criterion`]; [`survey`] evaluates them over a box of stretches and along the tests that laboratories
//! make:
//!
//! ```
//! use piola_laboratory::stability::criteria::Criterion;
//! use piola_laboratory::stability::{Path, SurveySettings, survey};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let solid = piola_materials::StVenantKirchhoff::new(1.0, 0.0)?;
//! let report = survey(&solid, &SurveySettings::default())?;
//! let crushed = report.walks.iter().find(|walk| walk.path == Path::Confined && walk.to == 0.3);
//! let lost = crushed.and_then(|walk| walk.lost[Criterion::StrongEllipticity as usize]);
//! // An oblique wave stands still a little before the tangent ψ11 = μ (3 λ1² − 1) vanishes.
//! assert!(lost.is_some_and(|stretch| (stretch - (2.0 - 2f64.sqrt())).abs() < 1e-8));
//! # Ok(())
//! # }
//! ```
//!
//! The stretches are positive: inverted states are not surveyed. By isotropy, ordered ones are enough.
//! Nothing is checked between the points of the box, and a stable solid may still buckle: that depends on the
//! body.
//!
//! [`constant_volume`] does the same for incompressible solids.
//!
//! [`criteria`] has the inequalities and the implications between them; [`wave`] derives a test of strong
//! ellipticity without a search.

pub mod constant_volume;
pub mod criteria;
mod display;
mod path;
pub mod wave;

use piola::__private::message::number;
use piola::material::Moduli;

use crate::{Specimen, specimen};
use criteria::{Criterion, Judgement};

pub use path::{Path, Walk};

/// Range of stretches that a survey covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurveySettings {
    /// The least stretch, from 10⁻⁶ to below 1.
    pub from: f64,
    /// The greatest stretch, above 1 and up to 10⁶.
    pub to: f64,
    /// Stretches along each axis of the box, in equal steps of their logarithm, 2 … 400.
    pub resolution: usize,
}

impl Default for SurveySettings {
    /// 0.3 … 3 in steps of 6 %.
    fn default() -> Self {
        Self { from: 0.3, to: 3.0, resolution: 41 }
    }
}

/// The result of a survey.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Range of stretches that was surveyed.
    pub settings: SurveySettings,
    /// Moduli at rest, in whose μ others are shown.
    pub moduli: Moduli,
    /// Points of the box, λ1 ≥ λ2 ≥ λ3.
    pub points: usize,
    /// Number of points that the material admits.
    pub admitted: usize,
    /// One for each of [`Criterion::ALL`].
    pub findings: [Finding; 3],
    /// Two for each of [`Path::ALL`], towards smaller and towards larger stretches.
    pub walks: Vec<Walk>,
}

/// A criterion in the box of stretches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The criterion.
    pub criterion: Criterion,
    /// Points of the box that are admitted and keep it.
    pub kept: usize,
    /// Point at which its modulus is least; `None` if no point is admitted.
    pub worst: Option<Judgement>,
}

/// Reason why a material cannot be surveyed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct SurveyError(String);

/// Limits of the stretches: a chain of a million links straightens by a factor of a thousand, and powers of
/// these are far from overflow.
const STRETCHES: (f64, f64) = (1e-6, 1e6);

/// Limits of [`SurveySettings::resolution`]: 400 are 10.7 million points.
const LIMITS: (usize, usize) = (2, 400);

/// Surveys a material over a box of stretches and along paths.
///
/// # Errors
/// [`SurveyError`] if the settings are out of range, or the material has no positive shear modulus at rest.
pub fn survey(specimen: &dyn Specimen<f64>, settings: &SurveySettings) -> Result<Report, SurveyError> {
    settings.check()?;
    let moduli = at_rest(specimen)?;
    let (mut points, mut admitted) = (0, 0);
    let mut findings = Criterion::ALL.map(|criterion| Finding { criterion, kept: 0, worst: None });
    for stretches in settings.triples() {
        points += 1;
        let Some(judgement) = Judgement::of(specimen, stretches) else { continue };
        admitted += 1;
        for (k, finding) in findings.iter_mut().enumerate() {
            finding.kept += usize::from(judgement.kept[k]);
            if finding.worst.is_none_or(|worst| judgement.moduli[k] < worst.moduli[k]) {
                finding.worst = Some(judgement);
            }
        }
    }
    let both = |path| [settings.from, settings.to].map(|to| Walk::along(path, specimen, to));
    let walks = Path::ALL.into_iter().flat_map(both).collect();
    Ok(Report { settings: *settings, moduli, points, admitted, findings, walks })
}

impl SurveySettings {
    pub(crate) fn check(&self) -> Result<(), SurveyError> {
        let Self { from, to, resolution } = *self;
        if !(STRETCHES.0 <= from && from < 1.0 && 1.0 < to && to <= STRETCHES.1) {
            return Err(SurveyError(format!(
                "the stretches are from {} to {}; they must be at least {:e} and at most {:e}, with the rest state, 1, \
                 between them",
                number(from),
                number(to),
                STRETCHES.0,
                STRETCHES.1
            )));
        }
        if !(LIMITS.0..=LIMITS.1).contains(&resolution) {
            let (least, most) = LIMITS;
            return Err(SurveyError(format!(
                "the resolution is {resolution}; it must be from {least} to {most}"
            )));
        }
        Ok(())
    }

    /// λ1 ≥ λ2 ≥ λ3 in equal steps of their logarithms.
    fn triples(&self) -> impl Iterator<Item = [f64; 3]> {
        let stretches = self.stretches(self.resolution);
        let n = stretches.len();
        let indices = (0..n).flat_map(|i| (0..=i).flat_map(move |j| (0..=j).map(move |k| [i, j, k])));
        indices.map(move |indices| indices.map(|index| stretches[index]))
    }

    /// `count` stretches from one end of the range to the other, in equal steps of their logarithm.
    pub(crate) fn stretches(&self, count: usize) -> Vec<f64> {
        let share = |k: usize| k as f64 / (count - 1) as f64;
        let mut stretches: Vec<f64> =
            (0..count).map(|k| self.from * (self.to / self.from).powf(share(k))).collect();
        // The ends are as given.
        stretches[count - 1] = self.to;
        stretches
    }
}

/// The moduli at rest, of which the shear modulus is positive.
fn at_rest(specimen: &dyn Specimen<f64>) -> Result<Moduli, SurveyError> {
    let moduli = specimen::moduli(specimen);
    let mu = if specimen.admits([1.0; 3]) { moduli.mu } else { f64::NAN };
    if mu > 0.0 && mu.is_finite() {
        return Ok(moduli);
    }
    let mu = number(mu);
    Err(SurveyError(format!(
        "the shear modulus at rest is {mu} Pa and must be positive: no solid has this energy"
    )))
}
