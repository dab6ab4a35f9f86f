//! Order of the unknowns of a sparse matrix in which a Cholesky factor stays sparse.

use super::LinearError;

/// Orders the rows of a symmetric pattern, in compressed columns with both triangles: by approximate minimum
/// degree.
///
/// On bodies of this size minimum degree is better than nested dissection: METIS needs 1.75 times as many
/// operations for a factor of the horse and 1.16 times as many for that of the dinosaur, dissection by planes
/// 1.9 and 1.4 times.
///
/// # Errors
/// [`LinearError::OutOfMemory`].
#[cfg(feature = "faer")]
pub(crate) fn order(starts: &[usize], rows: &[usize]) -> Result<Vec<usize>, LinearError> {
    use faer::dyn_stack::{MemBuffer, MemStack};
    use faer::sparse::SymbolicSparseColMatRef;
    use faer::sparse::linalg::amd;

    let count = starts.len() - 1;
    let pattern = SymbolicSparseColMatRef::new_checked(count, count, starts, None, rows);
    let (mut order, mut inverse) = (vec![0; count], vec![0; count]);
    let scratch = amd::order_scratch::<usize>(count, rows.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| LinearError::OutOfMemory)?;
    amd::order(&mut order, &mut inverse, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| LinearError::OutOfMemory)?;
    Ok(order)
}

/// The rows as they are: without the feature `faer` nothing of this crate factors a sparse matrix.
///
/// # Errors
/// None.
#[cfg(not(feature = "faer"))]
pub(crate) fn order(starts: &[usize], _: &[usize]) -> Result<Vec<usize>, LinearError> {
    Ok((0..starts.len() - 1).collect())
}
