//! What a back end supplies, and how it becomes a [`Real`] and [`Lanes`].
//!
//! Operations that differ from one instruction set to the next, and nothing else: the elementary functions and the
//! error-free product are written once, over these.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::elementary::{self, Logarithm};
use super::{Element, Lanes, Mask, PastCaches, Real};

/// Numbers of one format with the operations of an instruction set.
///
/// Results are those of IEEE 754 arithmetic in each lane by itself.
pub trait Primitive:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The result of a comparison.
    type Choice: Mask;
    /// The format of each number.
    type Format: Element;
    /// See [`Lanes::Interleaved`].
    type Interleaved: Primitive<Format = Self::Format>;
    /// How many numbers there are.
    const COUNT: usize;
    /// Whether [`Primitive::fused`] is an instruction that rounds once.
    const IS_FUSED: bool;

    /// The number nearest to `value`.
    fn fill(value: f64) -> Self;
    /// One number for each lane.
    fn each(value: impl Fn(usize) -> f64) -> Self;
    /// The first [`COUNT`](Self::COUNT) numbers of a slice; panics where there are fewer.
    fn read(from: &[Self::Format]) -> Self;
    /// See [`Lanes::load_lines`]; the numbers of a register lie in one line.
    #[inline(always)]
    fn read_lines(from: &[Self::Format], _: usize) -> Self {
        Self::read(from)
    }
    /// Into the first [`COUNT`](Self::COUNT) numbers of a slice; panics where there are fewer.
    fn write(self, to: &mut [Self::Format]);
    /// See [`Lanes::stream`].
    #[inline]
    fn copy_past_caches(from: &[Self::Format], to: &mut [Self::Format], _: &PastCaches) {
        to.copy_from_slice(from);
    }
    /// See [`Lanes::transpose`].
    #[inline(never)]
    fn turn(
        [rows, columns]: [usize; 2],
        from: &[Self::Format],
        from_stride: usize,
        to: &mut [Self::Format],
        to_stride: usize,
    ) {
        for i in 0..rows {
            for j in 0..columns {
                to[j * to_stride + i] = from[i * from_stride + j];
            }
        }
    }
    /// The lanes in which a choice is set, lane 0 being the lowest bit.
    fn choice_bits(choice: Self::Choice) -> u64;

    /// self · factor + addend.
    fn fused(self, factor: Self, addend: Self) -> Self;
    /// √self.
    fn root(self) -> Self;
    /// 1/√self for a normal self > 0, to 2u.
    fn reciprocal_root(self) -> Self;
    /// √self for a normal self > 0, to 2⁻¹² at least.
    fn rough_root(self) -> Self;
    /// |self|.
    fn magnitude(self) -> Self;
    /// self > other ? self : other, so the other one where either is NaN.
    fn larger(self, other: Self) -> Self;
    /// self < other ? self : other, so the other one where either is NaN.
    fn smaller(self, other: Self) -> Self;
    /// |self| with the sign bit of `sign`.
    fn with_sign(self, sign: Self) -> Self;
    /// self < other.
    fn is_less(self, other: Self) -> Self::Choice;
    /// self = ±0.
    fn is_zero(self) -> Self::Choice;
    /// `yes` where the choice is set, `no` elsewhere.
    fn choose(choice: Self::Choice, yes: Self, no: Self) -> Self;

    /// (m, e) with self = m 2ᵉ and √½ ≤ m < √2, both rounded, for a finite self > 0.
    ///
    /// Of ±0 it is (1, −∞), of ∞ (1, ∞); of NaN and what is negative, m or e is NaN.
    fn split(self) -> (Self, Self);
    /// self · 2ᵉ, rounded once, for ½ ≤ self < 2 and an integer e between −2 bias and 2 bias.
    fn scale(self, exponent: Self) -> Self;
    /// The power of two in |self|: 0 for zero and subnormal numbers, ∞ for ∞ and NaN.
    fn leading_power(self) -> Self;
    /// 1/self for a power of two that is normal and whose reciprocal is.
    fn reciprocal_of_power(self) -> Self;
}

/// x > 0 times a power of two that makes subnormal numbers normal, and its exponent.
#[inline(always)]
pub(super) fn lift<P: Primitive>(x: P) -> (P, P) {
    // 1/u is 2 to the number of digits.
    let (power, exponent) = (1.0 / P::UNIT_ROUNDOFF, f64::from(<P::Format as Element>::DIGITS));
    let is_tiny = x.is_less(constant(P::MIN_POSITIVE));
    (P::choose(is_tiny, x * constant(power), x), P::choose(is_tiny, constant(exponent), constant(0.0)))
}

