//! Report of a broken rule: rule, component, stretches, both values, and a remedy in the author's notation.

use std::error::Error;
use std::fmt;

use super::Rule;

/// Notation in which an energy is declared, and in which the remedies of its violations are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Notation {
    /// Rust: the arguments of [`material`](macro@crate::material) and of [`contract!`](crate::contract!).
    #[default]
    Rust,
    /// A formula, as the command `piola` and the Python package read it: conditions follow `where`.
    Formula,
}

impl Notation {
    /// One of two texts: for declarations in Rust, and for formulas.
    pub(super) fn either(self, rust: &'static str, formula: &'static str) -> &'static str {
        match self {
            Self::Rust => rust,
            Self::Formula => formula,
        }
    }

    /// Advice to leave out large stretches.
    pub(super) fn narrower(self) -> &'static str {
        self.either(
            "narrow the stretches of the test, as in `range: (0.7, 1.4)`",
            "exclude large stretches by a condition after the formula, such as `where J > 0, I1 < 9`",
        )
    }
}

/// A broken rule of the contract, in words, with the values that break it.
///
/// The text has a line for the rule, one for each of the facts and, where one is known, one for the remedy:
///
/// ```text
/// quotients: flips and twists keep their digits at every gap between stretches, zero included
///     component   flip of stretches 1 and 2, which are 1e-9 of their mean apart
///     stretches   1.50000000075, 1.49999999925, 0.5
///     found       0e0
///     expected    2e0
///     difference  2.0e0, of which rounding explains 1.0e-14
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// The rule.
    pub rule: Rule,
    /// True if an energy, or a derivative of it, is infinite or NaN inside its domain.
    pub(super) is_not_finite: bool,
    /// The lines below that of the rule.
    pub(super) facts: String,
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { rule, facts, .. } = self;
        write!(f, "{rule}: {}\n{facts}", rule.promise())
    }
}

impl Error for Violation {}

/// All broken rules, each with the first violation that was found.
///
/// Hardly any rule holds for an energy that is infinite or NaN inside its domain. The text describes this
/// cause alone, and names the rules that break with it in a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Violations(pub Vec<Violation>);

impl fmt::Display for Violations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_finite = !self.0.iter().any(|violation| violation.is_not_finite);
        // The rest state is judged on its own.
        let is_told = |violation: &&Violation| {
            is_finite || matches!(violation.rule, Rule::Rest | Rule::Domain | Rule::Moduli)
        };
        let (told, others): (Vec<_>, Vec<_>) = self.0.iter().partition(is_told);
        let told = told.iter().map(ToString::to_string).collect::<Vec<_>>();
        f.write_str(&told.join("\n"))?;
        if others.is_empty() {
            return Ok(());
        }
        let others = others.iter().map(|violation| violation.rule.to_string()).collect::<Vec<_>>();
        write!(f, "\nnot judged, because the energy is not finite: {}", others.join(", "))
    }
}

impl Error for Violations {}
