//! The signed singular value decomposition of a 2×2 matrix, in closed form.
//!
//! A matrix acts on the plane of complex numbers as z ↦ A z + B z̄, with
//!
//! ```text
//! A = (F11 + F22)/2 + i (F21 − F12)/2,     B = (F11 − F22)/2 + i (F21 + F12)/2.
//! ```
//!
//! U diag(λ1, λ2) Vᵀ, with rotations by u and v, unit numbers, has A = u v̄ (λ1 + λ2)/2 and
//! B = u v (λ1 − λ2)/2. So λ1 = |A| + |B|, and with the directions α = A/|A| and β = B/|B|, u is the root of
//! α β and v = u ᾱ. λ2 is |A| − |B|, which cancels where F is nearly singular; det F/λ1 does not, with the
//! determinant from products with their rounding errors.
//!
//! A and B have a relative error of u, being sums of two numbers each, so that every direction is accurate,
//! and so is λ1. Where A or B vanishes, its direction is arbitrary.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use super::Matrix2;
use crate::lanes::Real;

/// A signed singular value decomposition F = U diag(λ1, λ2) Vᵀ in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlaneSvd<R> {
    /// Left rotation, det U = +1.
    pub(crate) U: Matrix2<R>,
    /// λ1 ≥ |λ2|; λ2 has the sign of det F.
    pub(crate) stretches: [R; 2],
    /// Right rotation, det V = +1.
    pub(crate) V: Matrix2<R>,
}

/// Decomposes a 2×2 matrix; see [`PlaneSvd`].
///
/// Both stretches have a relative error of a few u, where det F is not zero to 4 u² λ1². F = 0 gives two
/// frames that are equal.
pub(crate) fn plane_svd<R: Real>(F: &Matrix2<R>) -> PlaneSvd<R> {
    let [[p, q], [r, s]] = *F;
    let (scale, back) = p.abs().max(q.abs()).max(r.abs().max(s.abs())).power_of_two_scale();
    let (p, q, r, s) = (p * scale, q * scale, r * scale, s * scale);
    let half = R::splat(0.5);
    let (alpha, A) = direction([half * (p + s), half * (r - q)]);
    let (beta, B) = direction([half * (p - s), half * (r + q)]);
    let u = root(times(alpha, beta));
    let v = times(u, [alpha[0], -alpha[1]]);

    let largest = A + B;
    let (ps, ps_error) = p.two_product(s);
    let (qr, qr_error) = q.two_product(r);
    let determinant = (ps - qr) + (ps_error - qr_error);
    let smallest = R::select(R::splat(R::min_positive()).less(largest), determinant / largest, R::splat(0.0));
    let smallest = smallest.abs().min(largest).copysign(smallest);
    // What is not finite must not become a plausible number by the order of a comparison.
    let smallest = R::select(largest.is_finite(), smallest, largest);
    PlaneSvd { U: rotation(u), stretches: [largest * back, smallest * back], V: rotation(v) }
}

/// Direction and length of a complex number; that of 0 is 1.
fn direction<R: Real>([x, y]: [R; 2]) -> ([R; 2], R) {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    let (scale, back) = x.abs().max(y.abs()).power_of_two_scale();
    let (x, y) = (x * scale, y * scale);
    let length = x.mul_add(x, y * y).sqrt();
    let vanishes = length.less(R::splat(R::min_positive()));
    let divisor = R::select(vanishes, one, length);
    ([R::select(vanishes, one, x / divisor), R::select(vanishes, zero, y / divisor)], length * back)
}

/// The square root of a number of length 1, up to its sign: the direction of z + 1 or, on the left, of
/// i (1 − z).
fn root<R: Real>([x, y]: [R; 2]) -> [R; 2] {
    let one = R::splat(1.0);
    let is_left = x.less(R::splat(0.0));
    direction([R::select(is_left, y, one + x), R::select(is_left, one - x, y)]).0
}

fn times<R: Real>([a, b]: [R; 2], [c, d]: [R; 2]) -> [R; 2] {
    [a.mul_add(c, -(b * d)), a.mul_add(d, b * c)]
}

fn rotation<R: Real>([c, s]: [R; 2]) -> Matrix2<R> {
    [[c, -s], [s, c]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    fn entry(svd: &PlaneSvd<f64>, i: usize, j: usize) -> f64 {
        (0..2).map(|k| svd.U[i][k] * svd.stretches[k] * svd.V[j][k]).sum()
    }

    #[track_caller]
    fn check(F: Matrix2<f64>) {
        let found = plane_svd(&F);
        let [largest, smallest] = found.stretches;
        assert!(largest >= smallest.abs(), "{found:?}");
        for i in 0..2 {
            for j in 0..2 {
                // Half a dozen roundings in each of the directions and three products.
                let error = (entry(&found, i, j) - F[i][j]).abs();
                assert!(error <= 12.0 * f64::EPSILON * largest, "{error:e} at {F:?}");
            }
        }
        for [[c, t], [s, d]] in [found.U, found.V] {
            assert!(c == d && s == -t && (c * c + s * s - 1.0).abs() <= 8.0 * f64::EPSILON, "{found:?}");
        }
    }

    #[test]
    fn the_factors_multiply_to_the_matrix() {
        let mut random = Random::new(81);
        for size in [1.0, 1e-300, 1e300] {
            for _ in 0..1000 {
                check(std::array::from_fn(|_| std::array::from_fn(|_| size * random.uniform(-1.0, 1.0))));
            }
        }
        for F in [
            [[1.0, 0.0], [0.0, 1.0]],
            [[-1.0, 0.0], [0.0, -1.0]],
            [[1.0, 0.0], [0.0, -1.0]],
            [[-1.0, 0.0], [0.0, 1.0]],
            [[0.0, 1.0], [1.0, 0.0]],
            [[0.0, 0.0], [0.0, 0.0]],
            [[1.0, 1.0], [1.0, 1.0]],
            [[1.0, 1e-9], [-1e-9, 1.0 + 1e-12]],
        ] {
            check(F);
        }
    }

    #[test]
    fn the_smaller_stretch_has_the_sign_and_the_digits_of_the_determinant() {
        assert_eq!(plane_svd(&[[0.0, -2.0], [-0.5, 0.0]]).stretches, [2.0, -0.5]);
        // det = 2⁻⁵⁰ exactly, and λ1 = 2 + O(2⁻⁵⁰).
        let F = [[1.0, 1.0], [1.0, 1.0 + 2f64.powi(-50)]];
        let [_, smallest] = plane_svd(&F).stretches;
        assert!((smallest - 2f64.powi(-51)).abs() <= 8.0 * f64::EPSILON * 2f64.powi(-51), "{smallest:e}");
    }

    #[test]
    fn what_is_not_finite_is_in_every_stretch() {
        for bad in [f64::NAN, f64::INFINITY] {
            for place in 0..4 {
                let mut F = [[1.0, 0.3], [0.2, 1.0]];
                F[place / 2][place % 2] = bad;
                assert!(plane_svd(&F).stretches.iter().all(|x| !x.is_finite()), "{F:?}");
            }
        }
    }
}
