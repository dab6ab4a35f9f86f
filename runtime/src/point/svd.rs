//! The signed singular value decomposition of a deformation gradient.
//!
//! F = U diag(λ) Vᵀ with det U = det V = +1 and λ1 ≥ λ2 ≥ |λ3|; the sign of λ3 is that of det F \[ITF04\].
//! One column of V is the eigenvector of FᵀF whose eigenvalue lies apart from the other two, in closed form.
//! The other two columns are found by one rotation that makes the columns of F V orthogonal, one-sided as
//! Jacobi's method is \[DV92\]. There is no branch on a value and no count that depends on one, so that a
//! matrix among others in lanes gets the bits it would get alone.
//!
//! What floating point does here. F is first multiplied by a power of two, which is exact, so that squares
//! neither overflow nor, where they matter, underflow. FᵀF loses half of the digits of small stretches, but
//! an error of u λ1² in it turns the vector apart so far only as changes F by u λ1. V is a product of
//! rotations and U is built around its first column: both are rotations by construction, for any rank of F,
//! instead of matrices that may turn out to be reflections. Each stretch is known to a few u λ1 and no
//! better, as from any backward-stable method; when λ3 is smaller than that, so is its sign, unless
//! [`svd_signed_by_determinant`] takes it from the determinant.
//!
//! This module is independent of materials. Reading V by columns vk and U by columns uk, F vk = λk uk.
//!
//! \[ITF04\] Irving, Teran, Fedkiw, *Invertible finite elements for robust simulation of large deformation*,
//! 2004. \[DV92\] Demmel, Veselić, *Jacobi's method is more accurate than QR*, 1992. \[Duff17\] Duff et al.,
//! *Building an orthonormal basis, revisited*, 2017.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use super::Matrix3;
use super::deflation::{deflate, rotation};
use super::matrix::{dot, three, transpose};
use crate::lanes::{Mask, Numbers, Real, Replace, Truth, stage};

#[cfg(test)]
mod tests;

/// A signed singular value decomposition F = U diag(λ) Vᵀ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Svd<R> {
    /// Left rotation, det U = +1; column k is the direction into which stretch k points after the
    /// deformation.
    pub U: Matrix3<R>,
    /// λ1 ≥ λ2 ≥ |λ3|, exactly in floating point; λ3 has the sign of det F.
    pub stretches: [R; 3],
    /// Right rotation, det V = +1; column k is the direction of stretch k at rest.
    pub V: Matrix3<R>,
}

impl<R: Real> Numbers<R> for Svd<R> {
    fn map(self, to: &mut impl Replace<R>) -> Self {
        let (U, stretches, V) = (self.U, self.stretches, self.V).map(to);
        Self { U, stretches, V }
    }
}

/// Decomposes F; see [`Svd`].
///
/// Backward error ‖F − U diag(λ) Vᵀ‖ ≤ 24 u λ1 in the Frobenius norm, and no entry of UᵀU − I or VᵀV − I
/// exceeds 20 u. F = 0 gives U = V = I. Where F holds an infinity or NaN, so does every stretch; where λ1
/// exceeds the largest finite number, it is infinite.
///
/// ```
/// let svd = piola::point::svd(&[[0.0, -2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -0.5]]);
/// assert_eq!(svd.stretches, [2.0, 1.0, -0.5]);
/// ```
#[inline(always)]
#[must_use]
pub fn svd<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    let F = *F;
    stage!(R, "decomposition", (F) => aligned(&F, unaligned(&F)))
}

/// Decomposes F, with λ3 = det F / (λ1 λ2) from a determinant in twice the working precision.
///
/// For energies whose domain ends at det F = 0: there the sign of a tiny λ3 decides whether a deformation is
/// admissible, and its logarithm needs all the relative accuracy that F can give. The sign is right wherever
/// the determinant exceeds 2⁵u²·λ1³ (in `f64` 4·10⁻³¹ λ1³) and no product of three entries of F/λ1 comes
/// within 1/u of underflow. Error bounds are those of [`svd()`].
#[inline(always)]
#[must_use]
pub fn svd_signed_by_determinant<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    let F = *F;
    stage!(R, "decomposition_signed_by_determinant", (F) => {
        aligned(&F, unaligned_signed_by_determinant(&F))
    })
}

