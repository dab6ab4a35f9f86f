//! A point as the contract asks for it, compiled once for each material.
//!
//! The functions of [`point`] are inlined wherever they are called, for the sake of speed. The rules call them at many
//! places, and each material would be compiled for each of those.

#![expect(non_snake_case, reason = "F as in the literature")]

use crate::material::Material;
use crate::point::{self, Filter, Matrix3, Tangent};

/// ψ(F).
#[inline(never)]
pub(super) fn energy(material: &impl Material, F: &Matrix3<f64>) -> f64 {
    point::evaluate_energy(material, F).0
}

/// P(F).
#[inline(never)]
pub(super) fn stress(material: &impl Material, F: &Matrix3<f64>) -> Matrix3<f64> {
    point::evaluate_stress(material, F).0
}

/// dP/dF, not filtered.
#[inline(never)]
pub(super) fn tangent(material: &impl Material, F: &Matrix3<f64>) -> Tangent<f64> {
    point::evaluate(material, F, Filter::None).tangent
}
