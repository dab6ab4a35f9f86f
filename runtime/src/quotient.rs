//! Divided differences φ[a, b] = (φ(a) − φ(b)) / (a − b) that never subtract close values, and what else generated
//! materials need beyond the operations of a real number.
//!
//! Generated materials call these. Each is accurate to a few u for every gap a − b, zero included: where a kernel
//! switches between two formulas, both are accurate on both sides of the switch, and neither is a limit. What a
//! switch discards may be NaN; it is never looked at.

use crate::lanes::{Mask, Real};

/// (ln a − ln b)/(a − b) for a, b > 0.
///
/// With w = (a − b)/(a + b), ln(a/b) = 2 artanh w: the series 2/(a + b) (1 + w²/3 + w⁴/5 + …) for w² < 1/16, where its
/// tail is below u, else the logarithm of the quotient, which is at least ½ in magnitude and so keeps its relative
/// accuracy.
#[inline(always)]
pub fn ln_quotient<R: Real>(a: R, b: R) -> R {
    // w^2k/(2k + 1) < u/2 from k = 13 on: 16⁻¹³ < 2⁻⁵².
    const TERMS: u32 = 13;
    let one = R::splat(1.0);
    let reciprocal = one / (a + b);
    let w = (a - b) * reciprocal;
    let w2 = w * w;
    let mut series = R::splat(1.0 / f64::from(2 * TERMS + 1));
    for k in (0..TERMS).rev() {
        series = series.mul_add(w2, R::splat(1.0 / f64::from(2 * k + 1)));
    }
    let close = series * (reciprocal + reciprocal);
    let apart = (a / b).ln() / (a - b);
    R::select(w2.less(R::splat(1.0 / 16.0)), close, apart)
}

/// (eᵃ − eᵇ)/(a − b).
///
/// e^((a+b)/2) sinhc((a − b)/2) for |a − b| < 1, else the plain quotient, which loses less than two bits and cannot
/// overflow where the result does not.
#[inline(always)]
pub fn exp_quotient<R: Real>(a: R, b: R) -> R {
    let half = R::splat(0.5);
    let v = (a - b) * half;
    // Halves first: a + b may overflow where neither does.
    let close = a.mul_add(half, b * half).exp() * sinhc(v);
    let apart = (a.exp() - b.exp()) / (a - b);
    R::select(v.abs().less(half), close, apart)
}

/// (aʳ − bʳ)/(a − b) for a, b > 0, from each base with its power, the exponent and [`ln_quotient`] of the bases.
///
/// With v = ½ r ln(a/b) it is √(aʳ) √(bʳ) sinhc(v) r ln[a, b] for |v| < ½, else the plain quotient, whose numerator then
/// loses less than two bits.
#[inline(always)]
pub fn power_quotient<R: Real>([a, a_power]: [R; 2], [b, b_power]: [R; 2], exponent: R, ln_quotient: R) -> R {
    let slope = exponent * ln_quotient;
    let v = slope * (a - b) * R::splat(0.5);
    let close = a_power.sqrt() * b_power.sqrt() * sinhc(v) * slope;
    let apart = (a_power - b_power) / (a - b);
    R::select(v.abs().less(R::splat(0.5)), close, apart)
}

/// sinh v / v for |v| ≤ ½: Σ v²ᵏ/(2k + 1)!, whose tail is below u after seven terms.
#[inline(always)]
fn sinhc<R: Real>(v: R) -> R {
    const INVERSE_FACTORIALS: [f64; 8] = [
        1.0,
        1.0 / 6.0,
        1.0 / 120.0,
        1.0 / 5040.0,
        1.0 / 362_880.0,
        1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
        1.0 / 1_307_674_368_000.0,
    ];
    let v2 = v * v;
    INVERSE_FACTORIALS.into_iter().rev().fold(R::splat(0.0), |sum, c| sum.mul_add(v2, R::splat(c)))
}

/// ln(λ1 λ2 λ3) for λ1 ≥ λ2 ≥ λ3 > 0, also where the product is out of range.
///
/// The logarithm of the product, in which stretches near one cancel exactly as far as they do; where the product or a part
/// of it overflows or loses digits to underflow, the sum of logarithms.
#[inline(always)]
pub fn ln_product<R: Real>([l1, l2, l3]: [R; 3]) -> R {
    let extremes = l1 * l3;
    let product = extremes * l2;
    let smallest = R::splat(R::MIN_POSITIVE);
    let in_range = smallest.less(extremes) & smallest.less(product) & product.is_finite();
    let ln = product.ln();
    // The sum is only computed if one of the numbers in R needs it, and only that one takes it.
    if !(!in_range).any() {
        return ln;
    }
    R::select(in_range, ln, (l1.ln() + l3.ln()) + l2.ln())
}

/// The fraction of the interval from a to b that lies above ε; a point counts as above from ε on.
///
/// Differences of the arguments themselves, so every digit is kept.
#[inline(always)]
pub fn share_above<R: Real>(a: R, b: R, epsilon: R) -> R {
    let inside = (a.max(epsilon) - b.max(epsilon)) / (a - b);
    let zero_length = R::select(a.less(epsilon), R::splat(0.0), R::splat(1.0));
    R::select(R::splat(0.0).less((a - b).abs()), inside, zero_length)
}

