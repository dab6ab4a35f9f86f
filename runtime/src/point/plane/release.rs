//! The stretch at which a free side of a body carries no stress, to rounding.
//!
//! The nominal stress g(t) of a side with the stretch t > 0 is the slope of the energy in t. Wanted is a
//! stable root, where g changes from negative to positive: the side, pressed outwards before, is pulled
//! inwards after.
//!
//! **Enclosing.** Between the stretch of constant volume and 1 lies the root of nearly every solid with
//! 0 ≤ ν ≤ ½. Otherwise the interval is widened to both sides, by factors 1 + 2⁻¹⁰ and its squares, until one
//! of the new parts has a root. The first parts are narrow, because an energy for metals softens within a few
//! percent: a wide one would have the stable root and the unstable one behind it. Where the energy is not
//! defined, at the end of a chain say, the domain may be an end of the interval: such an energy keeps away
//! from it.
//!
//! **Solving.** Newton's method with the slope that the energy has. Where a step would leave the interval,
//! where it is not shorter than half of the step before the last, and where the slope is not positive, the
//! interval is halved, by the geometric mean as long as its ends are far apart \[PTVF07\]. Each halving
//! shrinks it and each other step is shorter than half of an earlier one, so that the iteration ends.
//!
//! **Rounding.** g is a sum of terms as large as the moduli, and known to u times their sum N. The root is
//! accepted where |g| ≤ 64 u N, so that t errs by a few u N/g′: by a few u t for every solid whose stiffness
//! across, t g′, is not much smaller than its other moduli, incompressible ones included. Where g jumps over
//! zero, there is no root.
//!
//! This module is independent of materials.
//!
//! \[PTVF07\] Press, Teukolsky, Vetterling, Flannery, *Numerical Recipes*, 3rd edition, 2007, section 9.4.

use crate::lanes::Real;

/// Widenings of the interval: 1 + 2⁻¹⁰ to the power of 2²⁰ leaves the range of `f64`.
const WIDENINGS: usize = 20;

/// Maximum number of steps of an iteration that rounding keeps from ending; some ten are usual, and halving
/// an interval of f64 to nothing takes 120.
const STEPS: usize = 300;

/// Stress of a free side at a stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<R> {
    /// g, Pa.
    pub(super) stress: R,
    /// g′, Pa.
    pub(super) slope: R,
    /// Sum of the magnitudes that g is made of, Pa.
    pub(super) magnitude: R,
}

impl<R: Real<Mask = bool>> Side<R> {
    /// True if the stress is zero up to rounding, at a stable stretch.
    fn is_free(&self) -> bool {
        let rounding = R::splat(64.0 * R::unit_roundoff()) * self.magnitude;
        R::splat(0.0).less(self.slope) && !rounding.less(self.stress.abs())
    }
}

/// Reason why the side cannot be made free of stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unreleased {
    /// The energy is not defined, or not finite, at any of the stretches tried.
    Undefined,
    /// The side is pulled, or pressed, at every stretch, or is free of stress only at an unstable one.
    NoEquilibrium,
}

/// The stretch t > 0 at which `side` has no stress; `side` is `None` where the energy is not defined.
pub(super) fn release<R: Real<Mask = bool>>(
    side: impl Fn(R) -> Option<Side<R>>,
    isochoric: R,
) -> Result<R, Unreleased> {
    // Below the range too little is left of a stretch.
    let smallest = R::splat(R::min_positive());
    let side = |stretch: R| if smallest.less(stretch) { side(stretch) } else { None };
    let ends = enclose(|stretch| side(stretch).map(|side| side.stress), isochoric)?;
    solve(side, ends).ok_or(Unreleased::NoEquilibrium)
}

/// A stretch with its stress, unless it is outside the domain.
type End<R> = (R, Option<R>);

/// True if one end is too small and the other too large; either may be outside the domain, but not both.
fn is_enclosed<R: Real<Mask = bool>>([(_, at_low), (_, at_high)]: [End<R>; 2]) -> bool {
    let zero = R::splat(0.0);
    match (at_low, at_high) {
        (Some(narrow), Some(wide)) => !zero.less(narrow) && !wide.less(zero),
        (Some(narrow), None) => narrow.less(zero),
        (None, Some(wide)) => zero.less(wide),
        (None, None) => false,
    }
}

/// The two ends of an interval that [encloses](is_enclosed) a root.
fn enclose<R: Real<Mask = bool>>(
    stress: impl Fn(R) -> Option<R>,
    isochoric: R,
) -> Result<[End<R>; 2], Unreleased> {
    let end = |stretch: R| (stretch, stress(stretch));
    let one = R::splat(1.0);
    // Collapsed in the plane, the body would have to be infinitely thick.
    let range = R::splat(R::min_positive().powf(0.2));
    let isochoric = isochoric.max(range).min(one / range);
    let (mut low, mut high) = (end(isochoric.min(one)), end(isochoric.max(one)));
    if is_enclosed([low, high]) {
        return Ok([low, high]);
    }
    let mut is_defined = low.1.is_some() || high.1.is_some();
    let mut factor = R::splat(1.0 + 1.0 / 1024.0);
    for _ in 0..WIDENINGS {
        let (below, above) = (end(low.0 / factor), end(high.0 * factor));
        if let Some(interval) = [[below, low], [high, above]].into_iter().find(|ends| is_enclosed(*ends)) {
            return Ok(interval);
        }
        is_defined |= below.1.is_some() || above.1.is_some();
        (low, high, factor) = (below, above, factor * factor);
    }
    Err(if is_defined { Unreleased::NoEquilibrium } else { Unreleased::Undefined })
}

