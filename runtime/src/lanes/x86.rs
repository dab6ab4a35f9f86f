//! Registers of x86-64: 512 bits with AVX-512, 256 bits with AVX2 and FMA.
//!
//! **Safety.** The intrinsics below must run on a processor that has their instructions. The types of this file are
//! named in one other place, `backend`, which instantiates kernels with them behind a check of the processor and inside a
//! function compiled for these instructions. Every method is inlined into that function.

#![expect(unsafe_code, reason = "vector instructions; see the module's text")]

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::pair::Pair;
use super::primitive::{Primitive, exponent_or_limit, lift};
use super::{Mask, PastCaches};

mod transpose;

/// Stores before are seen before those that follow, non-temporal ones too.
pub(super) fn order_stores() {
    // SAFETY: every processor of x86-64 has SSE.
    unsafe { _mm_sfence() }
}

/// Bit masks of AVX-512: one bit for each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneBits<const LANES: usize>(u16);

impl<const LANES: usize> LaneBits<LANES> {
    const ALL: u16 = u16::MAX >> (16 - LANES);
}

impl<const LANES: usize> Mask for LaneBits<LANES> {
    #[inline(always)]
    fn splat(value: bool) -> Self {
        Self(if value { Self::ALL } else { 0 })
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.0 != 0
    }
}

impl<const LANES: usize> BitAnd for LaneBits<LANES> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<const LANES: usize> BitOr for LaneBits<LANES> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<const LANES: usize> Not for LaneBits<LANES> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0 & Self::ALL)
    }
}

