//! Registers of x86-64: 512 bits with AVX-512, 256 bits with AVX2 and FMA.
//!
//! **Safety.** The intrinsics below must run on a processor that has their instructions. The types of this
//! file are named in one other place, `backend`. There kernels are instantiated with them behind a check of
//! the processor, inside a function compiled for these instructions, and every method is inlined into it.

#![expect(unsafe_code, reason = "vector instructions; see the module's text")]

use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use super::elementary::elementary_functions;
use super::lanes2::Lanes2;
use super::primitive::{Primitive, exponent_or_limit, lift};
use super::real::{Mask, Real};
use super::vector::{Lanes, Scalar};

mod transpose;

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
        $Register:ident($Raw:ident) of $lanes:literal $Number:ident, mask $Mask:ty,
        compare $compare:ident |$compared:ident| $mask_of:expr, casts $to_bits:ident $from_bits:ident,
        integers $set_bits:ident $subtract:ident, two_biases $two_biases:expr,
        features $features:literal, splat $splat:ident, load $load:ident, store $store:ident,
        transpose $transpose:path, narrower $Narrower:ident, add $add:ident, sub $sub:ident, mul $mul:ident, div $div:ident,
        mul_add $mul_add:ident, sqrt $sqrt:ident, max $max:ident, min $min:ident,
        xor $xor:ident, and_not $and_not:ident,
        bits |$bits_of:ident| $bits:expr,
        real { $($real:item)* } primitive { $($primitive:item)* }
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
                Self(unsafe { $xor(self.0, $splat(-0.0)) })
            }
        }

        // Functions of their own: inlined into every kernel they would only take its registers.
        impl $Register {
            /// Transposes a matrix whose rows are FROM apart into one whose rows are TO apart, by squares, at
            /// least one. What is left is a square that overlaps its neighbour, or, if it is narrow, copied.
            #[target_feature(enable = $features)]
            fn transpose_squares<const FROM: usize, const TO: usize>(
                rows: usize,
                columns: usize,
                from: &[$Number],
                to: &mut [$Number],
            ) {
                const LINE: usize = <$Number as Scalar>::LINE;
                // Registers that are lines have as many points. By constants, loops over few components are
                // unrolled; over many that takes the compiler long.
                const FEW: usize = 2 * LINE;
                let (rows, columns) = match ($lanes, FROM, TO) {
                    (LINE, ..=FEW, LINE) => (LINE, FROM),
                    (LINE, LINE, ..=FEW) => (TO, LINE),
                    _ => (rows, columns),
                };
                // There is a square, and all before the end of the last row, so every entry, is in its slice.
                assert!(rows >= $lanes && columns >= $lanes);
                assert!((rows - 1).saturating_mul(FROM).saturating_add(columns) <= from.len());
                assert!((columns - 1).saturating_mul(TO).saturating_add(rows) <= to.len());
                let (length, from, to) = (to.len(), from.as_ptr(), to.as_mut_ptr());
                let in_squares = |count: usize| match count % $lanes {
                    narrow if narrow <= $lanes / 8 => count - narrow,
                    _ => count,
                };
                let (square_rows, square_columns) = (in_squares(rows), in_squares(columns));
                let mut i = 0;
                while i < square_rows {
                    i = i.min(square_rows - $lanes);
                    let mut j = 0;
                    while j < square_columns {
                        j = j.min(square_columns - $lanes);
                        // SAFETY: `$lanes` rows of either matrix from i and j on have `$lanes` entries
                        // each, which are in their slices, as is what is asked for ahead; the processor has
                        // what `$transpose` needs.
                        unsafe {
                            let square = $transpose(from.add(i * FROM + j), FROM);
                            // Rows that are not whole lines of the cache straddle them, and a store to two
                            // lines waits for both: those of the next rows are asked for. With smaller
                            // registers, and of short or aligned rows, that costs more than it gains.
                            let next = (j + $lanes) * TO + i;
                            let straddles = $lanes == LINE && TO > 2 * LINE && TO % LINE != 0;
                            if straddles && next + $lanes * TO <= length {
                                for k in 0..$lanes {
                                    _mm_prefetch::<_MM_HINT_ET0>(to.add(next + k * TO).cast());
                                }
                            }
                            for k in 0..$lanes {
                                $store(to.add((j + k) * TO + i), square[k]);
                            }
                        }
                        j += $lanes;
                    }
                    i += $lanes;
                }
                for i in square_rows..rows {
                    for j in (0..columns).step_by($lanes).map(|j| j.min(columns - $lanes)) {
                        for k in 0..$lanes {
                            // SAFETY: the entry is in its slice.
                            unsafe { *to.add((j + k) * TO + i) = *from.add(i * FROM + j + k) }
                        }
                    }
                }
                for j in square_columns..columns {
                    for i in (0..rows).step_by($lanes).map(|i| i.min(rows - $lanes)) {
                        for k in 0..$lanes {
                            // SAFETY: as above.
                            unsafe { *to.add(j * TO + i + k) = *from.add((i + k) * FROM + j) }
                        }
                    }
                }
            }
        }

        impl Real for $Register {
            type Mask = $Mask;
            const UNIT_ROUNDOFF: f64 = <$Number as Real>::UNIT_ROUNDOFF;
            const MIN_POSITIVE: f64 = <$Number as Real>::MIN_POSITIVE;

            elementary_functions!();
            register!(@method mul_add(factor, addend) $mul_add);
            register!(@method sqrt() $sqrt);
            register!(@method max(other) $max);
            register!(@method min(other) $min);

            #[inline(always)]
            fn splat(value: f64) -> Self {
                // SAFETY: the processor has this instruction: only `backend` names this type, behind a check.
                Self(unsafe { $splat(value as $Number) })
            }

            #[inline(always)]
            fn from_fn(value: impl Fn(usize) -> f64) -> Self {
                Self::load(&std::array::from_fn::<$Number, $lanes, _>(|lane| value(lane) as $Number))
            }

            #[inline(always)]
            fn abs(self) -> Self {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $and_not($splat(-0.0), self.0) })
            }

            #[inline(always)]
            fn less(self, other: Self) -> $Mask {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                let $compared = unsafe { $compare::<_CMP_LT_OQ>(self.0, other.0) };
                $mask_of
            }

            $($real)*
        }

        impl Lanes for $Register {
            type Scalar = $Number;
            type Interleaved = Lanes2<Self>;
            const LANES: usize = $lanes;

            #[inline(always)]
            fn load(from: &[$Number]) -> Self {
                let from = &from[..$lanes];
                // SAFETY: `from` is as long as the register.
                Self(unsafe { $load(from.as_ptr()) })
            }

            #[inline(always)]
            fn store(self, to: &mut [$Number]) {
                let to = &mut to[..$lanes];
                // SAFETY: `to` is as long as the register.
                unsafe { $store(to.as_mut_ptr(), self.0) }
            }

            #[inline(always)]
            fn points_to_line<const N: usize>(from: &[$Number], to: &mut [$Number]) {
                const LINE: usize = <$Number as Scalar>::LINE;
                let points = from.len() / N;
                if points < $lanes || N < $lanes {
                    return $Narrower::points_to_line::<N>(from, to);
                }
                // SAFETY: the processor has the instructions: only `backend` names this type, behind a check.
                unsafe { Self::transpose_squares::<N, LINE>(points, N, from, to) }
            }

            #[inline(always)]
            fn line_to_points<const N: usize>(from: &[$Number], points: usize, to: &mut [$Number]) {
                const LINE: usize = <$Number as Scalar>::LINE;
                if points < $lanes || N < $lanes {
                    return $Narrower::line_to_points::<N>(from, points, to);
                }
                // SAFETY: the processor has the instructions: only `backend` names this type, behind a check.
                unsafe { Self::transpose_squares::<LINE, N>(N, points, from, to) }
            }

            #[inline(always)]
            fn bits($bits_of: $Mask) -> u64 {
                $bits
            }
        }

        impl Primitive for $Register {
            const IS_FUSED: bool = true;

            #[inline(always)]
            fn is_zero(self) -> $Mask {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                let $compared = unsafe { $compare::<_CMP_EQ_OQ>(self.0, Self::splat(0.0).0) };
                $mask_of
            }

            #[inline(always)]
            fn reciprocal_of_power(self) -> Self {
                // SAFETY: the processor has these instructions, or there would be no value of this type.
                Self(unsafe { $from_bits($subtract($set_bits($two_biases), $to_bits(self.0))) })
            }

            $($primitive)*
        }
    };
    (@operator $Register:ident, $Operator:ident $method:ident $intrinsic:ident) => {
        impl $Operator for $Register {
            type Output = Self;
            register!(@method $method(other) $intrinsic);
        }
    };
    (@method $method:ident($($other:ident),*) $intrinsic:ident) => {
        #[inline(always)]
        fn $method(self $(, $other: Self)*) -> Self {
            // SAFETY: the processor has this instruction, or there would be no value of this type.
            Self(unsafe { $intrinsic(self.0 $(, $other.0)*) })
        }
    };
}

