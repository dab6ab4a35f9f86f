//! Divided differences φ[a, b] = (φ(a) − φ(b)) / (a − b) that never subtract close values, and other
//! functions that generated materials call.
//!
//! Each is accurate to a few u for every gap a − b, zero included. A function that switches between two
//! formulas does so at a point near which both are accurate, and neither is a limit. The formula that is not
//! selected may give NaN.

mod cardinal;
mod error_function;
mod exponential;
mod logarithm;
mod trigonometric;
mod whole_power;

pub use error_function::erf_quotient;
pub use exponential::{cosh_quotient, exp_m1_quotient, sigmoid_quotient, sinh_quotient, tanh_quotient};
pub use logarithm::{asinh_quotient, ln_1p_quotient, softplus_quotient};
pub use trigonometric::{atan_quotient, cos_quotient, sin_quotient};
pub use whole_power::{whole_power, whole_power_quotient};

use crate::lanes::{Mask, Real, stage};

/// Two arguments a, b > 0, with the part that the divided differences of ln and of all powers share.
#[derive(Clone, Copy, Debug)]
pub struct Pair<R> {
    difference: R,
    /// 1/(a − b): infinite for a = b, and unused if the two are close.
    reciprocal_difference: R,
    ln_quotient: R,
}

impl<R: Real> Pair<R> {
    /// Prepares the pair (a, b) from both numbers, their reciprocals and their logarithms.
    ///
    /// With q = (a − b)²/4ab, |ln(a/b)| = 2 arsinh √q, and ½ (1/a + 1/b) = √(q (1 + q)) 2/|a − b|. So
    ///
    /// ```text
    /// ln[a, b] = ½ (1/a + 1/b) arsinh √q / √(q (1 + q))
    ///          = ½ (1/a + 1/b) (1 − 2/3 q + 8/15 q² − 16/35 q³ + 128/315 q⁴ − …)
    /// ```
    ///
    /// for q < 2⁻¹⁴, where q⁴ is below u/8 (in `f32` q² is below u/16), else (ln a − ln b)/(a − b). There
    /// |ln(a/b)| is 2⁻⁶ at least. The logarithm of 2ᵉ m is e ln 2 + ln m: the error of ln m is 2⁻¹⁰ u, that
    /// of e ln 2, which cancels, is less, and so their difference is known to u/4, even for numbers at the
    /// ends of the range.
    #[inline(always)]
    pub fn new(
        [a, b]: [R; 2],
        [a_reciprocal, b_reciprocal]: [R; 2],
        [a_logarithm, b_logarithm]: [R::Logarithm; 2],
    ) -> Self {
        let half = R::splat(0.5);
        let difference = a - b;
        let half_difference = half * difference;
        let q = (half_difference * a_reciprocal) * (half_difference * b_reciprocal);
        let mut series = R::splat(-2.0 / 3.0);
        if is_double::<R>() {
            series = R::splat(-16.0 / 35.0).mul_add(q, R::splat(8.0 / 15.0)).mul_add(q, series);
        }
        let mean = a_reciprocal.mul_add(half, half * b_reciprocal);
        let close = (mean * q).mul_add(series, mean);
        let reciprocal_difference = R::splat(1.0) / difference;
        let apart = R::logarithm_of_ratio(a_logarithm, b_logarithm) * reciprocal_difference;
        let is_close = q.less(R::splat(1.0 / 16384.0));
        Self { difference, reciprocal_difference, ln_quotient: R::select(is_close, close, apart) }
    }

    /// Prepares the pair (a, b) from both numbers alone, for callers with no other use of the logarithms.
    #[inline(always)]
    pub fn of(a: R, b: R) -> Self {
        let one = R::splat(1.0);
        Self::new([a, b], [one / a, one / b], [a.logarithm(), b.logarithm()])
    }

    /// ln\[a, b\] = (ln a − ln b)/(a − b).
    #[inline(always)]
    pub fn ln_quotient(self) -> R {
        self.ln_quotient
    }

    /// (aʳ − bʳ)/(a − b) from both powers and the exponent r.
    ///
    /// With v = ½ r ln(a/b), aʳ − bʳ = (aʳ + bʳ) tanh v. So the quotient is ½ (aʳ + bʳ) tanh v / v · r ln[a,
    /// b] for |v| < ½, else the plain one, which then loses less than two bits.
    #[inline(always)]
    pub fn power_quotient(self, [a_power, b_power]: [R; 2], exponent: R) -> R {
        let half_slope = R::splat(0.5) * exponent * self.ln_quotient;
        let v = half_slope * self.difference;
        let apart = (a_power - b_power) * self.reciprocal_difference;
        difference_of_exponentials([a_power, b_power], v, half_slope, apart)
    }
}

