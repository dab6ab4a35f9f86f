//! Nanoseconds and errors of P and dP/dF, method by method, at the reference cases.
//!
//! Each family of cases is a contest of its own: all methods get its deformation gradients in one run, in
//! turns, and what they leave behind is judged.

use std::any::type_name;
use std::collections::BTreeMap;
use std::hint::black_box;

use piola::Real;
use piola::batch::Kernels;
use piola::point::Filter;
use piola_speed::{Effort, Times, is_on_front, time_in_turns};
use piola_tests::cases::{Case, Quantity};
use serde::Serialize;

mod contestant;
mod energies;
mod methods;

use contestant::{Contestant, Number, Output, POINTS, Points};
pub(crate) use energies::ENERGIES;
use energies::contestants;
pub(crate) use methods::{OURS, OURS_AS_A_SCALAR};

/// A method at a family of deformation gradients.
#[derive(Clone, Serialize)]
pub(crate) struct PointRow {
    /// `tangent`: P and dP/dF; `projected`: P and the nearest semidefinite matrix to dP/dF.
    pub(crate) work: &'static str,
    pub(crate) material: &'static str,
    pub(crate) precision: &'static str,
    pub(crate) method: &'static str,
    pub(crate) setting: String,
    /// The least of the repeats.
    pub(crate) ns_per_element: f64,
    /// The larger of ‖X − X*‖/(‖X*‖ + sens) of P and of the matrix.
    pub(crate) worst_error: f64,
    pub(crate) median_error: f64,
    pub(crate) family: String,
    pub(crate) cases: usize,
    /// True if it takes any ψ(λ1, λ2, λ3).
    pub(crate) is_general: bool,
    /// True if no other method for any ψ(λ) is both faster and more accurate in the worst case.
    pub(crate) is_on_front: bool,
}

/// The family of F = I + 0.3 X, entries of X uniform in [−1, 1).
pub(crate) const ORDINARY: &str = "ordinary";

/// All families but [`ORDINARY`] in one row: the worst error, the median of errors, the mean of times.
pub(crate) const HARD: &str = "every hard family";

/// Outputs that are computed in addition to P, by name.
const WORKS: [(&str, Filter, Quantity); 2] =
    [("tangent", Filter::None, Quantity::Tangent), ("projected", Filter::Clamp, Quantity::Projected)];

pub(crate) fn rows(effort: Effort) -> Result<Vec<PointRow>, String> {
    // Those whose energies take part.
    let cases = Case::own(&["cases", "cases-ordinary"])?;
    let mut rows = Vec::new();
    for (name, in_catalogue) in ENERGIES {
        eprintln!("points: {name} …");
        let cases: Vec<&Case> = cases.iter().filter(|case| case.material == in_catalogue).collect();
        rows.extend(contests::<f64>(name, &cases, effort)?);
        rows.extend(contests::<f32>(name, &cases, effort)?);
    }
    Ok(rows)
}

/// The cases that a format can hold, by family.
fn families<'a, E: Kernels>(cases: &[&'a Case]) -> BTreeMap<&'a str, Vec<&'a Case>> {
    let mut families: BTreeMap<&str, Vec<&Case>> = BTreeMap::new();
    for case in cases {
        let fits = |quantity| case.reference(quantity).into_iter().all(|x| E::splat(x).is_finite());
        let is_exact = E::UNIT_ROUNDOFF == f64::UNIT_ROUNDOFF || case.f32_exact;
        if is_exact && [Quantity::Stress, Quantity::Tangent, Quantity::Projected].into_iter().all(fits) {
            families.entry(&case.tag).or_default().push(case);
        }
    }
    families
}

fn contests<E: Number>(
    energy: &'static str,
    cases: &[&Case],
    effort: Effort,
) -> Result<Vec<PointRow>, String> {
    let mut rows = Vec::new();
    for work in WORKS {
        let mut of_work = Vec::new();
        for (family, cases) in families::<E>(cases) {
            let rows = contest::<E>(work, energy, family, &cases, effort)?;
            of_work.extend(with_front(rows, E::UNIT_ROUNDOFF));
        }
        of_work.extend(with_front(all_hard(&of_work), E::UNIT_ROUNDOFF));
        rows.extend(of_work);
    }
    Ok(rows)
}

/// Deformation gradients of one energy: point i is that of case i mod the number of cases.
struct Group<'a, E> {
    cases: Vec<&'a Case>,
    points: Points<E>,
    contestants: Vec<Contestant<E>>,
}

