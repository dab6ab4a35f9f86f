//! Sparse Cholesky factorisation A = L Lᵀ, analysed once and refactored for each new set of values.
//!
//! Sequential on purpose: at the sizes of real-time bodies (fewer than 10⁴ unknowns) threads cost more than they
//! bring. Supernodal: columns of one pattern are factored as dense panels. This module knows no nodes; unknowns come already
//! in an order that keeps L sparse.
//!
//! Beside it lie what the steps of a simulation can choose instead: conjugate gradients, a preconditioner for them where there
//! is no matrix, and a factor in f32 that they refine. The smallest eigenvalue of
//! a matrix comes from its factor by Lanczos' method.

use std::fmt;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::RealField;
use faer::{Conj, MatMut, Par, Side};

pub(crate) mod block_jacobi;
pub(crate) mod conjugate_gradients;
pub(crate) mod lanczos;
pub(crate) mod refined;

/// A factorisation in f64 or f32, and the memory for the next one.
pub struct Cholesky<E = f64> {
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<E>,
    memory: MemBuffer,
}

impl<E> fmt::Debug for Cholesky<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Cholesky {{ unknowns: {}, entries: {} }}", self.symbolic.nrows(), self.factor.len())
    }
}

impl<E: RealField> Cholesky<E> {
    /// Analyses the lower triangle of a symmetric pattern and allocates all that later calls need.
    ///
    /// # Errors
    /// Where the factor does not fit into memory.
    pub fn new(pattern: SymbolicSparseColMatRef<'_, usize>) -> Result<Self, LinearError> {
        // Without a permutation faer takes the pattern to be an upper triangle, whatever the side it is told.
        let upper = pattern.transpose().to_col_major().map_err(|_| LinearError::OutOfMemory)?;
        // Dense kernels pay from a few hundred unknowns on; by its own estimate faer would begin later.
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic =
            factorize_symbolic_cholesky(upper.as_ref(), Side::Upper, SymmetricOrdering::Identity, parameters)
                .map_err(|_| LinearError::OutOfMemory)?;
        let scratch = symbolic
            .factorize_numeric_llt_scratch::<E>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<E>(1, Par::Seq));
        let memory = MemBuffer::try_new(scratch).map_err(|_| LinearError::OutOfMemory)?;
        let mut factor = Vec::new();
        factor.try_reserve_exact(symbolic.len_val()).map_err(|_| LinearError::OutOfMemory)?;
        factor.resize(symbolic.len_val(), E::zero_impl());
        Ok(Self { symbolic, factor, memory })
    }

    /// Factors a matrix of the analysed pattern.
    ///
    /// # Errors
    /// Where it is not numerically positive definite.
    pub fn factor(&mut self, matrix: SparseColMatRef<'_, usize, E>) -> Result<(), LinearError> {
        let result = self.symbolic.factorize_numeric_llt(
            &mut self.factor,
            matrix,
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
    pub fn solve(&mut self, b: &mut [E]) {
        let b = MatMut::from_column_major_slice_mut(b, self.symbolic.nrows(), 1);
        let factor = LltRef::new(&self.symbolic, &self.factor);
        factor.solve_in_place_with_conj(Conj::No, b, Par::Seq, MemStack::new(&mut self.memory));
    }
}

/// A x for a symmetric matrix given by its lower triangle.
pub(crate) fn symmetric_product(matrix: SparseColMatRef<'_, usize, f64>, x: &[f64], product: &mut [f64]) {
    product.fill(0.0);
    for column in 0..x.len() {
        let entries = matrix.row_idx_of_col_raw(column).iter().zip(matrix.val_of_col(column));
        let mut sum = 0.0;
        for (&row, value) in entries {
            sum += value * x[row];
            if row != column {
                product[row] += value * x[column];
            }
        }
        product[column] += sum;
    }
}

/// Why a system cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinearError {
    /// A pivot is negative, zero or NaN.
    NotPositive {
        /// The column in which it is met.
        column: usize,
    },
    /// The factor does not fit into memory.
    OutOfMemory,
    /// An element or a pin names a node that does not exist.
    NoSuchNode {
        /// As named.
        node: usize,
        /// How many nodes there are, numbered from 0.
        nodes: usize,
    },
}

impl fmt::Display for LinearError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositive { column } => {
                write!(f, "the matrix is not positive definite (pivot of column {column})")
            }
            Self::NoSuchNode { node, nodes } => {
                write!(f, "there is no node {node}: the {nodes} nodes are numbered from 0")
            }
            Self::OutOfMemory => write!(f, "the factor of the matrix does not fit into memory"),
        }
    }
}

impl std::error::Error for LinearError {}
