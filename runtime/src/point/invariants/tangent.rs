//! dP/dF from the derivatives of an energy W by I1, I2 and J, and the stiffness of a tetrahedron.
//!
//! With C = cof F, D = C × F and the derivatives of [`super`], dC = F × dF and dD = C × dF + F × (F × dF):
//!
//! ```text
//! dP  = 2 W1 dF + T × dF + 2 W2 F × (F × dF) + F (hF : dF) + D (hD : dF) + C (hC : dF)
//!
//! T   = WJ F + 2 W2 C                    hF = 4 W11 F + 4 W12 D + 2 W1J C
//!                                        hD = 4 W12 F + 4 W22 D + 2 W2J C
//!                                        hC = 2 W1J F + 2 W2J D +   WJJ C
//! ```
//!
//! and F × (F × dF) = F (F : dF) + I1 dF − F Fᵀ dF − dF Fᵀ F, whose first term joins that with hF.
//!
//! # Seen from other coordinates
//!
//! Let dF = ec ⊗ wy, and take the product with ea ⊗ wx, where the rows wx are those of any 3×3 matrix W.
//! Since (a ⊗ b) × (c ⊗ d) = (a × c) ⊗ (b × d), each term keeps its form. With F̃ = F Wᵀ, likewise C̃, D̃ and
//! h̃, with T̃ = T (cof W)ᵀ and M = W Wᵀ, and with k the third index besides a and c, z that besides x and y,
//!
//! ```text
//! K between (a, x) and (c, y) = (δac (2 W1 + 2 W2 I1) − 2 W2 (F Fᵀ)ac) Mxy − δac 2 W2 (F̃ᵀ F̃)xy
//!                             + εack εxyz T̃kz + F̃ax h̃Fcy + D̃ax h̃Dcy + C̃ax h̃Ccy
//! ```
//!
//! For W = I this is dP/dF; with √volume Dm⁻¹ it is the stiffness between three nodes of a tetrahedron.
//!
//! # What floating point does here
//!
//! The terms are as good as F determines them, and what is left to fear is that they cancel. No entry of F, C
//! and D exceeds f = √I1, c = √I2 and d = |D| = √(I1 I2 + 3 J²), so that the terms of an entry of dP/dF are
//! not larger together than
//!
//! ```text
//! 2 |W1| + f |WJ| + 2 (c + 3 I1) |W2| + 4 f² |W11| + 4 d² |W22| + c² |WJJ|
//!   + 8 f d |W12| + 4 f c |W1J| + 4 c d |W2J|
//! ```
//!
//! and its error is a few u times that. N is a bound of it without roots, with c ≤ f²/√3 and means of squares
//! in the place of products, all equal at rest. At rest, where f² = 3 bounds entries that are 1, N is 3 to 9
//! times the largest entry on the diagonal for the energies in use. A point where it is more than
//! [`MAX_CANCELLATION`] times that entry goes the way of all others: [`Terms::keeps_digits`].

#![expect(non_snake_case, reason = "F, C, D, P, T, I1, I2, J, W as in the text above")]

use super::super::Matrix3;
#[cfg(feature = "batch")]
use super::super::matrix::multiply_transposed;
use super::super::matrix::{dot, symmetric, three};
use super::super::tangent::Assemble;
use super::{cofactor, half_derivative_of_I2, square, stress_of_terms};
use crate::lanes::Real;

