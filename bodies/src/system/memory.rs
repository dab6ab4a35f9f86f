//! Vectors of any length that a caller gives: an error instead of an abort if memory is too small.

use super::linear::LinearError;

pub(crate) fn reserved<T>(capacity: usize) -> Result<Vec<T>, LinearError> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(capacity).map_err(|_| LinearError::OutOfMemory)?;
    Ok(vector)
}

pub(crate) fn filled<T: Clone>(length: usize, value: T) -> Result<Vec<T>, LinearError> {
    let mut vector = reserved(length)?;
    vector.resize(length, value);
    Ok(vector)
}