/// `exponent` where x is finite and positive, else what [`Primitive::split`] gives for it.
#[inline(always)]
pub(super) fn exponent_or_limit<P: Primitive>(x: P, exponent: P) -> P {
    let zero = constant::<P>(0.0);
    let limit = P::choose(x.is_less(zero), constant(f64::NAN), constant(f64::NEG_INFINITY));
    let exponent = P::choose(zero.is_less(x), exponent, limit);
    // Where the comparison fails, x is what is wanted: ∞ or NaN.
    P::choose(x.is_less(constant(f64::INFINITY)), exponent, x)
}

/// 2ⁿ for n < 64.
const fn power_of_two(n: u32) -> f64 {
    (1u64 << n) as f64
}

/// `value` as a number of the format, at compile time where it is a literal.
#[inline(always)]
fn constant<P: Primitive>(value: f64) -> P {
    P::fill(value)
}

impl<P: Primitive> Real for P {
    type Mask = P::Choice;
    type Logarithm = Logarithm<P>;

    const UNIT_ROUNDOFF: f64 = 1.0 / power_of_two(<P::Format as Element>::DIGITS);
    const MIN_POSITIVE: f64 = <P::Format as Element>::SMALLEST_NORMAL;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        P::fill(value)
    }

    #[inline(always)]
    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        P::each(value)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        if P::IS_FUSED { self.fused(factor, addend) } else { self * factor + addend }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.root()
    }

    #[inline(always)]
    fn reciprocal_sqrt(self) -> Self {
        self.reciprocal_root()
    }

    #[inline(always)]
    fn rough_sqrt(self) -> Self {
        self.rough_root()
    }

    #[inline(always)]
    fn cbrt(self) -> Self {
        elementary::cbrt(self)
    }

    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }

    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }

    #[inline(always)]
    fn logarithm(self) -> Logarithm<P> {
        elementary::logarithm(self)
    }

    #[inline(always)]
    fn power(logarithm: Logarithm<P>, exponent: Self) -> Self {
        elementary::power(logarithm, exponent)
    }

    #[inline(always)]
    fn logarithm_of_ratio(a: Logarithm<P>, b: Logarithm<P>) -> Self {
        elementary::logarithm_of_ratio(a, b)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.magnitude()
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.larger(other)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.smaller(other)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.with_sign(sign)
    }

    #[inline(always)]
    fn less(self, other: Self) -> P::Choice {
        self.is_less(other)
    }

    #[inline(always)]
    fn is_finite(self) -> P::Choice {
        self.magnitude().is_less(constant(f64::INFINITY))
    }

    #[inline(always)]
    fn select(mask: P::Choice, yes: Self, no: Self) -> Self {
        P::choose(mask, yes, no)
    }

    #[inline(always)]
    fn two_product(self, other: Self) -> (Self, Self) {
        let product = self * other;
        if P::IS_FUSED {
            return (product, self.fused(other, -product));
        }
        // Veltkamp's splitting and Dekker's product: each half has few enough bits for exact products.
        let split = |x: P| {
            let big = constant::<P>(power_of_two(<P::Format as Element>::DIGITS.div_ceil(2)) + 1.0) * x;
            let high = big - (big - x);
            (high, x - high)
        };
        let ((ah, al), (bh, bl)) = (split(self), split(other));
        (product, al * bl - (((product - ah * bh) - al * bh) - ah * bl))
    }

    #[inline(always)]
    fn power_of_two_scale(self) -> (Self, Self) {
        let smallest = constant::<P>(Self::MIN_POSITIVE);
        // Both 2⁻ᵉ and 2ᵉ are normal numbers for |e| ≤ bias − 1.
        let largest = constant::<P>(1.0 / Self::MIN_POSITIVE);
        let power = self.leading_power();
        let zero = constant::<P>(0.0);
        let is_ordinary = zero.is_less(self.magnitude()) & power.is_less(constant(f64::INFINITY));
        let back = P::choose(is_ordinary, power.larger(smallest).smaller(largest), constant(1.0));
        (back.reciprocal_of_power(), back)
    }
}

impl<P: Primitive> Lanes for P {
    type Element = P::Format;
    type Interleaved = P::Interleaved;

    const LANES: usize = P::COUNT;

    #[inline(always)]
    fn load(from: &[P::Format]) -> Self {
        P::read(from)
    }

    #[inline(always)]
    fn load_lines(from: &[P::Format], numbers: usize) -> Self {
        P::read_lines(from, numbers)
    }

    #[inline(always)]
    fn store(self, to: &mut [P::Format]) {
        self.write(to);
    }

    #[inline(always)]
    fn stream(from: &[P::Format], to: &mut [P::Format], order: &PastCaches) {
        P::copy_past_caches(from, to, order);
    }

    #[inline(always)]
    fn transpose(
        size: [usize; 2],
        from: &[P::Format],
        from_stride: usize,
        to: &mut [P::Format],
        to_stride: usize,
    ) {
        P::turn(size, from, from_stride, to, to_stride);
    }

    #[inline(always)]
    fn bits(mask: P::Choice) -> u64 {
        P::choice_bits(mask)
    }
}
