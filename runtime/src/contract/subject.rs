//! Interface of a material to the rules: behind `dyn`, so that they are compiled once and not for each
//! material.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::dual::Dual;
use super::results::{ALL, COUNT, SideBySide, results};
use crate::lanes::{Backend, Mask};
use crate::material::{Inversion, Material, Moduli, Response};
use crate::point::{self, Filter, Matrix3, Tangent};

/// Material under test: its responses in `f64`, and anything that a rule compares with them.
pub(super) trait Subject: Response<f64> {
    /// [`Material::inversion`].
    fn inversion(&self) -> Inversion;

    /// [`Material::stated_moduli`].
    fn stated_moduli(&self) -> Option<Moduli>;

    /// [`Material::energy`] of dual numbers.
    fn dual_energy(&self, stretches: [Dual; 3]) -> Dual;

    /// [`Material::gradient`] of dual numbers.
    fn dual_gradient(&self, stretches: [Dual; 3]) -> [Dual; 3];

    /// Row of results in `f32`; `None` outside the domain.
    fn in_single_precision(&self, stretches: [f32; 3]) -> Option<[f32; COUNT]>;
}

/// A material on lanes. Apart from [`Subject`], since each back end is compiled for it.
pub(super) trait OnLanes {
    /// Rows of results at all points, from the lanes of a back end.
    fn side_by_side_on(&self, backend: Backend, points: &[[f64; 3]]) -> Vec<[f64; ALL]>;
}

impl<M: Material> OnLanes for M {
    fn side_by_side_on(&self, backend: Backend, points: &[[f64; 3]]) -> Vec<[f64; ALL]> {
        backend.run(SideBySide(self, points))
    }
}

impl<M: Material> Subject for M {
    fn inversion(&self) -> Inversion {
        Material::inversion(self)
    }

    fn stated_moduli(&self) -> Option<Moduli> {
        Material::stated_moduli(self)
    }

    fn dual_energy(&self, stretches: [Dual; 3]) -> Dual {
        Material::energy(self, stretches)
    }

    fn dual_gradient(&self, stretches: [Dual; 3]) -> [Dual; 3] {
        Material::gradient(self, stretches)
    }

    fn in_single_precision(&self, stretches: [f32; 3]) -> Option<[f32; COUNT]> {
        Material::admits(self, stretches).any().then(|| results(self, stretches))
    }
}

/// Energy density ψ(F), Pa.
pub(super) fn energy(material: &dyn Subject, F: &Matrix3<f64>) -> f64 {
    point::evaluate_energy(material, F).energy
}

/// First Piola stress P(F), Pa.
pub(super) fn stress(material: &dyn Subject, F: &Matrix3<f64>) -> Matrix3<f64> {
    point::evaluate_stress(material, F).stress
}

/// Unfiltered tangent dP/dF, Pa.
pub(super) fn tangent(material: &dyn Subject, F: &Matrix3<f64>) -> Tangent<f64> {
    point::evaluate(material, F, Filter::None).tangent
}
