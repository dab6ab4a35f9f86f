//! Sparse Cholesky factorisation A = L Lᵀ, analysed once and refactored for each new set of values.
//!
//! Sequential on purpose: at the sizes of real-time bodies (fewer than 10⁴ unknowns) threads cost more than
//! they bring. Supernodal: columns of one pattern are factored as dense panels. This module knows no nodes;
//! unknowns come already in an order that keeps L sparse.

use std::fmt;
use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use super::{LinearError, fits};

/// A factorisation, and the memory for the next one.
///
/// Matrices are given by their lower triangle in compressed columns: see
/// [`LowerTriangle`](crate::system::LowerTriangle).
///
/// ```
/// use piola_bodies::system::Cholesky;
///
/// // [[4, 2], [2, 5]]: a column of two entries and one of one.
/// let mut cholesky = Cholesky::new(&[0, 2, 3], &[0, 1, 1])?;
/// cholesky.factor(&[4.0, 2.0, 5.0])?;
/// let mut x = [8.0, 12.0];
/// cholesky.solve(&mut x)?;
/// assert_eq!(x, [1.0, 2.0]);
/// # Ok::<(), piola_bodies::system::LinearError>(())
/// ```
pub struct Cholesky {
    pattern: Arc<SymbolicSparseColMat<usize>>,
    symbolic: Arc<SymbolicCholesky<usize>>,
    factor: Vec<f64>,
    /// True if `factor` belongs to a matrix: not before the first, nor after one that is not positive.
    is_factored: bool,
    memory: MemBuffer,
}

impl fmt::Debug for Cholesky {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cholesky {{ unknowns: {}, entries: {} }}", self.symbolic.nrows(), self.factor.len())
    }
}

impl Clone for Cholesky {
    fn clone(&self) -> Self {
        let (pattern, symbolic) = (self.pattern.clone(), self.symbolic.clone());
        let memory = MemBuffer::new(scratch(&symbolic));
        Self { pattern, symbolic, factor: self.factor.clone(), is_factored: self.is_factored, memory }
    }
}

impl Cholesky {
    /// Analyses the lower triangle of a symmetric pattern and allocates all memory that later calls need.
    ///
    /// Entries of column c are those from `column_starts[c]` to `column_starts[c + 1]`, their rows ascending
    /// from the diagonal, which is always stored.
    ///
    /// # Errors
    /// [`LinearError::Pattern`] if the slices do not describe such a triangle, [`LinearError::OutOfMemory`].
    pub fn new(column_starts: &[usize], row_indices: &[usize]) -> Result<Self, LinearError> {
        let unknowns = column_starts.len().checked_sub(1).ok_or(LinearError::Pattern { column: 0 })?;
        let is_lower = |column: usize| {
            let rows = row_indices.get(column_starts[column]..column_starts[column + 1]);
            rows.is_some_and(|rows| {
                rows.first() == Some(&column)
                    && rows.last().is_some_and(|&last| last < unknowns)
                    && rows.is_sorted_by(|a, b| a < b)
            })
        };
        if let Some(column) = (0..unknowns).find(|&column| !is_lower(column)) {
            return Err(LinearError::Pattern { column });
        }
        if column_starts[0] != 0 || column_starts[unknowns] != row_indices.len() {
            return Err(LinearError::Pattern { column: unknowns });
        }
        let (starts, rows) = (column_starts.to_vec(), row_indices.to_vec());
        let pattern = SymbolicSparseColMat::new_checked(unknowns, unknowns, starts, None, rows);
        // Without a permutation faer takes the pattern to be an upper triangle, whatever the side it is told.
        let upper = pattern.as_ref().transpose().to_col_major().map_err(|_| LinearError::OutOfMemory)?;
        // Dense kernels pay from a few hundred unknowns on; by its own estimate faer would begin later.
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic =
            factorize_symbolic_cholesky(upper.as_ref(), Side::Upper, SymmetricOrdering::Identity, parameters)
                .map_err(|_| LinearError::OutOfMemory)?;
        let memory = MemBuffer::try_new(scratch(&symbolic)).map_err(|_| LinearError::OutOfMemory)?;
        let mut factor = Vec::new();
        factor.try_reserve_exact(symbolic.len_val()).map_err(|_| LinearError::OutOfMemory)?;
        factor.resize(symbolic.len_val(), 0.0);
        let (pattern, symbolic) = (Arc::new(pattern), Arc::new(symbolic));
        Ok(Self { pattern, symbolic, factor, is_factored: false, memory })
    }

