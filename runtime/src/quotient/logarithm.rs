//! Divided differences of functions that are logarithms: a difference of logarithms is one logarithm of a
//! quotient, ln(1 + y), with a y that has the gap as a factor.

use super::cardinal::{exp_m1c, ln_1pc};
use crate::lanes::{Mask, Real};

/// Bound below which y may be multiplied by a number of the order of 1. Above, logarithms differ by 80 at
/// least, and their difference loses nothing.
#[inline(always)]
fn largest_ratio<R: Real>() -> R {
    R::splat(0.001 / R::min_positive())
}

/// (ln(1 + a) − ln(1 + b))/(a − b) = ln(1 + y)/y / (1 + b) for y = (a − b)/(1 + b) and a ≥ b.
///
/// From the smaller one, so that y ≥ 0 and its error is not magnified.
#[inline(always)]
pub fn ln_1p_quotient<R: Real>(a: R, b: R) -> R {
    let one = R::splat(1.0);
    let smaller = a.min(b);
    let reciprocal = one / (one + smaller);
    let y = (a - b).abs() * reciprocal;
    let close = ln_1pc(y) * reciprocal;
    let is_close = (-one).less(smaller) & y.less(largest_ratio());
    if !(!is_close).any() {
        return close;
    }
    // Also NaN outside of the domain.
    R::select(is_close, close, (a.ln_1p() - b.ln_1p()) / (a - b))
}

/// (asinh a − asinh b)/(a − b), for a ≥ b ≥ 0 with A = √(1 + a²) and B = √(1 + b²)
///
/// ```text
/// asinh a − asinh b = ln((a + A)/(b + B)) = ln(1 + y)
/// y = (a − b + A − B)/(b + B) = (a − b) (1 + (a + b)/(A + B))/(b + B)
/// ```
///
/// Numbers of opposite signs have asinh of opposite signs: then the plain quotient is accurate.
#[inline(always)]
pub fn asinh_quotient<R: Real>(a: R, b: R) -> R {
    let (zero, half, one) = (R::splat(0.0), R::splat(0.5), R::splat(1.0));
    let (larger, smaller) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
    let root = |x: R| {
        // 1 is below the last bit of the large ones, whose squares may overflow.
        let is_large = R::splat(1.0 / R::unit_roundoff()).less(x);
        R::select(is_large, x, x.mul_add(x, one).sqrt())
    };
    let (larger_root, smaller_root) = (root(larger), root(smaller));
    let share = larger.mul_add(half, half * smaller) / larger_root.mul_add(half, half * smaller_root);
    let slope = (one + share) / (smaller + smaller_root);
    let y = (a - b).abs() * slope;
    let close = ln_1pc(y) * slope;

    let is_opposite = a.min(b).less(zero) & zero.less(a.max(b));
    let is_close = !is_opposite & y.less(largest_ratio());
    if !(!is_close).any() {
        return close;
    }
    // The gap of the largest numbers overflows, unless it is halved; the smallest have no half.
    let scale = R::select(one.less(larger), half, one);
    let apart = (a.asinh() * scale - b.asinh() * scale) / (a * scale - b * scale);
    R::select(is_close, close, apart)
}

/// (s(a) − s(b))/(a − b) for s = softplus, whose derivative is the sigmoid σ.
///
/// With a ≥ b and d = a − b, in which ln(1 + y) is ±(s(a) − s(b)):
///
/// | for | formula |
/// |---|---|
/// | a < 0 | y = (e⁻ᵈ − 1) σ(a) ≥ −½ |
/// | a ≥ 0, d < 32 | y = (eᵈ − 1) σ(b) |
/// | a ≥ 0, d ≥ 32 | difference of max(x, 0), and that of the rest, which is 2 % of d at most |
///
/// In the first two ln(1 + y)/d is ln(1 + y)/y · (e^±d − 1)/(±d) · σ.
#[inline(always)]
pub fn softplus_quotient<R: Real>(a: R, b: R) -> R {
    let zero = R::splat(0.0);
    let (larger, smaller) = (a.max(b), a.min(b));
    let gap = (a - b).abs();
    let is_negative = larger.less(zero);
    let exponent = R::select(is_negative, -gap, gap);
    let sigmoid = R::select(is_negative, larger, smaller).sigmoid();
    let slope = exp_m1c(exponent) * sigmoid;
    let close = ln_1pc(exponent * slope) * slope;
    let is_wide = !is_negative & !gap.less(R::splat(32.0));
    if !is_wide.any() {
        return close;
    }
    let rest = |x: R| (-x.abs()).softplus();
    // Halves, because the gap may overflow.
    let half = R::splat(0.5);
    let ramps = larger.max(zero) * half - smaller.max(zero) * half;
    let wide = (ramps + (rest(larger) - rest(smaller)) * half) / (larger * half - smaller * half);
    R::select(is_wide, wide, close)
}
