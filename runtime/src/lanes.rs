//! The real numbers that every kernel and every generated material computes with.
//!
//! A kernel is written once over [`Real`] and instantiated for `f64` and `f32`, for batches of them side by side in the
//! registers of a processor ([`Lanes`]), and for multiprecision types in tests. So a `Real` may be many numbers at once:
//! there is no comparison that yields a `bool`, only masks, and no branch on a value, only [`Real::select`].
//!
//! How wide the registers are is known at run time only. A [`Kernel`] is what wants to compute with lanes; a [`Backend`],
//! AVX-512, AVX2 or portable, runs it with a type of its own. Scalars and lanes share all code above the operations of
//! IEEE arithmetic, elementary functions included, and no number depends on its neighbours: within a back end a
//! number gets the same bits in any lane.
//!
//! This module knows numbers only: no matrices, no materials. It is the only one with unsafe code.

use std::fmt::Debug;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

mod backend;
mod elementary;
mod pair;
mod primitive;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use backend::{Backend, Kernel};
pub use pair::Pair;
pub use scalar::Element;

/// A real number, or several that are computed with side by side.
///
/// Operations are those of IEEE 754 arithmetic with round-to-nearest; the elementary functions are accurate to
/// 1.5 units in the last place, exact at 0 and ∞, and give NaN outside their domain.
pub trait Real:
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
    type Mask: Mask;

    /// A logarithm with enough digits to make any power from it; see [`Real::logarithm`].
    type Logarithm: Copy + Debug + Send + Sync + 'static;

    /// Unit roundoff u: 2⁻⁵³ for `f64`, 2⁻²⁴ for `f32`.
    const UNIT_ROUNDOFF: f64;

    /// The smallest positive normal number.
    const MIN_POSITIVE: f64;

    /// The number nearest to `value`.
    fn splat(value: f64) -> Self;

    /// One number for each lane, the nearest to `value(lane)`.
    ///
    /// What is a single number asks for lane 0 only.
    fn from_fn(value: impl Fn(usize) -> f64) -> Self;

    /// self · factor + addend, with one rounding where the hardware has such an instruction, else with two.
    ///
    /// Without the instruction a fused operation is a library call, an order of magnitude slower.
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self;

    /// √self.
    #[must_use]
    fn sqrt(self) -> Self;
    /// 1/√self to two units in the last place for a normal self > 0.
    #[must_use]
    #[inline(always)]
    fn reciprocal_sqrt(self) -> Self {
        Self::splat(1.0) / self.sqrt()
    }
    /// √self to 2⁻¹² for a normal self > 0, where the digits don't matter and a fast instruction exists.
    #[must_use]
    #[inline(always)]
    fn rough_sqrt(self) -> Self {
        self.sqrt()
    }
    /// ∛self.
    #[must_use]
    fn cbrt(self) -> Self;
    /// ln self.
    #[must_use]
    fn ln(self) -> Self;
    /// e^self.
    #[must_use]
    fn exp(self) -> Self;
    /// self^exponent for self ≥ 0; NaN for self < 0.
    #[must_use]
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        Self::power(self.logarithm(), exponent)
    }

    /// ln self, from which powers with many exponents are made at the price of an exponential each.
    fn logarithm(self) -> Self::Logarithm;
    /// x^exponent from the logarithm of x.
    #[must_use]
    fn power(logarithm: Self::Logarithm, exponent: Self) -> Self;
    /// ln (a/b) from the logarithms of a and b, with a relative error of 2u unless a/b is within u² |ln a| of 1.
    #[must_use]
    fn logarithm_of_ratio(a: Self::Logarithm, b: Self::Logarithm) -> Self;

    /// |self|.
    #[must_use]
    fn abs(self) -> Self;
    /// The larger of the two; the other one where self is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The smaller of the two; the other one where self is NaN.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// |self| with the sign of `sign`, that of zeros included.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;

    /// self < other; false where one is NaN.
    fn less(self, other: Self) -> Self::Mask;
    /// Neither infinite nor NaN.
    fn is_finite(self) -> Self::Mask;
    /// `yes` where the mask is set, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The product as a pair: its rounded value and the exact rounding error.
    ///
    /// Exact while neither factor exceeds 2⁹⁹⁶ (`f32`: 2¹¹⁶) and the error does not underflow.
    fn two_product(self, other: Self) -> (Self, Self);

    /// Powers of two (s, 1/s) that bring a magnitude into [1, 2): `self.abs() * s`, undone exactly by `1/s`.
    ///
    /// (1, 1) for zero and for what is not finite; subnormal numbers are brought as far as s stays finite.
    fn power_of_two_scale(self) -> (Self, Self);
}

/// Several numbers side by side: a [`Real`] that is loaded from slices and stored to them.
pub trait Lanes: Real {
    /// What a lane holds.
    type Element: Element;

    /// Several registers that are computed with in turns, for kernels whose operations wait for each other.
    ///
    /// Each gets the bits it would get alone. On x86-64 there are four, which spill and are still the fastest for the singular
    /// value decomposition; elsewhere, what is an array already.
    type Interleaved: Lanes<Element = Self::Element>;

    /// How many lanes there are.
    const LANES: usize;

    /// The first [`LANES`](Self::LANES) entries of a slice.
    ///
    /// # Panics
    /// Where there are fewer.
    fn load(from: &[Self::Element]) -> Self;

    /// One number of points in lines of [`LINE`](Element::LINE), each line `numbers` of them after the one before: as many entries
    /// as a line has or there are lanes from the first place, as many from `numbers` lines later, and so on.
    ///
    /// # Panics
    /// Where there are fewer.
    fn load_lines(from: &[Self::Element], numbers: usize) -> Self;

    /// Writes the lanes into the first entries of a slice.
    ///
    /// # Panics
    /// Where there are fewer.
    fn store(self, to: &mut [Self::Element]);

    /// Copies numbers past the caches where the back end can and both slices consist of whole aligned registers.
    ///
    /// # Panics
    /// Where the lengths differ.
    fn stream(from: &[Self::Element], to: &mut [Self::Element], order: &PastCaches);

    /// Transposes a matrix: entry (i, j) of the given size from `from[i from_stride + j]` to `to[j to_stride + i]`.
    ///
    /// # Panics
    /// Where an entry is outside.
    fn transpose(
        size: [usize; 2],
        from: &[Self::Element],
        from_stride: usize,
        to: &mut [Self::Element],
        to_stride: usize,
    );

    /// The lanes in which a mask is set, as bits: lane 0 is the lowest.
    fn bits(mask: Self::Mask) -> u64;
}

/// Keeps stores past the caches in order: when it is dropped, whatever is written afterwards is seen after them.
///
/// Only this crate makes one, and keeps what was written from others until it is dropped: such stores are not ordered with
/// the ordinary ones by which threads tell each other of their work.
#[derive(Debug)]
pub struct PastCaches(());

impl PastCaches {
    pub(crate) fn new() -> Self {
        Self(())
    }
}

impl Drop for PastCaches {
    fn drop(&mut self) {
        #[cfg(target_arch = "x86_64")]
        x86::order_stores();
    }
}

/// The result of comparing [`Real`]s: one truth value for each number.
pub trait Mask:
    Copy + Debug + Send + Sync + 'static + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// The same truth value for each number.
    fn splat(value: bool) -> Self;
    /// Whether it holds for one of them.
    fn any(self) -> bool;
}
