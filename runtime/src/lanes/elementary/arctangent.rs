//! atan x.
//!
//! With one of three centres c, atan |x| = atan c + atan t for t = (|x| − c)/(1 + c|x|), |t| ≤ tan π/8:
//!
//! | x below | c | atan c | t |
//! |---|---|---|---|
//! | √2 − 1 | 0 | 0 | x |
//! | √2 + 1 | 1 | π/4 | (x − 1)/(x + 1) |
//! | ∞ | ∞ | π/2 | −1/x |

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, SQRT_2};

use super::arithmetic::{below_the_last_bit, divide, polynomial, quick_two_sum, two_sum};
use crate::lanes::primitive::Primitive;

/// (atan t − t)/t³ as a polynomial in z = t², for |t| ≤ tan π/8.
///
/// z times its error is below 2⁻⁵⁹ (`f32`: 2⁻³⁰).
#[inline(always)]
fn arctangent_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 5] = [-0.333_333_16, 0.199_985_33, -0.142_445_1, 0.106_001_66, -0.060_927_12];
    const DOUBLE: [f64; 11] = [
        -0.333_333_333_333_332,
        0.199_999_999_999_538_2,
        -0.142_857_142_802_209_65,
        0.111_111_107_847_020_47,
        -0.090_908_977_936_224_86,
        0.076_920_608_498_143_7,
        -0.066_631_111_604_471_27,
        0.058_479_399_018_759_15,
        -0.050_395_263_360_540_04,
        0.038_070_011_583_716_756,
        -0.017_912_969_159_193_78,
    ];
    polynomial(z, &SINGLE, &DOUBLE)
}

/// atan x.
#[inline(always)]
pub(in super::super) fn atan<P: Primitive>(x: P) -> P {
    let (zero, one) = (P::splat(0.0), P::splat(1.0));
    // From 2⁶⁰ on the result is π/2, and products by x stay in range. NaN passes through.
    let a = P::splat(2f64.powi(60)).min(x.abs());
    let is_small = a.less(P::splat(SQRT_2 - 1.0));
    let is_large = P::splat(SQRT_2 + 1.0).less(a);
    let of_three =
        |small: P, middle: P, large: P| P::select(is_small, small, P::select(is_large, large, middle));

    let (above, above_low) = two_sum(a, one);
    let (below, below_low) = two_sum(a, -one);
    let numerator = (of_three(a, below, -one), of_three(zero, below_low, zero));
    let denominator = (of_three(one, above, a), of_three(zero, above_low, zero));
    let (t, t_low) = divide(numerator, denominator);

    let z = t * t;
    let centre = of_three(zero, P::splat(FRAC_PI_4), P::splat(FRAC_PI_2));
    let centre_low = of_three(
        zero,
        below_the_last_bit(FRAC_PI_4, 3.061_616_997_868_383e-17),
        below_the_last_bit(FRAC_PI_2, 6.123_233_995_736_766e-17),
    );
    let (sum, error) = quick_two_sum(centre, t);
    // d atan t/dt = 1/(1 + t²) is close enough to 1 − t².
    let low = t_low.mul_add(-z, t_low) + (centre_low + error);
    (sum + (t * z).mul_add(arctangent_tail(z), low)).copysign(x)
}