fn contest<E: Number>(
    (work, filter, quantity): (&'static str, Filter, Quantity),
    energy: &'static str,
    family: &str,
    cases: &[&Case],
    effort: Effort,
) -> Result<Vec<PointRow>, String> {
    let mut groups: Vec<Group<'_, E>> = Vec::new();
    // Ordinary cases share one energy and go side by side; each hard case has parameters of its own.
    let size = if family == ORDINARY { cases.len() } else { 1 };
    for cases in cases.chunks(size) {
        groups.push(Group {
            cases: cases.to_vec(),
            points: Points::new(|point| cases[point % cases.len()].deformation),
            contestants: contestants(cases[0], filter)?,
        });
    }
    let labels: Vec<_> = groups[0].contestants.iter().map(|contestant| contestant.label.clone()).collect();
    let mut output = Output::new();
    let mut errors = vec![Vec::new(); labels.len()];
    for group in &groups {
        for (contestant, errors) in group.contestants.iter().zip(&mut errors) {
            output.clear();
            (contestant.run)(&group.points, &mut output);
            errors.extend(group.cases.iter().enumerate().map(|(point, case)| {
                let (stress, tangent) = output.of_point(point, contestant.layout);
                judge::<E>(case, Quantity::Stress, &stress).max(judge::<E>(case, quantity, &tangent))
            }));
        }
    }
    let times = in_turns(&groups, effort);
    let rows = labels.into_iter().zip(errors).zip(times).map(|((label, mut errors), times)| {
        errors.sort_by(f64::total_cmp);
        PointRow {
            work,
            material: energy,
            precision: type_name::<E>(),
            method: label.method,
            setting: label.setting,
            ns_per_element: times.least,
            worst_error: errors[errors.len() - 1],
            median_error: errors[errors.len() / 2],
            family: family.to_owned(),
            cases: errors.len(),
            is_general: label.is_general,
            is_on_front: false,
        }
    });
    Ok(rows.collect())
}

/// ‖X − X*‖/(‖X*‖ + sens).
fn judge<E: Real>(case: &Case, quantity: Quantity, values: &[f64]) -> f64 {
    case.error(quantity, values, 0.0, E::UNIT_ROUNDOFF) * E::UNIT_ROUNDOFF
}

/// The times of the contestants, each over all groups.
fn in_turns<E: Kernels>(groups: &[Group<'_, E>], effort: Effort) -> Vec<Times> {
    let calls = (0..groups[0].contestants.len()).map(move |method| {
        let mut output = Output::new();
        move || {
            for Group { points, contestants, .. } in groups {
                (contestants[method].run)(points, &mut output);
                black_box(&output);
            }
        }
    });
    let mut calls: Vec<_> = calls.collect();
    let mut calls: Vec<&mut dyn FnMut()> = calls.iter_mut().map(|call| call as &mut dyn FnMut()).collect();
    time_in_turns(effort, POINTS * groups.len(), &mut calls)
}

/// A row for each method, which all are in every hard family.
fn all_hard(rows: &[PointRow]) -> Vec<PointRow> {
    let hard = || rows.iter().filter(|row| row.family != ORDINARY);
    let first = hard().next().map(|row| &row.family);
    let together = hard().filter(|row| Some(&row.family) == first).map(|row| {
        let same = |other: &&PointRow| (other.method, &other.setting) == (row.method, &row.setting);
        let of_families: Vec<&PointRow> = hard().filter(same).collect();
        let mut medians: Vec<f64> = of_families.iter().map(|row| row.median_error).collect();
        medians.sort_by(f64::total_cmp);
        let total: f64 = of_families.iter().map(|row| row.ns_per_element).sum();
        PointRow {
            family: HARD.to_owned(),
            ns_per_element: total / medians.len() as f64,
            worst_error: of_families.iter().map(|row| row.worst_error).fold(0.0, f64::max),
            median_error: medians[medians.len() / 2],
            cases: of_families.iter().map(|row| row.cases).sum(),
            ..row.clone()
        }
    });
    together.collect()
}

/// Rows of one family, marked where no method for any ψ(λ) beats them in both time and worst error.
fn with_front(mut rows: Vec<PointRow>, unit: f64) -> Vec<PointRow> {
    let pair = |row: &PointRow| (row.ns_per_element, row.worst_error);
    let rivals: Vec<(f64, f64)> = rows.iter().filter(|row| row.is_general).map(pair).collect();
    for row in &mut rows {
        row.is_on_front = is_on_front(pair(row), &rivals, unit);
    }
    rows
}
