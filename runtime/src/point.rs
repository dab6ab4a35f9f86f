//! One point: a deformation gradient F, and the energy density, stress and tangent at F.
//!
//! F = U diag(λ) Vᵀ ([`svd()`]); an energy gives its derivatives in the stretches λ
//! ([`Material`](crate::Material)); the frames carry them back: P = U diag(ψi) Vᵀ ([`stress()`]) and dP/dF as
//! a block-diagonal map between the frames ([`Tangent`]; `point/tangent.rs` derives it), made semidefinite on
//! request ([`project()`]). [`evaluate_dense`] gives its 81 entries, by a shorter way if there is one. A
//! [`DisplacementGradient`] F − I instead of F keeps the digits of bodies that hardly deform. For codes that
//! have their own elements there are other [`measures`] of stress, with their tangents, and points in the
//! [`plane`]. Everything is generic over the real type, and points that cannot be computed are reported in a
//! [`Status`] instead of an error, because a point may be one of many in a batch.
//!
//! Conventions. A matrix is its rows. F is dimensionless, ψ is energy per rest volume in Pa, P = ∂ψ/∂F in Pa.
//! In a flattened matrix, entry (i, j) goes to 3i+j, so that dP/dF is 9×9 with a row for each entry of P and
//! a column for each entry of F.
//!
//! This module is independent of any particular material and of meshes.

#![expect(non_snake_case, reason = "F, P, U, V as in the literature")]

use crate::lanes::{Mask, Real, Truth, stage};
use crate::material::{Blocks, Response, ResponseKind};
use crate::quotient::pole_floor;
use crate::status::Status;

mod deflation;
mod deformation;
mod dense;
pub(crate) mod invariants;
pub(crate) mod matrix;
pub mod measures;
pub mod plane;
mod project;
mod small_strain;
mod stress;
pub(crate) mod svd;
mod tangent;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod twice;

pub use deformation::Deformation;
use deformation::Evaluate;
pub use dense::{DensePoint, evaluate_dense};
use invariants::{invariants_for, stress_by_invariants};
#[cfg(feature = "batch")]
pub(crate) use matrix::multiply;
use matrix::three;
pub use project::{Filter, project};
pub use small_strain::DisplacementGradient;
pub use stress::stress;
pub use svd::{Svd, svd, svd_signed_by_determinant};
pub use tangent::Tangent;
#[cfg(feature = "batch")]
pub(crate) use tangent::{Assemble, assemble_blocks};

/// A 3×3 matrix as its rows: entry (i, j) is `m[i][j]`.
pub type Matrix3<R> = [[R; 3]; 3];

/// Energy density of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyPoint<R: Real> {
    /// Energy density ψ, Pa.
    pub energy: R,
    /// Validity of the energy.
    pub status: Status<R::Mask>,
}

/// Stress at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressPoint<R: Real> {
    /// First Piola stress P, Pa.
    pub stress: Matrix3<R>,
    /// Validity of the stress.
    pub status: Status<R::Mask>,
}

/// Stress and tangent at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<R: Real> {
    /// The principal stretches λ1 ≥ λ2 ≥ |λ3| of F.
    pub stretches: [R; 3],
    /// First Piola stress P, Pa.
    pub stress: Matrix3<R>,
    /// dP/dF, filtered as requested, Pa.
    pub tangent: Tangent<R>,
    /// Status of the results: valid or not, and filtered or not.
    pub status: Status<R::Mask>,
}

impl<R: Real> Point<R> {
    /// Decomposition of F from which stress and tangent were computed.
    #[inline(always)]
    #[must_use]
    pub fn decomposition(&self) -> Svd<R> {
        Svd { U: self.tangent.U, stretches: self.stretches, V: self.tangent.V }
    }
}

