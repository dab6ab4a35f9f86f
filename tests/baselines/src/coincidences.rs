//! dP/dF by differentiating P = F S(C), with a formula of its own for each coincidence of the stretches.
//!
//! This is what one arrives at by differentiating P with respect to F on paper \[GKJD09\]; the formulas are
//! those of \[SPO08\], appendix A, for the derivative D = ∂S/∂C of an isotropic tensor function with
//! principal values
//!
//! ```text
//! xa = λa²,   ya = ψa/λa,   yab = ∂ya/∂xb = (ψab/λa − δab ψa/λa²) / 2λb,   Na = va vaᵀ
//! ```
//!
//! **All distinct**, a, b, c cyclic, with s(a) = ya/((xa − xb)(xa − xc)):
//!
//! ```text
//! D = Σa s(a) [dC² − (xb + xc) 1 − (2xa − xb − xc) Na⊗Na − (xb − xc)(Nb⊗Nb − Nc⊗Nc)] + Σab yab Na⊗Nb
//! ```
//!
//! **Two equal**, a apart from b = c, with d = xa − xc and y = ya − yc:
//!
//! ```text
//! D = s1 dC² − s2 1 − s3 C⊗C + s4 (C⊗I + I⊗C) − s5 I⊗I
//! s1 = y/d² + (ycb − ycc)/d
//! s2 = 2xc y/d² + (xa + xc)(ycb − ycc)/d
//! s3 = 2y/d³ + (yac + yca − yaa − ycc)/d²
//! s4 = 2xc y/d³ + (yac − ycb)/d + xc (yac + yca − yaa − ycc)/d²
//! s5 = 2xc² y/d³ + xa xc (yac + yca)/d² − xc² (yaa + ycc)/d² − (xa + xc) ycb/d
//! ```
//!
//! **All equal**: D = (y11 − y12) 1 + y12 I⊗I.
//!
//! Here dC² is the derivative of C² by C, 1 the identity on symmetric matrices, and since yac = yca the
//! sources' two different coefficients of C⊗I and I⊗C are one. Then, D knowing symmetric increments only,
//!
//! ```text
//! ∂Pij/∂Fkl = δik Sjl + 2 Σmp Fim Fkp Dmj,pl
//! ```
//!
//! Which formula is right is a matter of a threshold, and none is accurate near it. Before the switch
//! differences of close numbers are divided by their gap, and the error is u/gap, or u/gap² where a pair that
//! counts as equal is close to the third stretch; behind the switch the derivative is that of other
//! stretches. Where two stretches have opposite signs their squares still coincide, and S is not a function
//! of C there unless the energy is even. A stretch of zero divides by zero.
//!
//! \[GKJD09\] Gao, Kim, James, Desai, as described by Sin et al., *Invertible Isotropic Hyperelasticity using
//! SVD Gradients*, 2011. \[SPO08\] de Souza Neto, Perić, Owen, *Computational Methods for Plasticity*, 2008.

#![expect(non_snake_case, reason = "F, C, S, D, N as above")]

use piola::material::Blocks;
use piola::point::{Matrix3, Svd};
use piola::{Material, Real};

use crate::matrix::{multiply_transposed, scale_columns};

/// dP/dF, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F. Symmetric up to rounding.
///
/// Two stretches count as equal where λi² − λj² < `threshold` · λi².
#[inline(always)]
#[must_use]
pub fn tangent<R: Real<Mask = bool>>(material: &impl Material, svd: &Svd<R>, threshold: f64) -> [[R; 9]; 9] {
    let Svd { U, stretches, V } = svd;
    let principal = Principal::new(material, *stretches);
    let D = principal.derivative(V, R::splat(threshold));
    let F = multiply_transposed(&scale_columns(U, *stretches), V);
    let S = multiply_transposed(&scale_columns(V, principal.y), V);

    let two = R::splat(2.0);
    let mut dP_dF = [[R::splat(0.0); 9]; 9];
    for j in 0..3 {
        for l in 0..3 {
            for i in 0..3 {
                // Row i of F times the 3×3 matrix of entries (mj, pl) of D.
                let mut row = [R::splat(0.0); 3];
                for p in 0..3 {
                    for m in 0..3 {
                        row[p] = F[i][m].mul_add(D[PLACE[m][j]][PLACE[p][l]], row[p]);
                    }
                }
                for k in 0..3 {
                    let sum = row[0].mul_add(F[k][0], row[1].mul_add(F[k][1], row[2] * F[k][2]));
                    let start = if i == k { S[j][l] } else { R::splat(0.0) };
                    dP_dF[3 * i + j][3 * k + l] = two.mul_add(sum, start);
                }
            }
        }
    }
    dP_dF
}

/// A linear map of symmetric matrices by its entries (ij, kl), i ≤ j and k ≤ l.
type Fourth<R> = [[R; 6]; 6];

/// The entries of a symmetric matrix.
const ENTRIES: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Index of each entry (i, j) among them.
const PLACE: [[usize; 3]; 3] = [[0, 3, 4], [3, 1, 5], [4, 5, 2]];

