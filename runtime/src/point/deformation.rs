//! Deformation of a point, the input of its energy, stress and tangent.
//!
//! This module has no formulas: `point.rs` has those from F, `small_strain.rs` those from F − I.

use super::{EnergyPoint, Filter, Point, StressPoint};
use crate::lanes::Real;
use crate::material::Response;

/// Deformation of a point: `&F`, the deformation gradient as a [`Matrix3`](super::Matrix3), or
/// [`DisplacementGradient`](super::DisplacementGradient)`(&H)` with H = F − I.
///
/// `D::Real` is the type of the entries.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a deformation",
    label = "expected `&F` or `DisplacementGradient(&H)`, with 3×3 matrices as arrays of their rows"
)]
pub trait Deformation: Evaluate {}

impl<D: Evaluate> Deformation for D {}

/// Results at a point from its deformation.
pub trait Evaluate: Copy {
    type Real: Real;

    fn energy(self, material: &(impl Response<Self::Real> + ?Sized)) -> EnergyPoint<Self::Real>;

    fn stress(self, material: &(impl Response<Self::Real> + ?Sized)) -> StressPoint<Self::Real>;

    fn point(self, material: &(impl Response<Self::Real> + ?Sized), filter: Filter) -> Point<Self::Real>;
}
