//! Two of a kind, and pairs of pairs.
//!
//! Of scalars they are the portable back end, which a compiler turns into what vector instructions the target has. Of
//! registers they are interleaving: independent batches in one body keep a processor busy while each waits for its own
//! last result.
//!
//! A structure and not an array, because a kernel has thousands of operations, and each would be a loop: compilers take minutes to
//! unroll so many.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::primitive::Primitive;
use super::{Element, Mask};

/// Two numbers, two registers, or two pairs.
#[derive(Clone, Copy, Debug)]
pub struct Pair<T>(T, T);

macro_rules! operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl<T: $Operator<Output = T>> $Operator for Pair<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor);

impl<T: Neg<Output = T>> Neg for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<T: Not<Output = T>> Not for Pair<T> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0, !self.1)
    }
}

impl<M: Mask> Mask for Pair<M> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(M::splat(value), M::splat(value))
    }

    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
}

/// Operations that each half does by itself.
macro_rules! halves {
    ($($method:ident($($other:ident),*)),* $(,)?) => {$(
        #[inline(always)]
        fn $method(self $(, $other: Self)*) -> Self {
            Self(self.0.$method($($other.0),*), self.1.$method($($other.1),*))
        }
    )*};
}

impl<P: Primitive> Primitive for Pair<P> {
    type Choice = Pair<P::Choice>;
    type Format = P::Format;
    type Interleaved = Self;
    const COUNT: usize = 2 * P::COUNT;
    const IS_FUSED: bool = P::IS_FUSED;

    halves! {
        fused(factor, addend), root(), reciprocal_root(), rough_root(), magnitude(), larger(other), smaller(other),
        with_sign(sign), scale(exponent), leading_power(), reciprocal_of_power(),
    }

    #[inline(always)]
    fn fill(value: f64) -> Self {
        Self(P::fill(value), P::fill(value))
    }

    #[inline(always)]
    fn each(value: impl Fn(usize) -> f64) -> Self {
        Self(P::each(&value), P::each(|lane| value(P::COUNT + lane)))
    }

    #[inline(always)]
    fn read(from: &[P::Format]) -> Self {
        let (first, second) = from[..Self::COUNT].split_at(P::COUNT);
        Self(P::read(first), P::read(second))
    }

    #[inline(always)]
    fn read_lines(from: &[P::Format], numbers: usize) -> Self {
        let line = P::Format::LINE;
        let second = P::COUNT / line * numbers * line + P::COUNT % line;
        Self(P::read_lines(from, numbers), P::read_lines(&from[second..], numbers))
    }

    #[inline(always)]
    fn write(self, to: &mut [P::Format]) {
        let (first, second) = to[..Self::COUNT].split_at_mut(P::COUNT);
        self.0.write(first);
        self.1.write(second);
    }

    #[inline(always)]
    fn choice_bits(choice: Self::Choice) -> u64 {
        P::choice_bits(choice.1) << P::COUNT | P::choice_bits(choice.0)
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> Self::Choice {
        Pair(self.0.is_less(other.0), self.1.is_less(other.1))
    }

    #[inline(always)]
    fn is_zero(self) -> Self::Choice {
        Pair(self.0.is_zero(), self.1.is_zero())
    }

    #[inline(always)]
    fn choose(choice: Self::Choice, yes: Self, no: Self) -> Self {
        Self(P::choose(choice.0, yes.0, no.0), P::choose(choice.1, yes.1, no.1))
    }

    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let ((m0, e0), (m1, e1)) = (self.0.split(), self.1.split());
        (Self(m0, m1), Self(e0, e1))
    }
}