/// Energy density ψ, Pa, at a deformation. Computes no derivative, and for an energy of I1, I2 and J alone,
/// well inside its domain, no decomposition of F.
#[inline(always)]
#[must_use]
pub fn evaluate_energy<D: Deformation>(
    material: &(impl Response<D::Real> + ?Sized),
    deformation: D,
) -> EnergyPoint<D::Real> {
    deformation.energy(material)
}

/// First Piola stress P, Pa, at a deformation. Computes no second derivative, and for an energy of I1, I2 and
/// J alone, well inside its domain, no decomposition of F.
#[inline(always)]
#[must_use]
pub fn evaluate_stress<D: Deformation>(
    material: &(impl Response<D::Real> + ?Sized),
    deformation: D,
) -> StressPoint<D::Real> {
    deformation.stress(material)
}

/// Stress and filtered tangent at a deformation.
///
/// Outside the domain of the energy the status is `refused` and the results are invalid. If it is not
/// `nonfinite`, stress and tangent are finite, and so are [`Tangent::to_matrix`] and [`Tangent::apply`] to
/// any dF with ‖dF‖ ≤ 1.
#[inline(always)]
#[must_use]
pub fn evaluate<D: Deformation>(
    material: &(impl Response<D::Real> + ?Sized),
    deformation: D,
    filter: Filter,
) -> Point<D::Real> {
    deformation.point(material, filter)
}

impl<R: Real> Evaluate for &Matrix3<R> {
    type Real = R;

    #[inline(always)]
    fn energy(self, material: &(impl Response<R> + ?Sized)) -> EnergyPoint<R> {
        let F = self;
        let (mut served, mut by_invariants) = (R::Mask::splat(false), R::splat(0.0));
        if material.has_energy_by_invariants() {
            let (invariants, is_in_range) = invariants_for(ResponseKind::EnergyByInvariants, material, F);
            by_invariants = material.energy_by_invariants(invariants);
            served = is_in_range & material.admits_invariants(invariants) & by_invariants.is_finite();
            if !(!served).any() {
                return EnergyPoint { energy: by_invariants, status: Status::clean() };
            }
        }
        let svd = decompose(material, F);
        let energy = material.energy(svd.stretches);
        let refused = !material.admits(svd.stretches) & !served;
        let nonfinite = !energy_is_finite(svd.stretches, energy) & !served;
        let energy = R::select(served, by_invariants, energy);
        EnergyPoint { energy, status: Status { refused, nonfinite, ..Status::clean() } }
    }

    #[inline(always)]
    fn stress(self, material: &(impl Response<R> + ?Sized)) -> StressPoint<R> {
        let F = self;
        let (mut served, mut by_invariants) = (R::Mask::splat(false), [[R::splat(0.0); 3]; 3]);
        if material.has_invariants() {
            (served, by_invariants) = stress_by_invariants(material, F);
            if !(!served).any() {
                return StressPoint { stress: by_invariants, status: Status::clean() };
            }
        }
        let svd = decompose(material, F);
        let P = stress(&svd, material.gradient(svd.stretches));
        let refused = !material.admits(svd.stretches) & !served;
        let nonfinite = !stress_is_finite(svd.stretches, &P) & !served;
        let P = three!(i => three!(j => R::select(served, by_invariants[i][j], P[i][j])));
        StressPoint { stress: P, status: Status { refused, nonfinite, ..Status::clean() } }
    }

    #[inline(always)]
    fn point(self, material: &(impl Response<R> + ?Sized), filter: Filter) -> Point<R> {
        let svd = decompose(material, self);
        let mut point = respond(&svd, &material.blocks(svd.stretches), material.has_pole(), filter);
        point.status.refused = !material.admits(svd.stretches);
        point
    }
}

/// Stress and filtered tangent from the derivatives of the energy in the stretches; the status leaves
/// `refused` unset.
#[inline(always)]
fn respond<R: Real>(svd: &Svd<R>, blocks: &Blocks<R>, has_pole: bool, filter: Filter) -> Point<R> {
    let P = stress(svd, blocks.gradient);
    let is_finite = stress_is_finite(svd.stretches, &P);
    let (blocks, mut status) = judge(svd.stretches, blocks, has_pole, filter);
    status.nonfinite = status.nonfinite | !is_finite;
    Point { stretches: svd.stretches, stress: P, tangent: Tangent { U: svd.U, V: svd.V, blocks }, status }
}

