//! Compares numbers, counts, and stops at the first that is wrong.

use super::subject::{Subject, samples};
use super::violation::Violation;
use super::{Finding, Notation, Rule, Settings};
use crate::material::Inversion;
use crate::random::Random;

/// The first violation of a rule, if there is one.
pub(super) type Verdict = Result<(), Violation>;

/// Ratio of a difference to its tolerance above which a formula is wrong; wrong ones mostly exceed 1e10.
const MISTAKE: f64 = 1e6;

/// Demand on a value that may not be infinite or NaN.
const FINITE: &str = "a finite number";

/// Explanation of values that are infinite or NaN, for which a difference, or a remedy for a sign, is
/// useless.
const SEE_DOMAIN: &str = "not a finite number, here or near by, but an overflow, or a root, real power or logarithm of something \
                          negative; see the rule `domain`";

/// Advice for a difference below [`MISTAKE`].
fn lost_digits(notation: Notation) -> String {
    let narrower = notation.narrower();
    let names = notation.either("the documentation of a declared type names", "`piola declare` names");
    format!(
        "a difference as small as this is more likely a loss of digits than a mistake in the formula: where terms nearly \
         cancel, such as I1b - 3 next to a small constant, rewrite them so that they do not, or choose other parameters \
         ({names} sums that cancel far from rest under **Digits**); where an exponent is large, {narrower}"
    )
}

/// One rule and the material under test: the comparisons so far and the worst of them.
pub(super) struct Judge<'a> {
    pub(super) material: &'a dyn Subject,
    pub(super) settings: &'a Settings,
    /// Random numbers to draw samples and further choices from.
    pub(super) random: Random,
    rule: Rule,
    comparisons: usize,
    worst: f64,
}

impl<'a> Judge<'a> {
    pub(super) fn new(rule: Rule, material: &'a dyn Subject, settings: &'a Settings) -> Self {
        let random = Random::new(settings.seed);
        Self { material, settings, random, rule, comparisons: 0, worst: 0.0 }
    }

    /// The points at which the rule is judged.
    pub(super) fn samples(&mut self) -> Vec<[f64; 3]> {
        samples(self.material, self.settings, &mut self.random)
    }

    /// Demands |found − expected| ≤ tolerance.
    pub(super) fn compare(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        expected: f64,
        tolerance: f64,
    ) -> Verdict {
        self.compare_or(component, stretches, found, expected, tolerance, None)
    }

    /// Demands |found − expected| ≤ tolerance, with advice if it fails.
    pub(super) fn compare_or(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        expected: f64,
        tolerance: f64,
        remedy: Option<&str>,
    ) -> Verdict {
        let difference = (found - expected).abs();
        self.comparisons += 1;
        // A NaN on either side is not agreement.
        if difference <= tolerance {
            if difference > 0.0 {
                self.worst = self.worst.max(difference / tolerance);
            }
            return Ok(());
        }
        let is_small = difference < MISTAKE * tolerance;
        let remedy =
            if is_small { Some(lost_digits(self.settings.notation)) } else { remedy.map(Into::into) };
        self.differs(&component(), stretches, [found, expected], tolerance, remedy)
    }

