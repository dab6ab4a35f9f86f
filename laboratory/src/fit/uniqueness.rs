//! Identifiability: which parameters, and combinations of them, the data determine near a minimum.
//!
//! All of it is in the singular values of ∂r/∂p with its columns scaled to the length one, after \[BKW80\]:
//! where one is small, the combination of parameters that belongs to it changes no residual.
//!
//! \[BKW80\] Belsley, Kuh, Welsch, *Regression Diagnostics*, 1980, chapter 3.

use std::collections::HashSet;

use super::candidate::Numbers;
use super::outcome::Warning;
use super::problem::Problem;

/// Share of the largest effect on a residual below which a parameter is not determined by it: rounding, such
/// as that of a bulk modulus at constant volume.
const SILENCE: f64 = 1e-9;
/// The greatest singular value by another, from which on \[BKW80\] call the dependence moderate to strong.
const CONDITION: f64 = 30.0;
/// A parameter that changes less than this, relative to the one that changes most, is not part of a
/// combination.
const SHARE: f64 = 0.01;

/// The numbers that the data do not determine: at all these places none of them changes any residual.
///
/// At a single place a number may merely be drowned, by an exponential at large stretches, or by a factor
/// that is zero there.
pub(super) fn unidentifiable<'a>(places: impl Iterator<Item = Problem<'a>>, numbers: &Numbers) -> Vec<usize> {
    let mut is_silent = vec![true; numbers.values.len()];
    let mut has_slopes = false;
    for place in places {
        let Some(slopes) = place.slopes() else { continue };
        has_slopes = true;
        for row in slopes.row_iter() {
            let change = |(slope, &number): (&f64, &usize)| {
                let value = place.values[number];
                (number, (slope * if value == 0.0 { 1.0 } else { value }).abs())
            };
            let changes: Vec<_> = row.iter().zip(&place.free).map(change).collect();
            // If numbers leave their range, none is determined.
            let greatest = changes.iter().fold(0.0, |greatest: f64, &(_, change)| greatest.max(change));
            for (number, change) in changes {
                is_silent[number] &= change.is_nan() || change <= SILENCE * greatest;
            }
        }
    }
    (0..is_silent.len()).filter(|&number| has_slopes && is_silent[number]).collect()
}

/// Standard errors, condition and warnings of a minimum.
pub(super) struct Analysis {
    /// √(diagonal of (Jᵀ J)⁻¹) of the free numbers: their standard errors for residuals with the standard
    /// deviation 1.
    pub(super) errors: Vec<f64>,
    /// The greatest singular value by the least.
    pub(super) condition: f64,
    pub(super) warnings: Vec<Warning>,
}

pub(super) fn analyse(problem: &Problem<'_>, numbers: &Numbers) -> Analysis {
    let nothing = || Analysis { errors: Vec::new(), condition: f64::INFINITY, warnings: Vec::new() };
    let Some(mut slopes) = problem.slopes() else { return nothing() };
    let lengths: Vec<f64> = slopes.column_iter().map(|column| column.norm()).collect();
    if !lengths.iter().all(|&length| length.is_finite() && length > 0.0) {
        return nothing();
    }
    for (mut column, length) in slopes.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let rows = problem.count() as f64;
    let decomposed = slopes.svd(false, true);
    let Some(directions) = decomposed.v_t else { return nothing() };
    let singular = &decomposed.singular_values;
    let greatest = singular.max();

    let mut errors = vec![0.0_f64; lengths.len()];
    let mut combinations = Vec::new();
    for (direction, &value) in directions.row_iter().zip(singular) {
        for (error, component) in errors.iter_mut().zip(direction.iter()) {
            *error += (component / value).powi(2);
        }
        if greatest < CONDITION * value {
            continue;
        }
        // Relative changes of the parameters; of one that is zero, absolute ones.
        let changes: Vec<f64> = (0..lengths.len())
            .map(|k| {
                let number = problem.values[problem.free[k]];
                direction[k] / lengths[k] / if number == 0.0 { 1.0 } else { number }
            })
            .collect();
        let most = changes.iter().copied().fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        let named = problem.free.iter().zip(&changes);
        let part = named.filter(|(_, change)| change.abs() >= SHARE * most.abs());
        let changes = part.map(|(&number, change)| (numbers.names[number].clone(), change / most));
        combinations.push((changes.collect(), value / most.abs() / rows.sqrt()));
    }
    for (error, length) in errors.iter_mut().zip(&lengths) {
        *error = error.sqrt() / length;
    }
    Analysis { errors, condition: greatest / singular.min(), warnings: warnings(combinations) }
}

/// One for each set of parameters: of combinations of the same ones that which changes least.
fn warnings(mut combinations: Vec<(Vec<(String, f64)>, f64)>) -> Vec<Warning> {
    combinations.sort_by(|(_, a), (_, b)| a.total_cmp(b));
    let mut seen = HashSet::new();
    combinations
        .retain(|(changes, _)| seen.insert(changes.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>()));
    let warning = |(changes, effect)| Warning::Collinear { changes, effect };
    combinations.into_iter().map(warning).collect()
}
