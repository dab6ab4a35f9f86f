//! Several numbers, or several registers, at once.
//!
//! Of scalars this is the portable back end: loops of fixed length over IEEE operations, which any compiler turns into
//! what vector instructions the target has. Of registers it is interleaving: two or four independent batches in
//! one body keep a processor busy while each waits for its own last result.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::Mask;
use super::primitive::Primitive;

/// N numbers, or N registers of numbers.
#[derive(Clone, Copy, Debug)]
pub struct Array<T, const N: usize>([T; N]);

impl<T: Copy, const N: usize> Array<T, N> {
    #[inline(always)]
    fn map<U: Copy>(self, f: impl Fn(T) -> U) -> Array<U, N> {
        Array(self.0.map(f))
    }

    #[inline(always)]
    fn zip<U: Copy, V>(self, other: Array<U, N>, f: impl Fn(T, U) -> V) -> Array<V, N> {
        Array(std::array::from_fn(|k| f(self.0[k], other.0[k])))
    }
}

macro_rules! operators {
    ($($Operator:ident $method:ident),*) => {$(
        impl<T: Copy + $Operator<Output = T>, const N: usize> $Operator for Array<T, N> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                self.zip(other, $Operator::$method)
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div, BitAnd bitand, BitOr bitor);

impl<T: Copy + Neg<Output = T>, const N: usize> Neg for Array<T, N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.map(Neg::neg)
    }
}

impl<T: Copy + Not<Output = T>, const N: usize> Not for Array<T, N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        self.map(Not::not)
    }
}

impl<M: Mask, const N: usize> Mask for Array<M, N> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self([M::splat(value); N])
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.0.into_iter().reduce(|a, b| a | b).is_some_and(M::any)
    }
}

impl<P: Primitive, const N: usize> Primitive for Array<P, N> {
    type Choice = Array<P::Choice, N>;
    type Format = P::Format;
    const COUNT: usize = N * P::COUNT;
    const IS_FUSED: bool = P::IS_FUSED;

    #[inline(always)]
    fn fill(value: f64) -> Self {
        Self([P::fill(value); N])
    }

    #[inline(always)]
    fn each(value: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(|k| P::each(|lane| value(k * P::COUNT + lane))))
    }

    #[inline(always)]
    fn read(from: &[P::Format]) -> Self {
        let from = &from[..Self::COUNT];
        Self(std::array::from_fn(|k| P::read(&from[k * P::COUNT..])))
    }

    #[inline(always)]
    fn write(self, to: &mut [P::Format]) {
        let to = &mut to[..Self::COUNT];
        for (k, part) in self.0.into_iter().enumerate() {
            part.write(&mut to[k * P::COUNT..]);
        }
    }

    #[inline(always)]
    fn choice_bits(choice: Self::Choice) -> u64 {
        choice.0.into_iter().rev().fold(0, |bits, part| bits << P::COUNT | P::choice_bits(part))
    }

    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        Self(std::array::from_fn(|k| self.0[k].fused(factor.0[k], addend.0[k])))
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.map(P::root)
    }

    #[inline(always)]
    fn reciprocal_root(self) -> Self {
        self.map(P::reciprocal_root)
    }

    #[inline(always)]
    fn rough_root(self) -> Self {
        self.map(P::rough_root)
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        self.map(P::magnitude)
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.zip(other, P::larger)
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.zip(other, P::smaller)
    }

    #[inline(always)]
    fn with_sign(self, sign: Self) -> Self {
        self.zip(sign, P::with_sign)
    }

    #[inline(always)]
    fn is_less(self, other: Self) -> Self::Choice {
        self.zip(other, P::is_less)
    }

    #[inline(always)]
    fn choose(choice: Self::Choice, yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|k| P::choose(choice.0[k], yes.0[k], no.0[k])))
    }

    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let parts = self.map(P::split);
        (parts.map(|part| part.0), parts.map(|part| part.1))
    }

    #[inline(always)]
    fn scale(self, exponent: Self) -> Self {
        self.zip(exponent, P::scale)
    }

    #[inline(always)]
    fn leading_power(self) -> Self {
        self.map(P::leading_power)
    }

    #[inline(always)]
    fn reciprocal_of_power(self) -> Self {
        self.map(P::reciprocal_of_power)
    }
}