    /// Demands that two values have the same bits; all NaN are equal.
    pub(super) fn same(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        expected: f64,
    ) -> Verdict {
        self.comparisons += 1;
        if found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan()) {
            return Ok(());
        }
        self.differs(&component(), stretches, [found, expected], 0.0, None)
    }

    /// Demands that a statement hold; the report gives it as 1 or 0.
    pub(super) fn holds(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: bool,
        remedy: &str,
    ) -> Verdict {
        self.comparisons += 1;
        if found {
            return Ok(());
        }
        // No overflow is the reason of a wrong statement.
        let component = format!("{} (1 or 0)", component());
        self.wrong(&component, stretches, 0.0, "\n    expected    1", Some(remedy.into()))
    }

    /// Demands a value that is neither infinite nor NaN.
    pub(super) fn finite(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        remedy: impl FnOnce() -> String,
    ) -> Verdict {
        let words = || (component(), Some(remedy()));
        self.demand(found.is_finite(), FINITE, words, stretches, found)
    }

    /// Demands that a condition be met; component and remedy are put into words only if it is not.
    pub(super) fn demand(
        &mut self,
        is_met: bool,
        expected: &'static str,
        words: impl FnOnce() -> (String, Option<String>),
        stretches: [f64; 3],
        found: f64,
    ) -> Verdict {
        self.comparisons += 1;
        if is_met {
            return Ok(());
        }
        let (component, remedy) = words();
        let overflow = self.overflow(stretches);
        if found.is_nan() && expected != FINITE && overflow.is_none() {
            let demand = format!(", where {expected} is expected: {SEE_DOMAIN}");
            return self.wrong(&component, stretches, found, &demand, None);
        }
        let demand = format!("\n    expected    {expected}");
        self.wrong(&component, stretches, found, &demand, overflow.or(remedy))
    }

    /// A value that differs from another one by more than rounding explains: nothing, where both must have
    /// the same bits.
    fn differs(
        &self,
        component: &str,
        stretches: [f64; 3],
        [found, expected]: [f64; 2],
        tolerance: f64,
        remedy: Option<String>,
    ) -> Verdict {
        let (difference, overflow) = ((found - expected).abs(), self.overflow(stretches));
        if (difference.is_nan() || tolerance.is_nan()) && overflow.is_none() {
            let demand = format!(", where {expected:e} is expected: {SEE_DOMAIN}");
            return self.wrong(component, stretches, found, &demand, None);
        }
        let (explained, remedy) = match tolerance == 0.0 {
            true => ("where both must have the same bits".to_owned(), None),
            false => (format!("of which rounding explains {tolerance:.1e}"), overflow.or(remedy)),
        };
        let demand = format!("\n    expected    {expected:e}\n    difference  {difference:.1e}, {explained}");
        self.wrong(component, stretches, found, &demand, remedy)
    }

    /// Advice where the energy is so large, more than the root of the largest number, that derivatives and
    /// what is made of them overflow, because its extension has come to these stretches.
    fn overflow(&self, stretches: [f64; 3]) -> Option<String> {
        let Inversion::Extend { epsilon } = self.material.inversion() else { return None };
        let overflows = stretches[2] < epsilon && self.material.energy(stretches) > 2f64.powi(512);
        let narrower = self.settings.notation.narrower();
        overflows.then(|| {
            format!(
                "the energy overflows where its extension begun at epsilon = {epsilon} has come to these stretches, as \
                 exponentials and high powers do: choose a greater `epsilon` or smaller parameters, or {narrower}"
            )
        })
    }

    /// A value that is not as demanded.
    fn wrong(
        &self,
        component: &str,
        [l1, l2, l3]: [f64; 3],
        found: f64,
        demand: &str,
        remedy: Option<String>,
    ) -> Verdict {
        let remedy = remedy.map(|remedy| format!("\n    remedy      {remedy}")).unwrap_or_default();
        let facts = format!(
            "    component   {component}\n    stretches   {l1}, {l2}, {l3}\n    found       {found:e}{demand}{remedy}"
        );
        let is_not_finite = self.rule == Rule::Domain && !found.is_finite();
        Err(Violation { rule: self.rule, is_not_finite, facts })
    }

    pub(super) fn finding(&self) -> Result<Finding, Violation> {
        let &Self { rule, comparisons, worst, .. } = self;
        if comparisons == 0 {
            let facts = "    the material admits none of the points at which this is judged: choose other parameters or a wider \
                         domain, or another `range` or more `points` of the settings";
            return Err(Violation { rule, is_not_finite: false, facts: facts.to_owned() });
        }
        Ok(Finding { rule, comparisons, worst })
    }
}