/// [`svd()`], of which [`aligned`] is to follow.
#[inline(always)]
pub(crate) fn unaligned<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    let (F, back) = scaled(F);
    let (U, stretches, V) = decompose(&F);
    Svd { U, stretches: three!(k => stretches[k] * back), V }
}

/// [`svd_signed_by_determinant`], of which [`aligned`] is to follow.
#[inline(always)]
pub(crate) fn unaligned_signed_by_determinant<R: Real>(F: &Matrix3<R>) -> Svd<R> {
    let (F, back) = scaled(F);
    let (U, [s1, s2, s3], V) = decompose(&F);
    let area = s1 * s2;
    let s3 = R::select(
        R::splat(R::min_positive()).less(area),
        stage!(R, "determinant", (F) => determinant(&F)) / area,
        s3,
    );
    // λ2 and the quotient are rounded independently, which must not disturb their order.
    let s3 = s3.abs().min(s2).copysign(s3);
    Svd { U, stretches: [s1 * back, s2 * back, s3 * back], V }
}

/// The decomposition with every axis that F maps to itself made exact; see [`along_axes`].
#[inline(always)]
pub(crate) fn aligned<R: Real>(F: &Matrix3<R>, svd: Svd<R>) -> Svd<R> {
    if may_have_axis(F).any() {
        let F = *F;
        stage!(R, "along_axes", (F, svd) => along_axes(&F, svd))
    } else {
        svd
    }
}

/// False only if F maps no axis to itself. If it does so with axis k, Fkk is alone in its row and column, and
/// of the three entries above the diagonal two are zero, and so all products of two.
#[inline(always)]
pub(crate) fn may_have_axis<R: Real>(F: &Matrix3<R>) -> R::Mask {
    let [a, b, c] = [F[0][1] * F[0][2], F[0][1] * F[1][2], F[0][2] * F[1][2]];
    vanishes(a.mul_add(a, b.mul_add(b, c * c)))
}

/// True if a number that is not negative is zero or NaN.
#[inline(always)]
fn vanishes<R: Real>(x: R) -> R::Mask {
    !R::splat(0.0).less(x)
}

/// The decomposition with every axis that is a principal direction exactly in the frames, and its stretch
/// exact: zeros of F that a plane of symmetry makes are then zeros of P and dP/dF too.
///
/// Nothing in [`right`] mixes the column of such an axis with the others, so that V is that exact already, up
/// to the rounding of a one. Where U does not contain the axis to rounding, as at rank one, where nothing
/// else distinguishes two directions, it is left as it is.
#[inline(always)]
pub(crate) fn along_axes<R: Real>(F: &Matrix3<R>, svd: Svd<R>) -> Svd<R> {
    let Svd { mut U, mut stretches, mut V } = svd;
    let (zero, one, rounding) = (R::splat(0.0), R::splat(1.0), R::splat(64.0 * R::unit_roundoff()));
    for k in 0..3 {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let others = F[k][i].abs().max(F[i][k].abs()).max(F[k][j].abs()).max(F[j][k].abs());
        let is_axis = vanishes(others);
        for column in 0..3 {
            let (u, v) = (one.copysign(U[k][column]), one.copysign(V[k][column]));
            let (l, m) = ((column + 1) % 3, (column + 2) % 3);
            let rest = U[k][l].abs().max(U[k][m].abs()).max(V[k][l].abs()).max(V[k][m].abs());
            let is_here = is_axis & rest.less(rounding);
            for other in 0..3 {
                U[k][other] = R::select(is_here, zero, U[k][other]);
                V[k][other] = R::select(is_here, zero, V[k][other]);
                U[other][column] = R::select(is_here, zero, U[other][column]);
                V[other][column] = R::select(is_here, zero, V[other][column]);
            }
            U[k][column] = R::select(is_here, u, U[k][column]);
            V[k][column] = R::select(is_here, v, V[k][column]);
            // Only the last is signed, even if a direction has underflowed.
            let stretch = if column == 2 { F[k][k] * u * v } else { F[k][k].abs() };
            stretches[column] = R::select(is_here, stretch, stretches[column]);
        }
    }
    Svd { U, stretches: descending(stretches), V }
}

