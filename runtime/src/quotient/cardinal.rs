//! f(x)/x for functions that are x close to 0.

use crate::lanes::Real;

/// `value`/x, and 1 where x is 0 or subnormal, from the value at x of a function x + c x² + ….
///
/// Nothing cancels in such a quotient: it is as accurate as the value.
#[inline(always)]
pub(super) fn cardinal<R: Real>(value: R, x: R) -> R {
    // A comparison that NaN fails, so that it stays NaN.
    R::select(x.abs().less(R::splat(R::min_positive())), R::splat(1.0), value / x)
}

/// atan x/x.
#[inline(always)]
pub(super) fn atanc<R: Real>(x: R) -> R {
    cardinal(x.atan(), x)
}

/// ln(1 + x)/x.
#[inline(always)]
pub(super) fn ln_1pc<R: Real>(x: R) -> R {
    cardinal(x.ln_1p(), x)
}

/// (eˣ − 1)/x.
#[inline(always)]
pub(super) fn exp_m1c<R: Real>(x: R) -> R {
    cardinal(x.exp_m1(), x)
}