/// The fraction of the interval from a to b that lies below ε: 1 − [`share_above`] without the subtraction.
#[inline(always)]
pub fn share_below<R: Real>(a: R, b: R, epsilon: R) -> R {
    let inside = (a.min(epsilon) - b.min(epsilon)) / (a - b);
    let zero_length = R::select(a.less(epsilon), R::splat(1.0), R::splat(0.0));
    R::select(R::splat(0.0).less((a - b).abs()), inside, zero_length)
}

/// Below this, λi + λj is rounding noise of stretches whose largest is λ1: 2u λ1, and never zero.
///
/// A backward-stable singular value decomposition knows each stretch to a few u λ1 and no better. The absolute part
/// keeps the quotient finite where all stretches vanish.
#[inline(always)]
pub fn pole_floor<R: Real>(stretches: [R; 3]) -> R {
    (R::splat(2.0 * R::UNIT_ROUNDOFF) * stretches[0].abs()).max(R::splat(R::MIN_POSITIVE.sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ln(a/b) for a = b (1 + t), as a double-double would give it: ln_1p has half a unit of error.
    fn exact_ln_quotient(b: f64, t: f64) -> f64 {
        if t == 0.0 { 1.0 / b } else { t.ln_1p() / (t * b) }
    }

    /// Worst relative error in units of u over all gaps, t a power of two so that b (1 + t) is exact.
    fn worst(error: impl Fn(f64, f64) -> f64) -> f64 {
        let gaps = (0..50).map(|k| 2f64.powi(-k)).chain([0.0]).chain((1..20).map(|k| 2f64.powi(k)));
        gaps.flat_map(|t| [1.0, 1.5, 3.0 / 1024.0].map(|b| (b, t)))
            .map(|(b, t)| error(b, t))
            .fold(0.0, f64::max)
    }

    #[test]
    fn ln_quotient_keeps_its_digits_at_every_gap() {
        let worst = worst(|b, t| {
            let exact = exact_ln_quotient(b, t);
            (ln_quotient(b * (1.0 + t), b) - exact).abs() / exact / f64::UNIT_ROUNDOFF
        });
        // Five roundings in either formula, the logarithm amplified by at most 2.
        assert!(worst <= 8.0, "{worst} u");
    }

    #[test]
    fn power_quotient_keeps_its_digits_at_every_gap() {
        for r in [0.3, 4.7, -3.3, 12.6, 1.0, -2.0] {
            let worst = worst(|b: f64, t: f64| {
                let a = b * (1.0 + t);
                // (aʳ − bʳ)/(a − b) = bʳ⁻¹ (e^(r ln(1+t)) − 1)/t
                let scaled = if t == 0.0 { r } else { (r * t.ln_1p()).exp_m1() / t };
                let exact = b.powf(r - 1.0) * scaled;
                let value = power_quotient([a, a.powf(r)], [b, b.powf(r)], r, ln_quotient(a, b));
                // The reference itself errs by u times its exponent.
                (value - exact).abs() / exact.abs() / f64::UNIT_ROUNDOFF / (1.0 + (r * t.ln_1p()).abs())
            });
            assert!(worst <= 16.0, "exponent {r}: {worst} u");
        }
    }

    #[test]
    fn exp_quotient_keeps_its_digits_at_every_gap() {
        let worst = worst(|b, t| {
            if b * t > 50.0 {
                return 0.0;
            }
            let exact = b.exp() * if t == 0.0 { 1.0 } else { (b * t).exp_m1() / (b * t) };
            let value = exp_quotient(b * (1.0 + t), b);
            (value - exact).abs() / exact / f64::UNIT_ROUNDOFF / (1.0 + b * t)
        });
        assert!(worst <= 8.0, "{worst} u");
    }

    #[test]
    fn the_logarithm_of_a_product_out_of_range_is_that_of_its_factors() {
        for ([a, b, c], expected) in [
            ([1e200, 1e180, 1e-300], 80.0 * std::f64::consts::LN_10),
            ([1e300, 1e10, 1e10], 320.0 * std::f64::consts::LN_10),
            ([1e-120, 1e-130, 1e-140], -390.0 * std::f64::consts::LN_10),
            ([1e160, 1e155, 1e-310], 5.0 * std::f64::consts::LN_10),
            ([2.0, 1.0, 0.5], 0.0),
        ] {
            let found: f64 = ln_product([a, b, c]);
            // Each logarithm is below 800 and rounded once.
            assert!((found - expected).abs() <= 800.0 * 4.0 * f64::UNIT_ROUNDOFF, "{found} for {expected}");
        }
        assert!(ln_product([1.0f64, 1.0, -1.0]).is_nan());
        assert_eq!(ln_product([1.0, 1.0, 0.0]), f64::NEG_INFINITY);
    }

    #[test]
    fn shares_are_exact_and_add_up() {
        let check = |a: f64, b: f64, above: f64| {
            assert_eq!(share_above(a, b, 0.5), above, "{a}, {b}");
            assert_eq!(share_below(a, b, 0.5), 1.0 - above, "{a}, {b}");
        };
        check(1.0, 0.75, 1.0);
        check(0.25, -1.0, 0.0);
        check(1.0, 0.0, 0.5);
        check(0.75, 0.25, 0.5);
        check(0.7, 0.7, 1.0);
        check(0.3, 0.3, 0.0);
        check(0.5, 0.5, 1.0);
    }
}
