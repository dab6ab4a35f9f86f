//! The list of the files that runs have written into a folder, kept in that folder.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use super::super::is_result;
use super::super::whole::new_file;
use crate::error::Error;

/// Name of the list.
pub(super) const LISTING: &str = "piola-files.txt";
/// The first line of a list, by which one is recognised.
const HEADER: &str = "Files that piola has written here; it replaces and removes these and no others.";
/// Longer than the names of a million frames.
const MAX_LENGTH: u64 = 1 << 28;

/// The names of the files that piola has written into a folder, and the right to write there.
///
/// A name is added before its file is created: whatever ends the program, each file of piola is in the list.
/// The list is locked for as long as it is open, by the system, which ends the lock with the program.
#[derive(Debug)]
pub(super) struct Listing {
    file: File,
    path: PathBuf,
    names: BTreeSet<String>,
    /// Whether the file names something that does not belong there.
    is_stale: bool,
}

impl Listing {
    /// Begins a list in a folder that has none.
    pub(super) fn create(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(LISTING);
        let file = File::options().read(true).append(true).create_new(true).open(&path);
        let mut file = match file {
            Ok(file) => file,
            // Another run has begun one since somebody looked.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(Error::Busy { folder: folder.into() });
            }
            Err(source) => return Err(Error::Folder { path: folder.into(), source }),
        };
        lock(&file, folder)?;
        if let Err(source) = writeln!(file, "{HEADER}") {
            let _ = fs::remove_file(&path);
            return Err(Error::Write { path, source });
        }
        Ok(Self { file, path, names: BTreeSet::new(), is_stale: false })
    }

    /// Opens the list of a folder, if it has one.
    pub(super) fn open(folder: &Path) -> Result<Option<Self>, Error> {
        let path = folder.join(LISTING);
        let foreign = || Error::ForeignFiles { folder: folder.into(), names: vec![LISTING.into()] };
        match fs::symlink_metadata(&path) {
            Ok(metadata) if metadata.is_file() && metadata.len() <= MAX_LENGTH => {}
            Ok(_) => return Err(foreign()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(Error::Folder { path: folder.into(), source }),
        }
        let failed = |source| Error::Folder { path: folder.into(), source };
        let mut file = File::options().read(true).append(true).open(&path).map_err(failed)?;
        lock(&file, folder)?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(failed)?;
        let text = String::from_utf8_lossy(&text);
        // A line without an end was being written when the program ended; its file does not exist.
        let mut lines = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
        match lines.next() {
            Some(HEADER) => {}
            // The program ended before it wrote anything.
            None if HEADER.starts_with(&*text) => {
                file.set_len(0).and_then(|()| writeln!(file, "{HEADER}")).map_err(failed)?;
            }
            _ => return Err(foreign()),
        }
        // Whatever a list says, no file is touched that a run would not write.
        let names = lines.filter(|name| is_result(name)).map(String::from).collect();
        if !text.is_empty() && !text.ends_with('\n') {
            file.write_all(b"\n").map_err(failed)?;
        }
        Ok(Some(Self { file, path, names, is_stale: false }))
    }

    /// Whether piola has written the file of this name.
    pub(super) fn contains(&self, name: &str) -> bool {
        self.names.contains(name)
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &str> {
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

    /// Takes back the name of a file that somebody else has created.
    pub(super) fn withdraw(&mut self, name: &str) {
        self.is_stale |= self.names.remove(name);
    }

    /// Leaves out names that were taken back, and those of files that do not exist.
    ///
    /// The list is written aside and moved into place; if that fails, the longer one stays.
    pub(super) fn tidy(&mut self) {
        let Some(folder) = self.path.parent() else { return };
        let (exist, gone): (BTreeSet<_>, BTreeSet<_>) =
            std::mem::take(&mut self.names).into_iter().partition(|name| folder.join(name).is_file());
        self.names = exist;
        if gone.is_empty() && !self.is_stale {
            return;
        }
        let mut text = format!("{HEADER}\n");
        text.extend(self.names.iter().flat_map(|name| [name, "\n"]));
        let written = new_file().tempfile_in(folder).and_then(|mut aside| {
            aside.write_all(text.as_bytes())?;
            // Nobody else can know of it yet; where there are no locks, there was none before.
            let _ = aside.as_file().try_lock();
            Ok(aside.persist(&self.path)?)
        });
        if let Ok(file) = written {
            (self.file, self.is_stale) = (file, false);
        }
    }
}

/// Locks a list, so that no two runs write into one folder. Does without where the file system has no locks.
fn lock(file: &File, folder: &Path) -> Result<(), Error> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(Error::Busy { folder: folder.into() }),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_read_as_it_was_written_by_one_at_a_time() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let folder = scratch.path();
        assert!(Listing::open(folder)?.is_none());
        let mut listing = Listing::create(folder)?;
        listing.add("frame_0000.ply")?;
        listing.add("frame_0001.ply")?;
        assert!(matches!(Listing::open(folder), Err(Error::Busy { .. })));
        drop(listing);

        // The program ended in the middle of a name, and somebody has added another file.
        let path = folder.join(LISTING);
        let text = fs::read_to_string(&path)? + "thesis.tex\n../frame_0002.ply\nframe_00";
        fs::write(&path, text)?;
        let mut listing = Listing::open(folder)?.expect("a list");
        assert_eq!(listing.names().collect::<Vec<_>>(), ["frame_0000.ply", "frame_0001.ply"]);

        fs::write(folder.join("frame_0001.ply"), "")?;
        listing.tidy();
        drop(listing);
        assert_eq!(fs::read_to_string(&path)?, format!("{HEADER}\nframe_0001.ply\n"));
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
