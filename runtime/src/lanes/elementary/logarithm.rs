//! ln x and ln(1 + x): to half a unit in the last place and a little more, or ln x with ten digits beyond the
//! format for powers.
//!
//! x = 2ᵉ m with √½ ≤ m < √2, and ln m = 2 artanh (t/2) = t + t³/12 + t⁵/80 + … for t = (m − 1)/((m + 1)/2).

use super::arithmetic::{is_single, ln_2, polynomial, quick_two_sum, residual, two_sum};
use crate::lanes::primitive::Primitive;

/// ln x as the unevaluated sum of two numbers, |low| ≤ u |high|. If high is infinite, low may have any value.
#[derive(Clone, Copy, Debug)]
pub struct Logarithm<P> {
    pub(in super::super) high: P,
    pub(in super::super) low: P,
}

/// x = 2ᵉ m, and t + t_low for ln m, t_low so small that ln m is linear in it.
struct Reduced<P> {
    e: P,
    t: P,
    t_low: P,
}

#[inline(always)]
fn reduce<P: Primitive>(x: P) -> Reduced<P> {
    let (one, half) = (P::splat(1.0), P::splat(0.5));
    let (m, e) = x.split();
    let f = m - one; // exact
    let reciprocal = one / m.mul_add(half, half);
    let t = f * reciprocal;
    // f − t (1 + f/2), where f − t is exact because the two are within a factor of 2 of each other.
    let rest = residual(t, f * -half, f - t);
    Reduced { e, t, t_low: rest * reciprocal }
}

/// 1/12 to double precision; `twelfth_low` in [`logarithm`] is the rest in the format.
const TWELFTH: f64 = 1.0 / 12.0;

/// (2 artanh (t/2) − t − t³/12)/t⁵ as a polynomial in z = t², for t² < 0.1178.
///
/// z² times its error is below 2⁻⁶⁵ (`f32`: 2⁻³⁶).
#[inline(always)]
fn artanh_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 3] = [0.012_500_048, 0.002_230_244_7, 0.000_457_394_26];
    const DOUBLE: [f64; 7] = [
        0.012_500_000_000_000_705,
        0.002_232_142_857_039_062_4,
        0.000_434_027_783_590_562_4,
        0.000_088_778_244_020_802_91,
        0.000_018_782_662_249_224_19,
        4.045_662_879_551_839e-6,
        1.006_792_203_878_343_5e-6,
    ];
    polynomial(z, &SINGLE, &DOUBLE)
}

/// ln x to a relative error of 2⁻⁶² (`f32`: 2⁻³³).
///
/// The terms t and t³/12 are carried with their errors; all others are below 2⁻¹¹ of the result and need
/// none.
#[inline(always)]
pub(in super::super) fn logarithm<P: Primitive>(x: P) -> Logarithm<P> {
    let Reduced { e, t, t_low } = reduce(x);

    let twelfth = P::splat(TWELFTH);
    let twelfth_low = P::splat(if is_single::<P>() {
        TWELFTH - (TWELFTH as f32) as f64
    } else {
        4.625_929_269_271_485e-18
    });
    let (square, square_low) = t.two_product(t);
    let (cube, cube_low) = t.two_product(square);
    let cube_low = t.mul_add(square_low, cube_low);
    let (cubic, cubic_low) = twelfth.two_product(cube);
    let cubic_low = twelfth.mul_add(cube_low, cubic_low);
    // d ln m/dt = 1/(1 − t²/4) = 1 + t²/4 + …, to 2⁻¹² by the chord-like line 1 + 0.2561 t².
    let t_low = (t_low * square).mul_add(P::splat(0.2561), t_low);

    // e ln_2 + t + cubic, and the error of these two sums: each difference is exact.
    let (ln_2, ln_2_low) = ln_2::<P>();
    let high = e.mul_add(ln_2, t) + cubic;
    let low = (e.mul_add(ln_2, -high) + t) + cubic;
    let low = e.mul_add(ln_2_low, low) + (t_low + cubic_low);
    let tail = square.mul_add(artanh_tail(square), twelfth_low);
    let (high, low) = quick_two_sum(high, without_nan(cube.mul_add(tail, low)));
    Logarithm { high, low }
}

/// A correction below 1, or 1 instead of NaN, which ∞ − ∞ yields if the logarithm is infinite.
#[inline(always)]
fn without_nan<P: Primitive>(correction: P) -> P {
    correction.min(P::splat(1.0))
}

/// ln x.
#[inline(always)]
pub(in super::super) fn ln<P: Primitive>(x: P) -> P {
    of_reduced(reduce(x))
}

#[inline(always)]
fn of_reduced<P: Primitive>(Reduced { e, t, t_low }: Reduced<P>) -> P {
    let (ln_2, ln_2_low) = ln_2::<P>();
    let high = e.mul_add(ln_2, t);
    let low = e.mul_add(ln_2_low, e.mul_add(ln_2, -high) + t) + t_low;
    let square = t * t;
    let tail = square.mul_add(artanh_tail(square), P::splat(TWELFTH));
    high + without_nan((t * square).mul_add(tail, low))
}

/// ln(2ⁿ (high + low)) for |low| ≤ 2u high, with a relative error that does not grow where the sum is close
/// to 1.
///
/// ln(high + low) = ln high + low/high, and t of `high` = 1 is 0: then the result is low itself.
#[inline(always)]
pub(super) fn ln_of_sum<P: Primitive>(high: P, low: P, n: P) -> P {
    let Reduced { e, t, t_low } = reduce(high);
    of_reduced(Reduced { e: e + n, t, t_low: t_low + low / high })
}

/// ln(1 + x).
#[inline(always)]
pub(in super::super) fn ln_1p<P: Primitive>(x: P) -> P {
    let (high, low) = two_sum(P::splat(1.0), x);
    ln_of_sum(high, low, P::splat(0.0)).copysign(x)
}

/// ln a − ln b.
#[inline(always)]
pub(in super::super) fn logarithm_of_ratio<P: Primitive>(a: Logarithm<P>, b: Logarithm<P>) -> P {
    (a.high - b.high) + (a.low - b.low)
}
