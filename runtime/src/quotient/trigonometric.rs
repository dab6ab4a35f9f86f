//! Divided differences of sin, cos and atan, by the theorems of addition.

use super::cardinal::{atanc, cardinal};
use crate::lanes::{Mask, Real};

/// The sine and cosine of the sum of two numbers, and their sum.
struct Turn<R> {
    sine: R,
    cosine: R,
    angle: R,
}

/// sin(a + b) and cos(a + b), with the rounding error e of the sum: sin s + e cos s and cos s − e sin s.
///
/// A sum that is rounded would do if it erred for itself. But an error of the middle in place of one of both
/// ends, which move the reach too, changes a divided difference more than its condition allows.
#[inline(always)]
fn turn<R: Real>(a: R, b: R) -> Turn<R> {
    let angle = a + b;
    let of_b = angle - a;
    let error = (a - (angle - of_b)) + (b - of_b);
    let (sine, cosine) = (angle.sin(), angle.cos());
    Turn { sine: error.mul_add(cosine, sine), cosine: error.mul_add(-sine, cosine), angle }
}

/// The middle of two numbers, and half of their difference.
#[inline(always)]
fn middle_and_reach<R: Real>(a: R, b: R) -> (Turn<R>, Turn<R>) {
    let (a, b) = (a * R::splat(0.5), b * R::splat(0.5));
    (turn(a, b), turn(a, -b))
}

/// (sin a − sin b)/(a − b) = cos m sin h/h for m = (a + b)/2 and h = (a − b)/2.
#[inline(always)]
pub fn sin_quotient<R: Real>(a: R, b: R) -> R {
    let (middle, reach) = middle_and_reach(a, b);
    middle.cosine * cardinal(reach.sine, reach.angle)
}

/// (cos a − cos b)/(a − b) = −sin m sin h/h for m = (a + b)/2 and h = (a − b)/2.
#[inline(always)]
pub fn cos_quotient<R: Real>(a: R, b: R) -> R {
    let (middle, reach) = middle_and_reach(a, b);
    -(middle.sine * cardinal(reach.sine, reach.angle))
}

/// (atan a − atan b)/(a − b) = atan t/t / (1 + ab) for t = (a − b)/(1 + ab), if ab ≥ 0.
///
/// Otherwise nothing cancels in the plain quotient.
#[inline(always)]
pub fn atan_quotient<R: Real>(a: R, b: R) -> R {
    let product = a * b;
    let reciprocal = R::splat(1.0) / a.mul_add(b, R::splat(1.0));
    let close = atanc((a - b) * reciprocal) * reciprocal;
    let is_opposite = product.less(R::splat(0.0));
    if !is_opposite.any() {
        return close;
    }
    R::select(is_opposite, (a.atan() - b.atan()) / (a - b), close)
}