/// A register, with the operations that have the same shape in every format and width.
macro_rules! register {
    (
        $(#[$doc:meta])*
        $Register:ident($Raw:ident) of $lanes:literal $Number:ident, choice $Choice:ty,
        features $features:literal, fill $fill:ident, load $load:ident, store $store:ident, stream $stream:ident, turn $turn:path,
        add $add:ident, sub $sub:ident, mul $mul:ident, div $div:ident, fused $fused:ident,
        root $root:ident, larger $max:ident, smaller $min:ident, xor $xor:ident, and_not $and_not:ident,
        { $($rest:item)* }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub(super) struct $Register($Raw);

        register!(@operator $Register, Add add $add);
        register!(@operator $Register, Sub sub $sub);
        register!(@operator $Register, Mul mul $mul);
        register!(@operator $Register, Div div $div);

        impl Neg for $Register {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $xor(self.0, $fill(-0.0)) })
            }
        }

        // Functions of their own: inlined into every kernel they would only take its registers.
        impl $Register {
            #[target_feature(enable = $features)]
            fn copy_registers_past_caches(from: &[$Number], to: &mut [$Number]) {
                let is_aligned = to.as_ptr().cast::<$Register>().is_aligned();
                if !is_aligned || to.len() % $lanes != 0 || from.len() != to.len() {
                    return to.copy_from_slice(from);
                }
                let (to_registers, from_registers) =
                    (to.as_chunks_mut::<$lanes>().0, from.as_chunks::<$lanes>().0);
                for (to, from) in to_registers.iter_mut().zip(from_registers) {
                    // SAFETY: as many numbers are writable at the pointer as the register holds, and it is aligned to it.
                    unsafe { $stream(to.as_mut_ptr(), Self::read(from).0) }
                }
            }

            /// A matrix of at least one square, square by square; the last one of a row or column overlaps the one before.
            #[target_feature(enable = $features)]
            fn turn_squares(
                [rows, columns]: [usize; 2],
                from: &[$Number],
                from_stride: usize,
                to: &mut [$Number],
                to_stride: usize,
            ) {
                let mut i = 0;
                while i < rows {
                    i = i.min(rows - $lanes);
                    let mut j = 0;
                    while j < columns {
                        j = j.min(columns - $lanes);
                        let from = &from[i * from_stride + j..][..($lanes - 1) * from_stride + $lanes];
                        let to = &mut to[j * to_stride + i..][..($lanes - 1) * to_stride + $lanes];
                        let mut square = [Self::fill(0.0).0; $lanes];
                        for k in 0..$lanes {
                            square[k] = Self::read(&from[k * from_stride..]).0;
                        }
                        // SAFETY: this function has the condition of that one.
                        let square = unsafe { $turn(square) };
                        for k in 0..$lanes {
                            Self(square[k]).write(&mut to[k * to_stride..]);
                        }
                        j += $lanes;
                    }
                    i += $lanes;
                }
            }
        }

        impl Primitive for $Register {
            type Choice = $Choice;
            type Format = $Number;
            type Interleaved = Pair<Pair<Self>>;
            const COUNT: usize = $lanes;
            const IS_FUSED: bool = true;

            #[inline(always)]
            fn fill(value: f64) -> Self {
                // SAFETY: the processor has this instruction: only `backend` names this type, behind a check.
                Self(unsafe { $fill(value as $Number) })
            }

            #[inline(always)]
            fn each(value: impl Fn(usize) -> f64) -> Self {
                Self::read(&std::array::from_fn::<$Number, $lanes, _>(|lane| value(lane) as $Number))
            }

            #[inline(always)]
            fn read(from: &[$Number]) -> Self {
                let from = &from[..$lanes];
                // SAFETY: as many numbers are readable from the pointer as the register holds.
                Self(unsafe { $load(from.as_ptr()) })
            }

            #[inline(always)]
            fn write(self, to: &mut [$Number]) {
                let to = &mut to[..$lanes];
                // SAFETY: as many numbers are writable at the pointer as the register holds.
                unsafe { $store(to.as_mut_ptr(), self.0) }
            }

            #[inline(always)]
            fn copy_past_caches(from: &[$Number], to: &mut [$Number], _: &PastCaches) {
                // SAFETY: the processor has the instructions, or nobody would name this type.
                unsafe { Self::copy_registers_past_caches(from, to) }
            }

            #[inline(always)]
            fn turn(
                size: [usize; 2],
                from: &[$Number],
                from_stride: usize,
                to: &mut [$Number],
                to_stride: usize,
            ) {
                if size[0] < $lanes || size[1] < $lanes {
                    return <$Number as Primitive>::turn(size, from, from_stride, to, to_stride);
                }
                // SAFETY: the processor has the instructions, or nobody would name this type.
                unsafe { Self::turn_squares(size, from, from_stride, to, to_stride) }
            }

            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $fused(self.0, factor.0, addend.0) })
            }

            #[inline(always)]
            fn root(self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $root(self.0) })
            }

            #[inline(always)]
            fn magnitude(self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $and_not($fill(-0.0), self.0) })
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $max(self.0, other.0) })
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $min(self.0, other.0) })
            }

            $($rest)*
        }
    };
    (@operator $Register:ident, $Operator:ident $method:ident $intrinsic:ident) => {
        impl $Operator for $Register {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}

/// The mantissa of a negative number is NaN, that of −0 is positive.
const POSITIVE_OR_NAN: _MM_MANTISSA_SIGN_ENUM = _MM_MANT_SIGN_NAN | _MM_MANT_SIGN_ZERO;

/// What AVX-512 does alike in both formats.
macro_rules! register_512 {
    (
        $(#[$doc:meta])*
        $Register:ident($Raw:ident) of $lanes:literal $Number:ident,
        compare $compare:ident as $Bits:ident, blend $blend:ident, rough $rsqrt:ident,
        mantissa $mantissa:ident, exponent $exponent:ident, scale $scale:ident, logic $logic:ident,
        casts $to_bits:ident $from_bits:ident, integers $set_bits:ident $subtract:ident,
        constants: $sign:expr, $power:expr, $two_biases:expr,
        refine: |$x:ident, $y:ident| $refine:expr,
        $($operations:tt)*
    ) => {
        register! {
            $(#[$doc])*
            $Register($Raw) of $lanes $Number, choice LaneBits<$lanes>,
            $($operations)*
            {
                #[inline(always)]
                fn choice_bits(choice: LaneBits<$lanes>) -> u64 {
                    u64::from(choice.0)
                }

                #[inline(always)]
                fn is_less(self, other: Self) -> LaneBits<$lanes> {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    LaneBits(unsafe { $compare::<_CMP_LT_OQ>(self.0, other.0) }.into())
                }

                #[inline(always)]
                fn is_zero(self) -> LaneBits<$lanes> {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    LaneBits(unsafe { $compare::<_CMP_EQ_OQ>(self.0, Self::fill(0.0).0) }.into())
                }

                #[inline(always)]
                fn choose(choice: LaneBits<$lanes>, yes: Self, no: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $blend(choice.0 as $Bits, no.0, yes.0) })
                }

                #[inline(always)]
                fn reciprocal_root(self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    let ($x, $y) = (self, Self(unsafe { $rsqrt(self.0) }));
                    $refine
                }

                #[inline(always)]
                fn rough_root(self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    self * Self(unsafe { $rsqrt(self.0) })
                }

                #[inline(always)]
                fn with_sign(self, sign: Self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type. The table
                    // picks a bit of `sign` where the last operand is set, else one of self.
                    unsafe {
                        let sign_bit = $set_bits($sign);
                        Self($from_bits($logic::<0xb8>($to_bits(self.0), sign_bit, $to_bits(sign.0))))
                    }
                }

                #[inline(always)]
                fn split(self) -> (Self, Self) {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    let (m, e) = unsafe {
                        let m = $mantissa::<_MM_MANT_NORM_1_2, POSITIVE_OR_NAN>(self.0);
                        (Self(m), Self($exponent(self.0)))
                    };
                    // √2 and what is larger is halved: one comparison and two operations under its mask.
                    let below = $Number::from_bits(std::$Number::consts::SQRT_2.to_bits() - 1);
                    let is_large = Self::fill(below.into()).is_less(m);
                    let (half, one) = (Self::fill(0.5), Self::fill(1.0));
                    (Self::choose(is_large, m * half, m), Self::choose(is_large, e + one, e))
                }

                #[inline(always)]
                fn scale(self, exponent: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $scale(self.0, exponent.0) })
                }

                #[inline(always)]
                fn leading_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type. The table
                    // is a & b.
                    unsafe {
                        let bits = $to_bits(self.0);
                        Self($from_bits($logic::<0xc0>(bits, $set_bits($power), bits)))
                    }
                }

                #[inline(always)]
                fn reciprocal_of_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $from_bits($subtract($set_bits($two_biases), $to_bits(self.0))) })
                }
            }
        }
    };
}