/// F brought to a magnitude between 1 and 2 by a power of two, and the power that brings stretches back.
///
/// What is not finite is left so and needs no mask: the mean of the diagonal of FᵀF is then infinite or NaN,
/// its deviator holds NaN, the frame is NaN, and F V spreads that over every stretch.
#[inline(always)]
fn scaled<R: Real>(F: &Matrix3<R>) -> (Matrix3<R>, R) {
    let rows: [R; 3] = three!(i => F[i][0].abs().max(F[i][1].abs()).max(F[i][2].abs()));
    let (scale, back) = rows[0].max(rows[1]).max(rows[2]).power_of_two_scale();
    (three!(i => three!(j => F[i][j] * scale)), back)
}

/// U, λ, V of a matrix scaled to a magnitude between 1 and 2.
#[inline(always)]
fn decompose<R: Real>(F: &Matrix3<R>) -> (Matrix3<R>, [R; 3], Matrix3<R>) {
    let F = *F;
    stage!(R, "scaled_decomposition", (F) => {
        let V = right(&F);
        let columns = three!(k => three!(i => dot(F[i], V[k])));
        let (U, stretches) = left(&columns);
        (U, descending(stretches), transpose(&V))
    })
}

/// The columns of V, in the order of descending stretches.
#[inline(always)]
fn right<R: Real>(F: &Matrix3<R>) -> [[R; 3]; 3] {
    let [f1, f2, f3] = transpose(F);
    let C = [dot(f1, f1), dot(f2, f2), dot(f3, f3), dot(f1, f2), dot(f1, f3), dot(f2, f3)];
    let ([v, p, q], Truth(is_largest)) = deflate(C);

    // A rotation in the plane of the other two, which takes its angle from F and not from C, where small
    // stretches have lost half of their digits: the columns of F V become orthogonal up to u λ1.
    let (bp, bq) = (three!(i => dot(F[i], p)), three!(i => dot(F[i], q)));
    let half_g = dot(bp, bq);
    let (c, s) = rotation(dot(bp, bp) - dot(bq, bq), half_g + half_g);
    let (p, q) = (three!(i => c.mul_add(p[i], s * q[i])), three!(i => c.mul_add(q[i], -(s * p[i]))));
    [
        three!(i => R::select(is_largest, v[i], p[i])),
        three!(i => R::select(is_largest, p[i], q[i])),
        three!(i => R::select(is_largest, q[i], v[i])),
    ]
}

/// U and λ from columns bk = λk uk that are orthogonal up to rounding, the longest first.
///
/// Only the direction of the first column and the one of the second within the plane normal to it are used,
/// and the third is their completion: det U = +1 for any rank, and λ3 = u3·b3 carries the sign of det F.
#[inline(always)]
fn left<R: Real>(columns: &[[R; 3]; 3]) -> (Matrix3<R>, [R; 3]) {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let [b1, b2, b3] = *columns;

    let squared = dot(b1, b1);
    let vanishes = squared.less(R::splat(R::min_positive()));
    let (s1, inverse) = length(squared);
    let u1 = [
        R::select(vanishes, one, b1[0] * inverse),
        R::select(vanishes, zero, b1[1] * inverse),
        R::select(vanishes, zero, b1[2] * inverse),
    ];

    let (p, q) = completed(u1);
    let (yp, yq) = (dot(b2, p), dot(b2, q));
    let squared = yp.mul_add(yp, yq * yq);
    let vanishes = squared.less(R::splat(R::min_positive()));
    let (s2, inverse) = length(squared);
    // Where b2 vanishes, q completes u1 = e1 to the identity.
    let cp = R::select(vanishes, zero, yp * inverse);
    let cq = R::select(vanishes, one, yq * inverse);
    let s3 = cp.mul_add(dot(b3, q), -(cq * dot(b3, p)));

    let U = three!(i => [u1[i], cp.mul_add(p[i], cq * q[i]), cp.mul_add(q[i], -(cq * p[i]))]);
    (U, [s1, s2, s3])
}

