//! Parameters, and combinations of them, that the data do not determine near a minimum, and others with which
//! a fit is about as good.
//!
//! The former are in the singular values of ∂r/∂p with its columns scaled to the length one, after \[BKW80\]:
//! where one is small, the combination of parameters that belongs to it changes no residual.
//!
//! The latter are those of other minima, and others of the same solid: the exponent of a term whose
//! coefficient has vanished is arbitrary; for two terms with the same exponent only the sum matters; and a
//! parameter that grows without bound changes less and less.
//!
//! \[BKW80\] Belsley, Kuh, Welsch, *Regression Diagnostics*, 1980, chapter 3.

use std::collections::{BTreeMap, HashSet};

use piola::material::Form;

use super::minimum::Minimum;
use super::outcome::{Number, Warning};
use super::problem::Problem;

/// Share of the largest effect on a residual below which a parameter is not determined by it: rounding, such
/// as that of a bulk modulus at constant volume.
const SILENCE: f64 = 1e-9;
/// The greatest singular value by another, from which on \[BKW80\] call the dependence moderate to strong.
const CONDITION: f64 = 30.0;
/// A parameter that changes less than this, relative to the one that changes most, is not part of a
/// combination.
const SHARE: f64 = 0.01;
/// Bound for another minimum to count as about as good: its differences, relative to those of the best.
const ABOUT_AS_GOOD: f64 = 1.1;
/// Parameters are the same if their relative difference is no more than this.
const SAME: f64 = 0.01;
/// A parameter that is less than this share of the one given counts as zero, as happens at an edge.
const ZERO: f64 = 1e-9;

/// True for each number that the data do not determine: at none of these places it changes any residual.
///
/// At a single place a number may merely be drowned, by an exponential at large stretches, or by a factor
/// that is zero there.
pub(super) fn are_silent<'a>(places: impl Iterator<Item = Problem<'a>>, numbers: usize) -> Vec<bool> {
    let mut are_silent = vec![true; numbers];
    let mut has_slopes = false;
    for place in places {
        let Some(slopes) = place.slopes() else { continue };
        has_slopes = true;
        for row in slopes.row_iter() {
            let change = |(slope, &number): (&f64, &usize)| {
                let value = place.values[number];
                (number, (slope * if value == 0.0 { 1.0 } else { value }).abs())
            };
            let changes: Vec<_> = row.iter().zip(place.task.free).map(change).collect();
            // If numbers leave their range, none is determined.
            let greatest = changes.iter().fold(0.0, |greatest: f64, &(_, change)| greatest.max(change));
            for (number, change) in changes {
                are_silent[number] &= change.is_nan() || change <= SILENCE * greatest;
            }
        }
    }
    if has_slopes { are_silent } else { vec![false; numbers] }
}

/// √(diagonal of (Jᵀ J)⁻¹) of the free numbers, which are their standard errors for residuals with the
/// standard deviation 1, the greatest singular value by the least, and warnings of a minimum.
pub(super) fn analyse(problem: &Problem<'_>, numbers: &[Number]) -> Option<(Vec<f64>, f64, Vec<Warning>)> {
    let free = problem.task.free;
    let (slopes, lengths) = problem.scaled_slopes()?;
    let rows = slopes.nrows() as f64;
    let decomposed = slopes.svd(false, true);
    let (directions, singular) = (decomposed.v_t?, decomposed.singular_values);
    let greatest = singular.max();

    let mut errors = vec![0.0_f64; lengths.len()];
    let mut combinations: Vec<(Vec<(String, f64)>, f64)> = Vec::new();
    for (direction, &value) in directions.row_iter().zip(&singular) {
        for (error, component) in errors.iter_mut().zip(direction.iter()) {
            *error += (component / value).powi(2);
        }
        if greatest < CONDITION * value {
            continue;
        }
        // Relative changes of the parameters; of one that is zero, absolute ones.
        let changes: Vec<f64> = (0..lengths.len())
            .map(|k| {
                let number = problem.values[free[k]];
                direction[k] / lengths[k] / if number == 0.0 { 1.0 } else { number }
            })
            .collect();
        let most = changes.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let part = free.iter().zip(&changes).filter(|(_, change)| change.abs() >= SHARE * most.abs());
        let changes = part.map(|(&number, change)| (numbers[number].name.clone(), change / most));
        combinations.push((changes.collect(), value / most.abs() / rows.sqrt()));
    }
    for (error, length) in errors.iter_mut().zip(lengths.iter()) {
        *error = error.sqrt() / length;
    }
    // One for each set of parameters: of combinations of the same ones that which changes least.
    combinations.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    let mut seen = HashSet::new();
    combinations
        .retain(|(changes, _)| seen.insert(changes.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>()));
    let warning = |(changes, effect)| Warning::Collinear { changes, effect };
    Some((errors, greatest / singular.min(), combinations.into_iter().map(warning).collect()))
}

/// The ranges of parameters over the minima that are about as good as the best, if they differ.
pub(super) fn ambiguous(best: &Minimum<'_>, minima: &[Minimum<'_>], numbers: &[Number]) -> Option<Warning> {
    let count = best.problem.task.points.len() as f64;
    // Values that are exact up to rounding are as good as exact ones.
    let limit = best.squares * ABOUT_AS_GOOD * ABOUT_AS_GOOD + count * 1e-24;
    let (mut ranges, mut squares) = (BTreeMap::new(), best.squares);
    let is_as_good = |minimum: &&Minimum<'_>| minimum.is_least && minimum.squares <= limit;
    for minimum in minima.iter().filter(is_as_good) {
        let mut begin = 0;
        for &(length, form) in best.problem.task.parameters {
            let list = begin..begin + length;
            begin += length;
            // Terms of a sum that change places are the same energy, those of each sum by themselves. Values
            // of a function are compared in their order.
            let [ours, theirs] = [best, minimum].map(|minimum| {
                let values = &minimum.problem.values;
                let free = best.problem.task.free;
                let mut places: Vec<usize> = list.clone().filter(|number| free.contains(number)).collect();
                if form == Form::List {
                    places.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
                }
                places
            });
            for (number, other) in ours.into_iter().zip(theirs) {
                let (here, there) = (best.problem.values[number], minimum.problem.values[other]);
                let zero = ZERO * numbers[number].value.abs();
                if (here - there).abs() <= SAME * here.abs().max(there.abs()) + zero {
                    continue;
                }
                let (least, greatest) = ranges.entry(number).or_insert((here, here));
                (*least, *greatest) = (least.min(there), greatest.max(there));
                squares = squares.max(minimum.squares);
            }
        }
    }
    let ranges: Vec<_> = ranges
        .into_iter()
        .map(|(number, (least, greatest))| (numbers[number].name.clone(), least, greatest))
        .collect();
    let [difference, found] = [squares, best.squares].map(|squares| (squares / count).sqrt());
    (!ranges.is_empty()).then_some(Warning::Ambiguous { ranges, difference, found })
}