/// Filtered blocks and their status, which leaves `refused` unset.
#[inline(always)]
pub(crate) fn judge<R: Real>(
    stretches: [R; 3],
    blocks: &Blocks<R>,
    has_pole: bool,
    filter: Filter,
) -> (Blocks<R>, Status<R::Mask>) {
    let nonfinite = !tangent_stays_finite(blocks);
    let bounded = if has_pole {
        (stretches[1] + stretches[2]).less(pole_floor(stretches))
    } else {
        R::Mask::splat(false)
    };
    let (blocks, filtered) = project(blocks, filter);
    (blocks, Status { bounded, nonfinite, filtered, ..Status::clean() })
}

/// True if stretches and energy are valid.
#[inline(always)]
pub(crate) fn energy_is_finite<R: Real>(stretches: [R; 3], energy: R) -> R::Mask {
    stretches_in_range(stretches) & energy.is_finite()
}

/// True if no entry is infinite or NaN.
#[inline(always)]
pub(crate) fn entries_are_finite<R: Real>(A: &Matrix3<R>) -> R::Mask {
    none_infinite([none_infinite(A[0]), none_infinite(A[1]), none_infinite(A[2])]).is_finite()
}

/// True if stretches and stress are valid.
#[inline(always)]
pub(crate) fn stress_is_finite<R: Real>(stretches: [R; 3], P: &Matrix3<R>) -> R::Mask {
    let P = *P;
    stage!(R, "stress_is_finite", (stretches, P) => {
        Truth(stretches_in_range(stretches) & entries_are_finite(&P))
    })
    .0
}

/// Decomposes F as every evaluation of the material does: with [`svd_signed_by_determinant`] if its domain
/// ends at det F = 0, else with [`svd()`].
#[inline(always)]
#[must_use]
pub fn decompose<R: Real>(material: &(impl Response<R> + ?Sized), F: &Matrix3<R>) -> Svd<R> {
    if material.ends_at_zero_volume() { svd_signed_by_determinant(F) } else { svd(F) }
}

/// Zero if all are finite, else NaN: one comparison tests many.
#[inline(always)]
fn none_infinite<R: Real, const N: usize>(numbers: [R; N]) -> R {
    let zero = R::splat(0.0);
    let mut sum = zero;
    for number in numbers {
        sum = number.mul_add(zero, sum);
    }
    sum
}

/// Zero if none comes within a factor 16 of the largest finite number, else NaN.
#[inline(always)]
fn none_large<R: Real, const N: usize>(mut numbers: [R; N]) -> R {
    for number in &mut numbers {
        *number = *number * R::splat(16.0);
    }
    none_infinite(numbers)
}

/// True if stretches, their sums and their reciprocals are finite and have all digits: below a sixteenth of
/// the largest finite number.
#[inline(always)]
pub(crate) fn stretches_in_range<R: Real>(stretches: [R; 3]) -> R::Mask {
    none_large(stretches).is_finite()
}

/// True if no entry of dP/dF can overflow, filtered or not: no number exceeds a sixteenth of the largest
/// finite one.
///
/// With m the largest of the numbers, an eigenvalue of the Hessian block is at most 3m, which so bounds what
/// a filter leaves; and the partial sums of [`assemble_blocks`] between rotations stay below four times that.
#[inline(always)]
fn tangent_stays_finite<R: Real>(blocks: &Blocks<R>) -> R::Mask {
    let Blocks { hessian, flip, twist, .. } = *blocks;
    stage!(R, "tangent_stays_finite", (hessian, flip, twist) => {
        Truth((none_large(hessian) + none_large(flip) + none_large(twist)).is_finite())
    })
    .0
}
