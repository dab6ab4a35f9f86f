//! The derivatives of the singular value decomposition itself: dU, dλ, dVᵀ along dF \[PL00\].
//!
//! Stress and tangent never need them (see [`tangent`](super::tangent)); they are for those who follow the
//! principal directions, for instance in anisotropy or in plots.
//!
//! **Where they don't exist.** U, V and λ are not differentiable where |λi| = |λj|. At λi = λj the symmetric
//! part of the increment decides how both frames turn together, and at λi = −λj the antisymmetric part
//! decides how they turn against each other: the limits differ from direction to direction. The rotation of
//! such a pair, and of any pair that close, is reported in [`SvdGradient::singular`], and is whatever the
//! division by the gap gives, infinity and NaN included. No regularisation could give a right value where
//! there is none. dλ exists everywhere but for the order of the stretches.
//!
//! \[PL00\] Papadopoulo, Lourakis, *Estimating the Jacobian of the singular value decomposition: theory and
//! applications*, 2000.

#![expect(non_snake_case, reason = "U, V, dF as in the literature")]

use super::Matrix3;
use super::matrix::{multiply, multiply_transposed, to_principal};
use super::svd::Svd;
use crate::lanes::{Mask, Real};
use crate::material::PAIRS;
use crate::quotient::pole_floor;

/// First-order change of a singular value decomposition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SvdGradient<R: Real> {
    /// dU = U Ω, Ω antisymmetric.
    pub dU: Matrix3<R>,
    /// dλ.
    pub dstretches: [R; 3],
    /// dVᵀ = Θ Vᵀ, Θ antisymmetric.
    pub dVt: Matrix3<R>,
    /// Whether two stretches have magnitudes closer than rounding can tell, so that dU and dVᵀ mean nothing.
    pub singular: R::Mask,
}

/// dU, dλ and dVᵀ along `dF`; see the module's text for where they exist.
///
/// With dF̂ = Uᵀ dF V: dλi = dF̂ii, Ωij − Θij = (dF̂ij + dF̂ji)/(λj − λi) and
/// Ωij + Θij = (dF̂ij − dF̂ji)/(λi + λj). Both quotients lose accuracy as u λ1 / |λi ∓ λj|, which is their
/// condition, not a defect of the formula.
#[inline(always)]
#[must_use]
pub fn svd_gradient<R: Real>(svd: &Svd<R>, dF: &Matrix3<R>) -> SvdGradient<R> {
    let Svd { U, stretches, V } = svd;
    let increment = to_principal(U, dF, V);
    let zero = R::splat(0.0);
    let half = R::splat(0.5);
    let (mut omega, mut theta) = ([[zero; 3]; 3], [[zero; 3]; 3]);
    let floor = pole_floor(*stretches);
    let mut singular = R::Mask::splat(false);
    for (i, j) in PAIRS {
        let (gap, sum) = (stretches[j] - stretches[i], stretches[i] + stretches[j]);
        singular = singular | gap.abs().less(floor) | sum.abs().less(floor);
        let against = (increment[i][j] + increment[j][i]) / gap;
        let along = (increment[i][j] - increment[j][i]) / sum;
        omega[i][j] = half * (along + against);
        omega[j][i] = -omega[i][j];
        theta[i][j] = half * (along - against);
        theta[j][i] = -theta[i][j];
    }
    SvdGradient {
        dU: multiply(U, &omega),
        dstretches: [increment[0][0], increment[1][1], increment[2][2]],
        dVt: multiply_transposed(&theta, V),
        singular,
    }
}
