//! sinh, cosh and tanh, from both exponentials at the price of one.
//!
//! |x| = k ln 2 + r, and with c = 2⁻²ᵏ, E(r) = r²/2 + r⁴/24 + … and O(r) = r³/6 + …, which the tail of the
//! exponential has apart,
//!
//! ```text
//! 2 sinh |x| = 2ᵏ ((1 − c) + (1 + c) r + (1 − c) E + (1 + c) O)
//! 2 cosh |x| = 2ᵏ ((1 + c) + (1 − c) r + (1 + c) E + (1 − c) O)
//! ```
//!
//! For k = 0 the first is 2 (r + O): sinh has the digits of x however small that is.

use super::arithmetic::{quick_two_sum, quotient_of_sums, two_sum};
use super::exponential::{Remainder, exponential_tails, remainder};
use crate::lanes::primitive::Primitive;

/// 2ᵏ times one of two unevaluated sums: sinh |x|, and cosh |x|, both doubled.
struct Hyperbolic<P> {
    k: P,
    sinh: (P, P),
    cosh: (P, P),
}

/// sinh |x| and cosh |x|. The first part of a sum may be half of it.
#[inline(always)]
fn hyperbolic<P: Primitive>(x: P) -> Hyperbolic<P> {
    let Remainder { k, r, r_low } = remainder(x.abs());
    let one = P::splat(1.0);
    // Where it is bounded, c is far below the last bit.
    let c = one.scale(-(k + k).min(P::splat(64.0)));
    let square = r * r;
    let (even, odd) = exponential_tails(square);
    let (even, odd) = (square * even, (square * r).mul_add(odd, r_low));

    let (less, less_low) = quick_two_sum(one, -c);
    let (more, more_low) = quick_two_sum(one, c);
    // (1 ± c) + r with its errors; c r is exact.
    let (sinh, sinh_low) = quick_two_sum(less, r);
    let (cosh, cosh_low) = quick_two_sum(more, r);
    let sinh_tail = c.mul_add(r, more.mul_add(odd, less * even));
    let cosh_tail = c.mul_add(-r, less.mul_add(odd, more * even));
    Hyperbolic {
        k,
        sinh: (sinh, (less_low + sinh_low) + sinh_tail),
        cosh: (cosh, (more_low + cosh_low) + cosh_tail),
    }
}

/// sinh x.
#[inline(always)]
pub(in super::super) fn sinh<P: Primitive>(x: P) -> P {
    let Hyperbolic { k, sinh: (high, low), .. } = hyperbolic(x);
    (high + low).scale(k - P::splat(1.0)).copysign(x)
}

/// cosh x.
#[inline(always)]
pub(in super::super) fn cosh<P: Primitive>(x: P) -> P {
    let Hyperbolic { k, cosh: (high, low), .. } = hyperbolic(x);
    (high + low).scale(k - P::splat(1.0))
}

/// tanh x, the quotient of the two.
#[inline(always)]
pub(in super::super) fn tanh<P: Primitive>(x: P) -> P {
    let Hyperbolic { sinh, cosh, .. } = hyperbolic(x);
    quotient_of_sums(two_sum(sinh.0, sinh.1), quick_two_sum(cosh.0, cosh.1)).copysign(x)
}