/// The mantissa of a negative number is NaN, that of −0 is positive.
const POSITIVE_OR_NAN: _MM_MANTISSA_SIGN_ENUM = _MM_MANT_SIGN_NAN | _MM_MANT_SIGN_ZERO;

/// Operations that AVX-512 has alike in both formats.
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
            $Register($Raw) of $lanes $Number, mask LaneBits<$lanes>,
            compare $compare |bits| LaneBits(bits.into()), casts $to_bits $from_bits,
            integers $set_bits $subtract, two_biases $two_biases,
            $($operations)*
            bits |mask| u64::from(mask.0),
            real {
                const HAS_MANY_REGISTERS: bool = true;

                #[inline(always)]
                fn select(mask: LaneBits<$lanes>, yes: Self, no: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $blend(mask.0 as $Bits, no.0, yes.0) })
                }

                #[inline(always)]
                fn reciprocal_sqrt(self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    let ($x, $y) = (self, Self(unsafe { $rsqrt(self.0) }));
                    $refine
                }

                #[inline(always)]
                fn copysign(self, sign: Self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    // The table picks a bit of `sign` where the last operand is set, else one of self.
                    unsafe {
                        let sign_bit = $set_bits($sign);
                        Self($from_bits($logic::<0xb8>($to_bits(self.0), sign_bit, $to_bits(sign.0))))
                    }
                }
            }
            primitive {
                #[inline(always)]
                fn split(self) -> (Self, Self) {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    let (m, e) = unsafe {
                        let m = $mantissa::<_MM_MANT_NORM_1_2, POSITIVE_OR_NAN>(self.0);
                        (Self(m), Self($exponent(self.0)))
                    };
                    // m ≥ √2 is halved: one comparison and two operations under its mask.
                    let below = $Number::from_bits(std::$Number::consts::SQRT_2.to_bits() - 1);
                    let is_large = Self::splat(below.into()).less(m);
                    let (half, one) = (Self::splat(0.5), Self::splat(1.0));
                    (Self::select(is_large, m * half, m), Self::select(is_large, e + one, e))
                }

                #[inline(always)]
                fn scale(self, exponent: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $scale(self.0, exponent.0) })
                }

                #[inline(always)]
                fn leading_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    // The table is a & b.
                    unsafe {
                        let bits = $to_bits(self.0);
                        Self($from_bits($logic::<0xc0>(bits, $set_bits($power), bits)))
                    }
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
        let e = (-(x * y)).mul_add(y, Self::splat(1.0));
        let series = e.mul_add(Self::splat(0.3125), Self::splat(0.375)).mul_add(e, Self::splat(0.5));
        y.mul_add(e * series, y)
    },
    features "avx512f,avx512dq", splat _mm512_set1_pd, load _mm512_loadu_pd, store _mm512_storeu_pd,
    transpose transpose::transpose_f64x8, narrower F64x4,
    add _mm512_add_pd, sub _mm512_sub_pd, mul _mm512_mul_pd, div _mm512_div_pd,
    mul_add _mm512_fmadd_pd, sqrt _mm512_sqrt_pd, max _mm512_max_pd, min _mm512_min_pd,
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
        let e = (-(x * y)).mul_add(y, Self::splat(1.0));
        y.mul_add(e * Self::splat(0.5), y)
    },
    features "avx512f,avx512dq", splat _mm512_set1_ps, load _mm512_loadu_ps, store _mm512_storeu_ps,
    transpose transpose::transpose_f32x16, narrower F32x8,
    add _mm512_add_ps, sub _mm512_sub_ps, mul _mm512_mul_ps, div _mm512_div_ps,
    mul_add _mm512_fmadd_ps, sqrt _mm512_sqrt_ps, max _mm512_max_ps, min _mm512_min_ps,
    xor _mm512_xor_ps, and_not _mm512_andnot_ps,
}

