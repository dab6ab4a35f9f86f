//! Files that a command line names twice, once of them to be written.

use std::fs;
use std::path::PathBuf;

use crate::error::Error;

/// An option that names a file, and the file.
pub(crate) type Named = (&'static str, PathBuf);

/// Refuses an output that is also an input, by any path or link. Nothing is lost in a device or a pipe.
///
/// # Errors
/// [`Error::NamedTwice`].
pub(crate) fn refuse_overlaps(
    inputs: impl IntoIterator<Item = Named>,
    output: Option<Named>,
) -> Result<(), Error> {
    // An output that does not exist yet is none of the inputs.
    let place = |path: &PathBuf| fs::canonicalize(path).ok().filter(|place| place.is_file());
    let Some((other, path)) = output else { return Ok(()) };
    let Some(written) = place(&path) else { return Ok(()) };
    match inputs.into_iter().find(|(_, input)| place(input).is_some_and(|read| read == written)) {
        Some((one, _)) => Err(Error::NamedTwice { path, one, other }),
        None => Ok(()),
    }
}
