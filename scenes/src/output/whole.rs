//! Files that appear whole or not at all.

use std::fs;
use std::path::Path;

use crate::error::Error;

/// Writes a file that replaces an earlier one of the same name only once it is complete.
///
/// # Errors
/// [`Error::Write`].
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Error> {
    // The process number keeps two programs with the same file apart.
    let mut aside = path.as_os_str().to_owned();
    aside.push(format!(".unfinished-{}", std::process::id()));
    let written = fs::write(&aside, content).and_then(|()| fs::rename(&aside, path));
    written.map_err(|source| {
        // Where this fails too, the name of what stays says what it is.
        let _ = fs::remove_file(&aside);
        Error::Write { path: path.into(), source }
    })
}
