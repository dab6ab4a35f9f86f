//! Matrices from and to nalgebra (feature `nalgebra`), entry (i, j) to entry (i, j).
//!
//! A matrix of piola is an array of its rows; nalgebra stores columns. Copying the numbers in the order of
//! memory would transpose them, and a transposed F is a valid F with another stress. These functions cannot
//! be misread: each takes or returns rows on piola's side and the library's own matrix on the other. (Whole
//! slices of matrices by columns need no copy: see `piola::batch`.)
//!
//! They are for two versions of nalgebra. For another one, and for glam with its own indices, a line of code
//! does the same: `[0, 1, 2].map(|i| [0, 1, 2].map(|j| F[(i, j)]))`, and `Matrix3::from_fn(|i, j| P[i][j])`
//! the other way.
//!
//! Tangents are 9×9 for [`to_nalgebra`], from [`Tangent::to_matrix`](crate::point::Tangent::to_matrix): row
//! 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F. A matrix of nalgebra's flattened by its own
//! `reshape` or `as_slice` is in the other order, 3j+i: use `dP_dF *
//! SVector::from_row_slice(dF.as_flattened())` on piola's rows instead.

/// The rows of a matrix of nalgebra.
#[must_use]
pub fn from_nalgebra<T: nalgebra::Scalar + Copy, const M: usize, const N: usize>(
    matrix: &nalgebra::SMatrix<T, M, N>,
) -> [[T; N]; M] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]))
}

/// The matrix of nalgebra with these rows: 3×3 for F and P, 6×6 for tangents in Voigt notation, 9×9 for
/// dP/dF.
#[must_use]
pub fn to_nalgebra<T: nalgebra::Scalar + Copy, const M: usize, const N: usize>(
    rows: &[[T; N]; M],
) -> nalgebra::SMatrix<T, M, N> {
    nalgebra::SMatrix::from_fn(|i, j| rows[i][j])
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROWS: [[f64; 3]; 3] = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]];

    #[test]
    fn nalgebra_stores_columns_and_piola_rows() {
        let matrix: nalgebra::Matrix3<f64> = to_nalgebra(&ROWS);
        assert_eq!(matrix.as_slice(), [1.0, 4.0, 7.0, 2.0, 5.0, 8.0, 3.0, 6.0, 9.0]);
        assert_eq!(from_nalgebra(&matrix), ROWS);
        let two_by_three = [[1, 2, 3], [4, 5, 6]];
        assert_eq!(from_nalgebra(&to_nalgebra(&two_by_three)), two_by_three);
    }
}
