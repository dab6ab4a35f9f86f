//! Minima other than the best one: other solids that agree with the data about as well, and other parameters
//! of the same solid.
//!
//! Different parameters may describe the same solid. Terms of a sum exchange their places; the exponent of a
//! term whose coefficient has vanished is arbitrary; for two terms with the same exponent only the sum
//! matters; and a parameter that grows without bound changes less and less. So stresses are compared.

use super::candidate::Numbers;
use super::minimum::Minimum;
use super::outcome::{Warning, change};

/// Bound for another minimum to count as about as good: its differences, relative to those of the best.
const ABOUT_AS_GOOD: f64 = 1.1;
/// Parameters are the same if their relative difference is no more than this.
const SAME: f64 = 0.01;
/// A parameter that is less than this share of the one given counts as zero, as happens at an edge.
const ZERO: f64 = 1e-9;
/// Solids are the same if no stress differs by more than this share of the greatest there, below what
/// machines can measure.
const SAME_STRESS: f64 = 1e-3;
/// A parameter that grew by this factor and no longer affects the fit is reported as unbounded (random starts
/// vary by ten at most).
const RUNAWAY_FACTOR: f64 = 1e3;
/// Largest number of other minima that are reported: in a flat valley there would be one for each descent.
const OTHERS: usize = 5;

/// Warnings of other solids, best first, and of the same solid with parameters that differ most, if their
/// minima are about as good as the best.
pub(super) fn warnings(best: &Minimum<'_>, minima: &[Minimum<'_>], numbers: &Numbers) -> Vec<Warning> {
    let count = best.problem.count() as f64;
    // Values that are exact up to rounding are as good as exact ones.
    let limit = best.squares * ABOUT_AS_GOOD * ABOUT_AS_GOOD + count * 1e-24;
    let good = minima.iter().filter(|minimum| minimum.is_least && minimum.squares <= limit);
    let mut good: Vec<_> = good.collect();
    good.sort_by(|a, b| a.squares.total_cmp(&b.squares));

    let is_same = |number: usize, one: f64, other: f64| {
        let zero = ZERO * numbers.values[number].abs();
        (one - other).abs() <= SAME * one.abs().max(other.abs()) + zero
    };
    let differing = |one: &Minimum<'_>, other: &Minimum<'_>| {
        numbers.differing(&one.problem.values, &other.problem.values, is_same)
    };
    let both = |number: usize, one: &Minimum<'_>, other: &Minimum<'_>| {
        [one, other].map(|minimum| minimum.problem.values[number])
    };
    // Far out, sums such as 1 + x/n leave nothing but rounding, which stresses then show.
    let is_runaway = |differing: &[usize], one: &Minimum<'_>, other: &Minimum<'_>| match *differing {
        [number] => {
            let [one, other] = both(number, one, other);
            let far = RUNAWAY_FACTOR * numbers.values[number].abs();
            far > 0.0 && one * other > 0.0 && one.abs().min(other.abs()) >= far
        }
        _ => false,
    };
    let (mut solids, mut equivalent, mut furthest) = (vec![best], None, 0.0);
    for minimum in good {
        let is_of = |solid: &&Minimum<'_>| {
            let differing = differing(solid, minimum);
            differing.is_empty()
                || is_runaway(&differing, solid, minimum)
                || solid.problem.has_stresses_of(&minimum.problem, SAME_STRESS)
        };
        match solids.iter().position(is_of) {
            None => solids.push(minimum),
            Some(0) => {
                let differing = differing(best, minimum);
                let is_runaway = is_runaway(&differing, best, minimum);
                let changed = differing.into_iter().map(|number| {
                    let [here, there] = both(number, best, minimum);
                    (numbers.names[number].clone(), here, there)
                });
                let changed: Vec<_> = changed.collect();
                let distance =
                    changed.iter().map(|(_, here, there)| change(*here, *there)).fold(0.0, f64::max);
                if distance > furthest {
                    furthest = distance;
                    equivalent = Some(Warning::EquivalentParameters { numbers: changed, is_runaway });
                }
            }
            Some(_) => {}
        }
    }
    let difference = |minimum: &Minimum<'_>| (minimum.squares / count).sqrt();
    let others = solids.into_iter().skip(1).take(OTHERS).map(|minimum| Warning::OtherMinimum {
        numbers: numbers.names.iter().cloned().zip(minimum.problem.values.iter().copied()).collect(),
        difference: difference(minimum),
        found: difference(best),
    });
    others.chain(equivalent).collect()
}