/// p and q that complete a unit vector to a right-handed orthonormal basis \[Duff17\].
#[inline(always)]
fn completed<R: Real>([x, y, z]: [R; 3]) -> ([R; 3], [R; 3]) {
    let one = R::splat(1.0);
    let sign = one.copysign(z);
    let a = -(one / (sign + z));
    let xa = x * a;
    let xya = y * xa;
    ([one + sign * x * xa, sign * xya, -(sign * x)], [xya, sign + y * (y * a), -y])
}

/// The length of a vector and its reciprocal from the square; a length of 0 where that is not a normal
/// number.
#[inline(always)]
fn length<R: Real>(squared: R) -> (R, R) {
    let smallest = R::splat(R::min_positive());
    let vanishes = squared.less(smallest);
    let inverse = R::select(vanishes, smallest, squared).reciprocal_sqrt();
    (R::select(vanishes, R::splat(0.0), squared.sqrt()), inverse)
}

/// λ1 ≥ λ2 ≥ |λ3|.
///
/// The columns are sorted already, their lengths out of order by a few u λ1 at most. Exchanging the lengths
/// alone changes U diag(λ) Vᵀ by no more than that, and the vectors of stretches so close are arbitrary
/// anyway.
#[inline(always)]
pub fn descending<R: Real>([s1, s2, s3]: [R; 3]) -> [R; 3] {
    let magnitude = s3.abs();
    let (s1, s2) = (s1.max(s2), s1.min(s2));
    let (s2, magnitude) = (s2.max(magnitude), s2.min(magnitude));
    let (s1, s2) = (s1.max(s2), s1.min(s2));
    [s1, s2, magnitude.copysign(s3)]
}

/// det F to about twice the working precision, relative to Σ|products of three entries|.
#[inline(always)]
pub(super) fn determinant<R: Real>(F: &Matrix3<R>) -> R {
    let [(a, da), (b, db), (c, dc)] = three!(j => {
        let (k, l) = ((j + 1) % 3, (j + 2) % 3);
        let (minor, minor_error) = difference_of_products(F[1][k], F[2][l], F[1][l], F[2][k]);
        let (product, error) = F[0][j].two_product(minor);
        (product, F[0][j].mul_add(minor_error, error))
    });
    let (ab, dab) = two_sum(a, b);
    let (abc, dabc) = two_sum(ab, c);
    abc + ((da + db) + dc + (dab + dabc))
}

/// a b − c d as the sum of a rounded value and a correction of at most 2u (|a b| + |c d|), which may be the
/// larger one.
#[inline(always)]
fn difference_of_products<R: Real>(a: R, b: R, c: R, d: R) -> (R, R) {
    let (ab, dab) = a.two_product(b);
    let (cd, dcd) = c.two_product(d);
    let (difference, error) = two_sum(ab, -cd);
    (difference, error + (dab - dcd))
}

/// a + b as a rounded value and its exact error [Knuth, The Art of Computer Programming 2, 4.2.2].
#[inline(always)]
fn two_sum<R: Real>(a: R, b: R) -> (R, R) {
    let sum = a + b;
    let b_part = sum - a;
    (sum, (a - (sum - b_part)) + (b - b_part))
}
