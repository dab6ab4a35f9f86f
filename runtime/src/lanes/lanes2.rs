//! Pairs of numbers or registers, and pairs of pairs.
//!
//! Pairs of scalars are the portable back end, which a compiler turns into the vector instructions of its
//! target. Pairs of registers are interleaved: independent batches in one body keep a processor busy while
//! each waits for its own last result.
//!
//! A structure and not an array, because a kernel has thousands of operations, and each would be a loop:
//! compilers take minutes to unroll them.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::elementary_functions;
use super::primitive::Primitive;
use super::real::{Mask, Real};
use super::vector::{Lanes, Scalar};

/// Two scalars, two registers, or two pairs, with the lanes of both.
#[derive(Clone, Copy, Debug)]
pub struct Lanes2<T>(T, T);

macro_rules! operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl<T: $Operator<Output = T>> $Operator for Lanes2<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor);

impl<T: Neg<Output = T>> Neg for Lanes2<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<T: Not<Output = T>> Not for Lanes2<T> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0, !self.1)
    }
}

impl<M: Mask> Mask for Lanes2<M> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(M::splat(value), M::splat(value))
    }

    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
}

/// Operations that act on each half separately.
macro_rules! halves {
    ($($method:ident($($other:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $other: Self)*) -> Self {
            Self(self.0.$method($($other.0),*), self.1.$method($($other.1),*))
        }
    )*};
}

impl<P: Primitive + Lanes> Real for Lanes2<P> {
    type Mask = Lanes2<P::Mask>;
    const UNIT_ROUNDOFF: f64 = P::UNIT_ROUNDOFF;
    const MIN_POSITIVE: f64 = P::MIN_POSITIVE;

    elementary_functions!();
    halves! { sqrt(), reciprocal_sqrt(), abs(), max(other), min(other), copysign(sign) }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self(P::splat(value), P::splat(value))
    }

    #[inline(always)]
    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        Self(P::from_fn(&value), P::from_fn(|lane| value(P::LANES + lane)))
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        // Two instructions go side by side, not half by half, so that the compiler finds pairs to vectorise.
        if !P::IS_FUSED {
            return self * factor + addend;
        }
        Self(self.0.mul_add(factor.0, addend.0), self.1.mul_add(factor.1, addend.1))
    }

    #[inline(always)]
    fn less(self, other: Self) -> Self::Mask {
        Lanes2(self.0.less(other.0), self.1.less(other.1))
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(P::select(mask.0, yes.0, no.0), P::select(mask.1, yes.1, no.1))
    }
}

impl<P: Primitive + Lanes> Lanes for Lanes2<P> {
    type Scalar = P::Scalar;
    type Interleaved = Self;
    const LANES: usize = 2 * P::LANES;

    #[inline(always)]
    fn load(from: &[P::Scalar]) -> Self {
        let (first, second) = from[..Self::LANES].split_at(P::LANES);
        Self(P::load(first), P::load(second))
    }

    #[inline(always)]
    fn load_lines(from: &[P::Scalar], components: usize) -> Self {
        let line = P::Scalar::LINE;
        let second = P::LANES / line * components * line + P::LANES % line;
        Self(P::load_lines(from, components), P::load_lines(&from[second..], components))
    }

    #[inline(always)]
    fn store(self, to: &mut [P::Scalar]) {
        let (first, second) = to[..Self::LANES].split_at_mut(P::LANES);
        self.0.store(first);
        self.1.store(second);
    }

    #[inline(always)]
    fn bits(mask: Self::Mask) -> u64 {
        P::bits(mask.1) << P::LANES | P::bits(mask.0)
    }
}

impl<P: Primitive + Lanes> Primitive for Lanes2<P> {
    const IS_FUSED: bool = P::IS_FUSED;

    halves! { scale(exponent), leading_power(), reciprocal_of_power() }

    #[inline(always)]
    fn is_zero(self) -> Self::Mask {
        Lanes2(self.0.is_zero(), self.1.is_zero())
    }

    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let ((m0, e0), (m1, e1)) = (self.0.split(), self.1.split());
        (Self(m0, m1), Self(e0, e1))
    }
}
