//! What every [`Material`] promises, as checks that a crate declaring one can run in its own tests.
//!
//! ```
//! # use piola::contract::{Settings, Violation, check};
//! # fn promise(material: &impl piola::Material) -> Result<(), Violation> {
//! check(material, &Settings::default())?;
//! # Ok(())
//! # }
//! ```
//!
//! The rules, each also a function of its own:
//!
//! | rule | what must hold |
//! |---|---|
//! | [`rest`] | no stress, no twist at F = I, and a positive shear modulus |
//! | [`objectivity`] | rotating space rotates the stress: P(Q F) = Q P(F), ψ(Q F) = ψ(F) |
//! | [`isotropy`] | rotating the rest shape does likewise, and equal stretches are interchangeable |
//! | [`symmetric_tangent`] | A : (dP/dF) B = B : (dP/dF) A |
//! | [`stress_slope`] | difference quotients of ψ approach P as h² |
//! | [`tangent_slope`] | difference quotients of P approach dP/dF as h² |
//! | [`quotients`] | flips and twists are accurate at every gap, 10⁻¹ … 10⁻¹⁶ and 0 |
//! | [`extension`] | P and dP/dF are exact beside the threshold, across it and deep below, where ψ drives inverted material back |
//! | [`moduli`] | the small-strain moduli that a declaration states are those of its Hessian |
//!
//! A check returns what it found or the first [`Violation`]; nothing is printed, nothing panics. Samples are
//! reproducible: they follow from [`Settings::seed`]. Points that the material does not admit are left out, and a
//! check that could not compare anything says so.
//!
//! Tolerances are stated where they are used, as c·u·scale: u = 2⁻⁵³ and the scale the largest entry of the tangent
//! times the quantity it multiplies. That is what a backward-stable evaluation may lose; a wrong sign or factor
//! exceeds it by ten orders of magnitude.
//!
//! This module knows materials only through their trait, and no way to repair them.

use std::fmt;

use crate::material::{Blocks, Declared, Material};

mod evaluation;
mod frames;
mod inverted;
mod pairs;
mod samples;
mod slopes;

pub use frames::{isotropy, objectivity, symmetric_tangent};
pub use inverted::extension;
pub use pairs::quotients;
pub use slopes::{stress_slope, tangent_slope};

/// Which points are checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Points per rule.
    pub points: usize,
    /// Determines all samples.
    pub seed: u64,
    /// Stretches are drawn between these, 0 < smallest < 1 < largest.
    pub range: (f64, f64),
    /// The `epsilon` of [`Inversion::Extend`](crate::Inversion::Extend), where the material was built with it.
    pub threshold: Option<f64>,
    /// Whether the material claims that F = I is free of stress.
    pub stress_free_at_rest: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self { points: 64, seed: 1, range: (0.4, 2.5), threshold: None, stress_free_at_rest: true }
    }
}

/// A rule of the contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rule {
    /// See [`rest`].
    Rest,
    /// See [`objectivity`].
    Objectivity,
    /// See [`isotropy`].
    Isotropy,
    /// See [`symmetric_tangent`].
    SymmetricTangent,
    /// See [`stress_slope`].
    StressSlope,
    /// See [`tangent_slope`].
    TangentSlope,
    /// See [`quotients`].
    Quotients,
    /// See [`extension`].
    Extension,
    /// See [`moduli`].
    Moduli,
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rest => "rest",
            Self::Objectivity => "objectivity",
            Self::Isotropy => "isotropy",
            Self::SymmetricTangent => "symmetric tangent",
            Self::StressSlope => "slope of the energy",
            Self::TangentSlope => "slope of the stress",
            Self::Quotients => "quotients",
            Self::Extension => "extension",
            Self::Moduli => "moduli",
        })
    }
}

/// A broken promise.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Violation {
    /// Two values that must agree don't.
    Differs {
        /// The rule.
        rule: Rule,
        /// What was compared, such as `flip of stretches 1 and 2`.
        component: String,
        /// Where.
        stretches: [f64; 3],
        /// The material's value.
        found: f64,
        /// What the rule demands.
        expected: f64,
        /// The difference that rounding explains.
        tolerance: f64,
    },
    /// A value that must be positive, or negative, isn't.
    WrongSign {
        /// The rule.
        rule: Rule,
        /// What was looked at.
        component: String,
        /// Where.
        stretches: [f64; 3],
        /// The material's value.
        found: f64,
    },
    /// The material admits none of the sampled points.
    NothingToCheck {
        /// The rule.
        rule: Rule,
    },
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Differs { rule, component, stretches: [l1, l2, l3], found, expected, tolerance } => write!(
                f,
                "{rule}: the {component} at stretches ({l1}, {l2}, {l3}) is {found:e} and should be {expected:e}; \
                 rounding explains a difference of {tolerance:.0e}"
            ),
            Self::WrongSign { rule, component, stretches: [l1, l2, l3], found } => write!(
                f,
                "{rule}: the {component} at stretches ({l1}, {l2}, {l3}) is {found:e}, which has the wrong sign"
            ),
            Self::NothingToCheck { rule } => {
                write!(f, "{rule}: the material admits none of the sampled stretches; widen `range`")
            }
        }
    }
}