/// A bound of every term of an entry of dP/dF together, N in the text above, and one of the entries of P;
/// without `HAS_SECOND`, `HAS_ALL` or `HAS_VOLUME` as in [`Terms`].
#[inline(always)]
fn bounds<R: Real, const HAS_SECOND: bool, const HAS_ALL: bool, const HAS_VOLUME: bool>(
    [I1, I2, J]: [R; 3],
    derivatives: &[R; 9],
) -> (R, R) {
    let mut sizes = *derivatives;
    for size in &mut sizes {
        *size = size.abs();
    }
    let [W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J] = sizes;
    let (two, four) = (R::splat(2.0), R::splat(4.0));
    let (mut tangent, mut stress) = (two * W1, two * W1);
    if HAS_VOLUME {
        // f ≤ (f² + 3)/(2√3).
        let f = I1.mul_add(R::splat(0.5 * FRAC_1_SQRT_3), R::splat(1.5 * FRAC_1_SQRT_3));
        tangent = f.mul_add(WJ, I2.mul_add(WJJ, tangent));
        stress = stress + WJ;
    }
    if HAS_SECOND {
        // c ≤ f²/√3.
        tangent = (R::splat(6.0 + 2.0 * FRAC_1_SQRT_3) * I1).mul_add(W2, tangent);
        stress = two.mul_add(W2, stress);
    }
    if HAS_SECOND || HAS_ALL {
        tangent = (four * I1).mul_add(W11, tangent);
    }
    if HAS_ALL {
        // f c ≤ (f² + c²)/2.
        tangent = (two * (I1 + I2)).mul_add(W1J, tangent);
    }
    if HAS_SECOND && HAS_ALL {
        // f d ≤ f² + d²/4 and c d ≤ c² + d²/4.
        let d2 = R::splat(3.0).mul_add(J * J, I1 * I2);
        tangent = (four * d2).mul_add(W22, tangent);
        tangent = R::splat(8.0).mul_add(I1, two * d2).mul_add(W12, tangent);
        tangent = four.mul_add(I2, d2).mul_add(W2J, tangent);
    }
    // No entry of F, C and D exceeds (1 + f²)².
    let largest = R::splat(1.0) + I1;
    (tangent, largest * (largest * stress))
}

const FRAC_1_SQRT_3: f64 = 0.577_350_269_189_625_8;

/// Coordinates of a tangent: the rows of W.
pub(crate) trait Coordinates<R> {
    /// True if W = I.
    const ARE_ENTRIES: bool;

    /// A Wᵀ.
    fn pulled(&self, A: &Matrix3<R>) -> Matrix3<R>;

    /// A (cof W)ᵀ.
    fn pulled_normals(&self, A: &Matrix3<R>) -> Matrix3<R>;

    /// `factor` (W Wᵀ)xy; `None` if it is zero for any factor.
    fn metric(&self, x: usize, y: usize, factor: R) -> Option<R>;
}

/// W = I: the coordinates of dP/dF.
pub(crate) struct Entries;

impl<R: Real> Coordinates<R> for Entries {
    const ARE_ENTRIES: bool = true;

    #[inline(always)]
    fn pulled(&self, A: &Matrix3<R>) -> Matrix3<R> {
        *A
    }

    #[inline(always)]
    fn pulled_normals(&self, A: &Matrix3<R>) -> Matrix3<R> {
        *A
    }

    #[inline(always)]
    fn metric(&self, x: usize, y: usize, factor: R) -> Option<R> {
        (x == y).then_some(factor)
    }
}

/// The rows of W as given.
#[cfg(feature = "batch")]
pub(crate) struct RowsOf<R> {
    rows: Matrix3<R>,
    normals: Matrix3<R>,
    metric: Matrix3<R>,
}

#[cfg(feature = "batch")]
impl<R: Real> RowsOf<R> {
    #[inline(always)]
    pub(crate) fn new(W: Matrix3<R>) -> Self {
        Self { rows: W, normals: cofactor(&W), metric: gram(&W) }
    }
}

#[cfg(feature = "batch")]
impl<R: Real> Coordinates<R> for RowsOf<R> {
    const ARE_ENTRIES: bool = false;

    #[inline(always)]
    fn pulled(&self, A: &Matrix3<R>) -> Matrix3<R> {
        multiply_transposed(A, &self.rows)
    }

    #[inline(always)]
    fn pulled_normals(&self, A: &Matrix3<R>) -> Matrix3<R> {
        multiply_transposed(A, &self.normals)
    }

    #[inline(always)]
    fn metric(&self, x: usize, y: usize, factor: R) -> Option<R> {
        Some(factor * self.metric[x][y])
    }
}

/// F, C, D and T seen from other coordinates.
struct Pulled<R> {
    F: Matrix3<R>,
    C: Matrix3<R>,
    D: Matrix3<R>,
    T: Matrix3<R>,
}

