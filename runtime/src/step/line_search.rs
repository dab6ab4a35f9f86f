//! Line search by backtracking.
//!
//! A trial is accepted where it decreases the objective enough \[Arm66\]. Near a minimum the decrease drowns
//! in rounding; there the slope decides instead, which is still accurate: the "approximate Wolfe" condition
//! [HZ05 eq. 4.1]. A trial outside the domain of the objective is a step too long.
//!
//! \[Arm66\] Armijo, *Minimization of functions having Lipschitz continuous first partial derivatives*, 1966.
//! \[HZ05\] Hager, Zhang, *A New Conjugate Gradient Method with Guaranteed Descent and an Efficient Line
//! Search*, 2005.
//!
//! This module knows a function of one variable and nothing else.

use super::term::EnergyChange;

/// Settings of the line search: when to accept a step and how to shorten it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct LineSearchSettings {
    /// Share δ of the decrease predicted by the slope that is enough, 0 < δ < ½.
    pub sufficient_decrease: f64,
    /// Factor from the length of one trial to the next, between 0 and 1.
    pub shrink: f64,
    /// Number of trials after which to give up.
    pub max_trials: usize,
    /// Whether a step is accepted however the energy changes, unless it leaves the domain: Newton's method
    /// without a line search, for comparisons.
    pub accepts_increase: bool,
}

impl Default for LineSearchSettings {
    fn default() -> Self {
        Self { sufficient_decrease: 1e-4, shrink: 0.5, max_trials: 48, accepts_increase: false }
    }
}

crate::chained::chained!(LineSearchSettings {
    with_sufficient_decrease(sufficient_decrease: f64),
    with_shrink(shrink: f64),
    with_max_trials(max_trials: usize),
    with_accepts_increase(accepts_increase: bool),
});

/// Objective along a line, relative to its start: what a [`LineSearch`] may ask.
pub trait Line {
    /// The objective at a step minus that at the start, with a bound for its rounding error; `None` outside
    /// the domain.
    fn change(&mut self, step: f64) -> Option<EnergyChange>;

    /// The derivative at the step tried last.
    fn slope(&mut self) -> f64;
}

/// Line search that is not piola's own: see
/// [`Simulation::set_line_search`](super::Simulation::set_line_search).
///
/// Any function of the form of [`LineSearch::step`] is one.
pub trait LineSearch: Send + Sync {
    /// The step to take along a direction of descent, between 0 and `longest`; `None` if there is no good
    /// one, where the iteration ends. `slope` < 0 is the derivative at 0.
    ///
    /// Each question to the line costs an evaluation of the energies, and each slope one of the forces. A
    /// step outside the domain counts as none.
    fn step(&self, line: &mut dyn Line, longest: f64, slope: f64) -> Option<f64>;
}

impl<F> LineSearch for F
where
    F: Fn(&mut dyn Line, f64, f64) -> Option<f64> + Send + Sync,
{
    fn step(&self, line: &mut dyn Line, longest: f64, slope: f64) -> Option<f64> {
        self(line, longest, slope)
    }
}

/// Piola's own: backtracking, for Newton's methods outside of a [`Simulation`](super::Simulation).
impl LineSearch for LineSearchSettings {
    fn step(&self, line: &mut dyn Line, longest: f64, slope: f64) -> Option<f64> {
        match backtrack(line, longest, slope, self) {
            Outcome::Accepted { step, .. } => Some(step),
            Outcome::Failed { .. } => None,
        }
    }
}

/// The line search of a simulation: a caller's own, or else that of the settings.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub(super) settings: &'a LineSearchSettings,
    pub(super) own: Option<&'a dyn LineSearch>,
}

