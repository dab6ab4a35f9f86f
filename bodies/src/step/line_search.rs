//! Line search by backtracking.
//!
//! A trial is accepted if it decreases the objective enough \[Arm66\]. Near a minimum the decrease drowns in
//! rounding; there the slope decides instead, which is still accurate: the "approximate Wolfe" condition
//! [HZ05 eq. 4.1]. A trial outside the domain of the objective is a step too long.
//!
//! \[Arm66\] Armijo, *Minimization of functions having Lipschitz continuous first partial derivatives*, 1966.
//! \[HZ05\] Hager, Zhang, *A New Conjugate Gradient Method with Guaranteed Descent and an Efficient Line
//! Search*, 2005.
//!
//! This module depends on a function of one variable and on nothing else.

use super::term::EnergyChange;

/// Share δ of the decrease predicted by the slope that suffices, 0 < δ < ½.
const SUFFICIENT_DECREASE: f64 = 1e-4;

/// Factor from the length of one trial to the next.
const SHRINK: f64 = 0.5;

const MAX_TRIALS: usize = 48;

/// Multiple of the noise of a change above which a decrease that the slope predicts must show.
pub(super) const MARGIN: f64 = 16.0;

/// Objective along a line, relative to its start.
pub(super) trait Line {
    /// The objective at a step minus that at the start, with a bound for its rounding error; `None` outside
    /// the domain.
    fn change(&mut self, step: f64) -> Option<EnergyChange>;

    /// The derivative at the step tried last.
    fn slope(&mut self) -> f64;
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outcome {
    /// The step tried last was accepted.
    Accepted {
        /// The step, 0 < step ≤ 1.
        step: f64,
        /// The objective there minus that at the start.
        difference: f64,
        /// Number of trials outside the domain.
        refused: usize,
        /// Bound for the rounding error of the difference, which the slope replaces if it is below.
        noise: f64,
    },
    /// No step was accepted.
    Failed {
        /// The smallest step tried.
        step: f64,
        /// Number of trials outside the domain.
        refused: usize,
    },
}

/// Halves the step, beginning with `first`, until it is acceptable; `slope` < 0 is the derivative at the
/// start.
pub(super) fn backtrack(line: &mut impl Line, first: f64, slope: f64) -> Outcome {
    let delta = SUFFICIENT_DECREASE;
    let (mut step, mut refused) = (first, 0);
    if first <= 0.0 {
        return Outcome::Failed { step, refused };
    }
    for trials in 1..=MAX_TRIALS {
        match line.change(step) {
            None => refused += 1,
            Some(EnergyChange { difference, noise }) => {
                let enough = difference <= delta * step * slope;
                let noisy = difference.abs() <= noise;
                // φ'(step) ≤ (2δ − 1) φ'(0) is equivalent to the sufficient decrease for a quadratic, without
                // differences.
                if (enough && !noisy) || (noisy && line.slope() <= (2.0 * delta - 1.0) * slope) {
                    return Outcome::Accepted { step, difference, refused, noise };
                }
            }
        }
        if trials < MAX_TRIALS {
            step *= SHRINK;
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
        assert_eq!(backtrack(&mut line, 1.0, slope), expected);
    }

    fn accepted(step: f64, difference: f64, refused: usize, noise: f64) -> Outcome {
        Outcome::Accepted { step, difference, refused, noise }
    }

    #[test]
    fn a_good_step_is_taken_whole() {
        check(|s| Some(s * s / 2.0 - s), |s| s - 1.0, 0.0, accepted(1.0, -0.5, 0, 0.0));
    }

    #[test]
    fn a_step_too_long_or_out_of_the_domain_is_halved() {
        let halved = accepted(0.0625, -0.03125, 0, 0.0);
        check(|s| Some(8.0 * s * s - s), |s| 16.0 * s - 1.0, 0.0, halved);
        check(|s| (s < 0.3).then_some(-s), |_| -1.0, 0.0, accepted(0.25, -0.25, 2, 0.0));
    }

    #[test]
    fn below_the_noise_the_slope_decides() {
        // The difference says "uphill", but it is noise: the minimum is at 1.
        check(|_| Some(1e-16), |s| 1e-12 * (s - 1.0), 1e-15, accepted(1.0, 1e-16, 0, 1e-15));
        // Here the slope at 1 is steeper than at 0: the minimum is at ⅓.
        check(|_| Some(1e-16), |s| 1e-12 * (3.0 * s - 1.0), 1e-15, accepted(0.5, 1e-16, 0, 1e-15));
    }

    #[test]
    fn failure_is_a_value() {
        let step = 0.5f64.powi(47);
        check(Some, |_| -1.0, 0.0, Outcome::Failed { step, refused: 0 });
        check(|_| None, |_| -1.0, 0.0, Outcome::Failed { step, refused: 48 });
        check(|_| Some(f64::NAN), |_| -1.0, 0.0, Outcome::Failed { step, refused: 0 });
    }
}
