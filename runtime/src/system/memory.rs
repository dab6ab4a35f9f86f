//! Vectors as long as a caller says: where there is no room for them, an error and no abort.

use super::linear::LinearError;

/// An empty vector with room for so many entries.
///
/// # Errors
/// [`LinearError::OutOfMemory`].
pub(super) fn reserved<T>(capacity: usize) -> Result<Vec<T>, LinearError> {
    let mut vector = Vec::new();
    vector.try_reserve_exact(capacity).map_err(|_| LinearError::OutOfMemory)?;
    Ok(vector)
}

/// A vector of so many equal entries.
///
/// # Errors
/// [`LinearError::OutOfMemory`].
pub(super) fn filled<T: Clone>(length: usize, value: T) -> Result<Vec<T>, LinearError> {
    let mut vector = reserved(length)?;
    vector.resize(length, value);
    Ok(vector)
}
