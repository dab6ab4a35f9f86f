//! Checks of the status at any finite deformation gradient: invalid results are flagged, and valid ones are
//! not.
//!
//! One half needs no oracle ([`check`], [`check_elements`]): where a status is clean, ψ, P, dP/dF, forces and
//! stiffness are finite, and all evaluations of one deformation agree on whether it is refused. The other
//! half compares `f32` with `f64` ([`check_single`]): what every deformation within rounding of F has
//! comfortably inside the range of `f32` may not be flagged there, and must be right there.
//!
//! This module is independent of any particular material, and draws no samples.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::collections::BTreeMap;

use piola::StatusCell;
use piola::batch::{Batch, TileMaterial};
use piola::material::{Blocks, Response};
use piola::point::{EnergyPoint, Filter, Matrix3, StressPoint, decompose};

use crate::bits::widen;
use crate::compiled::{evaluate, evaluate_energy, evaluate_stress};
use crate::energies::{Format, Subject};

/// The filters, in the order of their strength.
pub const FILTERS: [Filter; 3] = [Filter::None, Filter::Clamp, Filter::Absolute];

/// Kind of answer to a deformation, if it is sound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Answer {
    /// All numbers are exact to rounding.
    Clean,
    /// The tangent has a bounded value in place of an infinite one.
    Bounded,
    /// Deformation outside the domain.
    Refused,
    /// Deformation outside the range of the format.
    Nonfinite,
    /// Said to be outside the range of the format, though it fits, because a part of it does not.
    FlaggedEarly,
}

/// What is wrong with a result at a deformation.
pub type Fault = String;

/// For any entries of F a clean status means finite numbers, and the status does not depend on the requested
/// results.
pub fn check<R: Format>(material: &dyn Response<R>, F: &Matrix3<R>) -> Result<Answer, Fault> {
    let EnergyPoint { energy, status: energy_status } = evaluate_energy(material, F);
    let StressPoint { stress, status: stress_status } = evaluate_stress(material, F);
    let finite_input = F.iter().flatten().all(|x| x.is_finite());
    let mut answer = Answer::Clean;
    for filter in FILTERS {
        let point = evaluate(material, F, filter);
        let status = point.status;
        if status.refused != energy_status.refused || status.refused != stress_status.refused {
            return Err("energy, stress and tangent disagree on whether it is refused".to_owned());
        }
        let all_flagged = status.nonfinite && energy_status.nonfinite && stress_status.nonfinite;
        if !finite_input && !all_flagged {
            return Err(unflagged("tangent"));
        }
        if status.refused {
            return Ok(Answer::Refused);
        }
        if status.nonfinite {
            answer = Answer::Nonfinite;
            continue;
        }
        if status.bounded {
            answer = Answer::Bounded;
        }
        finite("stress", point.stress.iter().flatten())?;
        let tangent = point.tangent.to_matrix();
        finite("tangent", tangent.iter().flatten())?;
        if (0..9).any(|row| (0..row).any(|column| tangent[row][column] != tangent[column][row])) {
            return Err("a clean tangent is not symmetric".to_owned());
        }
        if filter != Filter::None && !is_semidefinite(&point.tangent.blocks) {
            return Err("a filtered tangent has a negative eigenvalue".to_owned());
        }
    }
    if !energy_status.nonfinite {
        finite("energy", [&energy])?;
    }
    if !stress_status.nonfinite {
        finite("stress alone", stress.iter().flatten())?;
    }
    Ok(answer)
}

fn finite<'a, R: Format>(quantity: &str, entries: impl IntoIterator<Item = &'a R>) -> Result<(), Fault> {
    if entries.into_iter().all(|x| x.is_finite()) { Ok(()) } else { Err(unflagged(quantity)) }
}

fn unflagged(quantity: &str) -> Fault {
    format!("{quantity}: infinite or NaN under a clean status")
}

/// Flips and twists are eigenvalues themselves; of the 3×3 block the eigenvalues are known to a few u of the
/// largest, for which 64 u leaves room.
fn is_semidefinite<R: Format>(blocks: &Blocks<R>) -> bool {
    let zero = R::splat(0.0);
    if blocks.flip.iter().chain(&blocks.twist).any(|&x| x < zero) {
        return false;
    }
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian.map(R::widen);
    let scale = [h11, h22, h33, h12, h13, h23].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if scale == 0.0 {
        return true;
    }
    let H = nalgebra::Matrix3::new(h11, h12, h13, h12, h22, h23, h13, h23, h33) / scale;
    let underflow = R::SMALLEST / scale;
    H.symmetric_eigenvalues().min() >= -64.0 * R::UNIT_ROUNDOFF - 64.0 * underflow
}

