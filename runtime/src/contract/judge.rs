//! Compares numbers, counts, and stops at the first that is wrong.

use super::{Finding, Rule, Violation};

/// The state of one rule.
pub(super) struct Judge {
    rule: Rule,
    comparisons: usize,
    worst: f64,
}

impl Judge {
    pub(super) fn new(rule: Rule) -> Self {
        Self { rule, comparisons: 0, worst: 0.0 }
    }

    /// |found − expected| ≤ tolerance.
    pub(super) fn compare(
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

    /// The same bits; all NaN are the same.
    pub(super) fn same(
        &mut self,
        component: impl FnOnce() -> String,
        stretches: [f64; 3],
        found: f64,
        expected: f64,
    ) -> Result<(), Violation> {
        self.comparisons += 1;
        if found.to_bits() == expected.to_bits() || (found.is_nan() && expected.is_nan()) {
            return Ok(());
        }
        let (rule, component) = (self.rule, component());
        Err(Violation::Differs { rule, component, stretches, found, expected, tolerance: 0.0 })
    }

    /// found > 0.
    pub(super) fn positive(
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

    pub(super) fn finding(self) -> Result<Finding, Violation> {
        let Self { rule, comparisons, worst } = self;
        if comparisons == 0 {
            return Err(Violation::NothingToCheck { rule });
        }
        Ok(Finding { rule, comparisons, worst })
    }
}
