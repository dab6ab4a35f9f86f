//! Filters that make a tangent positive semidefinite, exactly and eigenvalue by eigenvalue.
//!
//! In the basis of the diagonal entries and (ij ± ji)/√2 the tangent is diagonal except for one 3×3 block
//! (see [`tangent`](super::tangent)): its nine eigenvalues are the flips, the twists and those of the Hessian
//! ψij. Filtering them filters dP/dF, because the frames are orthogonal. Applied to an element, the filtered
//! dP/dF is pulled back: that is not the same as filtering the 12×12 stiffness, which some codes do, unless
//! the element is regular.
//!
//! What floating point does here. A filtered eigenvalue is zero up to u ‖dP/dF‖ of either sign; where nothing
//! is negative beyond doubt, the block comes back bit for bit.
//!
//! # The 3×3 block in closed form
//!
//! Let A be symmetric with eigenvalues of both signs, f the filter, |·| the spectral norm. Of the three
//! eigenvalues the middle one is closer to one end than to the other; call the end that stands apart ν. The
//! spread between the ends is at least |A|, or they would have the same sign, so that ν is |A|/2 or more away
//! from both others, wherever these are. From this follows that nothing below loses digits, and no case is
//! special: not two eigenvalues near zero, not two equal ones.
//!
//! **ν and its vector** p, with an orthonormal basis v, w of the plane normal to p, are split off in closed
//! form (`point/deflation.rs`); ν = pᵀA p.
//!
//! **The other two** are those of the 2×2 matrix M of A in that basis: m ± r, with m half its trace and r² =
//! −det of M − m I.
//!
//! **The filtered matrix** is f(ν) p pᵀ + (v w) f(M) (v w)ᵀ with
//!
//! ```text
//! f(M) = h I + k (M − m I),   h the mean of f(m ± r),   k = (f(m + r) − f(m − r))/2r.
//! ```
//!
//! |k| ≤ 1 because f is a contraction, however close the two are, and where M − m I is nothing but rounding, so is what a
//! wrong k does. Both parts are semidefinite, to a few u of their own size and not of that of A: where a
//! large negative eigenvalue is cut off, what is left is as clean as if it had never been there. The error of
//! the whole is below 16 u |A| in the tests, as a backward error of A.
//!
//! Where no eigenvalue is positive, nothing need be separated: the answer is zero or −A.
//!
//! \[CLLZJ24\] Chen, Liu, Levin, Zheng, Jacobson, *Stabler Neo-Hookean Simulation: Absolute Eigenvalue
//! Filtering for Projected Newton*, 2024.

#![expect(non_snake_case, reason = "A, L, Q as in linear algebra")]

use super::deflation::deflate;
use super::matrix::{dot, multiply_symmetric, three};
use crate::lanes::{Mask, Real, Truth, stage};
use crate::material::{Blocks, PAIRS};

/// Treatment of the negative eigenvalues of dP/dF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Filter {
    /// Leaves negative eigenvalues as they are: the exact derivative of the stress.
    #[default]
    None,
    /// Sets negative eigenvalues to zero: the nearest positive semidefinite matrix in the Frobenius norm, the
    /// usual PSD projection.
    Clamp,
    /// Replaces negative eigenvalues by their absolute values \[CLLZJ24\]: directions of negative curvature
    /// are stiff instead of free.
    Absolute,
}

impl Filter {
    /// The slope of the filter as a function of negative eigenvalues; for positive ones it is 1.
    #[inline(always)]
    pub(super) fn slope<R: Real>(self) -> R {
        R::splat(match self {
            Self::None => 1.0,
            Self::Clamp => 0.0,
            Self::Absolute => -1.0,
        })
    }
}

/// An eigenvalue after a filter of this slope, which multiplies the negative ones.
#[inline(always)]
pub(super) fn filtered<R: Real>(eigenvalue: R, slope: R) -> R {
    // Not `max`, which would turn NaN into a plausible zero; and no zero is negative.
    let zero = R::splat(0.0);
    R::select(eigenvalue.less(zero), eigenvalue.mul_add(slope, zero), eigenvalue)
}

/// The filtered map, and true if an eigenvalue was negative by more than the rounding of the largest one.
#[inline(always)]
#[must_use]
pub fn project<R: Real>(blocks: &Blocks<R>, filter: Filter) -> (Blocks<R>, R::Mask) {
    if filter == Filter::None {
        return (*blocks, R::Mask::splat(false));
    }
    let slope = filter.slope();
    let Blocks { gradient, hessian, flip, twist } = *blocks;
    let (hessian, flip, twist, Truth(is_filtered)) =
        stage!(R, "filter", (hessian, flip, twist, slope) => all_filtered(hessian, flip, twist, slope));
    (Blocks { gradient, hessian, flip, twist }, is_filtered)
}

/// Hessian, flips and twists after a filter of this slope, and true if one was negative beyond roundings.
#[inline(always)]
fn all_filtered<R: Real>(
    hessian: [R; 6],
    mut flip: [R; 3],
    mut twist: [R; 3],
    slope: R,
) -> ([R; 6], [R; 3], [R; 3], Truth<R::Mask>) {
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
    let is_filtered = smallest.less(R::splat(-16.0 * R::unit_roundoff()) * largest);
    (hessian, flip, twist, Truth(is_filtered))
}

