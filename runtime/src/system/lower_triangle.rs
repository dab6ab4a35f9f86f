//! A symmetric matrix as its lower triangle, on its way to a solver.

use faer::sparse::SparseColMatRef;

use super::linear::{LinearError, fits, symmetric_product};

/// A symmetric matrix, given by its lower triangle in compressed columns: the form of
/// [`BlockMatrix`](super::BlockMatrix), of SciPy's `csc_matrix` and of most sparse solvers.
///
/// Entries of column c are those from `column_starts()[c]` to `column_starts()[c + 1]`, their rows ascending
/// from the diagonal, which is always stored.
#[derive(Clone, Copy, Debug)]
pub struct LowerTriangle<'a>(pub(crate) SparseColMatRef<'a, usize, f64>);

impl<'a> LowerTriangle<'a> {
    /// Start of each column among the entries, and the end of the last.
    #[must_use]
    pub fn column_starts(&self) -> &'a [usize] {
        self.0.symbolic().col_ptr()
    }

    /// Row of each entry.
    #[must_use]
    pub fn row_indices(&self) -> &'a [usize] {
        self.0.symbolic().row_idx()
    }

    /// The entries.
    #[must_use]
    pub fn values(&self) -> &'a [f64] {
        self.0.val()
    }

    /// The entries on the diagonal.
    pub fn diagonal(&self) -> impl Iterator<Item = f64> + 'a {
        let (starts, values) = (self.column_starts(), self.values());
        starts.iter().take(starts.len().saturating_sub(1)).map(move |&start| values[start])
    }

    /// Computes A x of the whole matrix, both triangles.
    ///
    /// # Errors
    /// [`LinearError::Length`] unless `x` and `product` have one entry for each row.
    pub fn multiply(&self, x: &[f64], product: &mut [f64]) -> Result<(), LinearError> {
        fits("x", x.len(), self.0.nrows())?;
        fits("product", product.len(), self.0.nrows())?;
        symmetric_product(self.0, x, product);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::sparse::SymbolicSparseColMatRef;

    #[test]
    fn the_product_is_that_of_both_triangles() {
        // [[4, 2, 0], [2, 5, 1], [0, 1, 3]]
        let pattern = SymbolicSparseColMatRef::new_checked(3, 3, &[0, 2, 4, 5], None, &[0, 1, 1, 2, 2]);
        let matrix = LowerTriangle(SparseColMatRef::new(pattern, &[4.0, 2.0, 5.0, 1.0, 3.0]));
        let mut product = [0.0; 3];
        assert_eq!(matrix.multiply(&[1.0, 2.0, 3.0], &mut product), Ok(()));
        assert_eq!(
            (product, matrix.diagonal().collect::<Vec<_>>()),
            ([8.0, 15.0, 11.0], vec![4.0, 5.0, 3.0])
        );
        assert!(matrix.multiply(&[1.0; 2], &mut product).is_err());
    }
}
