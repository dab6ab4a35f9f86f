//! Jacobi's method on FᵀF, without a branch on a value, so that it runs on lanes \[MSTTS11\].
//!
//! 1. S = FᵀF is made diagonal by cyclic Jacobi, a fixed number of sweeps. V is accumulated as a quaternion.
//! 2. Columns of B = F V and of V are sorted by length, an exchange changing the sign of one, so that V
//!    remains a rotation.
//! 3. B = U R by Givens rotations. R is diagonal up to what is left of VᵀS V, and holds the stretches; only
//!    the third can become negative.
//!
//! The half angles of Jacobi are the paper's approximate ones: tan θ/2 = ¼ tan 2θ where that stays below tan
//! π/8, and π/8 elsewhere. Each rotation so leaves a part of the entry that it should have made zero; near
//! the end the part is of third order. Two things differ from the paper. F is scaled by a power of two first,
//! because its squares leave the range of numbers long before F does. And quaternions are normalised once,
//! when they become a matrix.
//!
//! What floating point does here: S is known to u λ1², hence the directions of stretches below √u λ1 are not
//! known at all, R keeps off-diagonal entries up to √u λ1 which are dropped, and half of the digits are gone.
//!
//! \[MSTTS11\] McAdams, Selle, Tamstorf, Teran, Sifakis, *Computing the singular value decomposition of 3×3
//! matrices with minimal branching and elementary floating point operations*, 2011.

#![expect(non_snake_case, reason = "F, S, B, U, V, R as in the paper")]

use piola::Real;
use piola::point::{Matrix3, Svd};

use super::descending;
use crate::matrix::{dot, multiply, transpose};

/// Decomposes F. Four sweeps, the paper's number, bring `f32` to a hundred u; `f64` needs six.
#[inline(always)]
#[must_use]
pub fn jacobi<R: Real>(F: &Matrix3<R>, sweeps: usize) -> Svd<R> {
    let zero = R::splat(0.0);
    let mut largest = zero;
    for row in F {
        largest = largest.max(row[0].abs()).max(row[1].abs()).max(row[2].abs());
    }
    let (scale, back) = largest.power_of_two_scale();
    let mut B = *F;
    for row in &mut B {
        *row = [row[0] * scale, row[1] * scale, row[2] * scale];
    }

    let columns = transpose(&B);
    let mut S = Symmetric {
        diagonal: [dot(columns[0], columns[0]), dot(columns[1], columns[1]), dot(columns[2], columns[2])],
        opposite: [dot(columns[1], columns[2]), dot(columns[2], columns[0]), dot(columns[0], columns[1])],
    };
    let mut right = Quaternion::identity();
    for _ in 0..sweeps {
        S.rotate::<2>(&mut right);
        S.rotate::<0>(&mut right);
        S.rotate::<1>(&mut right);
    }
    let V = right.to_matrix();
    let (mut B, mut Vt) = (transpose(&multiply(&B, &V)), transpose(&V));
    let mut squares = [dot(B[0], B[0]), dot(B[1], B[1]), dot(B[2], B[2])];
    for (p, q) in [(0, 1), (0, 2), (1, 2)] {
        let swap = squares[p].less(squares[q]);
        (squares[p], squares[q]) = (squares[p].max(squares[q]), squares[p].min(squares[q]));
        exchange(swap, &mut B, p, q);
        exchange(swap, &mut Vt, p, q);
    }

    let mut B = transpose(&B);
    let mut left = Quaternion::identity();
    eliminate::<R, 2>(&mut B, &mut left);
    eliminate::<R, 1>(&mut B, &mut left);
    eliminate::<R, 0>(&mut B, &mut left);
    let stretches = descending([B[0][0], B[1][1], B[2][2]]);
    Svd {
        U: left.to_matrix(),
        stretches: [stretches[0] * back, stretches[1] * back, stretches[2] * back],
        V: transpose(&Vt),
    }
}

/// A rotation in the making, of any positive norm.
#[derive(Clone, Copy)]
struct Quaternion<R> {
    w: R,
    vector: [R; 3],
}

impl<R: Real> Quaternion<R> {
    #[inline(always)]
    fn identity() -> Self {
        Self { w: R::splat(1.0), vector: [R::splat(0.0); 3] }
    }

    /// Its product with the rotation about an axis of the half angle with this cosine and sine.
    #[inline(always)]
    fn turn<const AXIS: usize>(&mut self, cosine: R, sine: R) {
        let (p, q) = others(AXIS);
        let Self { w, vector: x } = *self;
        self.w = w.mul_add(cosine, -(x[AXIS] * sine));
        self.vector[AXIS] = x[AXIS].mul_add(cosine, w * sine);
        self.vector[p] = x[p].mul_add(cosine, x[q] * sine);
        self.vector[q] = x[q].mul_add(cosine, -(x[p] * sine));
    }

    #[inline(always)]
    fn to_matrix(self) -> Matrix3<R> {
        let Self { w, vector: [x, y, z] } = self;
        let (ww, xx, yy, zz) = (w * w, x * x, y * y, z * z);
        let scale = R::splat(1.0) / ((ww + xx) + (yy + zz));
        let twice = scale + scale;
        let (wx, wy, wz) = (w * x, w * y, w * z);
        [
            [((ww + xx) - (yy + zz)) * scale, x.mul_add(y, -wz) * twice, x.mul_add(z, wy) * twice],
            [x.mul_add(y, wz) * twice, ((ww + yy) - (xx + zz)) * scale, y.mul_add(z, -wx) * twice],
            [x.mul_add(z, -wy) * twice, y.mul_add(z, wx) * twice, ((ww + zz) - (xx + yy)) * scale],
        ]
    }
}

