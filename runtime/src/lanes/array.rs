//! Several numbers at once.
//!
//! The portable back end: loops of fixed length over IEEE operations, which any compiler turns into what vector
//! instructions the target has.
//!
//! Plain loops, no closures: what is not inlined into the function of a back end is not compiled for its instructions, and
//! nothing can force a closure to be.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::primitive::Primitive;
use super::{Mask, PastCaches};

/// N numbers.
#[derive(Clone, Copy, Debug)]
pub struct Array<T, const N: usize>([T; N]);

macro_rules! binary_operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl<T: Copy + $Operator<Output = T>, const N: usize> $Operator for Array<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for k in 0..N {
                    self.0[k] = $Operator::$method(self.0[k], other.0[k]);
                }
                self
            }
        }
    )*};
}
binary_operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor);

macro_rules! unary_operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl<T: Copy + $Operator<Output = T>, const N: usize> $Operator for Array<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self) -> Self {
                for k in 0..N {
                    self.0[k] = $Operator::$method(self.0[k]);
                }
                self
            }
        }
    )*};
}
unary_operators!(Neg neg, Not not);

impl<M: Mask, const N: usize> Mask for Array<M, N> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self([M::splat(value); N])
    }

    #[inline(always)]
    fn any(self) -> bool {
        let mut all = self.0[0];
        for k in 1..N {
            all = all | self.0[k];
        }
        all.any()
    }
}

/// Methods that do to each part what they do to it alone.
macro_rules! part_by_part {
    ($($method:ident($($other:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(mut self, $($other: Self),*) -> Self {
            for k in 0..N {
                self.0[k] = self.0[k].$method($($other.0[k]),*);
            }
            self
        }
    )*};
}

impl<P: Primitive, const N: usize> Primitive for Array<P, N> {
    type Choice = Array<P::Choice, N>;
    type Format = P::Format;
    type Interleaved = Self;
    const COUNT: usize = N * P::COUNT;
    const IS_FUSED: bool = P::IS_FUSED;

    part_by_part! {
        fused(factor, addend), root(), reciprocal_root(), rough_root(), magnitude(), larger(other), smaller(other),
        with_sign(sign), scale(exponent), leading_power(), reciprocal_of_power(),
    }

    #[inline(always)]
    fn fill(value: f64) -> Self {
        Self([P::fill(value); N])
    }

    #[inline(always)]
    fn each(value: impl Fn(usize) -> f64) -> Self {
        let mut all = Self::fill(0.0);
        for k in 0..N {
            all.0[k] = P::each(|lane| value(k * P::COUNT + lane));
        }
        all
    }

    #[inline(always)]
    fn read(from: &[P::Format]) -> Self {
        let from = &from[..Self::COUNT];
        let mut all = Self::fill(0.0);
        for k in 0..N {
            all.0[k] = P::read(&from[k * P::COUNT..]);
        }
        all
    }

    #[inline(always)]
    fn write(self, to: &mut [P::Format]) {
        let to = &mut to[..Self::COUNT];
        for k in 0..N {
            self.0[k].write(&mut to[k * P::COUNT..]);
        }
    }

    #[inline(always)]
    fn write_past_caches(self, to: &mut [P::Format], order: &PastCaches) {
        let to = &mut to[..Self::COUNT];
        for k in 0..N {
            self.0[k].write_past_caches(&mut to[k * P::COUNT..], order);
        }
    }

    #[inline(always)]
    fn choice_bits(choice: Self::Choice) -> u64 {
        let mut bits = 0;
        for k in 0..N {
            bits |= P::choice_bits(choice.0[k]) << (k * P::COUNT);
        }
        bits
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> Self::Choice {
        let mut choice = Self::Choice::splat(false);
        for k in 0..N {
            choice.0[k] = self.0[k].is_less(other.0[k]);
        }
        choice
    }

    #[inline(always)]
    fn is_zero(self) -> Self::Choice {
        let mut choice = Self::Choice::splat(false);
        for k in 0..N {
            choice.0[k] = self.0[k].is_zero();
        }
        choice
    }

    #[inline(always)]
    fn choose(choice: Self::Choice, mut yes: Self, no: Self) -> Self {
        for k in 0..N {
            yes.0[k] = P::choose(choice.0[k], yes.0[k], no.0[k]);
        }
        yes
    }

    #[inline(always)]
    fn split(mut self) -> (Self, Self) {
        let mut exponents = self;
        for k in 0..N {
            (self.0[k], exponents.0[k]) = self.0[k].split();
        }
        (self, exponents)
    }
}
