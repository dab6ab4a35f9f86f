//! A point as the contract asks for it, compiled once for each material and kind of number.
//!
//! The methods of a material and the functions of [`point`] are inlined wherever they are called, for the
//! sake of speed. The rules call them at many places, and each material would be compiled for each of those.

#![expect(non_snake_case, reason = "F as in the literature")]

use crate::lanes::Real;
use crate::material::{Blocks, Material};
use crate::point::{self, Filter, Matrix3, Tangent};

/// Energy density ψ(F), Pa.
#[inline(never)]
pub(super) fn energy(material: &impl Material, F: &Matrix3<f64>) -> f64 {
    point::evaluate_energy(material, F).0
}

/// First Piola stress P(F), Pa.
#[inline(never)]
pub(super) fn stress(material: &impl Material, F: &Matrix3<f64>) -> Matrix3<f64> {
    point::evaluate_stress(material, F).0
}

/// Unfiltered tangent dP/dF, Pa.
#[inline(never)]
pub(super) fn tangent(material: &impl Material, F: &Matrix3<f64>) -> Tangent<f64> {
    point::evaluate(material, F, Filter::None).tangent
}

/// [`Material::energy`].
#[inline(never)]
pub(super) fn energy_at<R: Real>(material: &impl Material, stretches: [R; 3]) -> R {
    material.energy(stretches)
}

/// [`Material::gradient`].
#[inline(never)]
pub(super) fn gradient_at<R: Real>(material: &impl Material, stretches: [R; 3]) -> [R; 3] {
    material.gradient(stretches)
}

/// [`Material::gradient_at_strains`].
#[inline(never)]
pub(super) fn gradient_at_strains(material: &impl Material, strains: [f64; 3]) -> [f64; 3] {
    material.gradient_at_strains(strains)
}

/// [`Material::blocks`].
#[inline(never)]
pub(super) fn blocks_at<R: Real>(material: &impl Material, stretches: [R; 3]) -> Blocks<R> {
    material.blocks(stretches)
}

/// [`Material::admits`].
#[inline(never)]
pub(super) fn is_admitted(material: &impl Material, stretches: [f64; 3]) -> bool {
    material.admits(stretches)
}
