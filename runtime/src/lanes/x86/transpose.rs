//! Transposes of square matrices in registers.
//!
//! Neighbours are paired within each 128 bits first, until these hold entries of one column; then blocks of
//! 128 bits are brought to their places. Macros and loops instead of closures, which nothing can force the
//! compiler to inline.

#![expect(unsafe_code, reason = "vector instructions; see the module above")]

use std::arch::x86_64::*;

/// Columns 0, 1, 2, 3 of a 4×4 matrix of 128-bit blocks given by rows.
macro_rules! transpose_blocks {
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

/// Four rows of floats, transposed within each 128 bits: element j holds entries j, j + 4, j + 8, … of all.
macro_rules! transpose_quads {
    (
        $low:ident, $high:ident, $low_pairs:ident, $high_pairs:ident, $to_pairs:ident, $from_pairs:ident,
        $rows:expr, $start:expr
    ) => {{
        let (a, b, c, d) = ($rows[$start], $rows[$start + 1], $rows[$start + 2], $rows[$start + 3]);
        let (ab_low, ab_high) = ($to_pairs($low(a, b)), $to_pairs($high(a, b)));
        let (cd_low, cd_high) = ($to_pairs($low(c, d)), $to_pairs($high(c, d)));
        [
            $from_pairs($low_pairs(ab_low, cd_low)),
            $from_pairs($high_pairs(ab_low, cd_low)),
            $from_pairs($low_pairs(ab_high, cd_high)),
            $from_pairs($high_pairs(ab_high, cd_high)),
        ]
    }};
}

macro_rules! transpose_quads_512 {
    ($rows:expr, $start:expr) => {
        transpose_quads!(
            _mm512_unpacklo_ps,
            _mm512_unpackhi_ps,
            _mm512_unpacklo_pd,
            _mm512_unpackhi_pd,
            _mm512_castps_pd,
            _mm512_castpd_ps,
            $rows,
            $start
        )
    };
}

macro_rules! transpose_quads_256 {
    ($rows:expr, $start:expr) => {
        transpose_quads!(
            _mm256_unpacklo_ps,
            _mm256_unpackhi_ps,
            _mm256_unpacklo_pd,
            _mm256_unpackhi_pd,
            _mm256_castps_pd,
            _mm256_castpd_ps,
            $rows,
            $start
        )
    };
}

/// The transpose of an 8×8 matrix.
///
/// # Safety
/// The processor has AVX-512.
#[inline(always)]
pub(super) unsafe fn transpose_f64x8([a, b, c, d, e, f, g, h]: [__m512d; 8]) -> [__m512d; 8] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        let low = [
            _mm512_unpacklo_pd(a, b),
            _mm512_unpacklo_pd(c, d),
            _mm512_unpacklo_pd(e, f),
            _mm512_unpacklo_pd(g, h),
        ];
        let high = [
            _mm512_unpackhi_pd(a, b),
            _mm512_unpackhi_pd(c, d),
            _mm512_unpackhi_pd(e, f),
            _mm512_unpackhi_pd(g, h),
        ];
        let (even, odd) =
            (transpose_blocks!(_mm512_shuffle_f64x2, low), transpose_blocks!(_mm512_shuffle_f64x2, high));
        [even[0], odd[0], even[1], odd[1], even[2], odd[2], even[3], odd[3]]
    }
}

/// The transpose of a 16×16 matrix.
///
/// # Safety
/// The processor has AVX-512.
#[inline(always)]
pub(super) unsafe fn transpose_f32x16(rows: [__m512; 16]) -> [__m512; 16] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        // Column 4b + j of four rows each is in block b of element j.
        let quads = [
            transpose_quads_512!(rows, 0),
            transpose_quads_512!(rows, 4),
            transpose_quads_512!(rows, 8),
            transpose_quads_512!(rows, 12),
        ];
        let mut columns = rows;
        for j in 0..4 {
            let blocks = [quads[0][j], quads[1][j], quads[2][j], quads[3][j]];
            let transposed = transpose_blocks!(_mm512_shuffle_f32x4, blocks);
            for b in 0..4 {
                columns[4 * b + j] = transposed[b];
            }
        }
        columns
    }
}

/// The transpose of a 4×4 matrix.
///
/// # Safety
/// The processor has AVX2.
#[inline(always)]
pub(super) unsafe fn transpose_f64x4([a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
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
pub(super) unsafe fn transpose_f32x8(rows: [__m256; 8]) -> [__m256; 8] {
    // SAFETY: that the processor has these instructions is the condition of this function.
    unsafe {
        // Column 4b + j of four rows each is in block b of element j.
        let (upper, lower) = (transpose_quads_256!(rows, 0), transpose_quads_256!(rows, 4));
        let mut columns = rows;
        for j in 0..4 {
            columns[j] = _mm256_permute2f128_ps::<0x20>(upper[j], lower[j]);
            columns[4 + j] = _mm256_permute2f128_ps::<0x31>(upper[j], lower[j]);
        }
        columns
    }
}