/// Checks a batch of tetrahedra with the corner shape at rest: where the status of one is clean, its energy,
/// stress, forces and stiffness are finite. Returns the first fault of each that has one, by its index.
pub fn check_elements(material: &dyn TileMaterial<f64>, F: &[Matrix3<f64>]) -> Vec<(usize, Fault)> {
    const REST: [f64; 10] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0 / 6.0];
    const FITS: &str = "the lengths are those of the points";
    let points = F.len();
    let (F, rest) = (F.as_flattened().as_flattened(), REST.repeat(points));
    let statuses: Vec<StatusCell> = F.chunks(9).map(|_| StatusCell::default()).collect();
    let mut faults = BTreeMap::new();
    let mut check = |quantity: &str, results: &[f64]| {
        for (point, entries) in results.chunks(results.len() / points).enumerate() {
            if statuses[point].get().is_clean()
                && let Err(fault) = finite(quantity, entries)
            {
                faults.entry(point).or_insert(fault);
            }
        }
    };
    // No filter acts on these.
    let batch = Batch::new(material).with_statuses(&statuses);
    let (mut energies, mut stresses) = (vec![0.0; points], vec![0.0; 9 * points]);
    batch.energies(F, &mut energies).expect(FITS);
    check("energy", &energies);
    batch.stresses(F, &mut stresses).expect(FITS);
    check("stress alone", &stresses);
    let (mut gradients, mut stiffnesses) = (vec![0.0; 12 * points], vec![0.0; 144 * points]);
    for filter in FILTERS {
        let batch = Batch::new(material).with_statuses(&statuses).with_filter(filter);
        batch.stiffnesses(F, &rest, &mut gradients, &mut stiffnesses).expect(FITS);
        check("forces", &gradients);
        check("stiffness", &stiffnesses);
    }
    faults.into_iter().collect()
}

/// Stretches, and their reciprocals, up to which `f32` must have an answer wherever there is one. Beyond, a
/// power of a stretch, or a product of two, may leave the format though the answer does not, and it is enough
/// that the status reports it.
pub const ORDINARY: f64 = 30.0;

/// `f32` against `f64` on the same numbers; whether it is flagged early, at stretches that are not
/// [`ORDINARY`].
pub fn check_single(subject: &Subject, F: &Matrix3<f32>) -> Result<bool, Fault> {
    let Subject { double: material, single, .. } = subject;
    let material: &dyn Response<f64> = &**material;
    let energy = evaluate_energy(&**single, F).status;
    let stress = evaluate_stress(&**single, F).status;
    let tangent = evaluate(&**single, F, Filter::None).status;
    let stretches = decompose(material, &widen(F)).stretches;
    let is_flagged = energy.nonfinite || stress.nonfinite || tangent.nonfinite || tangent.bounded;
    if !is_flagged && material.admits(stretches) != energy.refused {
        // Both formats agree on the domain, and so no neighbour can contradict.
        return Ok(false);
    }
    match agreed(material, stretches) {
        Some(true) if energy.refused && !energy.nonfinite => {
            return Err("refused well inside the domain".to_owned());
        }
        Some(false) if !energy.refused && !energy.nonfinite => {
            return Err("admitted well outside the domain".to_owned());
        }
        Some(true) if is_flagged => {}
        _ => return Ok(false),
    }
    let is_ordinary = stretches.iter().all(|stretch| (1.0 / ORDINARY..ORDINARY).contains(&stretch.abs()));
    let floor = 64.0 * SINGLE * stretches[0] + 64.0 * f64::from(f32::MIN_POSITIVE).sqrt();
    let is_far_from_pole = stretches[1] + stretches[2] > floor;
    let [energy_fits, stress_fits, tangent_fits] = fits(material, stretches, is_far_from_pole);
    let quantities = [
        ("energy", energy_fits && energy.nonfinite),
        ("stress alone", stress_fits && stress.nonfinite),
        ("tangent", tangent_fits && tangent.nonfinite),
    ];
    if let Some((quantity, _)) = quantities.into_iter().find(|(_, is_early)| *is_early) {
        return if is_ordinary { Err(format!("{quantity}: flagged though it fits")) } else { Ok(true) };
    }
    if is_far_from_pole && tangent.bounded && !tangent.nonfinite {
        return Err("said to be at a pole though far from one".to_owned());
    }
    Ok(false)
}

