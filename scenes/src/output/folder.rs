//! Folder with the files of a run, which leaves all other files alone.
//!
//! Files are written during the run, so that an interruption leaves a shorter run. Each is entered in a list
//! in the folder before it is created: files that are not in the list belong to others. Files in the list are
//! removed when another run begins there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

use super::{PARTIAL, RESERVE, is_result};

mod listing;
#[cfg(test)]
mod tests;

use listing::{LISTING, Listing};

/// Disk space reserved for the closing files of a run that has filled the disk, in bytes.
const ROOM: usize = 64 * 1024;

/// A folder that is being filled with the files of a run.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    listing: Listing,
    /// Folders that did not exist before, innermost first.
    created: Vec<PathBuf>,
}

impl Folder {
    /// Prepares a folder for the files of a run: creates it if it does not exist, and removes the files of an
    /// earlier run.
    ///
    /// # Errors
    /// [`Error::ForeignFiles`] if the folder holds something with the name of a frame or a result that no run
    /// has written, [`Error::Busy`] if another run writes there, and [`Error::Folder`] if files cannot be
    /// removed or written there.
    pub fn prepare(path: &Path) -> Result<Self, Error> {
        let is_new = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let created: Vec<_> = path.ancestors().take_while(is_new).map(PathBuf::from).collect();
        let failed = |source| Error::Folder { path: path.into(), source };
        let prepare = || -> Result<Listing, Error> {
            fs::create_dir_all(path).map_err(failed)?;
            let listing = Listing::open(path)?;
            refuse_foreign(path, listing.as_ref())?;
            let mut listing = listing.map_or_else(|| Listing::begin(path), Ok)?;
            // The last first: at any moment, what is left is the beginning of a run.
            for name in listing.names().rev() {
                match fs::remove_file(path.join(name)) {
                    Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(failed(error)),
                    _ => {}
                }
            }
            listing.clear().map_err(failed)?;
            Ok(listing)
        };
        match prepare() {
            Ok(listing) => Ok(Self { path: path.into(), listing, created }),
            Err(error) => {
                remove_folders(&created);
                Err(error)
            }
        }
    }

    /// Opens the folder of a run to continue it.
    ///
    /// # Errors
    /// Like [`Folder::prepare`], and [`Error::NothingToResume`] if the folder holds no run.
    pub fn reopen(path: &Path) -> Result<Self, Error> {
        let nothing = || Error::NothingToResume { folder: path.into() };
        let listing = Listing::open(path)?.ok_or_else(nothing)?;
        refuse_foreign(path, Some(&listing))?;
        Ok(Self { path: path.into(), listing, created: Vec::new() })
    }

    /// The folder that files are written to.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// True if the run has written a file of this name.
    #[must_use]
    pub fn contains(&self, name: &str) -> bool {
        self.listing.contains(name) && self.path.join(name).is_file()
    }

    /// Writes one file, which `content` fills. It appears when it is complete, and replaces one that the run
    /// has written before.
    ///
    /// # Errors
    /// [`Error::Write`] if the disk is full, `content` fails, or somebody else has written a file of that
    /// name meanwhile. The folder is then as it was.
    pub fn write(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        self.listing.add(PARTIAL)?;
        let [partial, path] = [PARTIAL, name].map(|name| self.path.join(name));
        let is_own = self.listing.contains(name);
        self.listing.add(name)?;
        let written = File::create(&partial).and_then(|file| {
            let mut file = BufWriter::new(file);
            content(&mut file)?;
            file.flush()?;
            if !is_own && fs::symlink_metadata(&path).is_ok() {
                return Err(io::Error::other("a file of that name has appeared meanwhile"));
            }
            fs::rename(&partial, &path)
        });
        written.map_err(|source| {
            let _ = fs::remove_file(&partial);
            if !is_own {
                self.listing.withdraw(name);
            }
            Error::Write { path, source }
        })
    }

    /// Writes one file, which is on the disk before it replaces one that the run has written before.
    ///
    /// # Errors
    /// Like [`Folder::write`].
    pub fn replace(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        self.write(name, |file| {
            content(file)?;
            file.flush()?;
            file.get_ref().sync_all()
        })
    }

    /// Reserves disk space for the closing files of a run that fills the disk, until
    /// [`release`](Self::release).
    ///
    /// # Errors
    /// Like [`Folder::write`].
    pub fn reserve(&mut self) -> Result<(), Error> {
        self.write(RESERVE, |file| file.write_all(&[0; ROOM]))
    }

    /// Frees the reserved disk space.
    pub fn release(&mut self) {
        let _ = fs::remove_file(self.path.join(RESERVE));
    }

    /// Removes all files of the run, and its folder if that did not exist before.
    pub fn abandon(self) {
        for name in self.listing.names().chain([LISTING]) {
            let _ = fs::remove_file(self.path.join(name));
        }
        remove_folders(&self.created);
    }
}

/// Refuses a folder that contains a file with the name of a result that is not in the list.
fn refuse_foreign(folder: &Path, listing: Option<&Listing>) -> Result<(), Error> {
    let failed = |source| Error::Folder { path: folder.into(), source };
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        // Names that are not in UTF-8 are nobody's but the user's.
        let Ok(name) = entry.map_err(failed)?.file_name().into_string() else { continue };
        if is_result(&name) && !listing.is_some_and(|listing| listing.contains(&name)) {
            names.push(name);
        }
    }
    names.sort_unstable();
    if names.is_empty() { Ok(()) } else { Err(Error::ForeignFiles { folder: folder.into(), names }) }
}

/// Removes folders that are empty.
fn remove_folders(innermost_first: &[PathBuf]) {
    for folder in innermost_first {
        let _ = fs::remove_dir(folder);
    }
}
