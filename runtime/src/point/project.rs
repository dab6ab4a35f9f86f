//! Filters that make a tangent positive semidefinite, exactly and eigenvalue by eigenvalue.
//!
//! In the basis of the diagonal entries and (ij ± ji)/√2 the tangent is diagonal but for one 3×3 block (see
//! [`tangent`](super::tangent)): its nine eigenvalues are the flips, the twists and those of the Hessian ψij.
//! Filtering them is filtering dP/dF, because the frames are orthogonal. Applied to an element, the filtered dP/dF
//! is pulled back: that is not the same as filtering the 12×12 stiffness, which some codes do, unless the element
//! is regular.
//!
//! What floating point does here. A filtered eigenvalue is zero up to u ‖dP/dF‖ of either sign; where nothing is
//! negative beyond doubt, the block comes back bit for bit.
//!
//! # The 3×3 block in closed form
//!
//! Let A be symmetric with eigenvalues of both signs, f the filter, |·| the spectral norm. Of the three eigenvalues the middle
//! one is closer to one end than to the other; call the end that stands apart ν. The spread between the ends is at least
//! |A|, or they would have the same sign, so that ν is |A|/2 or more away from both others, whatever these do. From
//! this follows that nothing below loses digits, and no case is special: not two eigenvalues near zero, not two equal ones.
//!
//! **ν.** With q = tr A/3, C = A − q I and p² = tr C²/6, the eigenvalues are q + p y for the roots of y³ − 3y = 2x, x =
//! det C/(2p³), and the one apart is of the sign of x and has |y| = 2 cos(⅓ arccos |x|), between √3 and 2. There the
//! derivative 3y² − 3 is at least 6: a polynomial and a Newton step give y to rounding.
//!
//! **Its projector** is the adjugate of A − ν I over its trace. The trace is the product of the distances to the other two
//! eigenvalues, at least |A|²/2, which no rounding of the adjugate, u |A|², can hurt.
//!
//! **The other two** are those of T = A − ν P − m (I − P) in the plane normal to ν, moved by m = (tr A − ν)/2, half their sum: T
//! has no trace, T² = r² (I − P), and they are m ± r with r² = tr T²/2. T is formed, since tr A² − ν² − 2m² would cancel.
//!
//! **The filtered matrix** is f(ν) P + h (I − P) + k T, with h the mean of f(m ± r) and k = (f(m + r) − f(m − r))/2r,
//! or, multiplied out,
//!
//! ```text
//! f(A) = k A + a P + b I,   b = h − k m,   a = f(ν) − k ν − b.
//! ```
//!
//! |k| ≤ 1 because f is a contraction, however close the two are, and where T is nothing but rounding, so is what a wrong k does.
//! Where both are positive, k = 1 and b = 0: A is corrected by a multiple of P. Where both are negative, a clamp leaves
//! k = b = 0: the result is a multiple of P, or exactly zero. The error is below 16 u |A| in the tests, as a backward
//! error of A.
//!
//! \[CLLZJ24\] Chen, Liu, Levin, Zheng, Jacobson, *Stabler Neo-Hookean Simulation: Absolute Eigenvalue Filtering for
//! Projected Newton*, 2024.

#![expect(non_snake_case, reason = "A, L, Q as in linear algebra")]

use crate::lanes::{Mask, Real};
use crate::material::Blocks;

/// What becomes of the negative eigenvalues of dP/dF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// They stay: the exact derivative of the stress.
    #[default]
    None,
    /// They become zero: the semidefinite matrix nearest in the Frobenius norm.
    Clamp,
    /// They change sign \[CLLZJ24\]: directions of negative curvature are stiff instead of free.
    Absolute,
}

impl Filter {
    /// The slope of the filter as a function of negative eigenvalues; for positive ones it is 1.
    #[inline(always)]
    fn slope<R: Real>(self) -> R {
        R::splat(match self {
            Self::None => 1.0,
            Self::Clamp => 0.0,
            Self::Absolute => -1.0,
        })
    }
}

/// What becomes of an eigenvalue by a filter of this slope.
#[inline(always)]
fn filtered<R: Real>(eigenvalue: R, slope: R) -> R {
    // Not `max`, which would turn NaN into a plausible zero; and no zero is negative.
    let zero = R::splat(0.0);
    R::select(eigenvalue.less(zero), eigenvalue.mul_add(slope, zero), eigenvalue)
}

