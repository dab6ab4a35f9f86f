//! Squares of numbers turned in registers.
//!
//! Neighbours are paired within each 128 bits first, until these hold entries of one column; then blocks of 128 bits are
//! brought to their places.

#![expect(unsafe_code, reason = "vector instructions; see the module above")]

use std::arch::x86_64::*;

/// Columns 0, 1, 2, 3 of a 4×4 matrix of 128-bit blocks given by rows.
macro_rules! turn_blocks {
    ($shuffle:ident, $rows:expr) => {{
        let [a, b, c, d] = $rows;
        let (ab_even, ab_odd) = ($shuffle::<0x88>(a, b), $shuffle::<0xdd>(a, b));
        let (cd_even, cd_odd) = ($shuffle::<0x88>(c, d), $shuffle::<0xdd>(c, d));
        [
            $shuffle::<0x88>(ab_even, cd_even),
            $shuffle::<0x88>(ab_odd, cd_odd),
            $shuffle::<0xdd>(ab_even, cd_even),
            $shuffle::<0xdd>(ab_odd, cd_odd),
        ]
    }};
}

/// The transpose of an 8×8 matrix.
///
/// # Safety
/// The processor has AVX-512.
#[inline(always)]
pub(super) unsafe fn turn_f64x8(rows: [__m512d; 8]) -> [__m512d; 8] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        let low = [0, 2, 4, 6].map(|k| _mm512_unpacklo_pd(rows[k], rows[k + 1]));
        let high = [0, 2, 4, 6].map(|k| _mm512_unpackhi_pd(rows[k], rows[k + 1]));
        let (even, odd) = (turn_blocks!(_mm512_shuffle_f64x2, low), turn_blocks!(_mm512_shuffle_f64x2, high));
        [even[0], odd[0], even[1], odd[1], even[2], odd[2], even[3], odd[3]]
    }
}

/// The transpose of a 16×16 matrix.
///
/// # Safety
/// The processor has AVX-512.
#[inline(always)]
pub(super) unsafe fn turn_f32x16(rows: [__m512; 16]) -> [__m512; 16] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        let as_doubles = |x| _mm512_castps_pd(x);
        // Column 4b + j of four rows each is in block b of `quads[j]`.
        let quads: [[__m512; 4]; 4] = std::array::from_fn(|q| {
            let [a, b, c, d] = [rows[4 * q], rows[4 * q + 1], rows[4 * q + 2], rows[4 * q + 3]];
            let (ab_low, ab_high) =
                (as_doubles(_mm512_unpacklo_ps(a, b)), as_doubles(_mm512_unpackhi_ps(a, b)));
            let (cd_low, cd_high) =
                (as_doubles(_mm512_unpacklo_ps(c, d)), as_doubles(_mm512_unpackhi_ps(c, d)));
            [
                _mm512_unpacklo_pd(ab_low, cd_low),
                _mm512_unpackhi_pd(ab_low, cd_low),
                _mm512_unpacklo_pd(ab_high, cd_high),
                _mm512_unpackhi_pd(ab_high, cd_high),
            ]
            .map(|x| _mm512_castpd_ps(x))
        });
        let columns: [[__m512; 4]; 4] = std::array::from_fn(|j| {
            turn_blocks!(_mm512_shuffle_f32x4, [quads[0][j], quads[1][j], quads[2][j], quads[3][j]])
        });
        std::array::from_fn(|column| columns[column % 4][column / 4])
    }
}

/// The transpose of a 4×4 matrix.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
pub(super) unsafe fn turn_f64x4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        let (ab_low, ab_high) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab_low, cd_low),
            _mm256_permute2f128_pd::<0x20>(ab_high, cd_high),
            _mm256_permute2f128_pd::<0x31>(ab_low, cd_low),
            _mm256_permute2f128_pd::<0x31>(ab_high, cd_high),
        ]
    }
}

/// The transpose of an 8×8 matrix.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
pub(super) unsafe fn turn_f32x8(rows: [__m256; 8]) -> [__m256; 8] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        let as_doubles = |x| _mm256_castps_pd(x);
        // Column 4b + j of four rows each is in block b of `quads[j]`.
        let quads: [[__m256; 4]; 2] = std::array::from_fn(|q| {
            let [a, b, c, d] = [rows[4 * q], rows[4 * q + 1], rows[4 * q + 2], rows[4 * q + 3]];
            let (ab_low, ab_high) =
                (as_doubles(_mm256_unpacklo_ps(a, b)), as_doubles(_mm256_unpackhi_ps(a, b)));
            let (cd_low, cd_high) =
                (as_doubles(_mm256_unpacklo_ps(c, d)), as_doubles(_mm256_unpackhi_ps(c, d)));
            [
                _mm256_unpacklo_pd(ab_low, cd_low),
                _mm256_unpackhi_pd(ab_low, cd_low),
                _mm256_unpacklo_pd(ab_high, cd_high),
                _mm256_unpackhi_pd(ab_high, cd_high),
            ]
            .map(|x| _mm256_castpd_ps(x))
        });
        std::array::from_fn(|column| {
            let (upper, lower) = (quads[0][column % 4], quads[1][column % 4]);
            if column < 4 {
                _mm256_permute2f128_ps::<0x20>(upper, lower)
            } else {
                _mm256_permute2f128_ps::<0x31>(upper, lower)
            }
        })
    }
}
