//! Transposes of square matrices whose rows lie in memory, a stride apart.
//!
//! Neighbours are paired within each 128 bits, until these hold entries of one column, and blocks of 128 bits
//! are brought to their places: half of the way, and with AVX2 all of it, while they are loaded, which spares
//! these shuffles. Macros and loops instead of closures, which nothing can force the compiler to inline.

#![expect(unsafe_code, reason = "vector instructions; see the module above")]

use std::arch::x86_64::*;

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
/// The processor has AVX-512, and 8 entries of each row can be read.
#[inline(always)]
pub(super) unsafe fn transpose_f64x8(from: *const f64, stride: usize) -> [__m512d; 8] {
    // SAFETY: both are conditions of this function.
    unsafe {
        let mut columns = [_mm512_setzero_pd(); 8];
        for half in 0..2 {
            // Four columns: of row k in the first 256 bits, of row k + 2 in the others.
            let mut rows = [_mm512_setzero_pd(); 4];
            for (register, k) in [0, 1, 4, 5].into_iter().enumerate() {
                let at = from.add(k * stride + 4 * half);
                let first = _mm512_castpd256_pd512(_mm256_loadu_pd(at));
                rows[register] = _mm512_insertf64x4::<1>(first, _mm256_loadu_pd(at.add(2 * stride)));
            }
            let [a, b, c, d] = rows;
            let (even_ab, even_cd) = (_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d));
            let (odd_ab, odd_cd) = (_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d));
            columns[4 * half] = _mm512_shuffle_f64x2::<0x88>(even_ab, even_cd);
            columns[4 * half + 1] = _mm512_shuffle_f64x2::<0x88>(odd_ab, odd_cd);
            columns[4 * half + 2] = _mm512_shuffle_f64x2::<0xdd>(even_ab, even_cd);
            columns[4 * half + 3] = _mm512_shuffle_f64x2::<0xdd>(odd_ab, odd_cd);
        }
        columns
    }
}

/// The transpose of a 16×16 matrix.
///
/// # Safety
/// The processor has AVX-512, and 16 entries of each row can be read.
#[inline(always)]
pub(super) unsafe fn transpose_f32x16(from: *const f32, stride: usize) -> [__m512; 16] {
    // SAFETY: both are conditions of this function.
    unsafe {
        let mut columns = [_mm512_setzero_ps(); 16];
        for half in 0..2 {
            // Eight columns: of row k in the first 256 bits, of row k + 4 in the others.
            let mut rows = [_mm512_setzero_ps(); 8];
            for (register, k) in [0, 1, 2, 3, 8, 9, 10, 11].into_iter().enumerate() {
                let at = from.add(k * stride + 8 * half);
                let first = _mm512_castps256_ps512(_mm256_loadu_ps(at));
                rows[register] = _mm512_insertf32x8::<1>(first, _mm256_loadu_ps(at.add(4 * stride)));
            }
            let (upper, lower) = (transpose_quads_512!(rows, 0), transpose_quads_512!(rows, 4));
            for j in 0..4 {
                columns[8 * half + j] = _mm512_shuffle_f32x4::<0x88>(upper[j], lower[j]);
                columns[8 * half + 4 + j] = _mm512_shuffle_f32x4::<0xdd>(upper[j], lower[j]);
            }
        }
        columns
    }
}

/// The transpose of a 4×4 matrix.
///
/// # Safety
/// The processor has AVX2, and 4 entries of each row can be read.
#[inline(always)]
pub(super) unsafe fn transpose_f64x4(from: *const f64, stride: usize) -> [__m256d; 4] {
    // SAFETY: both are conditions of this function.
    unsafe {
        let mut columns = [_mm256_setzero_pd(); 4];
        for pair in 0..2 {
            // Rows 0 and 2, and rows 1 and 3, of two columns.
            let at = from.add(2 * pair);
            let even = _mm256_loadu2_m128d(at.add(2 * stride), at);
            let odd = _mm256_loadu2_m128d(at.add(3 * stride), at.add(stride));
            columns[2 * pair] = _mm256_unpacklo_pd(even, odd);
            columns[2 * pair + 1] = _mm256_unpackhi_pd(even, odd);
        }
        columns
    }
}

/// The transpose of an 8×8 matrix.
///
/// # Safety
/// The processor has AVX2, and 8 entries of each row can be read.
#[inline(always)]
pub(super) unsafe fn transpose_f32x8(from: *const f32, stride: usize) -> [__m256; 8] {
    // SAFETY: both are conditions of this function.
    unsafe {
        let mut columns = [_mm256_setzero_ps(); 8];
        for half in 0..2 {
            // Four columns: of row k in the first 128 bits, of row k + 4 in the others.
            let mut rows = [_mm256_setzero_ps(); 4];
            for k in 0..4 {
                let at = from.add(k * stride + 4 * half);
                rows[k] = _mm256_loadu2_m128(at.add(4 * stride), at);
            }
            let quads = transpose_quads_256!(rows, 0);
            for j in 0..4 {
                columns[4 * half + j] = quads[j];
            }
        }
        columns
    }
}
