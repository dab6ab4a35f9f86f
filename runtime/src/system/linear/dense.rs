//! Eigenvalues of small dense symmetric matrices.

use faer::diag::Diag;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::evd::{ComputeEigenvectors, self_adjoint_evd, self_adjoint_evd_scratch};
use faer::{Mat, Par};

use super::LinearError;

/// Eigenvalues, ascending, and orthonormal eigenvectors of a symmetric n×n matrix, given by its entries. A
/// single thread computes them, so that the bits do not depend on the number of threads.
///
/// # Errors
/// [`LinearError::NoEigenvalues`].
pub(crate) fn eigen(
    n: usize,
    entry: impl Fn(usize, usize) -> f64,
) -> Result<(Vec<f64>, Vec<Vec<f64>>), LinearError> {
    let matrix = Mat::from_fn(n, n, entry);
    let (mut values, mut vectors) = (Diag::zeros(n), Mat::zeros(n, n));
    let scratch = self_adjoint_evd_scratch::<f64>(n, ComputeEigenvectors::Yes, Par::Seq, Default::default());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let (to_values, to_vectors) = (values.as_mut(), Some(vectors.as_mut()));
    self_adjoint_evd(matrix.as_ref(), to_values, to_vectors, Par::Seq, stack, Default::default())
        .map_err(|_| LinearError::NoEigenvalues)?;
    let vectors = vectors.col_iter().map(|vector| vector.iter().copied().collect());
    Ok((values.column_vector().iter().copied().collect(), vectors.collect()))
}
