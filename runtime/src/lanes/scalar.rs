//! One number at a time: `f64` and `f32`.

use super::{Mask, Real};

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
    ($Real:ident, $Bits:ident, mantissa: $mantissa:literal, bias: $bias:literal, splitter: $splitter:literal) => {
        impl Real for $Real {
            type Mask = bool;

            const UNIT_ROUNDOFF: f64 = $Real::EPSILON as f64 / 2.0;
            const MIN_POSITIVE: f64 = $Real::MIN_POSITIVE as f64;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                value as $Real
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
                    $Real::mul_add(self, factor, addend)
                } else {
                    self * factor + addend
                }
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                $Real::sqrt(self)
            }

            #[inline(always)]
            fn cbrt(self) -> Self {
                $Real::cbrt(self)
            }

            #[inline(always)]
            fn ln(self) -> Self {
                $Real::ln(self)
            }

            #[inline(always)]
            fn exp(self) -> Self {
                $Real::exp(self)
            }

            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                $Real::powf(self, exponent)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                $Real::abs(self)
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                $Real::max(self, other)
            }

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                $Real::min(self, other)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $Real::copysign(self, sign)
            }

            #[inline(always)]
            fn less(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                $Real::is_finite(self)
            }

            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }

            #[inline(always)]
            fn two_product(self, other: Self) -> (Self, Self) {
                let product = self * other;
                if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
                    return (product, $Real::mul_add(self, other, -product));
                }
                // Veltkamp's splitting and Dekker's product: each half has few enough bits for exact products.
                let split = |x: $Real| {
                    let big = $splitter * x;
                    let high = big - (big - x);
                    (high, x - high)
                };
                let ((ah, al), (bh, bl)) = (split(self), split(other));
                (product, al * bl - (((product - ah * bh) - al * bh) - ah * bl))
            }

            #[inline(always)]
            fn power_of_two_scale(self) -> (Self, Self) {
                const EXPONENT: $Bits = 2 * $bias + 1;
                let biased = (self.to_bits() >> $mantissa) & EXPONENT;
                if self == 0.0 || biased == EXPONENT {
                    return (1.0, 1.0);
                }
                // Both 2^−e and 2^e are normal numbers for |e| ≤ bias − 1.
                let biased = biased.clamp(1, 2 * $bias - 1);
                ($Real::from_bits((2 * $bias - biased) << $mantissa), $Real::from_bits(biased << $mantissa))
            }
        }
    };
}

scalar!(f64, u64, mantissa: 52, bias: 1023, splitter: 134_217_729.0); // 2²⁷ + 1
scalar!(f32, u32, mantissa: 23, bias: 127, splitter: 4097.0); // 2¹² + 1

#[cfg(test)]
mod tests {
    use super::*;

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