impl Search<'_> {
    /// Looks for a step from `first` downwards.
    pub(super) fn run(self, line: &mut impl Line, first: f64, slope: f64) -> Outcome {
        let Some(own) = self.own else { return backtrack(line, first, slope, self.settings) };
        let mut noted = Noted { line, last: None, shortest: first, trials: 0, refused: 0 };
        let step = if first > 0.0 { own.step(&mut noted, first, slope) } else { None };
        // The step that is taken is the one tried last.
        if let Some(step) = step
            && noted.last.is_none_or(|(last, _)| last != step)
        {
            noted.change(step);
        }
        let Noted { last, shortest, trials, refused, .. } = noted;
        match step.and(last) {
            Some((step, Some(EnergyChange { difference, noise })))
                if step > 0.0 && difference.is_finite() =>
            {
                Outcome::Accepted { step, difference, trials, refused, by_slope: difference.abs() <= noise }
            }
            _ => Outcome::Failed { step: shortest, refused },
        }
    }
}

/// A line with notes of what was asked.
struct Noted<'a, L> {
    line: &'a mut L,
    /// The step tried last, with the change there.
    last: Option<(f64, Option<EnergyChange>)>,
    shortest: f64,
    trials: usize,
    refused: usize,
}

impl<L: Line> Line for Noted<'_, L> {
    fn change(&mut self, step: f64) -> Option<EnergyChange> {
        let change = self.line.change(step);
        self.trials += 1;
        self.refused += usize::from(change.is_none());
        self.shortest = self.shortest.min(step);
        self.last = Some((step, change));
        change
    }

    fn slope(&mut self) -> f64 {
        self.line.slope()
    }
}

/// Result of a line search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// The step tried last was accepted.
    Accepted {
        /// The step, 0 < step ≤ 1.
        step: f64,
        /// The objective there minus that at the start.
        difference: f64,
        /// Number of steps tried, this one included.
        trials: usize,
        /// Number of trials outside the domain.
        refused: usize,
        /// Whether the change of the objective was noise, so that the slope decided.
        by_slope: bool,
    },
    /// No step was accepted.
    Failed {
        /// The smallest step tried.
        step: f64,
        /// Number of trials outside the domain.
        refused: usize,
    },
}

