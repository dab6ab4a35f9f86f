//! The strain at which the free sides of a specimen carry no stress.
//!
//! Newton's method with the slope that the energy has, inside an interval with a side too narrow at one end
//! and too wide at the other, halved where the step would leave it or falls behind halving \[PTVF07\].
//!
//! This module is independent of materials.
//!
//! \[PTVF07\] Press, Teukolsky, Vetterling, Flannery, *Numerical Recipes*, 3rd edition, 2007, section 9.4.

/// Factor by which an interval without a solution is widened, to either side.
const WIDENING: f64 = 1.1;
/// Number of widenings: 1.1⁷³ is a little more than a thousand.
const WIDENINGS: usize = 73;

/// The stress of free sides and its derivative by their stretch, Pa.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    pub(crate) stress: f64,
    pub(crate) slope: f64,
}

/// The strain at which `side` has no stress, to the last digits; `side` is `None` outside the domain of the
/// energy.
///
/// Sides that are pressed outwards, that is, with a negative stress, are too narrow. If there are several
/// equilibria, it is one that is stable under this test, between `isochoric`, the strain at constant volume,
/// and 0 if there is one, else not far outside.
pub(crate) fn release(side: impl Fn(f64) -> Option<Side>, isochoric: f64) -> Option<f64> {
    let interval = enclose(|strain| side(strain).map(|side| side.stress), isochoric)?;
    solve(side, interval)
}

/// Too narrow and too wide. The edge of the domain may be one of them, where the energy keeps away from it.
fn enclose(stress: impl Fn(f64) -> Option<f64>, isochoric: f64) -> Option<Interval> {
    let interval = |low: f64, high: f64| {
        let (narrow, wide) = (stress(low), stress(high));
        let is_enclosed = match (narrow, wide) {
            (Some(narrow), Some(wide)) => narrow <= 0.0 && wide >= 0.0,
            (Some(narrow), None) => narrow < 0.0,
            (None, Some(wide)) => wide > 0.0,
            (None, None) => false,
        };
        is_enclosed.then_some(Interval { low, high, is_edge: [narrow.is_none(), wide.is_none()] })
    };
    let (mut low, mut high) = (isochoric.min(0.0), isochoric.max(0.0));
    if let Some(interval) = interval(low, high) {
        return Some(interval);
    }
    (0..WIDENINGS).find_map(|_| {
        let (narrower, wider) = ((1.0 + low) / WIDENING - 1.0, (1.0 + high) * WIDENING - 1.0);
        let found = interval(narrower, low).or_else(|| interval(high, wider));
        (low, high) = (narrower, wider);
        found
    })
}

#[derive(Clone, Copy, Debug)]
struct Interval {
    low: f64,
    high: f64,
    /// For low and high, true if it is outside the domain; never both.
    is_edge: [bool; 2],
}

fn solve(side: impl Fn(f64) -> Option<Side>, interval: Interval) -> Option<f64> {
    let Interval { mut low, mut high, mut is_edge } = interval;
    let mut strain = 0.5 * (low + high);
    let (mut before_last, mut last) = (high - low, high - low);
    loop {
        // Until nothing lies between.
        if strain <= low || strain >= high {
            return (is_edge == [false; 2]).then_some(strain);
        }
        match side(strain) {
            Some(Side { stress, slope }) => {
                if stress == 0.0 {
                    return Some(strain);
                }
                if stress < 0.0 {
                    (low, is_edge[0]) = (strain, false);
                } else {
                    (high, is_edge[1]) = (strain, false);
                }
                let step = -stress / slope;
                if step.abs() <= f64::EPSILON * strain.abs() {
                    return Some(strain);
                }
                let next = strain + step;
                let is_inside = low < next && next < high;
                if is_inside && step.abs() < 0.5 * before_last {
                    (before_last, last) = (last, step.abs());
                    strain = next;
                    continue;
                }
            }
            None if is_edge[0] => low = strain,
            None if is_edge[1] => high = strain,
            // A hole in the domain.
            None => return None,
        }
        (before_last, last) = (last, 0.5 * (high - low));
        strain = 0.5 * (low + high);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strain_of_a_spring_at_the_edge_of_its_domain() {
        // −1 + 1e-9/(1 − x): the root is 1 − 1e-9, next to the edge at 1, with rounding 1e9 u of its
        // distance.
        let spring = |x: f64| {
            let gap = 1.0 - x;
            (gap > 0.0).then(|| Side { stress: 1e-9 / gap - 1.0, slope: 1e-9 / gap.powi(2) })
        };
        let strain = release(spring, -0.3).unwrap_or(f64::NAN);
        assert!((strain - (1.0 - 1e-9)).abs() <= f64::EPSILON, "{strain}");
    }

    #[test]
    fn an_edge_that_does_not_push_back_is_no_equilibrium() {
        let slack = |x: f64| (x < 1.0).then_some(Side { stress: -1.0, slope: 0.0 });
        assert_eq!(release(slack, -0.3), None);
        assert_eq!(release(|_| Some(Side { stress: 1.0, slope: 0.0 }), -0.3), None);
    }
}
