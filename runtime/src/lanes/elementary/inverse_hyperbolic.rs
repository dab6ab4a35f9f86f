//! asinh x = ± ln(|x| + √(1 + x²)).

use super::arithmetic::{power_of_two, quick_two_sum, residual, two_sum};
use super::logarithm::ln_of_sum;
use crate::lanes::primitive::Primitive;

/// asinh x.
///
/// The argument of the logarithm comes with twice the digits, so that little is left of an error of u² when 1
/// is taken from it. Where x < 2⁻²⁰ (`f32`: 2⁻⁸) even that counts, and x − x³/6 is as good. Where x > 2²⁹
/// (`f32`: 2¹⁵) the argument is 2x to the last bit, and its 2 goes to the exponent because 2x may be too
/// large.
#[inline(always)]
pub(in super::super) fn asinh<P: Primitive>(x: P) -> P {
    let a = x.abs();
    let (zero, half, one) = (P::splat(0.0), P::splat(0.5), P::splat(1.0));
    let (square, square_low) = a.two_product(a);
    let (radicand, radicand_low) = two_sum(one, square);
    let root = radicand.sqrt();
    let rest = residual(root, -root, radicand) + (radicand_low + square_low);
    let (sum, sum_low) = quick_two_sum(root, a);
    let sum_low = (half * rest).mul_add(one / root, sum_low);

    let is_large = P::splat(power_of_two(P::digits() / 2 + 3)).less(a);
    let high = P::select(is_large, a, sum);
    let low = P::select(is_large, zero, sum_low);
    let logarithm = ln_of_sum(high, low, P::select(is_large, one, zero));

    let is_small = a.less(P::splat(1.0 / power_of_two(P::digits() * 2 / 5 - 1)));
    let cubic = (a * square).mul_add(P::splat(-1.0 / 6.0), a);
    P::select(is_small, cubic, logarithm).copysign(x)
}
