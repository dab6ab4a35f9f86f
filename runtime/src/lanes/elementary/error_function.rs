//! erf x = 2/√π ∫ e^(−t²) dt from 0 to x.
//!
//! For |x| < 1 it is x + x g(x²), where |g| is 0.157 at most and takes few digits. Beyond, it is
//! 1 − erfc |x|, and erfc x = e^(−x²) X(x), also 0.157 at most.

use super::arithmetic::polynomial;
use crate::lanes::complement::scaled_complement;
use crate::lanes::primitive::Primitive;

/// erf x/x − 1 as a polynomial in z = x² ≤ 1.
///
/// Its error is below 2⁻⁵⁵ (`f32`: 2⁻²⁹).
#[inline(always)]
fn error_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 7] = [
        0.128_379_17,
        -0.376_126_3,
        0.112_836_18,
        -0.026_855_126,
        0.005_190_733_4,
        -0.000_803_075,
        0.000_079_203_033,
    ];
    const DOUBLE: [f64; 12] = [
        0.128_379_167_095_512_56,
        -0.376_126_389_031_833_4,
        0.112_837_916_709_365_35,
        -0.026_866_170_641_868_095,
        0.005_223_977_595_822_727,
        -0.000_854_832_543_478_992,
        0.000_120_552_788_407_861_27,
        -0.000_014_924_431_477_340_266,
        1.644_370_617_187_360_6e-6,
        -1.618_045_102_412_307_8e-7,
        1.360_093_014_179_662e-8,
        -7.577_729_148_935_165e-10,
    ];
    polynomial(z, &SINGLE, &DOUBLE)
}

/// erf x.
#[inline(always)]
pub(in super::super) fn erf<P: Primitive>(x: P) -> P {
    let one = P::splat(1.0);
    // From 6 on the result rounds to 1. NaN passes through.
    let a = P::splat(6.0).min(x.abs());
    let square = a * a;
    let inner = a.mul_add(error_tail(square), a);
    let outer = one - (-square).exp() * scaled_complement(a);
    P::select(one.less(a), outer, inner).copysign(x)
}