/// The filtered map, and whether an eigenvalue was negative by more than the rounding of the largest one.
#[inline(always)]
#[must_use]
pub fn project<R: Real>(blocks: &Blocks<R>, filter: Filter) -> (Blocks<R>, R::Mask) {
    if filter == Filter::None {
        return (*blocks, R::Mask::splat(false));
    }
    let slope = filter.slope();
    let Blocks { gradient, hessian, mut flip, mut twist } = *blocks;
    let mut largest = R::splat(0.0);
    for k in 0..6 {
        largest = hessian[k].abs().max(largest);
    }
    let (hessian, mut smallest) = project_symmetric(hessian, slope);
    for k in 0..3 {
        smallest = flip[k].min(twist[k].min(smallest));
        largest = flip[k].abs().max(twist[k].abs().max(largest));
        (flip[k], twist[k]) = (filtered(flip[k], slope), filtered(twist[k], slope));
    }
    let is_filtered = smallest.less(R::splat(-16.0 * R::UNIT_ROUNDOFF) * largest);
    (Blocks { gradient, hessian, flip, twist }, is_filtered)
}

/// The filtered symmetric matrix, stored as 11, 22, 33, 12, 13, 23, and its smallest eigenvalue or, where it is
/// positive beyond doubt, zero.
#[inline(always)]
fn project_symmetric<R: Real>(A: [R; 6], slope: R) -> ([R; 6], R) {
    let [a11, a22, a33, a12, a13, a23] = A;
    let diagonal = a11.abs().max(a22.abs()).max(a33.abs());
    let largest = diagonal.max(a12.abs()).max(a13.abs()).max(a23.abs());
    let (scale, back) = largest.power_of_two_scale();
    let scaled = [a11 * scale, a22 * scale, a33 * scale, a12 * scale, a13 * scale, a23 * scale];

    // Both answers are defined for each number of a batch by itself; only the work for the second one is skipped,
    // and only if none needs it. So a number's result never depends on its neighbours.
    let definite = surely_definite(scaled);
    let zero = R::splat(0.0);
    if !(!definite).any() {
        return (A, zero);
    }
    let ([p11, p22, p33, p12, p13, p23], smallest) = filtered_indefinite(scaled, slope);
    let indefinite = !definite & smallest.less(zero);
    let projected = [
        R::select(indefinite, p11 * back, a11),
        R::select(indefinite, p22 * back, a22),
        R::select(indefinite, p33 * back, a33),
        R::select(indefinite, p12 * back, a12),
        R::select(indefinite, p13 * back, a13),
        R::select(indefinite, p23 * back, a23),
    ];
    (projected, R::select(indefinite, smallest * back, zero))
}

/// The filtered matrix and its smallest eigenvalue before, by the formulas of the module's text, for a matrix of magnitude
/// 1 to 2 that is not positive definite.
#[inline(always)]
fn filtered_indefinite<R: Real>(A: [R; 6], slope: R) -> ([R; 6], R) {
    let [a11, a22, a33, a12, a13, a23] = A;
    let half = R::splat(0.5);
    let trace = a11 + a22 + a33;
    let nu = eigenvalue_apart(A);
    let P = projector(A, nu);

    let [p11, p22, p33, p12, p13, p23] = P;
    let m = half * (trace - nu);
    let from_m = m - nu;
    let (t11, t22, t33) =
        (from_m.mul_add(p11, a11 - m), from_m.mul_add(p22, a22 - m), from_m.mul_add(p33, a33 - m));
    let (t12, t13, t23) = (from_m.mul_add(p12, a12), from_m.mul_add(p13, a13), from_m.mul_add(p23, a23));
    let r = half_square(t11, t22, t33, t12, t13, t23).sqrt();

    let (larger, smaller) = (m + r, m - r);
    let (f_larger, f_smaller) = (filtered(larger, slope), filtered(smaller, slope));
    // The difference is zero where r is.
    let k = (f_larger - f_smaller) / (r + r).max(R::splat(R::MIN_POSITIVE));
    let b = half * (f_larger + f_smaller) - k * m;
    let a = filtered(nu, slope) - k * nu - b;
    let answer = [
        k.mul_add(a11, a.mul_add(p11, b)),
        k.mul_add(a22, a.mul_add(p22, b)),
        k.mul_add(a33, a.mul_add(p33, b)),
        k.mul_add(a12, a * p12),
        k.mul_add(a13, a * p13),
        k.mul_add(a23, a * p23),
    ];
    (answer, smaller.min(nu))
}

/// tr T²/2 of a symmetric matrix.
#[inline(always)]
fn half_square<R: Real>(t11: R, t22: R, t33: R, t12: R, t13: R, t23: R) -> R {
    let diagonal = t11.mul_add(t11, t22.mul_add(t22, t33 * t33));
    diagonal.mul_add(R::splat(0.5), t12.mul_add(t12, t13.mul_add(t13, t23 * t23)))
}

