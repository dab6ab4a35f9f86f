//! sin and cos.
//!
//! |x| = k π/2 + r with an integer k and |r| ≤ π/4, and k mod 4 selects one of ±sin r and ±cos r.
//!
//! π/2 is the sum of three parts so short that k times each is exact, and of a last one with all digits
//! \[CW80\]. What one product leaves may be as small as the next, hence differences with their errors. For
//! k ≤ 2²⁰, |x| ≤ 1.6·10⁶ (`f32`: k ≤ 2¹⁰, |x| ≤ 1600), r has more digits than the format, however close x
//! is to a multiple of π/2. Beyond, products are rounded, and the values are those at an argument within
//! 4u |x| of x, up to |x| = 2⁵⁰ (`f32`: 2²¹). Still larger numbers give some value between −1 and 1.

use super::arithmetic::{is_single, nearest_integer_to_product, polynomial, quick_two_sum, two_sum};
use crate::lanes::primitive::Primitive;

/// π/2 in parts of 33 bits (`f32`: 14), the last with all of its own.
const PARTS_OF_DOUBLE: [f64; 4] = [
    1.570_796_326_734_125_6,
    6.077_100_506_303_966e-11,
    2.022_266_248_711_166_5e-21,
    8.478_427_660_368_9e-32,
];
const PARTS_OF_SINGLE: [f64; 4] =
    [1.570_678_710_937_5, 0.000_117_614_865_303_039_55, 9.920_313_459_588_215e-10, 6.223_372_171_896_613e-14];

/// (sin r − r)/r³ as a polynomial in z = r², for r² ≤ (π/4)².
///
/// z times its error is below 2⁻⁵⁷ (`f32`: 2⁻²⁸) of sin r/r.
#[inline(always)]
fn sine_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 3] = [-0.166_666_55, 0.008_332_191, -0.000_195_186_05];
    const DOUBLE: [f64; 6] = [
        -0.166_666_666_666_666_32,
        0.008_333_333_333_322_48,
        -0.000_198_412_698_298_460_9,
        2.755_731_370_167_781_4e-6,
        -2.505_075_924_691_411_7e-8,
        1.589_684_365_900_167_3e-10,
    ];
    polynomial(z, &SINGLE, &DOUBLE)
}

/// (cos r − 1 + r²/2)/r⁴ as a polynomial in z = r², for r² ≤ (π/4)².
///
/// z² times its error is below 2⁻⁶⁴ (`f32`: 2⁻³³).
#[inline(always)]
fn cosine_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 3] = [0.041_666_646, -0.001_388_730_1, 0.000_024_430_661];
    const DOUBLE: [f64; 6] = [
        0.041_666_666_666_666_6,
        -0.001_388_888_888_887_446_7,
        0.000_024_801_587_289_664_2,
        -2.755_731_439_812_579_6e-7,
        2.087_572_879_507_343e-9,
        -1.135_990_493_463_036_4e-11,
    ];
    polynomial(z, &SINGLE, &DOUBLE)
}

/// sin r, cos r, and k mod 4 between −2 and 2, for |x| = k π/2 + r.
struct Reduced<P> {
    sine: P,
    cosine: P,
    quadrant: P,
}

#[inline(always)]
fn reduce<P: Primitive>(x: P) -> Reduced<P> {
    let parts = if is_single::<P>() { PARTS_OF_SINGLE } else { PARTS_OF_DOUBLE };
    let x = x.abs();
    let k = nearest_integer_to_product(x, P::splat(std::f64::consts::FRAC_2_PI));
    let (r, first_error) = two_sum(x - k * P::splat(parts[0]), -(k * P::splat(parts[1])));
    let (r, second_error) = two_sum(r, -(k * P::splat(parts[2])));
    let rest = k.mul_add(-P::splat(parts[3]), first_error + second_error);
    let (r, r_low) = quick_two_sum(r, rest);
    // Only numbers so large that k is none reach these bounds. NaN passes through as the second operand.
    let one = P::splat(1.0);
    let r_low = P::select(r.abs().less(one), r_low, P::splat(0.0));
    let r = (-one).max(one.min(r));

    let z = r * r;
    let half = P::splat(0.5) * z;
    let (cosine, error) = quick_two_sum(one, -half);
    let cosine_rest = (z * z).mul_add(cosine_tail(z), r_low.mul_add(-r, error));
    let sine_rest = (z * r).mul_add(sine_tail(z), r_low.mul_add(-half, r_low));
    let whole_turns = nearest_integer_to_product(k, P::splat(0.25));
    let quadrant = whole_turns.mul_add(P::splat(-4.0), k);
    Reduced { sine: r + sine_rest, cosine: cosine + cosine_rest, quadrant }
}

/// sin x.
#[inline(always)]
pub(in super::super) fn sin<P: Primitive>(x: P) -> P {
    let Reduced { sine, cosine, quadrant } = reduce(x);
    let [half, three_halves] = [0.5, 1.5].map(P::splat);
    let is_odd = half.less(quadrant.abs()) & quadrant.abs().less(three_halves);
    let value = P::select(is_odd, cosine, sine);
    // −1 and ±2: the lower half of the circle.
    let is_lower = quadrant.less(-half) | three_halves.less(quadrant);
    P::select(is_lower, -value, value) * P::splat(1.0).copysign(x)
}

/// cos x.
#[inline(always)]
pub(in super::super) fn cos<P: Primitive>(x: P) -> P {
    let Reduced { sine, cosine, quadrant } = reduce(x);
    let [half, three_halves] = [0.5, 1.5].map(P::splat);
    let is_odd = half.less(quadrant.abs()) & quadrant.abs().less(three_halves);
    let value = P::select(is_odd, sine, cosine);
    // 1 and ±2: the left half of the circle.
    let is_left = half.less(quadrant) | quadrant.less(-three_halves);
    P::select(is_left, -value, value)
}
