//! One number at a time: `f64` and `f32`.

use std::fmt::Debug;

use super::primitive::{Primitive, exponent_or_limit, lift};
use super::{Backend, Kernel, Mask};

/// A format of floating-point numbers: `f64` or `f32`.
pub trait Element:
    Primitive<Format = Self, Choice = bool> + Default + PartialEq + PartialOrd + Debug + Into<f64>
{
    /// Binary digits of the significand.
    const DIGITS: u32;
    /// The smallest positive normal number.
    const SMALLEST_NORMAL: f64;
    /// Adding and subtracting it rounds |x| ≤ 2⁵⁰ (`f32`: 2²¹) to the nearest integer.
    const ROUNDING: f64;

    /// Numbers in a cache line of 64 bytes, the group in which blocks of numbers are laid out.
    const LINE: usize;

    /// Runs a kernel with the lanes of a back end.
    fn run<K: Kernel<Self>>(backend: Backend, kernel: K) -> K::Output;
}

impl Mask for bool {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        value
    }

    #[inline(always)]
    fn any(self) -> bool {
        self
    }
}

macro_rules! scalar {
    (
        $Number:ident, $Bits:ident, $Signed:ident,
        mantissa: $mantissa:literal, bias: $bias:literal, line: $line:literal,
        run: $run:path
    ) => {
        impl Element for $Number {
            const DIGITS: u32 = $Number::MANTISSA_DIGITS;
            const SMALLEST_NORMAL: f64 = $Number::MIN_POSITIVE as f64;
            const ROUNDING: f64 = (3u64 << ($mantissa - 1)) as f64;
            const LINE: usize = $line;

            #[inline(always)]
            fn run<K: Kernel<Self>>(backend: Backend, kernel: K) -> K::Output {
                $run(backend, kernel)
            }
        }

        impl Primitive for $Number {
            type Choice = bool;
            type Format = Self;
            type Interleaved = Self;
            const COUNT: usize = 1;
            const IS_FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

            #[inline(always)]
            fn fill(value: f64) -> Self {
                value as $Number
            }

            #[inline(always)]
            fn each(value: impl Fn(usize) -> f64) -> Self {
                value(0) as $Number
            }

            #[inline(always)]
            fn read(from: &[Self]) -> Self {
                from[0]
            }

            #[inline(always)]
            fn write(self, to: &mut [Self]) {
                to[0] = self;
            }

            #[inline(always)]
            fn choice_bits(choice: bool) -> u64 {
                u64::from(choice)
            }

            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                $Number::mul_add(self, factor, addend)
            }

            #[inline(always)]
            fn root(self) -> Self {
                $Number::sqrt(self)
            }

            #[inline(always)]
            fn reciprocal_root(self) -> Self {
                1.0 / $Number::sqrt(self)
            }

            #[inline(always)]
            fn rough_root(self) -> Self {
                $Number::sqrt(self)
            }

            #[inline(always)]
            fn magnitude(self) -> Self {
                $Number::abs(self)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                if self > other { self } else { other }
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                if self < other { self } else { other }
            }

            #[inline(always)]
            fn with_sign(self, sign: Self) -> Self {
                $Number::copysign(self, sign)
            }

            #[inline(always)]
            fn is_less(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn is_zero(self) -> bool {
                self == 0.0
            }

            #[inline(always)]
            fn choose(choice: bool, yes: Self, no: Self) -> Self {
                if choice { yes } else { no }
            }

            #[inline(always)]
            fn split(self) -> (Self, Self) {
                // As integers, patterns of bits are in the order of the numbers, an exponent is worth 2 to the mantissa.
                const SMALLEST: $Signed = std::$Number::consts::FRAC_1_SQRT_2.to_bits() as $Signed;
                let (lifted, lift) = lift(self);
                let bits = lifted.to_bits() as $Signed;
                let exponent = bits.wrapping_sub(SMALLEST) >> $mantissa;
                let m = $Number::from_bits(bits.wrapping_sub(exponent << $mantissa) as $Bits);
                (m, exponent_or_limit(self, exponent as $Number - lift))
            }

            #[inline(always)]
            fn scale(self, exponent: Self) -> Self {
                // Two factors, since 2ᵉ itself may be out of range; the first product is exact.
                let first = (exponent * 0.5 + Self::ROUNDING as $Number) - Self::ROUNDING as $Number;
                let power = |e: $Number| {
                    let biased = (e + (Self::ROUNDING as $Number + $bias as $Number)).to_bits();
                    $Number::from_bits(biased << $mantissa)
                };
                self * power(first) * power(exponent - first)
            }

            #[inline(always)]
            fn leading_power(self) -> Self {
                $Number::from_bits(self.to_bits() & $Number::INFINITY.to_bits())
            }

            #[inline(always)]
            fn reciprocal_of_power(self) -> Self {
                const TWO_BIASES: $Bits = 2 * $bias << $mantissa;
                $Number::from_bits(TWO_BIASES.wrapping_sub(self.to_bits()))
            }
        }
    };
}

scalar!(
    f64, u64, i64,
    mantissa: 52, bias: 1023, line: 8,
    run: super::backend::run_f64
);
scalar!(
    f32, u32, i32,
    mantissa: 23, bias: 127, line: 16,
    run: super::backend::run_f32
);

#[cfg(test)]
mod tests {
    use crate::lanes::Real;

    #[track_caller]
    fn check_scale(x: f64, scaled: f64) {
        let (s, back) = x.power_of_two_scale();
        assert_eq!(x.abs() * s, scaled, "scale of {x:e}");
        assert_eq!(s * back, 1.0, "inverse of the scale of {x:e}");
    }

    #[test]
    fn scale_brings_magnitudes_between_one_and_two() {
        check_scale(1.5, 1.5);
        check_scale(-12.0, 1.5);
        check_scale(0.0, 0.0);
        check_scale(1.5 * 2f64.powi(1023), 1.5 * 2.0); // 2⁻¹⁰²³ would be subnormal
        check_scale(1.5 * 2f64.powi(-1022), 1.5);
        assert_eq!(f64::INFINITY.power_of_two_scale(), (1.0, 1.0));
        assert_eq!(3e-39f32.power_of_two_scale(), (2f32.powi(126), 2f32.powi(-126))); // subnormal
    }

    #[test]
    fn two_product_is_exact() {
        // (2²⁷ + 1)² = 2⁵⁴ + 2²⁸ + 1 needs 55 bits.
        let x = 2f64.powi(27) + 1.0;
        assert_eq!(x.two_product(x), (2f64.powi(54) + 2f64.powi(28), 1.0));
        let x = 2f32.powi(12) + 1.0;
        assert_eq!(x.two_product(x), (2f32.powi(24) + 2f32.powi(13), 1.0));
    }
}