/// (eᵃ − eᵇ)/(a − b) from both arguments, each with its exponential.
///
/// With v = ½ (a − b) the quotient is ½ (eᵃ + eᵇ) tanh v / v for |v| < ½, else the plain one, which loses
/// less than two bits.
#[inline(always)]
pub fn exp_quotient<R: Real>([a, a_exponential]: [R; 2], [b, b_exponential]: [R; 2]) -> R {
    let half = R::splat(0.5);
    let difference = a - b;
    let apart = (a_exponential - b_exponential) / difference;
    difference_of_exponentials([a_exponential, b_exponential], difference * half, half, apart)
}

/// (A + B) tanh v / v · factor for |v| < ½, which is (A − B)/v · factor for A = B e^2v, else `apart`.
///
/// A factor + B factor, not (A + B) factor: the sum of A and B may overflow.
#[inline(always)]
fn difference_of_exponentials<R: Real>([a, b]: [R; 2], v: R, factor: R, apart: R) -> R {
    stage!(R, "difference_of_exponentials", (a, b, v, factor, apart) => {
        let v2 = v * v;
        let factor = tanhc(v2) * factor;
        let close = a.mul_add(factor, b * factor);
        R::select(v2.less(R::splat(0.25)), close, apart)
    })
}

/// tanh v / v from v² ≤ ¼, to u/16.
///
/// 1 − ⅓ v² + 2/15 v⁴ − …: the leading 1 stays exact, the other coefficients are minimax fits.
#[inline(always)]
fn tanhc<R: Real>(v2: R) -> R {
    const SINGLE: [f64; 5] = [
        -0.333_333_268_213_080_2,
        0.133_329_615_031_175_7,
        -0.053_898_811_012_489_14,
        0.021_295_962_766_492_595,
        -0.006_643_796_970_811_979,
    ];
    const DOUBLE: [f64; 10] = [
        -0.333_333_333_333_331_6,
        0.133_333_333_332_997_74,
        -0.053_968_253_945_587_41,
        0.021_869_487_776_679_85,
        -0.008_863_220_870_313_594,
        0.003_591_952_350_533_173_8,
        -0.001_454_480_164_344_707_2,
        0.000_583_268_645_411_824_1,
        -0.000_217_766_955_369_094_27,
        0.000_056_746_229_574_816_62,
    ];
    let coefficients: &[f64] = if is_double::<R>() { &DOUBLE } else { &SINGLE };
    let mut sum = R::splat(coefficients[coefficients.len() - 1]);
    for k in (0..coefficients.len() - 1).rev() {
        sum = sum.mul_add(v2, R::splat(coefficients[k]));
    }
    sum.mul_add(v2, R::splat(1.0))
}

/// True if a series needs more than the 24 bits of `f32`.
fn is_double<R: Real>() -> bool {
    R::unit_roundoff() < 1e-10
}

/// ln(λ1 λ2 λ3) for λ1 ≥ λ2 ≥ λ3 > 0, even if the product is out of range.
///
/// The logarithm of the product keeps its digits if the stretches nearly cancel; a sum of logarithms would
/// not. If the product or a part of it overflows or loses digits to underflow, the logarithms are added
/// instead.
#[inline(always)]
pub fn ln_product<R: Real>(stretches: [R; 3]) -> R {
    stage!(R, "ln_product", (stretches) => ln_of_product(stretches))
}

#[inline(always)]
fn ln_of_product<R: Real>([l1, l2, l3]: [R; 3]) -> R {
    let extremes = l1 * l3;
    let product = extremes * l2;
    let smallest = R::splat(R::min_positive());
    let in_range = smallest.less(extremes) & smallest.less(product) & product.is_finite();
    let ln = product.ln();
    // The sum is computed only if a lane needs it, and only that lane takes it.
    if !(!in_range).any() {
        return ln;
    }
    R::select(in_range, ln, (l1.ln() + l3.ln()) + l2.ln())
}

/// The base of a real power that vanishes only at rest, kept from zero: at least the smallest positive number
/// over u², so that its reciprocal leaves room for other factors.
///
/// So 0^(n − 2) 0 is 0 and not NaN, as the stiffness of (I1b − 3)ⁿ at rest is for n > 1. A negative base,
/// which no sum of squares has, is NaN.
#[inline(always)]
pub fn above_zero<R: Real>(base: R) -> R {
    R::select(
        base.less(R::splat(0.0)),
        R::splat(f64::NAN),
        base.max(R::splat(R::min_positive() / (R::unit_roundoff() * R::unit_roundoff()))),
    )
}

/// The fraction of the interval from a to b that lies above ε. For a = b it is 1 if a ≥ ε, else 0.
///
/// Only the arguments themselves are subtracted, so that every digit is kept.
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