/// Operations that AVX2 has alike in both formats. A mask is a register.
macro_rules! register_256 {
    (
        $(#[$doc:meta])*
        $Register:ident($Raw:ident) of $lanes:literal $Number:ident, mask $Mask:ident,
        compare $compare:ident, blend $blend:ident, bits $movemask:ident,
        and $and:ident, or $or:ident, casts $to_bits:ident $from_bits:ident,
        integers $set_bits:ident $subtract:ident $shift_left:ident, mantissa $mantissa:literal,
        constants: $power:expr, $two_biases:expr, $bias:expr,
        roots: |$x:ident| $reciprocal_sqrt:expr,
        split: |$split:ident| $split_body:expr,
        xor $xor:ident, and_not $and_not:ident,
        $($operations:tt)*
    ) => {
        /// The result of a comparison: the bits of a lane are all ones or all zeros.
        #[derive(Clone, Copy, Debug)]
        pub(super) struct $Mask($Raw);

        impl Mask for $Mask {
            #[inline(always)]
            fn splat(value: bool) -> Self {
                let ones = if value { -1 } else { 0 };
                // SAFETY: the processor has this instruction: only `backend` names this type, behind a check.
                Self(unsafe { $from_bits($set_bits(ones)) })
            }
            #[inline(always)]
            fn any(self) -> bool {
                $Register::bits(self) != 0
            }
        }

        register!(@operator $Mask, BitAnd bitand $and);
        register!(@operator $Mask, BitOr bitor $or);

        impl Not for $Mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                let ones = Self::splat(true);
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                Self(unsafe { $xor(self.0, ones.0) })
            }
        }

        impl $Register {
            /// 2ᵉ for the exponent of a normal number.
            #[inline(always)]
            fn power_of_two(exponent: Self) -> Self {
                let biased = exponent + Self::splat(<$Number as Primitive>::ROUNDING + $bias);
                // SAFETY: the processor has these instructions, or there would be no value of this type.
                Self(unsafe { $from_bits($shift_left::<$mantissa>($to_bits(biased.0))) })
            }
        }

        register! {
            $(#[$doc])*
            $Register($Raw) of $lanes $Number, mask $Mask,
            compare $compare |bits| $Mask(bits), casts $to_bits $from_bits,
            integers $set_bits $subtract, two_biases $two_biases,
            $($operations)* xor $xor, and_not $and_not,
            bits |mask| {
                // SAFETY: the processor has this instruction, or there would be no value of this type.
                u64::from(unsafe { $movemask(mask.0) } as u32)
            },
            real {
                #[inline(always)]
                fn select(mask: $Mask, yes: Self, no: Self) -> Self {
                    // SAFETY: the processor has this instruction, or there would be no value of this type.
                    Self(unsafe { $blend(no.0, yes.0, mask.0) })
                }

                #[inline(always)]
                fn reciprocal_sqrt(self) -> Self {
                    let $x = self;
                    $reciprocal_sqrt
                }

                #[inline(always)]
                fn copysign(self, sign: Self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $or(self.abs().0, $and(sign.0, Self::splat(-0.0).0)) })
                }
            }
            primitive {
                #[inline(always)]
                fn split(self) -> (Self, Self) {
                    let ($split, lift) = lift(self);
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    let (m, e) = unsafe { $split_body };
                    (m, exponent_or_limit(self, e - lift))
                }

                #[inline(always)]
                fn scale(self, exponent: Self) -> Self {
                    let rounding = Self::splat(Self::ROUNDING);
                    // Two factors, since 2ᵉ itself may be out of range; the first product is exact.
                    let first = exponent.mul_add(Self::splat(0.5), rounding) - rounding;
                    self * Self::power_of_two(first) * Self::power_of_two(exponent - first)
                }

                #[inline(always)]
                fn leading_power(self) -> Self {
                    // SAFETY: the processor has these instructions, or there would be no value of this type.
                    Self(unsafe { $and(self.0, $from_bits($set_bits($power))) })
                }
            }
        }
    };
}

