//! Other parameters with which a fit is about as good: those of other minima, and others of the same solid.
//!
//! Terms of a sum that exchange their places are the same parameters. The exponent of a term whose
//! coefficient has vanished is arbitrary; for two terms with the same exponent only the sum matters; and a
//! parameter that grows without bound changes less and less.

use std::collections::BTreeMap;

use super::candidate::Numbers;
use super::minimum::Minimum;
use super::outcome::Warning;

/// Bound for another minimum to count as about as good: its differences, relative to those of the best.
const ABOUT_AS_GOOD: f64 = 1.1;
/// Parameters are the same if their relative difference is no more than this.
const SAME: f64 = 0.01;
/// A parameter that is less than this share of the one given counts as zero, as happens at an edge.
const ZERO: f64 = 1e-9;

/// The ranges of parameters over the minima that are about as good as the best, if they differ.
pub(super) fn warning(best: &Minimum<'_>, minima: &[Minimum<'_>], numbers: &Numbers) -> Option<Warning> {
    let count = best.problem.count() as f64;
    // Values that are exact up to rounding are as good as exact ones.
    let limit = best.squares * ABOUT_AS_GOOD * ABOUT_AS_GOOD + count * 1e-24;
    let is_same = |number: usize, one: f64, other: f64| {
        let zero = ZERO * numbers.values[number].abs();
        (one - other).abs() <= SAME * one.abs().max(other.abs()) + zero
    };
    let (mut ranges, mut squares) = (BTreeMap::new(), best.squares);
    for minimum in minima.iter().filter(|minimum| minimum.is_least && minimum.squares <= limit) {
        for number in numbers.differing(&best.problem.values, &minimum.problem.values, is_same) {
            let [here, there] = [best, minimum].map(|minimum| minimum.problem.values[number]);
            let (least, greatest) = ranges.entry(number).or_insert((here, here));
            (*least, *greatest) = (least.min(there), greatest.max(there));
            squares = squares.max(minimum.squares);
        }
    }
    let ranges: Vec<_> = ranges
        .into_iter()
        .filter(|(_, (least, greatest))| least < greatest)
        .map(|(number, (least, greatest))| (numbers.names[number].clone(), least, greatest))
        .collect();
    let [difference, found] = [squares, best.squares].map(|squares| (squares / count).sqrt());
    (!ranges.is_empty()).then_some(Warning::Ambiguous { ranges, difference, found })
}
