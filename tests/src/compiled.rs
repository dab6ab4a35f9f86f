//! The evaluation of a point, compiled once for each precision.
//!
//! In `piola` it is inlined wherever it is called, for the sake of speed. A judge calls it at many places.

#![expect(non_snake_case, reason = "F as in the literature")]

use piola::Real;
use piola::material::Response;
use piola::point::{self, Deformation, DensePoint, EnergyPoint, Filter, Matrix3, Point, StressPoint, Svd};

/// [`point::evaluate`].
#[inline(never)]
pub fn evaluate<D: Deformation>(
    material: &dyn Response<D::Real>,
    deformation: D,
    filter: Filter,
) -> Point<D::Real> {
    point::evaluate(material, deformation, filter)
}

/// [`point::evaluate_dense`].
#[inline(never)]
pub fn evaluate_dense<R: Real>(material: &dyn Response<R>, F: &Matrix3<R>, filter: Filter) -> DensePoint<R> {
    point::evaluate_dense(material, F, filter)
}

/// [`point::evaluate_energy`].
#[inline(never)]
pub fn evaluate_energy<D: Deformation>(
    material: &dyn Response<D::Real>,
    deformation: D,
) -> EnergyPoint<D::Real> {
    point::evaluate_energy(material, deformation)
}

/// [`point::evaluate_stress`].
#[inline(never)]
pub fn evaluate_stress<D: Deformation>(
    material: &dyn Response<D::Real>,
    deformation: D,
) -> StressPoint<D::Real> {
    point::evaluate_stress(material, deformation)
}

/// [`point::svd()`].
#[inline(never)]
pub fn svd<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    point::svd(F)
}