register_256! {
    /// Four doubles in a register of AVX2.
    F64x4(__m256d) of 4 f64, mask F64x4Mask,
    compare _mm256_cmp_pd, blend _mm256_blendv_pd, bits _mm256_movemask_pd,
    and _mm256_and_pd, or _mm256_or_pd, casts _mm256_castpd_si256 _mm256_castsi256_pd,
    integers _mm256_set1_epi64x _mm256_sub_epi64 _mm256_slli_epi64, mantissa 52,
    constants: 0x7ff << 52, 2046 << 52, 1023.0,
    roots: |x| Self::splat(1.0) / x.sqrt(),
    split: |x| {
        // There is no arithmetic shift of 64 bits: 1024 is added to the exponent first.
        let offset = _mm256_set1_epi64x((1024 << 52) - std::f64::consts::FRAC_1_SQRT_2.to_bits() as i64);
        let shifted = _mm256_srli_epi64::<52>(_mm256_add_epi64(_mm256_castpd_si256(x.0), offset));
        let exponent = _mm256_sub_epi64(shifted, _mm256_set1_epi64x(1024));
        let m = _mm256_sub_epi64(_mm256_castpd_si256(x.0), _mm256_slli_epi64::<52>(exponent));
        let rounding = Self::splat(Self::ROUNDING);
        let e = _mm256_add_epi64(exponent, _mm256_castpd_si256(rounding.0));
        (Self(_mm256_castsi256_pd(m)), Self(_mm256_castsi256_pd(e)) - rounding)
    },
    xor _mm256_xor_pd, and_not _mm256_andnot_pd,
    features "avx2,fma", splat _mm256_set1_pd, load _mm256_loadu_pd, store _mm256_storeu_pd,
    transpose transpose::transpose_f64x4, narrower f64,
    add _mm256_add_pd, sub _mm256_sub_pd, mul _mm256_mul_pd, div _mm256_div_pd,
    mul_add _mm256_fmadd_pd, sqrt _mm256_sqrt_pd, max _mm256_max_pd, min _mm256_min_pd,
}