/// The bound below which λi + λj is rounding noise: 2u λ1 for the largest stretch λ1, and never zero.
///
/// A backward-stable singular value decomposition gives each stretch to a few u λ1 and no better. The
/// absolute part keeps a quotient by λi + λj finite if all stretches vanish.
#[inline(always)]
pub fn pole_floor<R: Real>(stretches: [R; 3]) -> R {
    (R::splat(2.0 * R::unit_roundoff()) * stretches[0].abs()).max(R::splat(R::min_positive().sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ln[b (1 + t), b], with the error of ln_1p only, half a unit.
    fn exact_ln_quotient(b: f64, t: f64) -> f64 {
        if t == 0.0 { 1.0 / b } else { t.ln_1p() / (t * b) }
    }

    /// The worst relative error, in units of u, over gaps t for which b (1 + t) is exact: powers of two, and
    /// some near each switch between formulas.
    ///
    /// Some bases b have large logarithms, which cancel except for their difference.
    fn worst(error: impl Fn(f64, f64) -> f64) -> f64 {
        let bases = [1.0, 1.5, 3.0 / 1024.0, 1.5 * 2f64.powi(332), 1.25 * 2f64.powi(-332)];
        let gaps = (0..50).map(|k| 2f64.powi(-k)).chain([0.0]).chain((1..20).map(|k| 2f64.powi(k)));
        let beside = (-32..32).flat_map(|k| [1.0 / 64.0, 0.25].map(|t| t * (1.0 + f64::from(k) / 64.0)));
        gaps.chain(beside).flat_map(|t| bases.map(|b| (b, t))).map(|(b, t)| error(b, t)).fold(0.0, f64::max)
    }

    #[test]
    fn ln_quotient_keeps_its_digits_at_every_gap() {
        let worst = worst(|b, t| {
            let exact = exact_ln_quotient(b, t);
            (Pair::of(b * (1.0 + t), b).ln_quotient() - exact).abs() / exact / f64::UNIT_ROUNDOFF
        });
        // Four roundings in either formula and those of the reference, ½ to 1 each.
        assert!(worst <= 5.0, "{worst} u");
    }

    #[test]
    fn power_quotient_keeps_its_digits_at_every_gap() {
        for r in [0.3, 4.7, -3.3, 12.6, 1.0, -2.0, 400.0] {
            let worst = worst(|b: f64, t: f64| {
                let a = b * (1.0 + t);
                // (aʳ − bʳ)/(a − b) = bʳ/b (e^(r ln(1+t)) − 1)/t
                let scaled = if t == 0.0 { r } else { (r * t.ln_1p()).exp_m1() / t };
                let exact = b.powf(r) / b * scaled;
                let powers = [a, b].map(|x| x.powf(r));
                if !powers.iter().chain([&exact]).all(|x| x.is_normal()) {
                    return 0.0;
                }
                let value = Pair::of(a, b).power_quotient(powers, r);
                // The reference itself errs by u times its exponent.
                (value - exact).abs() / exact.abs() / f64::UNIT_ROUNDOFF / (1.0 + (r * t.ln_1p()).abs())
            });
            assert!(worst <= 12.0, "exponent {r}: {worst} u");
        }
    }

    /// The reference is `f64`, with 29 additional bits.
    #[test]
    fn single_precision_keeps_its_digits_at_every_gap() {
        let u = f32::UNIT_ROUNDOFF;
        let worst_of = |quotient: &dyn Fn(f32, f32) -> f32, exact: &dyn Fn(f64, f64) -> f64| {
            let gaps = (0..23).map(|k| 2f32.powi(-k)).chain([0.0, 3.0, 30.0]);
            let beside = (-32..32).flat_map(|k| [1.0 / 64.0, 0.25].map(|t| t * (1.0 + k as f32 / 64.0)));
            let mut worst: f64 = 0.0;
            for t in gaps.chain(beside) {
                for b in [1.0f32, 1.5, 3.0 / 1024.0, 1.5e5, 1e-5] {
                    let a = b * (1.0 + t);
                    let exact = exact(f64::from(a), f64::from(b));
                    worst = worst.max((f64::from(quotient(a, b)) - exact).abs() / exact.abs() / u);
                }
            }
            worst
        };
        let worst = worst_of(&|a, b| Pair::of(a, b).ln_quotient(), &|a, b| Pair::of(a, b).ln_quotient());
        assert!(worst <= 3.0, "ln: {worst} u");
        for r in [0.5f32, 4.75, -3.25] {
            let worst =
                worst_of(&|a, b| Pair::of(a, b).power_quotient([a, b].map(|x| x.powf(r)), r), &|a, b| {
                    let r = f64::from(r);
                    Pair::of(a, b).power_quotient([a, b].map(|x| x.powf(r)), r)
                });
            // Each power is right to one u, and all but the fraction 0.63 may cancel in the plain quotient.
            assert!(worst <= 8.0, "exponent {r}: {worst} u");
        }
    }

    #[test]
    fn exp_quotient_keeps_its_digits_at_every_gap() {
        let worst = worst(|b, t| {
            if b * t > 50.0 {
                return 0.0;
            }
            let exact = b.exp() * if t == 0.0 { 1.0 } else { (b * t).exp_m1() / (b * t) };
            let a = b * (1.0 + t);
            let value = exp_quotient([a, a.exp()], [b, b.exp()]);
            (value - exact).abs() / exact / f64::UNIT_ROUNDOFF / (1.0 + b * t)
        });
        assert!(worst <= 8.0, "{worst} u");
    }

    type Quotient = fn(f64, f64) -> f64;

    /// Divided differences, with their values at 0.
    const AT_ZERO: [(Quotient, f64); 12] = [
        (exp_m1_quotient, 1.0),
        (ln_1p_quotient, 1.0),
        (sinh_quotient, 1.0),
        (cosh_quotient, 0.0),
        (tanh_quotient, 1.0),
        (asinh_quotient, 1.0),
        (sin_quotient, 1.0),
        (cos_quotient, 0.0),
        (atan_quotient, 1.0),
        (erf_quotient, std::f64::consts::FRAC_2_SQRT_PI),
        (softplus_quotient, 0.5),
        (sigmoid_quotient, 0.25),
    ];

    #[test]
    fn quotients_of_functions_have_their_limits_at_zero() {
        for (k, (quotient, limit)) in AT_ZERO.into_iter().enumerate() {
            for tiny in [0.0, 5e-324, 1e-310, 1e-290] {
                for (a, b) in [(tiny, tiny), (tiny, 0.0), (tiny, -tiny), (-tiny, -tiny)] {
                    let found = quotient(a, b);
                    let error = (found - limit).abs();
                    assert!(
                        error <= 4.0 * f64::UNIT_ROUNDOFF * limit + 2.0 * tiny,
                        "{k}: {found} at {a:e}, {b:e}"
                    );
                }
            }
        }
    }

    #[test]
    fn quotients_of_functions_are_symmetric_and_pass_nan_on() {
        let arguments = [-30.0, -2.5, -0.9, -0.3, -1e-9, 0.0, 1e-9, 0.3, 0.300_001, 1.0, 2.5, 7.0, 80.0];
        for (k, (quotient, _)) in AT_ZERO.into_iter().enumerate() {
            for a in arguments {
                for b in arguments {
                    let (found, swapped) = (quotient(a, b), quotient(b, a));
                    let same = found == swapped || found.is_nan() && swapped.is_nan();
                    assert!(same, "{k}: {found} and {swapped} at {a}, {b}");
                }
                assert!(quotient(a, f64::NAN).is_nan() && quotient(f64::NAN, a).is_nan(), "{k} at {a}");
            }
            assert!(quotient(f64::NAN, f64::NAN).is_nan(), "{k}");
        }
        // Outside of the domain, also where the quotient of two such numbers would have a value.
        assert!(ln_1p_quotient(-2.0f64, -3.0).is_nan() && ln_1p_quotient(0.5f64, -3.0).is_nan());
        assert_eq!(ln_1p_quotient(0.5, -1.0), f64::INFINITY);
    }

    #[test]
    fn quotients_of_functions_out_of_range_are_finite() {
        let check = |found: f64, expected: f64| {
            // Exponentials of 700 and more err by as many units.
            assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found:e} for {expected:e}");
        };
        // e^715/(2·715), in factors.
        let extreme = 357.5f64.exp() / 1430.0 * 357.5f64.exp();
        check(sinh_quotient(715.0, -715.0), extreme);
        check(cosh_quotient(715.0, 0.0), extreme);
        check(exp_m1_quotient(715.0, 0.0), 2.0 * extreme);
        let largest = f64::MAX;
        check(asinh_quotient(largest, -largest), (largest.ln() + std::f64::consts::LN_2) / largest);
        check(asinh_quotient(largest, 0.0), (largest.ln() + std::f64::consts::LN_2) / largest);
        check(ln_1p_quotient(1e300, f64::EPSILON - 1.0), (1e300f64.ln() - f64::EPSILON.ln()) / 1e300);
        check(softplus_quotient(largest, -largest), 0.5);
        check(atan_quotient(4e150, 1e150), 0.25e-300);
        check(atan_quotient(1e200, 1e-100), std::f64::consts::FRAC_PI_2 / 1e200);
        check(softplus_quotient(-30.0, -700.0), (-30f64).exp().ln_1p() / 670.0);
        check(softplus_quotient(1e6 + 40.0, 1e6), 1.0);
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
