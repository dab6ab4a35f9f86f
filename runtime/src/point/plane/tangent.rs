//! dP/dF in the plane, as two frames and the five numbers between them.

#![expect(non_snake_case, reason = "U, V, dF, dP as in the essay of the module above")]

use super::{Filter, Matrix2, filtered};
use crate::lanes::Real;

/// dP/dF in the plane, as frames and the numbers between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneTangent<R> {
    /// Left rotation of F.
    pub U: Matrix2<R>,
    /// Right rotation of F.
    pub V: Matrix2<R>,
    /// Stiffness between the diagonal entries in the principal frames, condensed in plane stress: 11, 22, 12,
    /// Pa.
    pub hessian: [R; 3],
    /// Flip of the two stretches in the plane, Pa.
    pub flip: R,
    /// Twist of the two stretches in the plane, Pa.
    pub twist: R,
}

impl<R: Real> PlaneTangent<R> {
    /// The product dP = (dP/dF) dF.
    #[must_use]
    pub fn apply(&self, dF: &Matrix2<R>) -> Matrix2<R> {
        let [h11, h22, h12] = self.hessian;
        let [[d1, up], [down, d2]] = multiply(&transpose(&self.U), &multiply(dF, &self.V));
        let half = R::splat(0.5);
        let (flip, twist) = (half * self.flip * (up + down), half * self.twist * (up - down));
        let increment =
            [[h11.mul_add(d1, h12 * d2), flip + twist], [flip - twist, h12.mul_add(d1, h22 * d2)]];
        in_the_world(&self.U, increment, &self.V)
    }

    /// dP/dF as a 4×4 matrix, Pa: row 2i+j for entry (i, j) of P, column 2k+l for entry (k, l) of F.
    ///
    /// Exactly symmetric.
    #[must_use]
    pub fn to_matrix(&self) -> [[R; 4]; 4] {
        let mut dP_dF = [[R::splat(0.0); 4]; 4];
        for column in 0..4 {
            let mut dF = [[R::splat(0.0); 2]; 2];
            dF[column / 2][column % 2] = R::splat(1.0);
            let dP = self.apply(&dF);
            for row in 0..=column {
                dP_dF[row][column] = dP[row / 2][row % 2];
                dP_dF[column][row] = dP[row / 2][row % 2];
            }
        }
        dP_dF
    }
}

impl<R: Real<Mask = bool>> PlaneTangent<R> {
    /// The tangent with its negative eigenvalues filtered, and true if there was one beyond rounding.
    ///
    /// Flip and twist are eigenvalues. Those of the 2×2 matrix are m ± r, with m half its trace; the filtered
    /// matrix is h I + k (A − m I), as [`project`](mod@crate::point::project) derives it.
    pub(super) fn project(self, filter: Filter) -> (Self, bool) {
        if filter == Filter::None {
            return (self, false);
        }
        let (zero, half, slope) = (R::splat(0.0), R::splat(0.5), filter.slope::<R>());
        let Self { hessian: [h11, h22, h12], flip, twist, .. } = self;
        let (m, d) = (half * (h11 + h22), half * (h11 - h22));
        let (scale, back) = d.abs().max(h12.abs()).power_of_two_scale();
        let (scaled_d, scaled_h12) = (d * scale, h12 * scale);
        let r = scaled_d.mul_add(scaled_d, scaled_h12 * scaled_h12).sqrt() * back;
        let (larger, smaller) = (m + r, m - r);
        let largest = larger.abs().max(smaller.abs()).max(flip.abs()).max(twist.abs());
        let smallest = smaller.min(flip).min(twist);
        let mut hessian = self.hessian;
        if smaller.less(zero) {
            let (f_larger, f_smaller) = (filtered(larger, slope), filtered(smaller, slope));
            let h = half * (f_larger + f_smaller);
            // The difference is zero where r is.
            let k = (f_larger - f_smaller) / (r + r).max(R::splat(R::min_positive()));
            hessian = [k.mul_add(d, h), h - k * d, k * h12];
        }
        let (flip, twist) = (filtered(flip, slope), filtered(twist, slope));
        let is_filtered = smallest.less(R::splat(-16.0 * R::unit_roundoff()) * largest);
        (Self { hessian, flip, twist, ..self }, is_filtered)
    }

    /// True if no entry of dP/dF can overflow, filtered or not.
    pub(super) fn stays_finite(&self) -> bool {
        let mut numbers = self.hessian.into_iter().chain([self.flip, self.twist]);
        numbers.all(|number| (R::splat(16.0) * number).is_finite())
    }
}

/// U A Vᵀ.
pub(super) fn in_the_world<R: Real>(U: &Matrix2<R>, A: Matrix2<R>, V: &Matrix2<R>) -> Matrix2<R> {
    multiply(U, &multiply(&A, &transpose(V)))
}

fn transpose<R: Real>([[a, b], [c, d]]: &Matrix2<R>) -> Matrix2<R> {
    [[*a, *c], [*b, *d]]
}

fn multiply<R: Real>(A: &Matrix2<R>, B: &Matrix2<R>) -> Matrix2<R> {
    A.map(|[a, b]| [a.mul_add(B[0][0], b * B[1][0]), a.mul_add(B[0][1], b * B[1][1])])
}
