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
use crate::lanes::{Real, stage};

/// P = U diag(ψi) Vᵀ, Pa, for the gradient ψ1, ψ2, ψ3 of the energy density in the stretches; equal stretches
/// use the same derivative.
#[inline(always)]
#[must_use]
pub fn stress<R: Real>(svd: &Svd<R>, gradient: [R; 3]) -> Matrix3<R> {
    let svd = *svd;
    stage!(R, "stress_in_frames", (svd, gradient) => {
        let [s1, s2, s3] = svd.stretches;
        let [g1, g2, g3] = gradient;
        let g2 = R::select(s2.less(s1), g2, g1);
        let g3 = R::select(s3.less(s2), g3, g2);
        let scaled = three!(i => [svd.U[i][0] * g1, svd.U[i][1] * g2, svd.U[i][2] * g3]);
        multiply_transposed(&scaled, &svd.V)
    })
}
