//! The evaluation of a point, compiled once for each precision.
//!
//! In `piola` it is inlined wherever it is called, for the sake of speed. A judge calls it at many places.

#![expect(non_snake_case, reason = "F and H as in the literature")]

use piola::Real;
use piola::Status;
use piola::material::Response;
use piola::point::{self, DensePoint, Filter, Matrix3, Point, Svd};

/// [`point::evaluate`].
#[inline(never)]
pub fn evaluate<R: Real>(material: &dyn Response<R>, F: &Matrix3<R>, filter: Filter) -> Point<R> {
    point::evaluate(material, F, filter)
}

/// [`point::evaluate_dense`].
#[inline(never)]
pub fn evaluate_dense<R: Real>(material: &dyn Response<R>, F: &Matrix3<R>, filter: Filter) -> DensePoint<R> {
    point::evaluate_dense(material, F, filter)
}

/// [`point::evaluate_energy`].
#[inline(never)]
pub fn evaluate_energy<R: Real>(material: &dyn Response<R>, F: &Matrix3<R>) -> (R, Status<R::Mask>) {
    point::evaluate_energy(material, F)
}

/// [`point::evaluate_stress`].
#[inline(never)]
pub fn evaluate_stress<R: Real>(material: &dyn Response<R>, F: &Matrix3<R>) -> (Matrix3<R>, Status<R::Mask>) {
    point::evaluate_stress(material, F)
}

/// [`point::evaluate_energy_from_displacement`].
#[inline(never)]
pub fn evaluate_energy_from_displacement<R: Real>(
    material: &dyn Response<R>,
    H: &Matrix3<R>,
) -> (R, Status<R::Mask>) {
    point::evaluate_energy_from_displacement(material, H)
}

/// [`point::evaluate_stress_from_displacement`].
#[inline(never)]
pub fn evaluate_stress_from_displacement<R: Real>(
    material: &dyn Response<R>,
    H: &Matrix3<R>,
) -> (Matrix3<R>, Status<R::Mask>) {
    point::evaluate_stress_from_displacement(material, H)
}

/// [`point::svd()`].
#[inline(never)]
#[must_use]
pub fn svd<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    point::svd(F)
}