/// Eigenvalues x of C, y of S, and ∂ya/∂xb.
struct Principal<R> {
    x: [R; 3],
    y: [R; 3],
    slopes: Matrix3<R>,
}

impl<R: Real<Mask = bool>> Principal<R> {
    #[inline(always)]
    fn new(material: &impl Material, stretches: [R; 3]) -> Self {
        // The compiler drops the quotients of `blocks`, which nobody reads.
        let Blocks { gradient, hessian: [h11, h22, h33, h12, h13, h23], .. } = material.blocks(stretches);
        let hessian = [[h11, h12, h13], [h12, h22, h23], [h13, h23, h33]];
        let inverses = stretches.map(|stretch| R::splat(1.0) / stretch);
        let y = [gradient[0] * inverses[0], gradient[1] * inverses[1], gradient[2] * inverses[2]];
        let mut slopes = hessian;
        for a in 0..3 {
            for b in 0..3 {
                let change = if a == b { hessian[a][b] - y[a] } else { hessian[a][b] };
                slopes[a][b] = R::splat(0.5) * change * (inverses[a] * inverses[b]);
            }
        }
        Self { x: stretches.map(|stretch| stretch * stretch), y, slopes }
    }

    /// D = ∂S/∂C by the formula for this coincidence.
    #[inline(always)]
    fn derivative(&self, V: &Matrix3<R>, threshold: R) -> Fourth<R> {
        let [x1, x2, x3] = self.x;
        let first_two = (x1 - x2).less(threshold * x1);
        let last_two = (x2 - x3).less(threshold * x2);
        match (first_two, last_two) {
            (true, true) => self.all_equal(),
            (true, false) => self.two_equal(V, [2, 0, 1]),
            (false, true) => self.two_equal(V, [0, 1, 2]),
            (false, false) => self.all_distinct(V),
        }
    }

    #[inline(always)]
    fn all_distinct(&self, V: &Matrix3<R>) -> Fourth<R> {
        let Self { x, y, slopes } = self;
        let zero = R::splat(0.0);
        // The coefficients of dC², 1 and Na⊗Nb.
        let (mut of_square, mut of_identity, mut of_products) = (zero, zero, *slopes);
        for (a, b, c) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let s = y[a] / ((x[a] - x[b]) * (x[a] - x[c]));
            of_square = of_square + s;
            of_identity = of_identity - s * (x[b] + x[c]);
            of_products[a][a] = of_products[a][a] - s * ((x[a] - x[b]) + (x[a] - x[c]));
            of_products[b][b] = of_products[b][b] - s * (x[b] - x[c]);
            of_products[c][c] = of_products[c][c] + s * (x[b] - x[c]);
        }
        let N = [0, 1, 2].map(|a| ENTRIES.map(|(i, j)| V[i][a] * V[j][a]));
        let mut D = square_and_identity(&self.right(V), of_square, of_identity);
        for a in 0..3 {
            for b in 0..3 {
                add_product(&mut D, of_products[a][b], &N[a], &N[b]);
            }
        }
        D
    }

    #[inline(always)]
    fn two_equal(&self, V: &Matrix3<R>, [a, b, c]: [usize; 3]) -> Fourth<R> {
        let Self { x, y, slopes } = self;
        let (xa, xc) = (x[a], x[c]);
        let inverse = R::splat(1.0) / (xa - xc);
        let (ycb, ycc, yac, yaa) = (slopes[c][b], slopes[c][c], slopes[a][c], slopes[a][a]);
        let once = y[a] - y[c];
        let twice = R::splat(2.0) * once;
        let both = yac + slopes[c][a];
        let (inverse2, inverse3) = (inverse * inverse, inverse * inverse * inverse);
        let s1 = once * inverse2 + (ycb - ycc) * inverse;
        let s2 = twice * xc * inverse2 + (xa + xc) * (ycb - ycc) * inverse;
        let s3 = twice * inverse3 + (both - yaa - ycc) * inverse2;
        let s4 = twice * xc * inverse3 + (yac - ycb) * inverse + xc * (both - yaa - ycc) * inverse2;
        let s5 = twice * xc * xc * inverse3 + xa * xc * both * inverse2
            - xc * xc * (yaa + ycc) * inverse2
            - (xa + xc) * ycb * inverse;
        let C = self.right(V);
        let entries = ENTRIES.map(|(i, j)| C[i][j]);
        let mut D = square_and_identity(&C, s1, -s2);
        add_product(&mut D, -s3, &entries, &entries);
        add_product(&mut D, s4, &entries, &identity());
        add_product(&mut D, s4, &identity(), &entries);
        add_product(&mut D, -s5, &identity(), &identity());
        D
    }

    #[inline(always)]
    fn all_equal(&self) -> Fourth<R> {
        let [y11, y12, _] = self.slopes[0];
        let zero = R::splat(0.0);
        let mut D = square_and_identity(&[[zero; 3]; 3], zero, y11 - y12);
        add_product(&mut D, y12, &identity(), &identity());
        D
    }

    /// C.
    #[inline(always)]
    fn right(&self, V: &Matrix3<R>) -> Matrix3<R> {
        multiply_transposed(&scale_columns(V, self.x), V)
    }
}