register_512! {
    /// Eight doubles in a register of AVX-512.
    F64x8(__m512d) of 8 f64,
    compare _mm512_cmp_pd_mask as __mmask8, blend _mm512_mask_blend_pd, rough _mm512_rsqrt14_pd,
    mantissa _mm512_getmant_pd, exponent _mm512_getexp_pd, scale _mm512_scalef_pd,
    logic _mm512_ternarylogic_epi64, casts _mm512_castpd_si512 _mm512_castsi512_pd,
    integers _mm512_set1_epi64 _mm512_sub_epi64,
    constants: i64::MIN, 0x7ff << 52, 2046 << 52,
    // With e = 1 − x y² < 2⁻¹³: 1/√x = y (1 + e/2 + 3e²/8 + 5e³/16 + …), and e⁴ is below u/2.
    refine: |x, y| {
        let e = (-(x * y)).fused(y, Self::fill(1.0));
        let series = e.fused(Self::fill(0.3125), Self::fill(0.375)).fused(e, Self::fill(0.5));
        y.fused(e * series, y)
    },
    features "avx512f", fill _mm512_set1_pd, load _mm512_loadu_pd, store _mm512_storeu_pd, stream _mm512_stream_pd, turn transpose::turn_f64x8,
    add _mm512_add_pd, sub _mm512_sub_pd, mul _mm512_mul_pd, div _mm512_div_pd, fused _mm512_fmadd_pd,
    root _mm512_sqrt_pd, larger _mm512_max_pd, smaller _mm512_min_pd,
    xor _mm512_xor_pd, and_not _mm512_andnot_pd,
}

register_512! {
    /// Sixteen floats in a register of AVX-512.
    F32x16(__m512) of 16 f32,
    compare _mm512_cmp_ps_mask as __mmask16, blend _mm512_mask_blend_ps, rough _mm512_rsqrt14_ps,
    mantissa _mm512_getmant_ps, exponent _mm512_getexp_ps, scale _mm512_scalef_ps,
    logic _mm512_ternarylogic_epi32, casts _mm512_castps_si512 _mm512_castsi512_ps,
    integers _mm512_set1_epi32 _mm512_sub_epi32,
    constants: i32::MIN, 0xff << 23, 254 << 23,
    // One Newton step: the error 3e²/8 with e < 2⁻¹³ is below u/4.
    refine: |x, y| {
        let e = (-(x * y)).fused(y, Self::fill(1.0));
        y.fused(e * Self::fill(0.5), y)
    },
    features "avx512f", fill _mm512_set1_ps, load _mm512_loadu_ps, store _mm512_storeu_ps, stream _mm512_stream_ps, turn transpose::turn_f32x16,
    add _mm512_add_ps, sub _mm512_sub_ps, mul _mm512_mul_ps, div _mm512_div_ps, fused _mm512_fmadd_ps,
    root _mm512_sqrt_ps, larger _mm512_max_ps, smaller _mm512_min_ps,
    xor _mm512_xor_ps, and_not _mm512_andnot_ps,
}

