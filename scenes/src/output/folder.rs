//! New folder with the files of a run.
//!
//! Files are written during the run, so that an interruption leaves a shorter run. Nothing that was there
//! before is replaced: a run begins in a folder that does not exist yet.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

use super::{PARTIAL, STATE_FILE};

#[cfg(test)]
mod tests;

/// A folder that is being filled with the files of a run.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    /// Names of the files written here.
    written: Vec<String>,
    /// Folders that did not exist before, innermost first.
    created: Vec<PathBuf>,
    /// The folder, locked until the program ends; `None` on systems that lock no folders.
    _lock: Option<File>,
}

impl Folder {
    /// Creates a folder for the files of a run.
    ///
    /// # Errors
    /// [`Error::FolderExists`], [`Error::Folder`] if it cannot be created, [`Error::Busy`].
    pub fn create(path: &Path) -> Result<Self, Error> {
        let is_new = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let created: Vec<_> = path.ancestors().take_while(is_new).map(PathBuf::from).collect();
        let parents = path.parent().map_or(Ok(()), fs::create_dir_all);
        match parents.and_then(|()| fs::create_dir(path)) {
            Ok(()) => Self::locked(path, created),
            Err(source) => {
                remove_folders(created.get(1..).unwrap_or_default());
                Err(match path.is_dir() {
                    true => Error::FolderExists { folder: path.into() },
                    false => Error::Folder { path: path.into(), source },
                })
            }
        }
    }

    /// Opens the folder of a run to continue it.
    ///
    /// # Errors
    /// [`Error::NothingToResume`] if the folder has no state of a run, [`Error::Busy`] if another program writes
    /// there.
    pub fn reopen(path: &Path) -> Result<Self, Error> {
        match path.join(STATE_FILE).is_file() {
            true => Self::locked(path, Vec::new()),
            false => Err(Error::NothingToResume { folder: path.into() }),
        }
    }

    fn locked(path: &Path, created: Vec<PathBuf>) -> Result<Self, Error> {
        let lock = File::open(path).ok();
        match lock.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => Err(Error::Busy { folder: path.into() }),
            _ => Ok(Self { path: path.into(), written: Vec::new(), created, _lock: lock }),
        }
    }

    /// The folder that files are written to.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes one file, which `content` fills. It appears when it is complete, and replaces one of its name.
    ///
    /// # Errors
    /// [`Error::Write`] if the disk is full or `content` fails. The folder is then as it was.
    pub fn write(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let [partial, path] = [PARTIAL, name].map(|name| self.path.join(name));
        let written = File::create(&partial).and_then(|file| {
            let mut file = BufWriter::new(file);
            content(&mut file)?;
            file.flush()?;
            fs::rename(&partial, &path)
        });
        self.written.push(name.into());
        written.map_err(|source| {
            let _ = fs::remove_file(&partial);
            Error::Write { path, source }
        })
    }

    /// Writes one file, which is on the disk before it replaces one of its name.
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

    /// Removes the files of the run, and the folders that it created.
    pub fn abandon(self) {
        for name in &self.written {
            let _ = fs::remove_file(self.path.join(name));
        }
        remove_folders(&self.created);
    }
}

/// The first of `base`, `base-2`, `base-3`, … that does not exist.
#[must_use]
pub fn new_folder(base: &Path) -> PathBuf {
    let numbered = |number: usize| {
        let mut name = base.as_os_str().to_owned();
        name.push(format!("-{number}"));
        PathBuf::from(name)
    };
    let mut folders = std::iter::once(base.to_owned()).chain((2..).map(numbered));
    folders.find(|folder| fs::symlink_metadata(folder).is_err()).unwrap_or_else(|| base.to_owned())
}

/// Removes folders that are empty.
fn remove_folders(innermost_first: &[PathBuf]) {
    for folder in innermost_first {
        let _ = fs::remove_dir(folder);
    }
}