register_256! {
    /// Eight floats in a register of AVX2.
    F32x8(__m256) of 8 f32, mask F32x8Mask,
    compare _mm256_cmp_ps, blend _mm256_blendv_ps, bits _mm256_movemask_ps,
    and _mm256_and_ps, or _mm256_or_ps, casts _mm256_castps_si256 _mm256_castsi256_ps,
    integers _mm256_set1_epi32 _mm256_sub_epi32 _mm256_slli_epi32, mantissa 23,
    constants: 0xff << 23, 254 << 23, 127.0,
    roots: |x| {
        // Eleven bits and a cubic step: with e = 1 − x y² < 2⁻¹⁰ the next term, 5e³/16, is below u/4.
        // SAFETY: the processor has this instruction, or there would be no value of this type.
        let y = Self(unsafe { _mm256_rsqrt_ps(x.0) });
        let e = (-(x * y)).mul_add(y, Self::splat(1.0));
        y.mul_add(e * e.mul_add(Self::splat(0.375), Self::splat(0.5)), y)
    },
    split: |x| {
        let smallest = _mm256_set1_epi32(std::f32::consts::FRAC_1_SQRT_2.to_bits() as i32);
        let exponent =
            _mm256_srai_epi32::<23>(_mm256_sub_epi32(_mm256_castps_si256(x.0), smallest));
        let m = _mm256_sub_epi32(_mm256_castps_si256(x.0), _mm256_slli_epi32::<23>(exponent));
        (Self(_mm256_castsi256_ps(m)), Self(_mm256_cvtepi32_ps(exponent)))
    },
    xor _mm256_xor_ps, and_not _mm256_andnot_ps,
    features "avx2,fma", splat _mm256_set1_ps, load _mm256_loadu_ps, store _mm256_storeu_ps,
    transpose transpose::transpose_f32x8, narrower f32,
    add _mm256_add_ps, sub _mm256_sub_ps, mul _mm256_mul_ps, div _mm256_div_ps,
    mul_add _mm256_fmadd_ps, sqrt _mm256_sqrt_ps, max _mm256_max_ps, min _mm256_min_ps,
}