/// I.
#[inline(always)]
fn identity<R: Real>() -> [R; 6] {
    let (zero, one) = (R::splat(0.0), R::splat(1.0));
    [one, one, one, zero, zero, zero]
}

/// α dC² + β 1, with ½ (δik Cjl + δil Cjk + δjk Cil + δjl Cik) for dC² and ½ (δik δjl + δil δjk) for 1.
#[inline(always)]
fn square_and_identity<R: Real>(C: &Matrix3<R>, alpha: R, beta: R) -> Fourth<R> {
    let (zero, half) = (R::splat(0.0), R::splat(0.5));
    let [c11, c22, c33, c12, c13, c23] = ENTRIES.map(|(i, j)| alpha * C[i][j]);
    let [h12, h13, h23] = [half * c12, half * c13, half * c23];
    let (diagonal, shear) = (|c: R| c + c + beta, |c: R, d: R| half * (c + d + beta));
    [
        [diagonal(c11), zero, zero, c12, c13, zero],
        [zero, diagonal(c22), zero, c12, zero, c23],
        [zero, zero, diagonal(c33), zero, c13, c23],
        [c12, c12, zero, shear(c11, c22), h23, h13],
        [c13, zero, c13, h23, shear(c11, c33), h12],
        [zero, c23, c23, h13, h12, shear(c22, c33)],
    ]
}

/// Adds s A⊗B.
#[inline(always)]
fn add_product<R: Real>(D: &mut Fourth<R>, s: R, A: &[R; 6], B: &[R; 6]) {
    for row in 0..6 {
        let scaled = s * A[row];
        for column in 0..6 {
            D[row][column] = scaled.mul_add(B[column], D[row][column]);
        }
    }
}

#[cfg(test)]
mod tests {
    use piola::point::svd;
    use piola_materials::{Ogden, StVenantKirchhoff};

    use super::*;
    use crate::matrix::to_world;
    use crate::testing::{IDENTITY, convert, error, exact};
    use piola::__private::random::Random;

    const THRESHOLD: f64 = 1e-6;

    /// The worst relative error of dP/dF over rotations around these stretches.
    fn worst<R: Real<Mask = bool> + Into<f64>>(stretches: [f64; 3]) -> f64 {
        let rubber = Ogden::new([2.0, 1.0], [1.5, 4.0], 3.0).expect("admissible parameters");
        let mut random = Random::new(3);
        let errors = (0..20).map(|_| {
            let F = to_world(&random.rotation(), &scale_columns(&IDENTITY, stretches), &random.rotation());
            let F = convert::<R>(&F);
            error(&tangent(&rubber, &svd(&F), THRESHOLD), &exact(&rubber, &F).1)
        });
        errors.fold(0.0, f64::max)
    }

    #[test]
    fn each_formula_is_right_where_it_is_at_home() {
        for stretches in [[1.4, 1.0, 0.6], [1.4, 1.4, 0.8], [1.4, 0.8, 0.8], [1.2, 1.2, 1.2]] {
            // A few hundred operations, among them divisions by powers of gaps of a half and more.
            let found =
                [worst::<f64>(stretches) / f64::UNIT_ROUNDOFF, worst::<f32>(stretches) / f32::UNIT_ROUNDOFF];
            assert!(found.into_iter().all(|error| error <= 200.0), "{stretches:?}: {found:?}");
        }
    }

    /// The derivative at other stretches errs like their distance, differences lose what they divide by.
    #[test]
    fn none_is_accurate_near_the_threshold() {
        let behind = worst::<f64>([1.4, 0.8 * (1.0 + 0.4 * THRESHOLD), 0.8]);
        assert!(behind >= 0.1 * THRESHOLD, "{behind:e}");
        let before = worst::<f64>([1.4, 0.8 * (1.0 + THRESHOLD), 0.8]);
        assert!(before >= 0.1 * f64::UNIT_ROUNDOFF / THRESHOLD, "{before:e}");
        let pair_and_one = worst::<f64>([1.0 + 10.0 * THRESHOLD, 1.0, 1.0]);
        assert!(pair_and_one >= 0.1 * f64::UNIT_ROUNDOFF / (10.0 * THRESHOLD).powi(2), "{pair_and_one:e}");
    }

    /// Even where the energy is a polynomial in C.
    #[test]
    fn a_stretch_of_zero_divides_by_zero() {
        let material = StVenantKirchhoff::new(1.0, 2.0).expect("admissible parameters");
        let F: Matrix3<f64> = [[1.2, 0.0, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 0.0]];
        let found = tangent(&material, &svd(&F), THRESHOLD);
        assert!(found.as_flattened().iter().any(|entry| entry.is_nan()));
        assert!(exact(&material, &F).1.as_flattened().iter().all(|entry| entry.is_finite()));
    }
}