/// What AVX2 does alike in both formats: a choice is a register whose lanes are all ones or all zeros.
macro_rules! register_256 {
    (
        $(#[$doc:meta])*
        $Register:ident($Raw:ident) of $lanes:literal $Number:ident, choice $Choice:ident,
        compare $compare:ident, blend $blend:ident, bits $movemask:ident,
        and $and:ident, or $or:ident, casts $to_bits:ident $from_bits:ident,
        integers $set_bits:ident $subtract:ident $shift_left:ident, mantissa $mantissa:literal,
        constants: $power:expr, $two_biases:expr, $bias:expr,
        roots: |$x:ident| $reciprocal_root:expr, $rough_root:expr,
        split: |$split:ident| $split_body:expr,
        xor $xor:ident, and_not $and_not:ident,
        $($operations:tt)*
    ) => {
        /// The result of a comparison, all bits of a lane alike.
        #[derive(Clone, Copy, Debug)]
        pub(super) struct $Choice($Raw);

        impl Mask for $Choice {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                let ones = if value { -1 } else { 0 };
                // SAFETY: the processor has this instruction: only `backend` names this type, behind a check.
                Self(unsafe { $from_bits($set_bits(ones)) })
            }
            #[inline(always)]
            fn any(self) -> bool {
                $Register::choice_bits(self) != 0
            }
        }

        impl BitAnd for $Choice {
            type Output = Self;
            #[inline(always)]
            fn bitand(self, other: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $and(self.0, other.0) })
            }
        }

        impl BitOr for $Choice {
            type Output = Self;
            #[inline(always)]
            fn bitor(self, other: Self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $or(self.0, other.0) })
            }
        }

        impl Not for $Choice {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                let ones = Self::splat(true);
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $xor(self.0, ones.0) })
            }
        }

        impl $Register {
            /// 2ᵉ, where it is normal.
            #[inline(always)]
            fn power_of_two(exponent: Self) -> Self {
                let biased = exponent + Self::fill(<$Number as super::Element>::ROUNDING + $bias);
                // SAFETY: the processor has these instructions, or there would be no value of this type.
                Self(unsafe { $from_bits($shift_left::<$mantissa>($to_bits(biased.0))) })
            }
        }

        register! {
            $(#[$doc])*
            $Register($Raw) of $lanes $Number, choice $Choice,
            $($operations)* xor $xor, and_not $and_not,
            {
                #[inline(always)]
                fn choice_bits(choice: $Choice) -> u64 {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    u64::from(unsafe { $movemask(choice.0) } as u32)
                }

                #[inline(always)]
                fn is_less(self, other: Self) -> $Choice {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    $Choice(unsafe { $compare::<_CMP_LT_OQ>(self.0, other.0) })
                }

                #[inline(always)]
                fn is_zero(self) -> $Choice {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    $Choice(unsafe { $compare::<_CMP_EQ_OQ>(self.0, Self::fill(0.0).0) })
                }

                #[inline(always)]
                fn choose(choice: $Choice, yes: Self, no: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $blend(no.0, yes.0, choice.0) })
                }

                #[inline(always)]
                fn reciprocal_root(self) -> Self {
                    let $x = self;
                    $reciprocal_root
                }

                #[inline(always)]
                fn rough_root(self) -> Self {
                    let $x = self;
                    $rough_root
                }

                #[inline(always)]
                fn with_sign(self, sign: Self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $or(self.magnitude().0, $and(sign.0, Self::fill(-0.0).0)) })
                }

                #[inline(always)]
                fn split(self) -> (Self, Self) {
                    let ($split, lift) = lift(self);
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    let (m, e) = unsafe { $split_body };
                    (m, exponent_or_limit(self, e - lift))
                }

                #[inline(always)]
                fn scale(self, exponent: Self) -> Self {
                    let rounding = Self::fill(<$Number as super::Element>::ROUNDING);
                    // Two factors, since 2ᵉ itself may be out of range; the first product is exact.
                    let first = exponent.fused(Self::fill(0.5), rounding) - rounding;
                    self * Self::power_of_two(first) * Self::power_of_two(exponent - first)
                }

                #[inline(always)]
                fn leading_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $and(self.0, $from_bits($set_bits($power))) })
                }

                #[inline(always)]
                fn reciprocal_of_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $from_bits($subtract($set_bits($two_biases), $to_bits(self.0))) })
                }
            }
        }
    };
}