/// The axes p, q with which a third one is right-handed.
const fn others(axis: usize) -> (usize, usize) {
    ((axis + 1) % 3, (axis + 2) % 3)
}

/// A symmetric matrix by its diagonal and, for each axis, the entry of the two others.
struct Symmetric<R> {
    diagonal: [R; 3],
    opposite: [R; 3],
}

impl<R: Real> Symmetric<R> {
    /// S ← QᵀS Q with a rotation Q about an axis that makes the entry of the other two small.
    #[inline(always)]
    fn rotate<const AXIS: usize>(&mut self, right: &mut Quaternion<R>) {
        let (p, q) = others(AXIS);
        let (spp, sqq, spq) = (self.diagonal[p], self.diagonal[q], self.opposite[AXIS]);
        let (half_cosine, half_sine) = approximate_half_angle(spp, spq, sqq);
        right.turn::<AXIS>(half_cosine, half_sine);

        let c = half_cosine.mul_add(half_cosine, -(half_sine * half_sine));
        let s = (half_cosine + half_cosine) * half_sine;
        let (cc, ss, cs) = (c * c, s * s, c * s);
        let cross = (cs + cs) * spq;
        self.diagonal[p] = cc.mul_add(spp, ss.mul_add(sqq, cross));
        self.diagonal[q] = ss.mul_add(spp, cc.mul_add(sqq, -cross));
        self.opposite[AXIS] = (cc - ss).mul_add(spq, cs * (sqq - spp));
        // Entry (p, axis) is opposite of q, entry (q, axis) opposite of p.
        let (spo, sqo) = (self.opposite[q], self.opposite[p]);
        self.opposite[q] = c.mul_add(spo, s * sqo);
        self.opposite[p] = c.mul_add(sqo, -(s * spo));
    }
}

/// Cosine and sine of half the angle of a rotation that makes s12 small (\[MSTTS11\], algorithm 2).
#[inline(always)]
fn approximate_half_angle<R: Real>(s11: R, s12: R, s22: R) -> (R, R) {
    use std::f64::consts::SQRT_2;
    const GAMMA: f64 = 3.0 + 2.0 * SQRT_2;
    const COSINE: f64 = 0.923_879_532_511_286_8; // of π/8
    const SINE: f64 = 0.382_683_432_365_089_8;
    let difference = s11 - s22;
    let (cosine, sine) = (difference + difference, s12);
    let (squared_cosine, squared_sine) = (cosine * cosine, sine * sine);
    let is_small = (R::splat(GAMMA) * squared_sine).less(squared_cosine);
    let scale = (squared_cosine + squared_sine).reciprocal_sqrt();
    (R::select(is_small, scale * cosine, R::splat(COSINE)), R::select(is_small, scale * sine, R::splat(SINE)))
}

/// Rows p and q of A become q and −p where the mask is set.
#[inline(always)]
fn exchange<R: Real>(mask: R::Mask, A: &mut Matrix3<R>, p: usize, q: usize) {
    for k in 0..3 {
        let (x, y) = (A[p][k], A[q][k]);
        A[p][k] = R::select(mask, y, x);
        A[q][k] = R::select(mask, -x, y);
    }
}

/// Rotates two rows of B about an axis so that the entry of the later row in the column of the earlier one
/// becomes zero (\[MSTTS11\], algorithm 4); U follows.
#[inline(always)]
fn eliminate<R: Real, const AXIS: usize>(B: &mut Matrix3<R>, left: &mut Quaternion<R>) {
    let (p, q) = others(AXIS);
    // About the second axis the pair is (3, 1), and the rotation the other way round.
    let (p, q) = (p.min(q), p.max(q));
    let (a1, a2) = (B[p][p], B[q][p]);
    let squared = a1.mul_add(a1, a2 * a2);
    let vanishes = squared.less(R::splat(4.0 * R::MIN_POSITIVE));
    let length = squared.sqrt();
    let (long, short) = (a1.abs() + length, a2);
    // Half the angle is steep where a1 < 0: the long side is then that of the sine.
    let is_steep = a1.less(R::splat(0.0));
    let scale = long.mul_add(long, short * short).reciprocal_sqrt();
    let (cosine, sine) = (R::select(is_steep, short, long) * scale, R::select(is_steep, long, short) * scale);
    let half_cosine = R::select(vanishes, R::splat(1.0), cosine);
    let half_sine = R::select(vanishes, R::splat(0.0), sine);
    left.turn::<AXIS>(half_cosine, if AXIS == 1 { -half_sine } else { half_sine });

    let c = half_cosine.mul_add(half_cosine, -(half_sine * half_sine));
    let s = (half_cosine + half_cosine) * half_sine;
    for k in 0..3 {
        let (x, y) = (B[p][k], B[q][k]);
        B[p][k] = c.mul_add(x, s * y);
        B[q][k] = c.mul_add(y, -(s * x));
    }
}