fn solve<R: Real<Mask = bool>>(side: impl Fn(R) -> Option<Side<R>>, ends: [End<R>; 2]) -> Option<R> {
    let (zero, half) = (R::splat(0.0), R::splat(0.5));
    let [mut low, mut high] = ends.map(|(stretch, _)| stretch);
    let mut is_edge = ends.map(|(_, stress)| stress.is_none());
    let mut stretch = middle(low, high);
    let (mut before_last, mut last) = (high - low, high - low);
    for _ in 0..STEPS {
        // Nothing lies between.
        if !(low.less(stretch) && stretch.less(high)) {
            break;
        }
        let Some(found) = side(stretch) else {
            match is_edge {
                [true, _] => low = stretch,
                [_, true] => high = stretch,
                // A hole in the domain.
                [false, false] => return None,
            }
            stretch = middle(low, high);
            (before_last, last) = (last, half * (high - low));
            continue;
        };
        let step = -(found.stress / found.slope);
        if found.is_free() && !(R::splat(2.0 * R::unit_roundoff()) * stretch).less(step.abs()) {
            return Some(stretch);
        }
        if zero.less(found.stress) {
            (high, is_edge[1]) = (stretch, false);
        } else {
            (low, is_edge[0]) = (stretch, false);
        }
        let next = stretch + step;
        let is_stable = zero.less(found.slope);
        if is_stable && low.less(next) && next.less(high) && step.abs().less(half * before_last) {
            (before_last, last) = (last, step.abs());
            stretch = next;
        } else {
            (before_last, last) = (last, half * (high - low));
            stretch = middle(low, high);
        }
    }
    // As after an interval that was empty from the beginning: a sheet at rest.
    [low, high].into_iter().find(|&end| side(end).is_some_and(|side| side.is_free()))
}

/// The middle of an interval, on the scale of logarithms where its ends are far apart.
fn middle<R: Real<Mask = bool>>(low: R, high: R) -> R {
    if (R::splat(4.0) * low).less(high) { low.sqrt() * high.sqrt() } else { R::splat(0.5) * (low + high) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(side: impl Fn(f64) -> Option<Side<f64>>, expected: Result<f64, Unreleased>, limit: f64) {
        match (release(side, 0.7), expected) {
            (Ok(found), Ok(expected)) => assert!((found - expected).abs() <= limit * expected, "{found}"),
            (found, expected) => assert_eq!(found, expected),
        }
    }

    #[test]
    fn a_root_is_found_however_far_away() {
        for root in [1e-60, 1e-3, 0.7, 0.9, 1.0, 1.7, 1e4, 1e40] {
            let spring = |t: f64| {
                Some(Side { stress: t / root - root / t, slope: 1.0 / root + root / (t * t), magnitude: 2.0 })
            };
            // t/c − c/t errs by 2 u, with a slope of 2/c.
            check(spring, Ok(root), 4.0 * f64::EPSILON);
        }
    }

    #[test]
    fn a_stable_root_is_told_from_the_unstable_one_behind_it() {
        // As of a metal whose stress falls from a strain of 7 % on.
        let softening = |t: f64| {
            Some(Side { stress: (t - 1.02) * (1.12 - t), slope: 2.14 - 2.0 * t, magnitude: 2.0 * t })
        };
        // t − 1.02 errs by u, and the product by as much times 0.1, with a slope of 0.1.
        check(softening, Ok(1.02), 64.0 * f64::EPSILON);
    }

    #[test]
    fn a_root_next_to_the_edge_of_the_domain() {
        // −1 + 1e-9/(1.1 − t): the root is 1.1 − 1e-9, with rounding 1e9 u of its distance.
        let chain = |t: f64| {
            let gap = 1.1 - t;
            (gap > 0.0).then(|| Side {
                stress: 1e-9 / gap - 1.0,
                slope: 1e-9 / gap.powi(2),
                magnitude: 1e-9 / gap.powi(2),
            })
        };
        check(chain, Ok(1.1 - 1e-9), f64::EPSILON);
    }

    #[test]
    fn what_has_no_equilibrium_says_so() {
        let pulled = |t: f64| Some(Side { stress: t, slope: 1.0, magnitude: t });
        check(pulled, Err(Unreleased::NoEquilibrium), 0.0);
        let jump =
            |t: f64| Some(Side { stress: if t < 0.8 { -1.0 } else { 1.0 }, slope: 1e-300, magnitude: 1.0 });
        check(jump, Err(Unreleased::NoEquilibrium), 0.0);
        let unstable = |t: f64| Some(Side { stress: 0.9 - t, slope: -1.0, magnitude: 2.0 });
        check(unstable, Err(Unreleased::NoEquilibrium), 0.0);
        let slack = |t: f64| (t < 1.1).then_some(Side { stress: -1.0, slope: 0.0, magnitude: 1.0 });
        check(slack, Err(Unreleased::NoEquilibrium), 0.0);
        check(|_| None, Err(Unreleased::Undefined), 0.0);
    }
}
