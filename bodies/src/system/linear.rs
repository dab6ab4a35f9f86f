//! Linear systems of bodies: their errors, and the solvers that a simulation can choose.
//!
//! `cholesky` is a sparse factorisation, for bodies of up to some thousand elements, and `ordering` numbers
//! its unknowns; both exist with the feature `faer`. `conjugate_gradients` has two preconditioners: the
//! blocks on the diagonal (`block_jacobi`) and `multigrid`.

use piola::NoSuchNode;
use thiserror::Error;

pub(crate) mod block_jacobi;
#[cfg(feature = "faer")]
pub(crate) mod cholesky;
pub(crate) mod conjugate_gradients;
pub(crate) mod multigrid;
pub(crate) mod ordering;
pub(crate) mod symmetric_blocks;

/// Checks the length of a slice.
pub(crate) fn fits(slice: &'static str, found: usize, expected: usize) -> Result<(), LinearError> {
    if found == expected { Ok(()) } else { Err(LinearError::Length { slice, found, expected }) }
}

/// Reason why a system cannot be solved.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinearError {
    /// A pivot is negative, zero or NaN.
    #[error("the matrix is not positive definite (pivot of column {column})")]
    NotPositive {
        /// The column in which it is met.
        column: usize,
    },
    /// The matrix or its factor does not fit into memory.
    #[error("the matrix or its factor does not fit into memory")]
    OutOfMemory,
    /// A slice does not fit the matrix.
    #[error("`{slice}` has {found} entries; the matrix demands {expected}")]
    Length {
        /// The slice, as the method calls it.
        slice: &'static str,
        /// Its length.
        found: usize,
        /// The length that the matrix demands.
        expected: usize,
    },
    /// A pin names a node that does not exist.
    #[error("{0}")]
    NoSuchNode(#[from] NoSuchNode),
    /// Another failure, of which the solver or the division among machines keeps the reason.
    #[error("the solver has failed for a reason of its own")]
    External,
}