register_256! {
    /// Four doubles in a register of AVX2.
    F64x4(__m256d) of 4 f64, choice F64x4Choice,
    compare _mm256_cmp_pd, blend _mm256_blendv_pd, bits _mm256_movemask_pd,
    and _mm256_and_pd, or _mm256_or_pd, casts _mm256_castpd_si256 _mm256_castsi256_pd,
    integers _mm256_set1_epi64x _mm256_sub_epi64 _mm256_slli_epi64, mantissa 52,
    constants: 0x7ff << 52, 2046 << 52, 1023.0,
    roots: |x| Self::fill(1.0) / x.root(), x.root(),
    split: |x| {
        // There is no arithmetic shift of 64 bits: 1024 is added to the exponent first.
        let offset = _mm256_set1_epi64x((1024 << 52) - std::f64::consts::FRAC_1_SQRT_2.to_bits() as i64);
        let shifted = _mm256_srli_epi64::<52>(_mm256_add_epi64(_mm256_castpd_si256(x.0), offset));
        let exponent = _mm256_sub_epi64(shifted, _mm256_set1_epi64x(1024));
        let m = _mm256_sub_epi64(_mm256_castpd_si256(x.0), _mm256_slli_epi64::<52>(exponent));
        let rounding = Self::fill(<f64 as super::Element>::ROUNDING);
        let e = _mm256_add_epi64(exponent, _mm256_castpd_si256(rounding.0));
        (Self(_mm256_castsi256_pd(m)), Self(_mm256_castsi256_pd(e)) - rounding)
    },
    xor _mm256_xor_pd, and_not _mm256_andnot_pd,
    features "avx2,fma", fill _mm256_set1_pd, load _mm256_loadu_pd, store _mm256_storeu_pd, stream _mm256_stream_pd, turn transpose::turn_f64x4,
    add _mm256_add_pd, sub _mm256_sub_pd, mul _mm256_mul_pd, div _mm256_div_pd, fused _mm256_fmadd_pd,
    root _mm256_sqrt_pd, larger _mm256_max_pd, smaller _mm256_min_pd,
}

register_256! {
    /// Eight floats in a register of AVX2.
    F32x8(__m256) of 8 f32, choice F32x8Choice,
    compare _mm256_cmp_ps, blend _mm256_blendv_ps, bits _mm256_movemask_ps,
    and _mm256_and_ps, or _mm256_or_ps, casts _mm256_castps_si256 _mm256_castsi256_ps,
    integers _mm256_set1_epi32 _mm256_sub_epi32 _mm256_slli_epi32, mantissa 23,
    constants: 0xff << 23, 254 << 23, 127.0,
    roots: |x| {
        // Eleven bits and a cubic step: with e = 1 − x y² < 2⁻¹⁰ the next term, 5e³/16, is below u/4.
        // SAFETY: the processor has this instruction, or there would be no value of this type.
        let y = Self(unsafe { _mm256_rsqrt_ps(x.0) });
        let e = (-(x * y)).fused(y, Self::fill(1.0));
        y.fused(e * e.fused(Self::fill(0.375), Self::fill(0.5)), y)
    }, {
        // SAFETY: the processor has this instruction, or there would be no value of this type.
        let y = Self(unsafe { _mm256_rsqrt_ps(x.0) });
        let e = (-(x * y)).fused(y, Self::fill(1.0));
        x * y.fused(e * Self::fill(0.5), y)
    },
    split: |x| {
        let smallest = _mm256_set1_epi32(std::f32::consts::FRAC_1_SQRT_2.to_bits() as i32);
        let exponent =
            _mm256_srai_epi32::<23>(_mm256_sub_epi32(_mm256_castps_si256(x.0), smallest));
        let m = _mm256_sub_epi32(_mm256_castps_si256(x.0), _mm256_slli_epi32::<23>(exponent));
        (Self(_mm256_castsi256_ps(m)), Self(_mm256_cvtepi32_ps(exponent)))
    },
    xor _mm256_xor_ps, and_not _mm256_andnot_ps,
    features "avx2,fma", fill _mm256_set1_ps, load _mm256_loadu_ps, store _mm256_storeu_ps, stream _mm256_stream_ps, turn transpose::turn_f32x8,
    add _mm256_add_ps, sub _mm256_sub_ps, mul _mm256_mul_ps, div _mm256_div_ps, fused _mm256_fmadd_ps,
    root _mm256_sqrt_ps, larger _mm256_max_ps, smaller _mm256_min_ps,
}