/// Checks that a clean answer of `f32` is that of `f64` up to rounding.
///
/// ‖X₃₂ − X₆₄‖ ≤ C u ‖X‖ + C u sens with C = 64, twice what the reference cases allow because two roundings
/// of a result are compared; C u sens = √Σ‖X(F ± C u ‖F‖ Eij) − X(F)‖² over the nine unit matrices is
/// measured in `f64`, not linearised. Nothing is said where one of these deformations is refused, bounded or
/// outside the format, nor where they lie around the end of a domain at zero volume or a pole. A modulus
/// times a few of the smallest numbers is allowed for intermediate numbers that underflow and a logarithm of
/// up to 88 that multiplies them.
pub fn check_single_accuracy(subject: &Subject, F: &Matrix3<f32>) -> Result<(), Fault> {
    let single = evaluate(&*subject.single, F, Filter::None);
    let material: &dyn Response<f64> = &*subject.double;
    let clean = |status: piola::Status<bool>| !(status.refused || status.bounded || status.nonfinite);
    let F = widen(F);
    let double = evaluate(material, &F, Filter::None);
    if !clean(single.status) || !clean(double.status) {
        return Ok(());
    }
    const C: f64 = 64.0;
    let size = F.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    let step = C * SINGLE * size + C * f32::SMALLEST;
    let [l1, l2, l3] = decompose(material, &F).stretches;
    let at_zero_volume = l3.abs() < 8.0 * step && !material.admits([l1, l2, 0.0]);
    let at_pole = l2 + l3 < 8.0 * step && material.has_pole();
    if at_zero_volume || at_pole {
        return Ok(());
    }
    let (stress, tangent) = (double.stress, double.tangent.to_matrix());
    let (mut stress_change, mut tangent_change) = (0.0, 0.0);
    for direction in 0..18 {
        let mut near = F;
        near[direction / 2 / 3][direction / 2 % 3] += if direction % 2 == 0 { step } else { -step };
        let near = evaluate(material, &near, Filter::None);
        if !clean(near.status) {
            return Ok(());
        }
        stress_change = f64::hypot(stress_change, distance(&near.stress, &stress));
        tangent_change = f64::hypot(tangent_change, distance(&near.tangent.to_matrix(), &tangent));
    }
    let underflow = C * 88.0 * f32::SMALLEST * material.blocks([1.0_f64; 3]).hessian[0].abs().max(1.0);
    let allowed = |norm: f64, change: f64| C * SINGLE * norm + change + underflow;
    let zero = [[0.0; 9]; 9];
    if distance(&widen(&single.stress), &stress) > allowed(distance(&stress, &[[0.0; 3]; 3]), stress_change) {
        return Err("stress: off by more than rounding of F and of the result".to_owned());
    }
    let found = single.tangent.to_matrix().map(|row| row.map(f32::widen));
    if distance(&found, &tangent) > allowed(distance(&tangent, &zero), tangent_change) {
        return Err("tangent: off by more than rounding of F and of the result".to_owned());
    }
    Ok(())
}

/// Frobenius norm of a difference. Neither its square nor that of its entries need fit the format.
fn distance<const N: usize>(a: &[[f64; N]; N], b: &[[f64; N]; N]) -> f64 {
    a.iter().flatten().zip(b.iter().flatten()).fold(0.0, |norm: f64, (x, y)| norm.hypot(x - y))
}

const SINGLE: f64 = <f32 as piola::Real>::UNIT_ROUNDOFF;

/// True if all deformations that an `f32` decomposition cannot distinguish from these stretches are inside
/// the domain, or all outside.
fn agreed(material: &dyn Response<f64>, stretches: [f64; 3]) -> Option<bool> {
    let here = material.admits(stretches);
    let mut others = indistinguishable(material.ends_at_zero_volume(), stretches);
    others.all(|there| material.admits(there) == here).then_some(here)
}

/// True for ψ, P and dP/dF each if it fits `f32` at all deformations that an `f32` decomposition cannot tell
/// from given stretches.
fn fits(material: &dyn Response<f64>, stretches: [f64; 3], is_far_from_pole: bool) -> [bool; 3] {
    // A result of entries up to this fits `f32` with room for the sums that its entries are.
    let limit = f32::LARGEST / 32.0;
    let fits = |values: &[f64]| values.iter().all(|value| value.abs() < limit);
    let (mut energy, mut stress) = (true, is_far_from_pole || !material.has_pole());
    let mut tangent = stress;
    for stretches in indistinguishable(material.ends_at_zero_volume(), stretches) {
        let blocks = material.blocks(stretches);
        energy &= fits(&[material.energy(stretches)]) && fits(&stretches);
        stress &= fits(&blocks.gradient) && fits(&stretches);
        tangent &= stress && fits(&blocks.hessian) && fits(&blocks.flip) && fits(&blocks.twist);
    }
    [energy, stress, tangent]
}

/// The corners, faces and centre of the box of stretches within the error of an `f32` decomposition, which is
/// documented as 20 u λ1, and for a λ3 from the determinant as the relative error of λ1 λ2.
fn indistinguishable(ends_at_zero_volume: bool, [l1, l2, l3]: [f64; 3]) -> impl Iterator<Item = [f64; 3]> {
    let error = 20.0 * SINGLE * l1 + f32::SMALLEST;
    let ratio = (l2 / l1) * (l3 / l1).abs();
    let sign_is_known = ratio > 32.0 * SINGLE * SINGLE && ratio > 2.0 * f64::from(f32::MIN_POSITIVE) / SINGLE;
    let third = if ends_at_zero_volume && sign_is_known {
        (l3.abs() * (error / l2 + error / l1 + 32.0 * SINGLE) + f32::SMALLEST).min(error.max(l3.abs()))
    } else {
        error
    };
    // A domain may end at zero volume from both sides.
    let flat = (l3.abs() <= third).then_some([l1, l2, 0.0]);
    let corners = (0..27).map(move |corner: i32| {
        let [a, b, c] = [corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1].map(f64::from);
        let (x, y, z) = ((l1 + a * error).max(0.0), (l2 + b * error).max(0.0), l3 + c * third);
        let (x, y) = (x.max(y), x.min(y));
        let (y, magnitude) = (y.max(z.abs()), y.min(z.abs()));
        [x.max(y), x.min(y), magnitude.copysign(z)]
    });
    corners.chain(flat)
}