/// The matrices and factors that P and dP/dF are made of at a point.
///
/// Without `HAS_SECOND`, derivatives by I2 are taken for zero. Without `HAS_ALL`, so are the second
/// derivatives other than WJJ and, with `HAS_SECOND`, W11; without `HAS_VOLUME` so are WJ and WJJ, and I1 is
/// the only invariant. The few forms that this makes are each compiled for every output.
pub(crate) struct Terms<R, const HAS_SECOND: bool, const HAS_ALL: bool, const HAS_VOLUME: bool> {
    F: Matrix3<R>,
    C: Matrix3<R>,
    D: Matrix3<R>,
    P: Matrix3<R>,
    T: Matrix3<R>,
    /// F Fᵀ.
    b: Matrix3<R>,
    /// 2 W1 + 2 W2 I1, and 2 W2.
    along: [R; 2],
    /// Factors of F, D and C in hF, that of F (F : dF) included, in hD, and in hC.
    factors: [[R; 3]; 3],
    /// N and the largest entry of P: see [`bounds`].
    bounds: (R, R),
}

impl<R: Real, const HAS_SECOND: bool, const HAS_ALL: bool, const HAS_VOLUME: bool>
    Terms<R, HAS_SECOND, HAS_ALL, HAS_VOLUME>
{
    /// Name of the stage from these terms to P and dP/dF.
    pub(crate) const TANGENT: &'static str = match (HAS_SECOND, HAS_ALL) {
        (true, true) => "tangent_by_invariants",
        (true, false) if !HAS_VOLUME => "tangent_by_invariants_without_mixed_and_J",
        (true, false) => "tangent_by_invariants_without_mixed",
        (false, true) => "tangent_by_invariants_without_I2",
        (false, false) => "tangent_by_invariants_without_I2_and_mixed",
    };

    /// Name of the stage from these terms to the gradient and stiffness of a tetrahedron.
    #[cfg(all(feature = "interpreter", not(test)))]
    pub(crate) const STIFFNESS: &'static str = match (HAS_SECOND, HAS_ALL) {
        (true, true) => "stiffness_by_invariants",
        (true, false) if !HAS_VOLUME => "stiffness_by_invariants_without_mixed_and_J",
        (true, false) => "stiffness_by_invariants_without_mixed",
        (false, true) => "stiffness_by_invariants_without_I2",
        (false, false) => "stiffness_by_invariants_without_I2_and_mixed",
    };

    /// The terms at F with its invariants, and W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J there.
    #[inline(always)]
    pub(crate) fn new(F: &Matrix3<R>, invariants: [R; 3], derivatives: &[R; 9]) -> Self {
        let [W1, W2, WJ, W11, W22, WJJ, W12, W1J, W2J] = *derivatives;
        let (two, four) = (R::splat(2.0), R::splat(4.0));
        let (p1, p2) = (two * W1, two * W2);
        let C = cofactor(F);
        let D = if HAS_SECOND { half_derivative_of_I2(F) } else { C };
        let [I1, I2, J] = invariants;
        let invariants = [I1, if HAS_SECOND { I2 } else { square(&C) }, J];
        let (a11, a12, a22, a1J, a2J) = (four * W11, four * W12, four * W22, two * W1J, two * W2J);
        Self {
            F: *F,
            C,
            D,
            P: stress_of_terms::<R, HAS_SECOND, HAS_VOLUME>([F, &D, &C], [p1, p2, WJ]),
            T: three!(i => three!(j => {
                match (HAS_SECOND, HAS_VOLUME) {
                    (true, true) => p2.mul_add(C[i][j], WJ * F[i][j]),
                    (true, false) => p2 * C[i][j],
                    (false, _) => WJ * F[i][j],
                }
            })),
            b: if HAS_SECOND { gram(F) } else { *F },
            along: [if HAS_SECOND { p2.mul_add(I1, p1) } else { p1 }, p2],
            factors: [[if HAS_SECOND { a11 + p2 } else { a11 }, a12, a1J], [a12, a22, a2J], [a1J, a2J, WJJ]],
            bounds: bounds::<R, HAS_SECOND, HAS_ALL, HAS_VOLUME>(invariants, derivatives),
        }
    }

    /// First Piola stress P, Pa.
    #[inline(always)]
    pub(crate) fn stress(&self) -> Matrix3<R> {
        self.P
    }

    /// A bound of the entries of dP/dF, Pa.
    #[cfg(feature = "batch")]
    #[inline(always)]
    pub(crate) fn bound(&self) -> R {
        self.bounds.0
    }

    /// True if dP/dF is as accurate as by a decomposition, given the largest entry on its diagonal, and
    /// nothing on the way to it or to P leaves the range.
    #[inline(always)]
    pub(crate) fn keeps_digits(&self, largest: R) -> R::Mask {
        let (tangent, stress) = self.bounds;
        // Of tiny F the factors are far larger than the products.
        let [[a11, a12, a1J], [_, a22, a2J], [.., aJJ]] = self.factors;
        let mut sizes = tangent + stress;
        if HAS_VOLUME {
            sizes = sizes + aJJ.abs();
        }
        if HAS_SECOND || HAS_ALL {
            sizes = sizes + a11.abs();
        }
        if HAS_ALL {
            sizes = sizes + a1J.abs();
        }
        if HAS_SECOND && HAS_ALL {
            sizes = sizes + a12.abs() + a22.abs() + a2J.abs();
        }
        tangent.less(R::splat(MAX_CANCELLATION) * largest) & (R::splat(16.0) * sizes).is_finite()
    }

    /// The largest entry on the diagonal of dP/dF, Pa.
    #[inline(always)]
    fn largest_on_diagonal(&self) -> R {
        let mut largest = R::splat(0.0);
        for a in 0..3 {
            let h = self.products(a, &self.F, &self.D, &self.C);
            for x in 0..3 {
                let metric = Some(self.metric_factor(a));
                let entry = self.on_diagonal(a, x, x, &self.F, &self.D, &self.C, &h, metric);
                largest = entry.abs().max(largest);
            }
        }
        largest
    }

    /// hF, hD and hC in a row, a triple for each column.
    #[inline(always)]
    fn products(&self, row: usize, F: &Matrix3<R>, D: &Matrix3<R>, C: &Matrix3<R>) -> [[R; 3]; 3] {
        if !HAS_ALL {
            let [[a11, ..], _, [.., aJJ]] = self.factors;
            return three!(y => [a11 * F[row][y], R::splat(0.0), aJJ * C[row][y]]);
        }
        three!(y => three!(k => {
            let [f, d, c] = self.factors[k];
            let sum = f.mul_add(F[row][y], c * C[row][y]);
            if HAS_SECOND { d.mul_add(D[row][y], sum) } else { sum }
        }))
    }

    /// F̃ax h̃F + D̃ax h̃D + C̃ax h̃C and another term.
    #[inline(always)]
    fn ranks(&self, [F, D, C]: [R; 3], [hF, hD, hC]: [R; 3], other: Option<R>) -> R {
        let mut sum = other;
        if HAS_VOLUME {
            sum = add(C, hC, sum);
        }
        if HAS_SECOND || HAS_ALL {
            sum = add(F, hF, sum);
        }
        if HAS_SECOND && HAS_ALL {
            sum = add(D, hD, sum);
        }
        sum.unwrap_or(R::splat(0.0))
    }

    /// K between (a, x) and (a, y), `metric` being the term with W Wᵀ.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "two rows of three matrices, and their products")]
    fn on_diagonal(
        &self,
        a: usize,
        x: usize,
        y: usize,
        F: &Matrix3<R>,
        D: &Matrix3<R>,
        C: &Matrix3<R>,
        h: &[[R; 3]; 3],
        metric: Option<R>,
    ) -> R {
        let sum = self.ranks([F[a][x], D[a][x], C[a][x]], h[y], metric);
        if !HAS_SECOND {
            return sum;
        }
        let right = dot([F[0][x], F[1][x], F[2][x]], [F[0][y], F[1][y], F[2][y]]);
        (-self.along[1]).mul_add(right, sum)
    }

    /// Factor of W Wᵀ in K between (a, x) and (a, y).
    #[inline(always)]
    fn metric_factor(&self, a: usize) -> R {
        let [along, p2] = self.along;
        if HAS_SECOND { (-p2).mul_add(self.b[a][a], along) } else { along }
    }

    /// K between (a, x) and (a, y), x a row and y a column.
    #[inline(always)]
    fn diagonal_block<C: Coordinates<R>>(&self, a: usize, seen: &Pulled<R>, from: &C) -> Matrix3<R> {
        let Pulled { F, C, D, .. } = seen;
        let h = self.products(a, F, D, C);
        symmetric!(x, y => {
            let metric = from.metric(x, y, self.metric_factor(a));
            self.on_diagonal(a, x, y, F, D, C, &h, metric)
        })
    }

    /// K between (a, x) and (c, y) for a < c, x a row and y a column.
    #[inline(always)]
    fn mixed_block<C: Coordinates<R>>(&self, [a, c]: [usize; 2], seen: &Pulled<R>, from: &C) -> Matrix3<R> {
        let Pulled { F, C, D, T } = seen;
        let h = self.products(c, F, D, C);
        three!(x => three!(y => {
            let turned = match (y + 3 - x) % 3 {
                0 => None,
                turn if turn == c - a => Some(T[third(a, c)][third(x, y)]),
                _ => Some(-T[third(a, c)][third(x, y)]),
            };
            let metric = if HAS_SECOND { from.metric(x, y, -self.along[1] * self.b[a][c]) } else { None };
            let other = match (metric, turned) {
                (Some(metric), Some(turned)) => Some(metric + turned),
                (metric, turned) => metric.or(turned),
            };
            self.ranks([F[a][x], D[a][x], C[a][x]], h[y], other)
        }))
    }

    /// Assembles dP/dF in the coordinates, as 3×3 blocks like those of
    /// [`assemble_blocks`](super::assemble_blocks), Pa. Returns the largest entry on the diagonal of dP/dF.
    #[inline(always)]
    pub(crate) fn assemble<C: Coordinates<R>>(&self, coordinates: &C, to: &mut impl Assemble<R>) -> R {
        let mut largest = if C::ARE_ENTRIES { R::splat(0.0) } else { self.largest_on_diagonal() };
        let (F, C) = (coordinates.pulled(&self.F), coordinates.pulled(&self.C));
        let D = if HAS_SECOND && HAS_ALL { coordinates.pulled(&self.D) } else { C };
        let seen = &Pulled { F, C, D, T: coordinates.pulled_normals(&self.T) };
        largest = self.put_diagonal(0, largest, seen, coordinates, to);
        to.block(0, 1, &self.mixed_block([0, 1], seen, coordinates));
        to.block(0, 2, &self.mixed_block([0, 2], seen, coordinates));
        largest = self.put_diagonal(1, largest, seen, coordinates, to);
        to.block(1, 2, &self.mixed_block([1, 2], seen, coordinates));
        self.put_diagonal(2, largest, seen, coordinates, to)
    }

    /// Puts a block on the diagonal. Returns the largest entry on the diagonal of dP/dF so far.
    #[inline(always)]
    fn put_diagonal<C: Coordinates<R>>(
        &self,
        a: usize,
        mut largest: R,
        seen: &Pulled<R>,
        coordinates: &C,
        to: &mut impl Assemble<R>,
    ) -> R {
        let block = self.diagonal_block(a, seen, coordinates);
        if C::ARE_ENTRIES {
            for x in 0..3 {
                largest = block[x][x].abs().max(largest);
            }
        }
        to.block(a, a, &block);
        largest
    }
}

/// a h and another term.
#[inline(always)]
fn add<R: Real>(a: R, h: R, other: Option<R>) -> Option<R> {
    match other {
        Some(other) => Some(a.mul_add(h, other)),
        None => Some(a * h),
    }
}

/// A Aᵀ.
#[inline(always)]
fn gram<R: Real>(A: &Matrix3<R>) -> Matrix3<R> {
    symmetric!(i, j => dot(A[i], A[j]))
}

/// The index different from two different ones.
const fn third(i: usize, j: usize) -> usize {
    (6 - i - j) % 3
}

/// N by the largest entry on the diagonal of dP/dF, up to which the latter has its digits.
///
/// Terms that cancel change with F as much as they are large: at 6000 random F of each energy of the
/// catalogue that has invariants, the error in `f32` beside `f64` was at most 9.2 u (‖dP/dF‖ + sens) up to a
/// ratio of 64, and 7.1 beyond it.
const MAX_CANCELLATION: f64 = 64.0;
