//! Sparse Cholesky factorisation A = L Lᵀ, analysed once and refactored for each new set of values.
//!
//! Sequential on purpose: at the sizes of real-time bodies (fewer than 10⁴ unknowns) threads cost more than
//! they bring. Supernodal: columns of one pattern are factored as dense panels. This module knows no nodes;
//! unknowns come already in an order that keeps L sparse.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side};

use super::LinearError;
use crate::system::memory::filled;

/// A factorisation, and the memory for the next one.
///
/// Matrices are given by their lower triangle in compressed columns: see
/// [`LowerTriangle`](crate::system::LowerTriangle).
pub(crate) struct Cholesky {
    pattern: Arc<SymbolicSparseColMat<usize>>,
    symbolic: Arc<SymbolicCholesky<usize>>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

impl Clone for Cholesky {
    fn clone(&self) -> Self {
        let (pattern, symbolic) = (self.pattern.clone(), self.symbolic.clone());
        let memory = MemBuffer::new(scratch(&symbolic));
        Self { pattern, symbolic, factor: self.factor.clone(), memory }
    }
}

impl Cholesky {
    /// Analyses the pattern of a lower triangle and allocates all memory that later calls need.
    pub(crate) fn new(column_starts: &[usize], row_indices: &[usize]) -> Result<Self, LinearError> {
        let unknowns = column_starts.len() - 1;
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
        let factor = filled(symbolic.len_val(), 0.0)?;
        Ok(Self { pattern: Arc::new(pattern), symbolic: Arc::new(symbolic), factor, memory })
    }

    /// Factors the matrix with these values in the order of the pattern.
    pub(crate) fn factor(&mut self, values: &[f64]) -> Result<(), LinearError> {
        let result = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            SparseColMatRef::new((*self.pattern).as_ref(), values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut self.memory),
            Default::default(),
        );
        match result {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => Err(LinearError::NotPositive { column: index }),
        }
    }

    /// Replaces b by A⁻¹ b, with the matrix factored last.
    pub(crate) fn solve(&mut self, b: &mut [f64]) {
        let b = MatMut::from_column_major_slice_mut(b, self.symbolic.nrows(), 1);
        let factor = LltRef::new(&self.symbolic, &self.factor);
        factor.solve_in_place_with_conj(Conj::No, b, Par::Seq, MemStack::new(&mut self.memory));
    }
}

/// Memory that a factorisation or a solution takes beside the factor.
fn scratch(symbolic: &SymbolicCholesky<usize>) -> StackReq {
    symbolic
        .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
        .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
}
