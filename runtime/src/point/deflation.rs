//! The eigenvector of a symmetric 3×3 matrix whose eigenvalue lies apart from the other two, in closed form.
//!
//! Two eigenvalues may be close, or equal, and then their eigenvectors are anything in a plane. The third one
//! is never close to both unless all three are equal, when any frame will do. So its eigenvector is found
//! first \[SD08\]; what is left is a problem of two dimensions, which one rotation solves for any gap.
//!
//! **Eigenvalue.** With the deviator D = A − (tr A/3) I and p² = |D|²/6, the eigenvalues of B = D/p are
//! 2 cos(φ + 2πk/3), cos 3φ = r = det B/2 \[Smith61\]. The one apart has the sign of r and the magnitude 2y,
//!
//! ```text
//! y = cos(acos|r| / 3),     4y³ − 3y = |r|,     √3/2 ≤ y ≤ 1
//! ```
//!
//! and lies √3 or more from the others. As a function of |r| from 0 to 1 it is smooth, the next singularity
//! being at −1: a polynomial gives it to 2⁻²⁹, and each step of Newton's method squares that. There is no
//! trigonometric function.
//!
//! **Eigenvector.** adj(B ∓ 2y I) = (12y² − 3) v vᵀ, so that each column is a multiple of v. The one with the
//! largest entry on the diagonal, at least 2, is free of cancellation.
//!
//! **Plane.** The rotation about eₗ × v that takes eₗ to v, where vₗ ≥ 1/√3 is the largest component of v,
//! takes the other two axes into the plane normal to v. A coordinate plane that contains v, or is normal to
//! it, is kept exactly: zeros of A stay zeros.
//!
//! **Error.** The vectors are orthonormal to a few u, and v is the eigenvector of a matrix that differs from
//! A by a few u ‖A‖.
//!
//! \[SD08\] Scherzinger, Dohrmann, *A robust algorithm for finding the eigenvalues and eigenvectors of 3×3
//! symmetric matrices*, 2008. \[Smith61\] Smith, *Eigenvalues of a symmetric 3×3 matrix*, 1961.

#![expect(non_snake_case, reason = "A, B, D as in the essay above")]

use crate::lanes::{Mask, Real, Truth, stage};

/// A right-handed orthonormal frame v, p, q for the symmetric matrix a11, a22, a33, a12, a13, a23: v is the
/// eigenvector whose eigenvalue lies apart from the other two; true if that is the largest, false if it is
/// the smallest one. Squares of entries must not overflow; infinite ones and NaN make the frame NaN.
#[inline(always)]
pub(super) fn deflate<R: Real>(A: [R; 6]) -> ([[R; 3]; 3], Truth<R::Mask>) {
    stage!(R, "deflation", (A) => deflation(A))
}

#[inline(always)]
fn deflation<R: Real>(A: [R; 6]) -> ([[R; 3]; 3], Truth<R::Mask>) {
    let [one, two] = [R::splat(1.0), R::splat(2.0)];
    let [a11, a22, a33, a12, a13, a23] = A;
    let mean = (a11 + a22 + a33) * (one / R::splat(3.0));
    // The trace vanishes even where D is no more than the rounding of A.
    let [d11, d22] = [a11 - mean, a22 - mean];
    let d33 = -(d11 + d22);

    // Where D vanishes, B does too, and v becomes e1. Where its square underflows, v may be any vector, which
    // is as good.
    let off_diagonal = a12.mul_add(a12, a13.mul_add(a13, a23 * a23));
    let squared = d11.mul_add(d11, d22.mul_add(d22, d33.mul_add(d33, two * off_diagonal)));
    let floor = R::splat(R::min_positive());
    let reciprocal = squared.mul_add(one / R::splat(6.0), floor).reciprocal_sqrt();
    let [b11, b22, b33] = [d11 * reciprocal, d22 * reciprocal, d33 * reciprocal];
    let [b12, b13, b23] = [a12 * reciprocal, a13 * reciprocal, a23 * reciprocal];

    let minor1 = b22.mul_add(b33, -(b23 * b23));
    let minor2 = b12.mul_add(b33, -(b23 * b13));
    let minor3 = b12.mul_add(b23, -(b22 * b13));
    let determinant = b11.mul_add(minor1, b13.mul_add(minor3, -(b12 * minor2)));
    // The sum makes +0 of −0, so that the frame of A = 0 is the identity.
    let r = determinant.mul_add(R::splat(0.5), R::splat(0.0));
    let twice_y = two * cosine_of_third(r.abs().min(one));
    let eigenvalue = twice_y.copysign(r);

    let [m11, m22, m33] = [b11 - eigenvalue, b22 - eigenvalue, b33 - eigenvalue];
    let c11 = m22.mul_add(m33, -(b23 * b23));
    let c22 = m11.mul_add(m33, -(b13 * b13));
    let c33 = m11.mul_add(m22, -(b12 * b12));
    let c12 = b13.mul_add(b23, -(b12 * m33));
    let c13 = b12.mul_add(b23, -(b13 * m22));
    let c23 = b12.mul_add(b13, -(b23 * m11));

    // Column l of the adjugate, whose other rows are m and n in cyclic order.
    let l = Largest { is_second: c11.less(c22), is_third: c11.max(c22).less(c33) };
    let scale = one / l.of([c11, c22, c33]);
    let (m, n) = (l.of([c12, c23, c13]) * scale, l.of([c13, c12, c23]) * scale);
    let vl = m.mul_add(m, n.mul_add(n, one)).reciprocal_sqrt();
    let (vm, vn) = (m * vl, n * vl);

    // eₘ − vₘ (eₗ + v)/(1 + vₗ), and so eₙ.
    let k = one / (one + vl);
    let (km, kn) = (vm * k, vn * k);
    let mixed = -(km * vn);
    let p = [-vm, (-km).mul_add(vm, one), mixed];
    let q = [-vn, mixed, (-kn).mul_add(vn, one)];

    let frame = [l.in_order([vl, vm, vn]), l.in_order(p), l.in_order(q)];
    (frame, Truth(R::splat(0.0).less(eigenvalue)))
}

