//! Where a material is stable, before a body made of it finds out.
//!
//! An energy that fits its measurements may still be one that no solid has: a specimen of it would narrow under a growing
//! pull, or fold into bands as fine as the mesh allows. Three inequalities say where that cannot be, [`Criterion`]; [`survey`]
//! looks at them over a box of stretches and along the tests that laboratories make:
//!
//! ```
//! use piola_laboratory::stability::{Criterion, Path, Settings, survey};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let solid = piola_materials::StVenantKirchhoff::new(1.0, 0.0)?;
//! let report = survey(&solid, &Settings::default())?;
//! let crushed = report.walk(Path::Confined, 0.3).and_then(|walk| walk.lost(Criterion::StrongEllipticity));
//! // An oblique wave stands still a little before the tangent ψ11 = μ (3 λ1² − 1) vanishes.
//! assert!(crushed.is_some_and(|stretch| (stretch - (2.0 - 2f64.sqrt())).abs() < 1e-8));
//! # Ok(())
//! # }
//! ```
//!
//! The stretches are positive: inverted states are not looked at. By isotropy, ordered ones are enough. Between the points of
//! the box nothing is known, and a stable solid may still buckle: that depends on the body.
//!
//! [`criteria`] has the inequalities and how they imply each other; [`wave`] tells how strong ellipticity is decided without
//! a search.

pub mod criteria;
mod display;
mod map;
mod path;
pub mod wave;

use std::fmt;

use piola::material::Moduli;

use crate::Specimen;

pub use criteria::{Criterion, Judgement};
pub use map::{NoMap, Plane, map};
pub use path::{Path, Walk};
pub use wave::{Wave, slowest};

/// Which stretches are looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// The least stretch, above 0 and below 1.
    pub from: f64,
    /// The greatest stretch, above 1.
    pub to: f64,
    /// Stretches along each axis of the box, in equal steps of their logarithm, 2 … 400.
    pub resolution: usize,
}

impl Default for Settings {
    /// 0.3 … 3 in steps of 6 %.
    fn default() -> Self {
        Self { from: 0.3, to: 3.0, resolution: 41 }
    }
}

/// What a survey finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Which stretches were looked at.
    pub settings: Settings,
    /// Moduli at rest, in whose μ others are shown.
    pub moduli: Moduli,
    /// Points of the box, λ1 ≥ λ2 ≥ λ3.
    pub points: usize,
    /// How many of them the material admits.
    pub admitted: usize,
    /// One for each of [`Criterion::ALL`].
    pub findings: [Finding; 3],
    /// Two for each of [`Path::ALL`], towards smaller and towards larger stretches.
    pub walks: Vec<Walk>,
}

/// What became of a criterion in the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The criterion.
    pub criterion: Criterion,
    /// Points of the box that are admitted and keep it.
    pub kept: usize,
    /// Where its modulus is least; `None` where no point is admitted.
    pub worst: Option<Judgement>,
}

/// Why nothing can be said.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoSurvey {
    /// The range of stretches does not contain the rest state.
    Range {
        /// The least stretch as given.
        from: f64,
        /// The greatest stretch as given.
        to: f64,
    },
    /// Too few or too many stretches along an axis.
    Resolution {
        /// As given.
        resolution: usize,
    },
    /// The rest state is not admitted, or its shear modulus, in which all others are shown, is not positive.
    Rest {
        /// The shear modulus, Pa; NaN where the rest state is not admitted.
        mu: f64,
    },
}

impl fmt::Display for NoSurvey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range { from, to } => {
                write!(
                    f,
                    "the stretches are from {from} to {to}; they must satisfy 0 < from < 1 < to, with the rest state inside"
                )
            }
            Self::Resolution { resolution } => {
                write!(f, "the resolution is {resolution}; it must be from {} to {}", LIMITS.0, LIMITS.1)
            }
            Self::Rest { mu } => {
                write!(
                    f,
                    "the shear modulus at rest is {mu} Pa and must be positive: no solid has this energy"
                )
            }
        }
    }
}

impl std::error::Error for NoSurvey {}

/// Of [`Settings::resolution`]: 400 are 10.7 million points.
const LIMITS: (usize, usize) = (2, 400);

/// Looks at a material over a box of stretches and along paths.
///
/// # Errors
/// Where the settings make no sense, or the material none at rest.
pub fn survey(specimen: &dyn Specimen, settings: &Settings) -> Result<Report, NoSurvey> {
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
    let walks = Walk::all(specimen, settings);
    Ok(Report { settings: *settings, moduli, points, admitted, findings, walks })
}

impl Report {
    /// The walk along a path to one end of the range.
    #[must_use]
    pub fn walk(&self, path: Path, to: f64) -> Option<&Walk> {
        self.walks.iter().find(|walk| walk.path == path && walk.to == to)
    }
}

impl Settings {
    fn check(&self) -> Result<(), NoSurvey> {
        let Self { from, to, resolution } = *self;
        if !(0.0 < from && from < 1.0 && 1.0 < to && to.is_finite()) {
            return Err(NoSurvey::Range { from, to });
        }
        if !(LIMITS.0..=LIMITS.1).contains(&resolution) {
            return Err(NoSurvey::Resolution { resolution });
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

    /// So many stretches from one end of the range to the other, in equal steps of their logarithm.
    fn stretches(&self, count: usize) -> Vec<f64> {
        let share = |k: usize| k as f64 / (count - 1) as f64;
        let mut stretches: Vec<f64> =
            (0..count).map(|k| self.from * (self.to / self.from).powf(share(k))).collect();
        // The ends are as given.
        stretches[count - 1] = self.to;
        stretches
    }
}

/// μ = (ψ11 − ψ12)/2 and λ = ψ12 at F = I.
fn at_rest(specimen: &dyn Specimen) -> Result<Moduli, NoSurvey> {
    let [h11, _, _, h12, ..] = specimen.blocks([1.0; 3]).hessian;
    let mu: f64 = if specimen.admits([1.0; 3]) { 0.5 * (h11 - h12) } else { f64::NAN };
    if mu > 0.0 && mu.is_finite() { Ok(Moduli { mu, lambda: h12 }) } else { Err(NoSurvey::Rest { mu }) }
}