/// Tries the step `first`, then that times shrink, shrink², … until one is acceptable; `slope` < 0 is the
/// derivative at the start.
fn backtrack(
    line: &mut (impl Line + ?Sized),
    first: f64,
    slope: f64,
    settings: &LineSearchSettings,
) -> Outcome {
    let delta = settings.sufficient_decrease;
    let (mut step, mut refused) = (first, 0);
    if first <= 0.0 {
        return Outcome::Failed { step, refused };
    }
    for trials in 1..=settings.max_trials {
        match line.change(step) {
            None => refused += 1,
            Some(EnergyChange { difference, noise }) => {
                let enough = difference <= delta * step * slope;
                let noisy = difference.abs() <= noise;
                // φ'(step) ≤ (2δ − 1) φ'(0) says for a quadratic what the sufficient decrease says, without
                // differences.
                let is_free = settings.accepts_increase && difference.is_finite();
                if is_free || (enough && !noisy) || (noisy && line.slope() <= (2.0 * delta - 1.0) * slope) {
                    return Outcome::Accepted { step, difference, trials, refused, by_slope: noisy };
                }
            }
        }
        if trials < settings.max_trials {
            step *= settings.shrink;
        }
    }
    Outcome::Failed { step, refused }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A function with its derivative and the step tried last.
    struct Function<F, G> {
        value: F,
        derivative: G,
        at: f64,
        noise: f64,
    }

    impl<F: Fn(f64) -> Option<f64>, G: Fn(f64) -> f64> Line for Function<F, G> {
        fn change(&mut self, step: f64) -> Option<EnergyChange> {
            self.at = step;
            (self.value)(step).map(|difference| EnergyChange { difference, noise: self.noise })
        }

        fn slope(&mut self) -> f64 {
            (self.derivative)(self.at)
        }
    }

    #[track_caller]
    fn check(
        value: impl Fn(f64) -> Option<f64>,
        derivative: impl Fn(f64) -> f64,
        noise: f64,
        expected: Outcome,
    ) {
        let slope = derivative(0.0);
        let mut line = Function { value, derivative, at: 0.0, noise };
        assert_eq!(backtrack(&mut line, 1.0, slope, &LineSearchSettings::default()), expected);
    }

    #[test]
    fn a_good_step_is_taken_whole() {
        check(
            |s| Some(s * s / 2.0 - s),
            |s| s - 1.0,
            0.0,
            Outcome::Accepted { step: 1.0, difference: -0.5, trials: 1, refused: 0, by_slope: false },
        );
    }

    #[test]
    fn a_step_too_long_or_out_of_the_domain_is_halved() {
        check(
            |s| Some(8.0 * s * s - s),
            |s| 16.0 * s - 1.0,
            0.0,
            Outcome::Accepted { step: 0.0625, difference: -0.03125, trials: 5, refused: 0, by_slope: false },
        );
        check(
            |s| (s < 0.3).then_some(-s),
            |_| -1.0,
            0.0,
            Outcome::Accepted { step: 0.25, difference: -0.25, trials: 3, refused: 2, by_slope: false },
        );
    }

    #[test]
    fn below_the_noise_the_slope_decides() {
        // The difference says "uphill", but it is noise: the minimum is at 1.
        let accepted =
            Outcome::Accepted { step: 1.0, difference: 1e-16, trials: 1, refused: 0, by_slope: true };
        check(|_| Some(1e-16), |s| 1e-12 * (s - 1.0), 1e-15, accepted);
        // Here the slope at 1 is steeper than at 0: the minimum is at ⅓.
        let halved =
            Outcome::Accepted { step: 0.5, difference: 1e-16, trials: 2, refused: 0, by_slope: true };
        check(|_| Some(1e-16), |s| 1e-12 * (3.0 * s - 1.0), 1e-15, halved);
    }

    /// A search of one's own need not end with the step that it takes, and may fail or leave the domain.
    #[test]
    fn the_step_of_a_search_of_ones_own_is_tried_last() {
        let search = |own: &dyn LineSearch| {
            let value = |s: f64| (s < 0.9).then_some(s * s / 2.0 - s);
            let mut line = Function { value, derivative: |s| s - 1.0, at: 0.0, noise: 0.0 };
            let settings = LineSearchSettings::default();
            let outcome = Search { settings: &settings, own: Some(own) }.run(&mut line, 1.0, -1.0);
            (outcome, line.at)
        };
        let golden = |line: &mut dyn Line, longest: f64, _: f64| {
            let steps = [longest, 0.25 * longest, 0.5 * longest, 0.1 * longest];
            let changes = steps.map(|step| (step, line.change(step)));
            let good = changes.into_iter().filter_map(|(step, change)| Some((step, change?.difference)));
            good.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(step, _)| step)
        };
        let half =
            Outcome::Accepted { step: 0.5, difference: -0.375, trials: 5, refused: 1, by_slope: false };
        assert_eq!(search(&golden), (half, 0.5));
        let none = |line: &mut dyn Line, longest: f64, _: f64| line.change(0.5 * longest).and(None);
        assert_eq!(search(&none).0, Outcome::Failed { step: 0.5, refused: 0 });
        let outside = |_: &mut dyn Line, longest: f64, _: f64| Some(longest);
        assert_eq!(search(&outside).0, Outcome::Failed { step: 1.0, refused: 1 });
    }

    #[test]
    fn settings_are_a_line_search() {
        let at_half = |expected: Option<f64>, value: fn(f64) -> Option<f64>| {
            let mut line = Function { value, derivative: |_| -1.0, at: 0.0, noise: 0.0 };
            assert_eq!(LineSearch::step(&LineSearchSettings::default(), &mut line, 1.0, -1.0), expected);
        };
        at_half(Some(0.5), |s| (s < 0.9).then_some(-s));
        at_half(None, |_| None);
    }

    #[test]
    fn failure_is_a_value() {
        let step = 0.5f64.powi(47);
        check(Some, |_| -1.0, 0.0, Outcome::Failed { step, refused: 0 });
        check(|_| None, |_| -1.0, 0.0, Outcome::Failed { step, refused: 48 });
        check(|_| Some(f64::NAN), |_| -1.0, 0.0, Outcome::Failed { step, refused: 0 });
    }
}
