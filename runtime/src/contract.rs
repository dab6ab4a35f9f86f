//! Rules that every [`Material`] must keep, and a macro that tests all of them in one line.
//!
//! ```
//! use piola::{Inversion, material};
//!
//! /// Rubber.
//! #[material(domain(J > 0.0), extend)]
//! pub fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! piola::contract!(rubber: Rubber::new(1e6, 5e6)?);
//! piola::contract!(
//!     extended_rubber: Rubber::new(1e6, 5e6)?.with_inversion(Inversion::Extend { epsilon: 0.1 })?,
//!     range: (0.2, 4.0),
//! );
//! # fn main() {}
//! ```
//!
//! Each [`contract!`](crate::contract!) is a module of tests, one for each rule and with its name, such as
//! `rubber::quotients`.
//! [`check`] judges all rules in one call, and [`check_rule`] a single one. [`Rule`] describes what must
//! hold.
//!
//! A material is anything that implements [`Material`], by the macro or by hand; the rules on an extension or
//! invariants apply to materials that have them. A check returns its findings or the first [`Violation`];
//! nothing is printed, and only the tests of [`contract!`](crate::contract!) panic. Samples are reproducible:
//! they follow from [`Settings::seed`]. Points that the material does not admit are left out, and a check
//! without any comparison is a violation.
//!
//! Tolerances are stated where they are used, as c·u·scale: u = 2⁻⁵³ and the scale the largest entry of the
//! tangent times the quantity that it multiplies. A backward-stable evaluation may lose this much; a wrong
//! sign or factor exceeds it by ten orders of magnitude.
//!
//! This module uses materials only through their trait, and does not repair them.

use std::fmt;

use crate::lanes::Backend;
use crate::material::{Blocks, Inversion, Material};

mod domain;
mod dual;
mod formats;
mod frames;
mod invariants;
mod inverted;
mod judge;
mod one_line;
mod pairs;
mod results;
mod rule;
mod slopes;
mod subject;
mod violation;

use domain::{domain, moduli, rest};
use formats::{lanes, single_precision};
use frames::isotropy;
use invariants::invariants;
use inverted::extension;
use pairs::quotients;
use results::SideBySide;
pub use rule::Rule;
use slopes::{dual_numbers, strains, stress_slope, tangent_slope};
#[doc(hidden)] // for energies from text
pub use violation::Notation;
pub use violation::{Violation, Violations};

use judge::{Judge, Verdict};
use subject::{OnLanes, Subject};

/// Choice of the points that are checked, and of the demands on the rest state.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Points per rule.
    pub points: usize,
    /// Seed of all random samples.
    pub seed: u64,
    /// Smallest and largest stretch to draw, 0 < smallest < 1 < largest.
    pub range: (f64, f64),
    /// True if the material claims that F = I is free of stress: `false` for one that is declared
    /// `prestressed`.
    ///
    /// ```
    /// use piola::contract::{Settings, check};
    ///
    /// /// A gel that swells.
    /// #[piola::material(domain(J > 0.0), prestressed)]
    /// pub fn Gel([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ kappa: f64) -> f64 {
    ///     mu / 2.0 * I1 + kappa / 2.0 * (J - 1.0).powi(2)
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let gel = Gel::new(1e4, 1e6)?;
    /// assert!(check(&gel, &Settings::default()).is_err());
    /// check(&gel, &Settings { stress_free_at_rest: false, ..Settings::default() })?;
    /// # Ok(())
    /// # }
    /// ```
    pub stress_free_at_rest: bool,
    /// Notation of the remedies.
    #[doc(hidden)] // for energies from text
    pub notation: Notation,
}

impl Default for Settings {
    fn default() -> Self {
        Self { points: 64, seed: 1, range: (0.4, 2.5), stress_free_at_rest: true, notation: Notation::Rust }
    }
}

/// Result of a rule that holds: its number of comparisons, and the worst of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finding {
    /// The rule.
    pub rule: Rule,
    /// Number of comparisons.
    pub comparisons: usize,
    /// The worst difference, as a fraction of its tolerance.
    pub worst: f64,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, comparisons, worst } = self;
        write!(f, "{rule}: {comparisons} comparisons, the worst at {worst:.2} of its tolerance")
    }
}

/// Findings, one for each rule that applies.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The findings, in the order of [`Rule::ALL`].
    pub findings: Vec<Finding>,
}

/// Checks every rule that applies to the material.
///
/// ```
/// # fn promise(material: &impl piola::Material) -> Result<(), piola::contract::Violations> {
/// use piola::contract::{Settings, check};
///
/// let report = check(material, &Settings { points: 16, ..Settings::default() })?;
/// assert!(report.findings.iter().all(|finding| finding.worst <= 1.0));
/// # Ok(())
/// # }
/// ```
///
/// # Errors
/// [`Violations`]: the first violation of each rule that is broken.
pub fn check(material: &impl Material, settings: &Settings) -> Result<Report, Violations> {
    report(|rule| check_rule(rule, material, settings))
}