/// Cosine and sine of the angle θ, cos θ ≥ 0, by which p and q turn to become eigenvectors in their plane,
/// that of the larger eigenvalue first: tan 2θ = g/d with d = pᵀA p − qᵀA q and g = 2 pᵀA q.
///
/// tan θ = g / (d + √(d² + g²)) for d ≥ 0 and (−d + √(d² + g²)) / g for d < 0: no cancellation.
#[inline(always)]
pub(super) fn rotation<R: Real>(d: R, g: R) -> (R, R) {
    stage!(R, "rotation", (d, g) => cosine_and_sine(d, g))
}

#[inline(always)]
fn cosine_and_sine<R: Real>(d: R, g: R) -> (R, R) {
    // What is this small may keep its direction, but c = 1 where d = g = 0: the root is then twice that of
    // the smallest normal number, its square normal, and c² + s² = 1 to rounding down here too.
    let floor = R::splat(4.0 * R::min_positive());
    let squared = d.mul_add(d, g.mul_add(g, floor));
    let x = d.abs() + squared.sqrt();
    let swap = d.less(R::splat(0.0));
    let cosine = R::select(swap, g.abs(), x);
    let sine = R::select(swap, x.copysign(g), g);
    let scale = x.mul_add(x, g * g).reciprocal_sqrt();
    (cosine * scale, sine * scale)
}

/// The index l of the largest of three numbers; it is the first where neither of the others is.
#[derive(Clone, Copy)]
struct Largest<M> {
    is_second: M,
    is_third: M,
}

impl<M: Mask> Largest<M> {
    /// Entry l.
    #[inline(always)]
    fn of<R: Real<Mask = M>>(self, [first, second, third]: [R; 3]) -> R {
        R::select(self.is_third, third, R::select(self.is_second, second, first))
    }

    /// The vector with these components l, m, n, where m and n follow l in cyclic order.
    #[inline(always)]
    fn in_order<R: Real<Mask = M>>(self, [l, m, n]: [R; 3]) -> [R; 3] {
        [self.of([l, n, m]), self.of([m, l, n]), self.of([n, m, l])]
    }
}

/// cos(acos x / 3) for 0 ≤ x ≤ 1.
#[inline(always)]
fn cosine_of_third<R: Real>(x: R) -> R {
    let mut y = R::splat(POLYNOMIAL[POLYNOMIAL.len() - 1]);
    for k in (0..POLYNOMIAL.len() - 1).rev() {
        y = y.mul_add(x, R::splat(POLYNOMIAL[k]));
    }
    for _ in 0..newton_steps(R::unit_roundoff()) {
        let four_y2 = R::splat(4.0) * y * y;
        let residual = y.mul_add(four_y2 - R::splat(3.0), -x);
        y = y - residual / four_y2.mul_add(R::splat(3.0), R::splat(-3.0));
    }
    y
}

/// The polynomial of degree 8 nearest to cos(acos x / 3) from 0 to 1; its error is below 2⁻²⁹.
const POLYNOMIAL: [f64; 9] = [
    0.866_025_405_599_565_2,
    0.166_666_371_144_498_67,
    -0.048_104_441_452_933_48,
    0.024_604_296_792_329_105,
    -0.015_107_275_161_216_754,
    0.009_383_330_570_705_11,
    -0.004_929_691_172_429_747,
    0.001_764_856_873_116_898_5,
    -0.000_302_854_201_450_862_7,
];

/// Steps of Newton's method that bring an error of 2⁻²⁹ below u: none for 2⁻²⁴, one for 2⁻⁵³.
const fn newton_steps(unit_roundoff: f64) -> usize {
    let mut reached = 1.0 / (1u64 << 29) as f64;
    let mut steps = 0;
    while reached > unit_roundoff {
        // f″/2f′ of f = 4y³ − 3y is below 2.
        reached = 2.0 * (reached * reached);
        steps += 1;
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cosine_of_a_third_is_that_of_trigonometric_functions() {
        for k in 0..=10_000 {
            let x = f64::from(k) / 10_000.0;
            let expected = (x.acos() / 3.0).cos();
            // acos loses digits next to 1, but its third part only those that the cosine does not show.
            assert!((cosine_of_third(x) - expected).abs() <= 2.0 * f64::EPSILON, "{x}");
            assert!((cosine_of_third(x as f32) - expected as f32).abs() <= 2.0 * f32::EPSILON, "{x}");
        }
    }
}