    /// Factors the matrix with these values in the order of the pattern.
    ///
    /// # Errors
    /// [`LinearError::NotPositive`] if it is not numerically positive definite, [`LinearError::Length`] if
    /// there are not as many values as entries.
    pub fn factor(&mut self, values: &[f64]) -> Result<(), LinearError> {
        fits("values", values.len(), self.pattern.row_idx().len())?;
        let result = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new((*self.pattern).as_ref(), values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        self.is_factored = result.is_ok();
        match result {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => Err(LinearError::NotPositive { column: index }),
        }
    }

    /// Replaces b by A⁻¹ b, with the matrix factored last.
    ///
    /// # Errors
    /// [`LinearError::Length`] if b does not hold one entry for each unknown, [`LinearError::NotFactored`]
    /// before [`Cholesky::factor`] has succeeded, or after it has failed. b is then as it was.
    pub fn solve(&mut self, b: &mut [f64]) -> Result<(), LinearError> {
        fits("b", b.len(), self.symbolic.nrows())?;
        if !self.is_factored {
            return Err(LinearError::NotFactored);
        }
        let b = MatMut::from_column_major_slice_mut(b, self.symbolic.nrows(), 1);
        let factor = LltRef::new(&self.symbolic, &self.factor);
        factor.solve_in_place_with_conj(Conj::No, b, Par::Seq, MemStack::new(&mut self.memory));
        Ok(())
    }
}

/// Memory that a factorisation or a solution takes beside the factor.
fn scratch(symbolic: &SymbolicCholesky<usize>) -> StackReq {
    symbolic
        .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
        .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_checked() {
        let error = |starts: &[usize], rows: &[usize]| Cholesky::new(starts, rows).err();
        assert_eq!(error(&[0, 2, 3], &[0, 1, 1]), None);
        let at = |column| Some(LinearError::Pattern { column });
        assert_eq!(error(&[], &[]), at(0));
        // A row above the diagonal, no diagonal, rows in the wrong order, a row outside, too few and too many
        // entries.
        assert_eq!(error(&[0, 2, 4], &[0, 1, 0, 1]), at(1));
        assert_eq!(error(&[0, 1, 2], &[1, 1]), at(0));
        assert_eq!(error(&[0, 3, 4, 5], &[0, 2, 1, 1, 2]), at(0));
        assert_eq!(error(&[0, 2, 3], &[0, 2, 1]), at(0));
        assert_eq!(error(&[0, 2, 3], &[0, 1]), at(1));
        assert_eq!(error(&[0, 1, 2], &[0, 1, 1]), at(2));
        assert_eq!(error(&[0, 3, 2], &[0, 1]), at(0));
    }

    #[test]
    fn slices_of_other_lengths_and_solutions_without_a_factor_are_refused() -> Result<(), LinearError> {
        let mut cholesky = Cholesky::new(&[0, 2, 3], &[0, 1, 1])?;
        let mut b = [8.0, 12.0];
        assert_eq!(cholesky.solve(&mut b), Err(LinearError::NotFactored));
        // The values of another pattern.
        let other = LinearError::Length { slice: "values", found: 2, expected: 3 };
        assert_eq!(cholesky.factor(&[4.0, 5.0]), Err(other));
        cholesky.factor(&[4.0, 2.0, 5.0])?;
        let short = LinearError::Length { slice: "b", found: 1, expected: 2 };
        assert_eq!(cholesky.solve(&mut b[..1]), Err(short));
        assert_eq!(short.to_string(), "`b` has 1 entries; the matrix demands 2");
        assert!(matches!(cholesky.factor(&[4.0, 2.0, 1.0]), Err(LinearError::NotPositive { column: 1 })));
        assert_eq!(cholesky.solve(&mut b), Err(LinearError::NotFactored));
        assert_eq!(b, [8.0, 12.0]);
        Ok(())
    }
}
