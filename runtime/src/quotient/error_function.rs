//! The divided difference of erf: the mean of 2/√π e^(−x²) between two points.

use std::f64::consts::FRAC_2_SQRT_PI;

use crate::lanes::{Mask, Real, scaled_complement};

/// (erf a − erf b)/(a − b).
///
/// A series where |a − b| < 1 and |a² − b²| < 1. Elsewhere nothing cancels in the plain quotient of numbers
/// of opposite signs. Otherwise a ≥ b ≥ 0 by symmetry, and with erfc x = e^(−x²) X(x)
///
/// ```text
/// erf a − erf b = erfc b − erfc a = e^(−b²) (X(b) − e^(−(a² − b²)) X(a))
/// ```
///
/// where the second term is less than 0.37 of the first.
#[inline(always)]
pub fn erf_quotient<R: Real>(a: R, b: R) -> R {
    let (zero, half, one) = (R::splat(0.0), R::splat(0.5), R::splat(1.0));
    let (gap, sum) = ((a - b).abs(), (a + b).abs());
    let difference_of_squares = gap * sum;
    let is_close = difference_of_squares.less(one) & gap.less(one);
    let close = mean_around_middle(sum * half, gap * half);
    if !(!is_close).any() {
        return close;
    }
    let (larger, smaller) = (a.abs().max(b.abs()), a.abs().min(b.abs()));
    let tail = (-difference_of_squares).exp() * scaled_complement(larger);
    let beyond = (-smaller * smaller).exp() * (scaled_complement(smaller) - tail) / gap;
    let is_opposite = a.min(b).less(zero) & zero.less(a.max(b));
    let apart = R::select(is_opposite, (a.erf() - b.erf()) / (a - b), beyond);
    R::select(is_close, close, apart)
}

/// The mean of 2/√π e^(−x²) over m − h … m + h, for m ≥ 0, 0 ≤ h < ½ and 4mh < 1.
///
/// e^(−(m + hs)²) = e^(−m²) Σ tₙ (−s)ⁿ with tₙ = hⁿ Hₙ(m)/n! from Hermite's polynomials, of which the mean
/// over −1 < s < 1 keeps t₂ₖ/(2k + 1). Their recurrence is n tₙ = 2mh tₙ₋₁ − 2h² tₙ₋₂. With 2mh and 2h² below
/// ½ the terms fall fast: what is left out is below u/16.
#[inline(always)]
fn mean_around_middle<R: Real>(m: R, h: R) -> R {
    let order = if R::unit_roundoff() < 1e-10 { 22 } else { 12 };
    let two_h = h + h;
    let (slope, curvature) = (m * two_h, -(h * two_h));
    let (mut before, mut term) = (R::splat(1.0), slope);
    let mut sum = R::splat(0.0);
    for n in 2..=order {
        let next = slope.mul_add(term, curvature * before) * R::splat(1.0 / f64::from(n));
        (before, term) = (term, next);
        if n % 2 == 0 {
            sum = term.mul_add(R::splat(1.0 / f64::from(n + 1)), sum);
        }
    }
    let exponential = (-m * m).exp() * R::splat(FRAC_2_SQRT_PI);
    exponential.mul_add(sum, exponential)
}
