//! The evaluation of a point, compiled once for each precision.
//!
//! In `piola` it is inlined wherever it is called, for the sake of speed. A judge calls it at many places.

use piola::material::Response;
use piola::point::{self, Deformation, EnergyPoint, Filter, Point, StressPoint};

/// [`point::evaluate`].
#[inline(never)]
pub fn evaluate<D: Deformation>(
    material: &dyn Response<D::Real>,
    deformation: D,
    filter: Filter,
) -> Point<D::Real> {
    point::evaluate(material, deformation, filter)
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
