//! Linear systems of bodies: their errors, and the solvers that a simulation can choose.
//!
//! `cholesky` is a sparse factorisation, for bodies of up to some thousand elements, and `ordering` numbers
//! its unknowns; both exist with the feature `faer`. `conjugate_gradients` has two preconditioners: the
//! blocks on the diagonal (`block_jacobi`) and `multigrid`.

use std::fmt;

use piola::NoSuchNode;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LinearError {
    /// A pivot is negative, zero or NaN.
    NotPositive {
        /// The column in which it is met.
        column: usize,
    },
    /// The matrix or its factor does not fit into memory.
    OutOfMemory,
    /// A slice does not fit the matrix.
    Length {
        /// The slice, as the method calls it.
        slice: &'static str,
        /// Its length.
        found: usize,
        /// The length that the matrix demands.
        expected: usize,
    },
    /// There is no factor to solve with.
    NotFactored,
    /// Column starts and row indices do not describe the lower triangle of a matrix.
    Pattern {
        /// The first column at fault.
        column: usize,
    },
    /// A pin names a node that does not exist.
    NoSuchNode(NoSuchNode),
    /// Another failure, of which the solver or the division among machines keeps the reason.
    External,
}

impl fmt::Display for LinearError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositive { column } => {
                write!(f, "the matrix is not positive definite (pivot of column {column})")
            }
            Self::NoSuchNode(error) => error.fmt(f),
            Self::Length { slice, found, expected } => {
                write!(f, "`{slice}` has {found} entries; the matrix demands {expected}")
            }
            Self::NotFactored => {
                write!(f, "there is no factor to solve with: `factor` was not called, or has failed")
            }
            Self::Pattern { column } => {
                write!(
                    f,
                    "column {column} is not the lower triangle of a symmetric pattern: rows must ascend from the diagonal"
                )
            }
            Self::OutOfMemory => write!(f, "the matrix or its factor does not fit into memory"),
            Self::External => write!(f, "the solver has failed for a reason of its own"),
        }
    }
}

crate::chained::wraps!(LinearError { NoSuchNode(NoSuchNode) });