/// Checks every rule that applies to the material, except for [`Rule::Lanes`].
///
/// [`Rule::Lanes`] compiles the material for each back end, which is wasted on materials whose lanes are
/// judged elsewhere.
///
/// # Errors
/// [`Violations`]: the first violation of each rule that is broken.
#[doc(hidden)] // for energies from text
pub fn check_without_lanes(material: &impl Material, settings: &Settings) -> Result<Report, Violations> {
    report(|rule| judge_rule(rule, material, None, settings))
}

/// Checks one rule; `None` if the material lacks its subject: an extension, invariants or stated moduli.
pub fn check_rule(
    rule: Rule,
    material: &impl Material,
    settings: &Settings,
) -> Option<Result<Finding, Violation>> {
    let on_lanes = |backend: Backend, points: &[[f64; 3]]| backend.run(SideBySide(material, points));
    judge_rule(rule, material, Some(&on_lanes), settings)
}

fn report(verdict: impl FnMut(Rule) -> Option<Result<Finding, Violation>>) -> Result<Report, Violations> {
    let mut findings = Vec::new();
    let mut violations = Vec::new();
    for verdict in Rule::ALL.into_iter().filter_map(verdict) {
        match verdict {
            Ok(finding) => findings.push(finding),
            Err(violation) => violations.push(violation),
        }
    }
    if violations.is_empty() { Ok(Report { findings }) } else { Err(Violations(violations)) }
}

/// Judges in a thread: without optimisation the kernels of wide lanes need more stack than a test has.
#[doc(hidden)] // for the tests of `contract!`
pub fn with_large_stack(
    judge: impl FnOnce() -> Result<String, String> + Send + 'static,
) -> Result<String, String> {
    let thread = std::thread::Builder::new().stack_size(1 << 26).spawn(judge);
    match thread.map_err(|error| format!("no thread for the test: {error}"))?.join() {
        Ok(verdict) => verdict,
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// [`check_rule`], compiled once for all materials; without lanes, their rule does not apply.
fn judge_rule(
    rule: Rule,
    material: &dyn Subject,
    on_lanes: Option<OnLanes<'_>>,
    settings: &Settings,
) -> Option<Result<Finding, Violation>> {
    let judge = &mut Judge::new(rule, material, settings);
    let verdict = match rule {
        Rule::Rest => rest(judge),
        Rule::Domain => domain(judge),
        Rule::Isotropy => isotropy(judge),
        Rule::StressSlope => stress_slope(judge),
        Rule::TangentSlope => tangent_slope(judge),
        Rule::DualNumbers => dual_numbers(judge),
        Rule::Quotients => quotients(judge),
        Rule::Strains => strains(judge),
        Rule::Invariants if !material.has_invariants() => return None,
        Rule::Invariants => invariants(judge),
        Rule::Extension => match material.inversion() {
            Inversion::Refuse => return None,
            Inversion::Extend { epsilon } => extension(judge, epsilon),
        },
        Rule::Moduli => moduli(judge, material.stated_moduli()?),
        Rule::SinglePrecision => single_precision(judge),
        Rule::Lanes => lanes(judge, on_lanes?),
    };
    Some(verdict.and_then(|()| judge.finding()))
}

/// u of `f64`, in which the contract is judged.
const UNIT: f64 = f64::EPSILON / 2.0;

/// The entries of the tangent: Hessian, flips and twists.
fn entries(blocks: &Blocks<f64>) -> impl Iterator<Item = f64> + use<> {
    blocks.hessian.into_iter().chain(blocks.flip).chain(blocks.twist)
}

/// The largest entry of the tangent, which multiplies an error of the stretches.
fn stiffness(blocks: &Blocks<f64>) -> f64 {
    entries(blocks).fold(0.0, |largest, entry| largest.max(entry.abs()))
}

/// Tolerable error of a stress in units of u, Pa: the tangent times the stretches, and its own size.
fn stress_scale(blocks: &Blocks<f64>, stretches: [f64; 3]) -> f64 {
    stiffness(blocks) * stretches[0] + blocks.gradient.into_iter().map(f64::abs).sum::<f64>()
}

fn gradient_name(k: usize) -> String {
    format!("derivative of the energy by stretch {}", k + 1)
}

fn hessian_name(entry: usize) -> String {
    match slopes::ENTRIES[entry] {
        (i, j) if i == j => format!("second derivative of the energy by stretch {}", i + 1),
        (i, j) => format!("second derivative of the energy by stretches {} and {}", i + 1, j + 1),
    }
}

fn pair_name(quotient: &str, pair: usize) -> String {
    let (i, j) = crate::material::PAIRS[pair];
    format!("{quotient} of stretches {} and {}", i + 1, j + 1)
}

#[cfg(test)]
mod tests;