/// The filtered symmetric matrix, stored as 11, 22, 33, 12, 13, 23, and its smallest eigenvalue or, if it is
/// positive beyond doubt, zero.
#[inline(always)]
fn project_symmetric<R: Real>(A: [R; 6], slope: R) -> ([R; 6], R) {
    let [a11, a22, a33, a12, a13, a23] = A;
    let diagonal = a11.abs().max(a22.abs()).max(a33.abs());
    let largest = diagonal.max(a12.abs()).max(a13.abs()).max(a23.abs());
    let (scale, back) = largest.power_of_two_scale();
    let scaled = [a11 * scale, a22 * scale, a33 * scale, a12 * scale, a13 * scale, a23 * scale];

    // Both answers are defined for each number of a batch by itself; only the work for the second one is
    // skipped, and only if none needs it. So a number's result never depends on its neighbours.
    let definite = surely_definite(scaled);
    let zero = R::splat(0.0);
    if !(!definite).any() {
        return (A, zero);
    }
    let ([p11, p22, p33, p12, p13, p23], smallest) =
        stage!(R, "filtered_indefinite", (scaled, slope) => filtered_indefinite(scaled, slope));
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

/// The filtered matrix and its smallest eigenvalue before, by the formulas of the module's text, for a matrix
/// of magnitude 1 to 2 that is not positive definite.
#[inline(always)]
fn filtered_indefinite<R: Real>(A: [R; 6], slope: R) -> ([R; 6], R) {
    let (zero, half) = (R::splat(0.0), R::splat(0.5));
    let ([p, v, w], _) = deflate(A);
    let (Ap, Av, Aw) = (multiply_symmetric(A, p), multiply_symmetric(A, v), multiply_symmetric(A, w));
    let nu = dot(p, Ap);
    let (m11, m12, m22) = (dot(v, Av), dot(v, Aw), dot(w, Aw));
    let (m, d) = (half * (m11 + m22), half * (m11 - m22));
    // Compared with an eigenvalue that is cut off, the other two may be so small that their squares would
    // underflow.
    let (scale, back) = d.abs().max(m12.abs()).power_of_two_scale();
    let (scaled_d, scaled_m12) = (d * scale, m12 * scale);
    let r = scaled_d.mul_add(scaled_d, scaled_m12 * scaled_m12).sqrt() * back;
    let (larger, smaller) = (m + r, m - r);
    let (f_larger, f_smaller) = (filtered(larger, slope), filtered(smaller, slope));
    let h = half * (f_larger + f_smaller);
    // The difference is zero where r is.
    let k = (f_larger - f_smaller) / (r + r).max(R::splat(R::min_positive()));
    let (f11, f12, f22) = (k.mul_add(d, h), k * m12, h - k * d);

    let f_nu = filtered(nu, slope);
    let along_p = three!(i => f_nu * p[i]);
    let along_v = three!(i => f11.mul_add(v[i], f12 * w[i]));
    let along_w = three!(i => f12.mul_add(v[i], f22 * w[i]));
    let diagonal = three!(i => p[i].mul_add(along_p[i], v[i].mul_add(along_v[i], w[i] * along_w[i])));
    let mixed = three!(pair => {
        let (i, j) = PAIRS[pair];
        p[i].mul_add(along_p[j], v[i].mul_add(along_v[j], w[i] * along_w[j]))
    });
    let [f11, f22, f33, f12, f13, f23] =
        [diagonal[0], diagonal[1], diagonal[2], mixed[0], mixed[1], mixed[2]];
    let has_positive = zero.less(larger.max(nu));
    let [a11, a22, a33, a12, a13, a23] = A;
    let answer = [
        R::select(has_positive, f11, a11.mul_add(slope, zero)),
        R::select(has_positive, f22, a22.mul_add(slope, zero)),
        R::select(has_positive, f33, a33.mul_add(slope, zero)),
        R::select(has_positive, f12, a12.mul_add(slope, zero)),
        R::select(has_positive, f13, a13.mul_add(slope, zero)),
        R::select(has_positive, f23, a23.mul_add(slope, zero)),
    ];
    (answer, smaller.min(nu))
}

/// True if every eigenvalue is positive regardless of rounding: LDLᵀ of A − 64 u I has positive pivots.
///
/// The computed factors of that matrix are exact for one that differs by a few u times its entries, which are
/// below 4 here; the shift outweighs it [Rump 2006, *Verification of positive definiteness*].
#[inline(always)]
fn surely_definite<R: Real>(A: [R; 6]) -> R::Mask {
    let zero = R::splat(0.0);
    let shift = R::splat(64.0 * R::unit_roundoff());
    let [a11, a22, a33, a12, a13, a23] = A;
    let d1 = a11 - shift;
    let (l21, l31) = (a12 / d1, a13 / d1);
    let d2 = (a22 - shift) - l21 * a12;
    let c32 = a23 - l31 * a12;
    let d3 = ((a33 - shift) - l31 * a13) - c32 / d2 * c32;
    zero.less(d1) & zero.less(d2) & zero.less(d3)
}