/// The eigenvalue at the end of the spectrum that is farther from the middle one.
#[inline(always)]
fn eigenvalue_apart<R: Real>([a11, a22, a33, a12, a13, a23]: [R; 6]) -> R {
    let one = R::splat(1.0);
    let q = (a11 + a22 + a33) * R::splat(1.0 / 3.0);
    let (c11, c22, c33) = (a11 - q, a22 - q, a33 - q);
    // Below u² this is that of a multiple of the identity, whose p may be anything from 0 to u.
    let floor = R::splat(R::UNIT_ROUNDOFF * R::UNIT_ROUNDOFF);
    let p_squared = half_square(c11, c22, c33, a12, a13, a23) * R::splat(1.0 / 3.0);
    let inverse = p_squared.max(floor).reciprocal_sqrt();
    let p = p_squared * inverse;

    let det = c11.mul_add(
        c22.mul_add(c33, -(a23 * a23)),
        a12.mul_add(a13.mul_add(a23, -(a12 * c33)), a13 * a12.mul_add(a23, -(c22 * a13))),
    );
    let two_x = det * (inverse * inverse * inverse);
    let x = (two_x.abs() * R::splat(0.5)).min(one);
    let mut y = R::splat(0.0);
    for k in (0..COSINE_OF_A_THIRD.len()).rev() {
        y = y.mul_add(x, R::splat(COSINE_OF_A_THIRD[k]));
    }
    for _ in 0..newton_steps(R::UNIT_ROUNDOFF) {
        let squared = y * y;
        let residual = y.mul_add(squared - R::splat(3.0), -(x + x));
        y = y - residual / squared.mul_add(R::splat(3.0), R::splat(-3.0));
    }
    p.mul_add(y.copysign(two_x), q)
}

/// 2 cos(⅓ arccos x) for 0 ≤ x ≤ 1 to 2⁻²⁸, by interpolation in Chebyshev's points. The nearest singularity is at −1.
const COSINE_OF_A_THIRD: [f64; 9] = [
    1.7320508111991306,
    0.3333327422889914,
    -0.096208882905821,
    0.04920859358455466,
    -0.030214550322650593,
    0.018766661142810205,
    -0.009859382347358756,
    0.003529713748188638,
    -0.0006057084034768052,
];

/// Steps that bring the 2⁻²⁸ of the polynomial below the unit roundoff; each squares it.
const fn newton_steps(unit_roundoff: f64) -> usize {
    let mut reached = 1.0 / (1u64 << 28) as f64;
    let mut steps = 0;
    while reached > unit_roundoff {
        reached *= reached;
        steps += 1;
    }
    steps
}

/// The projector on the eigenvector of an eigenvalue that stands apart from the others.
#[inline(always)]
fn projector<R: Real>([a11, a22, a33, a12, a13, a23]: [R; 6], eigenvalue: R) -> [R; 6] {
    let (s11, s22, s33) = (a11 - eigenvalue, a22 - eigenvalue, a33 - eigenvalue);
    let minor11 = s22.mul_add(s33, -(a23 * a23));
    let minor22 = s11.mul_add(s33, -(a13 * a13));
    let minor33 = s11.mul_add(s22, -(a12 * a12));
    // At least ½ where there are both signs. Where all are negative it may be anything, and is bounded so that what is
    // added to A stays smaller than A.
    let inverse = R::splat(1.0) / (minor11 + minor22 + minor33).max(R::splat(0.125));
    [
        minor11 * inverse,
        minor22 * inverse,
        minor33 * inverse,
        a13.mul_add(a23, -(a12 * s33)) * inverse,
        a12.mul_add(a23, -(a13 * s22)) * inverse,
        a12.mul_add(a13, -(a23 * s11)) * inverse,
    ]
}

/// Whether every eigenvalue is positive whatever rounding did: LDLᵀ of A − 64 u I has positive pivots.
///
/// The computed factors of that matrix are exact for one that differs by a few u times its entries, which are below
/// 4 here; the shift outweighs it [Rump 2006, *Verification of positive definiteness*].
#[inline(always)]
fn surely_definite<R: Real>(A: [R; 6]) -> R::Mask {
    let zero = R::splat(0.0);
    let shift = R::splat(64.0 * R::UNIT_ROUNDOFF);
    let [a11, a22, a33, a12, a13, a23] = A;
    let d1 = a11 - shift;
    let (l21, l31) = (a12 / d1, a13 / d1);
    let d2 = (a22 - shift) - l21 * a12;
    let c32 = a23 - l31 * a12;
    let d3 = ((a33 - shift) - l31 * a13) - c32 / d2 * c32;
    zero.less(d1) & zero.less(d2) & zero.less(d3)
}
