//! One number at a time: `f64` and `f32`.

use super::elementary::elementary_functions;
use super::primitive::{Primitive, exponent_or_limit, lift};
use super::real::{Mask, Real};
use super::vector::{ByFormat, InstructionSet, Lanes, Scalar};

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
        $Number:ident, $Bits:ident, $Signed:ident, lanes $Lanes:ident, mantissa $mantissa:literal, bias $bias:literal
    ) => {
        impl Scalar for $Number {
            const LINE: usize = 64 / size_of::<$Number>();
            type In<I: InstructionSet> = I::$Lanes;

            fn by_format<'a>(from: &'a [Self], to: &'a mut [Self]) -> ByFormat<'a> {
                ByFormat::$Lanes(from, to)
            }
        }

        impl Real for $Number {
            type Mask = bool;
            const UNIT_ROUNDOFF: f64 = $Number::EPSILON as f64 / 2.0;
            const MIN_POSITIVE: f64 = $Number::MIN_POSITIVE as f64;

            elementary_functions!();

            #[inline(always)]
            fn splat(value: f64) -> Self {
                value as $Number
            }

            #[inline(always)]
            fn from_fn(value: impl Fn(usize) -> f64) -> Self {
                value(0) as $Number
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if Self::IS_FUSED { $Number::mul_add(self, factor, addend) } else { self * factor + addend }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $Number::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $Number::abs(self)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $Number::copysign(self, sign)
            }

            #[inline(always)]
            fn less(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }

        impl Lanes for $Number {
            type Scalar = Self;
            type Interleaved = Self;
            const LANES: usize = 1;

            #[inline(always)]
            fn load(from: &[Self]) -> Self {
                from[0]
            }

            #[inline(always)]
            fn store(self, to: &mut [Self]) {
                to[0] = self;
            }

            #[inline(always)]
            fn bits(mask: bool) -> u64 {
                u64::from(mask)
            }
        }

        impl Primitive for $Number {
            const IS_FUSED: bool = cfg!(any(target_feature = "fma", target_arch = "aarch64"));

            #[inline(always)]
            fn is_zero(self) -> bool {
                self == 0.0
            }

            #[inline(always)]
            fn split(self) -> (Self, Self) {
                // Bit patterns of positive numbers, read as integers, are in order, and one exponent is 2 to
                // the width of the mantissa.
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

scalar!(f64, u64, i64, lanes F64, mantissa 52, bias 1023);
scalar!(f32, u32, i32, lanes F32, mantissa 23, bias 127);

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
