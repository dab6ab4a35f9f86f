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

/// Expectation of a violation where a value is infinite or NaN.
pub(super) const FINITE: &str = "a finite number";

/// A broken rule of the contract, with the values that break it.
///
/// As text it has a line for the rule, one for each of the facts and, where one is known, one for the remedy:
///
/// ```
/// use piola::contract::{Rule, Violation};
///
/// let violation = Violation::Differs {
///     rule: Rule::Quotients,
///     component: "flip of stretches 1 and 2, which are 1e-9 of their mean apart".into(),
///     stretches: [1.50000000075, 1.49999999925, 0.5],
///     found: 0.0,
///     expected: 2.0,
///     tolerance: 1e-14,
///     remedy: None,
/// };
/// let text = "\
/// quotients: flips and twists keep their digits at every gap between stretches, zero included
///     component   flip of stretches 1 and 2, which are 1e-9 of their mean apart
///     stretches   1.50000000075, 1.49999999925, 0.5
///     found       0e0
///     expected    2e0
///     difference  2.0e0, of which rounding explains 1.0e-14";
/// assert_eq!(violation.to_string(), text);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Violation {
    /// Two values that must agree differ.
    Differs {
        /// The rule.
        rule: Rule,
        /// Name of the quantity that was compared, such as `flip of stretches 1 and 2`.
        component: String,
        /// Stretches λ1, λ2, λ3 at which the rule was judged.
        stretches: [f64; 3],
        /// The material's value.
        found: f64,
        /// The value that the rule demands.
        expected: f64,
        /// The difference that rounding explains; zero where both must have the same bits.
        tolerance: f64,
        /// Advice on what to write instead, if any.
        remedy: Option<String>,
    },
    /// A value that must be positive, negative or finite is not.
    WrongKind {
        /// The rule.
        rule: Rule,
        /// Name of the quantity that was judged.
        component: String,
        /// Stretches λ1, λ2, λ3 at which the rule was judged.
        stretches: [f64; 3],
        /// The material's value.
        found: f64,
        /// The kind of value that the rule demands, such as `a positive number`.
        expected: &'static str,
        /// Advice on what to write instead, if the rule has any.
        remedy: Option<String>,
    },
    /// The material admits none of the points at which the rule looks.
    NothingToCheck {
        /// The rule.
        rule: Rule,
    },
}

impl Violation {
    /// The rule that is broken.
    #[must_use]
    pub(super) fn rule(&self) -> Rule {
        match self {
            Self::Differs { rule, .. } | Self::WrongKind { rule, .. } | Self::NothingToCheck { rule } => {
                *rule
            }
        }
    }
}

impl fmt::Display for Violation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rule = self.rule();
        writeln!(f, "{rule}: {}", rule.promise())?;
        let (Self::Differs { component, stretches: [l1, l2, l3], found, remedy, .. }
        | Self::WrongKind { component, stretches: [l1, l2, l3], found, remedy, .. }) = self
        else {
            return f.write_str(
                "    the material admits none of the points at which this is judged: choose other parameters or a wider \
                 domain, or another `range` or more `points` of the settings",
            );
        };
        writeln!(f, "    component   {component}\n    stretches   {l1}, {l2}, {l3}")?;
        write!(f, "    found       {found:e}")?;
        // A difference, or a remedy for a sign, is useless for values that are infinite or NaN.
        let see_domain = "not a finite number, here or near by, but an overflow, or a root, real power or logarithm of something \
                          negative; see the rule `domain`";
        match self {
            Self::Differs { expected, tolerance, .. } => {
                let difference = (found - expected).abs();
                if difference.is_nan() || tolerance.is_nan() {
                    return write!(f, ", where {expected:e} is expected: {see_domain}");
                }
                write!(f, "\n    expected    {expected:e}\n    difference  {difference:.1e}, ")?;
                if *tolerance == 0.0 {
                    return f.write_str("where both must have the same bits");
                }
                write!(f, "of which rounding explains {tolerance:.1e}")?;
            }
            Self::WrongKind { expected, .. } if found.is_nan() && *expected != FINITE => {
                return write!(f, ", where {expected} is expected: {see_domain}");
            }
            Self::WrongKind { expected, .. } => write!(f, "\n    expected    {expected}")?,
            Self::NothingToCheck { .. } => {}
        }
        remedy.as_ref().map_or(Ok(()), |remedy| write!(f, "\n    remedy      {remedy}"))
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
        let is_cause = |violation: &Violation| {
            matches!(violation, Violation::WrongKind { rule: Rule::Domain, expected: FINITE, .. })
        };
        let is_finite = !self.0.iter().any(is_cause);
        // The rest state is judged on its own.
        let is_told = |violation: &&Violation| {
            is_finite || matches!(violation.rule(), Rule::Rest | Rule::Domain | Rule::Moduli)
        };
        let (told, others): (Vec<_>, Vec<_>) = self.0.iter().partition(is_told);
        let told = told.iter().map(ToString::to_string).collect::<Vec<_>>();
        f.write_str(&told.join("\n"))?;
        if others.is_empty() {
            return Ok(());
        }
        let others = others.iter().map(|violation| violation.rule().to_string()).collect::<Vec<_>>();
        write!(f, "\nnot judged, because the energy is not finite: {}", others.join(", "))
    }
}

impl Error for Violations {}
