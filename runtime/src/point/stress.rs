//! The first Piola stress of a point: P = U diag(ψi) Vᵀ.
//!
//! This is \[SZLSB11\] eq. 2: the stress of an isotropic energy is diagonal in the same
//! two frames as F, and the second one enters transposed.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

use super::Matrix3;
use super::matrix::{multiply_transposed, three};
use super::svd::Svd;
use crate::lanes::Real;

/// P = U diag(ψi) Vᵀ, Pa, for the gradient ψ1, ψ2, ψ3 of the energy density in the stretches.
#[inline(always)]
#[must_use]
pub fn stress<R: Real>(svd: &Svd<R>, gradient: [R; 3]) -> Matrix3<R> {
    let scaled = three!(i => three!(k => svd.U[i][k] * gradient[k]));
    multiply_transposed(&scaled, &svd.V)
}