impl std::error::Error for Violation {}

/// What a kept rule was judged on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: Rule,
    /// Number of comparisons.
    pub comparisons: usize,
    /// The worst difference, as a fraction of its tolerance.
    pub worst: f64,
}

/// Findings, one for each rule that applies.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// In the order of the table above.
    pub findings: Vec<Finding>,
}

/// Checks every rule that needs no more than the [`Material`], the extension only where [`Settings::threshold`] is
/// given.
///
/// # Errors
/// The first violation.
pub fn check(material: &impl Material, settings: &Settings) -> Result<Report, Violation> {
    let mut findings = vec![
        rest(material, settings)?,
        objectivity(material, settings)?,
        isotropy(material, settings)?,
        symmetric_tangent(material, settings)?,
        stress_slope(material, settings)?,
        tangent_slope(material, settings)?,
        quotients(material, settings)?,
    ];
    if let Some(epsilon) = settings.threshold {
        findings.push(extension(material, settings, epsilon)?);
    }
    Ok(Report { findings })
}

/// At F = I: no stress (where claimed), twists of zero, flips of ψ11 − ψ12 = 2μ > 0.
///
/// # Errors
/// The first violation.
pub fn rest(material: &impl Material, settings: &Settings) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Rest);
    let stretches = [1.0; 3];
    let blocks = material.blocks(stretches);
    let tolerance = 64.0 * UNIT * stiffness(&blocks);
    for k in 0..3 {
        if settings.stress_free_at_rest {
            judge.compare(|| gradient_name(k), stretches, blocks.gradient[k], 0.0, tolerance)?;
            judge.compare(|| pair_name("twist", k), stretches, blocks.twist[k], 0.0, tolerance)?;
        }
        let shear = blocks.hessian[0] - blocks.hessian[3];
        judge.compare(|| pair_name("flip", k), stretches, blocks.flip[k], shear, tolerance)?;
        judge.positive(|| pair_name("flip", k), stretches, blocks.flip[k])?;
    }
    judge.finding()
}

/// The stated small-strain moduli are μ = (ψ11 − ψ12)/2 and λ = ψ12 at F = I.
///
/// # Errors
/// The first violation.
pub fn moduli(material: &impl Declared) -> Result<Finding, Violation> {
    let mut judge = Judge::new(Rule::Moduli);
    let stretches = [1.0; 3];
    let blocks = material.blocks(stretches);
    let stated = material.moduli();
    let tolerance = 64.0 * UNIT * stiffness(&blocks);
    let shear = 0.5 * (blocks.hessian[0] - blocks.hessian[3]);
    judge.compare(|| "shear modulus".into(), stretches, stated.mu, shear, tolerance)?;
    judge.compare(
        || "first Lamé parameter".into(),
        stretches,
        stated.lambda,
        blocks.hessian[3],
        tolerance,
    )?;
    judge.finding()
}

/// u of `f64`, in which the contract is judged.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The largest entry of the tangent: what multiplies an error of the stretches.
fn stiffness(blocks: &Blocks<f64>) -> f64 {
    let entries = blocks.hessian.into_iter().chain(blocks.flip).chain(blocks.twist);
    entries.fold(0.0, |largest, entry| largest.max(entry.abs()))
}

/// What a stress may be wrong by, in units of u: the tangent times the stretches, and its own size.
fn stress_scale(blocks: &Blocks<f64>, stretches: [f64; 3]) -> f64 {
    stiffness(blocks) * stretches[0] + blocks.gradient.into_iter().map(f64::abs).sum::<f64>()
}

fn gradient_name(k: usize) -> String {
    format!("derivative of the energy by stretch {}", k + 1)
}

fn pair_name(quotient: &str, pair: usize) -> String {
    let (i, j) = crate::material::PAIRS[pair];
    format!("{quotient} of stretches {} and {}", i + 1, j + 1)
}

/// Counts comparisons and stops at the first that fails.
struct Judge {
    rule: Rule,
    comparisons: usize,
    worst: f64,
}

impl Judge {
    fn new(rule: Rule) -> Self {
        Self { rule, comparisons: 0, worst: 0.0 }
    }

    fn compare(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        expected: f64,
        tolerance: f64,
    ) -> Result<(), Violation> {
        let difference = (found - expected).abs();
        self.comparisons += 1;
        // A NaN on either side is no agreement.
        if difference <= tolerance {
            if difference > 0.0 {
                self.worst = self.worst.max(difference / tolerance);
            }
            return Ok(());
        }
        let (rule, component) = (self.rule, component());
        Err(Violation::Differs { rule, component, stretches, found, expected, tolerance })
    }

    fn positive(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
    ) -> Result<(), Violation> {
        self.comparisons += 1;
        if found > 0.0 {
            return Ok(());
        }
        Err(Violation::WrongSign { rule: self.rule, component: component(), stretches, found })
    }

    fn finding(self) -> Result<Finding, Violation> {
        let Self { rule, comparisons, worst } = self;
        if comparisons == 0 {
            return Err(Violation::NothingToCheck { rule });
        }
        Ok(Finding { rule, comparisons, worst })
    }
}

#[cfg(test)]
mod tests;
