//! The list of the files that a run has written into a folder, kept in that folder.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::super::is_result;
use crate::error::Error;

/// Name of the list.
pub(super) const LISTING: &str = "piola-files.txt";
/// The first line of a list, by which one is recognised.
const HEADER: &str = "Files that piola has written here; it replaces and removes these and no others.\n";

/// The names of the files that piola has written into a folder, and the right to write there.
///
/// A name is added before its file is created: however the program ends, each file of piola is in the list.
/// The list is locked for as long as it is open, by the system, which ends the lock with the program.
#[derive(Debug)]
pub(super) struct Listing {
    file: File,
    path: PathBuf,
    names: BTreeSet<String>,
}

impl Listing {
    /// Opens the list of a folder, or begins one.
    pub(super) fn begin(folder: &Path) -> Result<Self, Error> {
        Self::with(folder, File::options().create(true))
    }

    /// Opens the list of a folder, if it has one.
    pub(super) fn open(folder: &Path) -> Result<Option<Self>, Error> {
        match fs::symlink_metadata(folder.join(LISTING)) {
            Ok(metadata) if metadata.is_file() => Self::with(folder, &mut File::options()).map(Some),
            Ok(_) => Err(foreign(folder)),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(source) => Err(Error::Folder { path: folder.into(), source }),
        }
    }

    fn with(folder: &Path, options: &mut OpenOptions) -> Result<Self, Error> {
        let failed = |source| Error::Folder { path: folder.into(), source };
        let path = folder.join(LISTING);
        let mut file = options.read(true).append(true).open(&path).map_err(failed)?;
        // Does without where the file system has no locks.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(Error::Busy { folder: folder.into() });
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(failed)?;
        let text = String::from_utf8_lossy(&text);
        let mut listing = Self { file, path, names: BTreeSet::new() };
        if let Some(names) = text.strip_prefix(HEADER) {
            // A line without an end was being written when the program ended; its file does not exist.
            let whole = names.rfind('\n').map_or(0, |end| end + 1);
            listing.file.set_len((HEADER.len() + whole) as u64).map_err(failed)?;
            // Regardless of the list, no file is touched that a run would not write.
            listing.names = names[..whole].lines().filter(|name| is_result(name)).map(String::from).collect();
        } else if HEADER.starts_with(&*text) {
            // The program ended before it wrote anything.
            listing.clear().map_err(failed)?;
        } else {
            return Err(foreign(folder));
        }
        Ok(listing)
    }

    /// Leaves out all names.
    pub(super) fn clear(&mut self) -> io::Result<()> {
        self.names.clear();
        self.file.set_len(0)?;
        self.file.write_all(HEADER.as_bytes())
    }

    /// True if piola has written the file of this name.
    pub(super) fn contains(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    pub(super) fn names(&self) -> impl DoubleEndedIterator<Item = &str> {
        self.names.iter().map(String::as_str)
    }

    /// Adds the name of a file that is to be created.
    pub(super) fn add(&mut self, name: &str) -> Result<(), Error> {
        if !self.names.contains(name) {
            let failed = |source| Error::Write { path: self.path.clone(), source };
            let length = self.file.metadata().map_err(failed)?.len();
            if let Err(source) = self.file.write_all(format!("{name}\n").as_bytes()) {
                // Half a name would run into the next one.
                let _ = self.file.set_len(length);
                return Err(failed(source));
            }
            self.names.insert(name.into());
        }
        Ok(())
    }

    /// Removes the name that was added last, whose file somebody else may have created.
    pub(super) fn withdraw(&mut self, name: &str) {
        self.names.remove(name);
        let length = self.file.metadata().map(|metadata| metadata.len());
        let _ = length.and_then(|length| self.file.set_len(length.saturating_sub(name.len() as u64 + 1)));
    }
}

fn foreign(folder: &Path) -> Error {
    Error::ForeignFiles { folder: folder.into(), names: vec![LISTING.into()] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read_as_it_was_written_by_one_at_a_time() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let folder = scratch.path();
        assert!(Listing::open(folder)?.is_none());
        let mut listing = Listing::begin(folder)?;
        for name in ["frame_0000.ply", "frame_0001.ply", "frame_0002.ply"] {
            listing.add(name)?;
        }
        listing.withdraw("frame_0002.ply");
        assert!(matches!(Listing::open(folder), Err(Error::Busy { .. })));
        drop(listing);

        // The program ended in the middle of a name, and somebody has added another file.
        let path = folder.join(LISTING);
        let text = fs::read_to_string(&path)? + "thesis.tex\n../frame_0002.ply\nframe_00";
        fs::write(&path, text)?;
        let mut listing = Listing::open(folder)?.expect("a list");
        assert_eq!(listing.names().collect::<Vec<_>>(), ["frame_0000.ply", "frame_0001.ply"]);
        listing.clear()?;
        drop(listing);
        assert_eq!(fs::read_to_string(&path)?, HEADER);
        Ok(())
    }

    #[test]
    fn another_file_of_the_name_is_left_alone() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let path = scratch.path().join(LISTING);
        fs::write(&path, "")?;
        assert!(Listing::open(scratch.path())?.is_some(), "the program ended before it wrote");
        fs::write(&path, "my notes\n")?;
        assert!(matches!(Listing::open(scratch.path()), Err(Error::ForeignFiles { .. })));
        assert_eq!(fs::read_to_string(&path)?, "my notes\n");
        Ok(())
    }
}
