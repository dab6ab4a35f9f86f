//! New folder with the files of a run.
//!
//! Files are written during the run, so that an interruption leaves a shorter run. Nothing that was there
//! before is replaced: a run begins in a folder that does not exist yet.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use crate::error::Error;

use super::{STATE_FILE, whole};

/// A folder that is being filled with the files of a run.
#[derive(Debug)]
pub struct Folder {
    /// The folder that files are written to.
    pub path: PathBuf,
    /// Folders that did not exist before, innermost first.
    created: Vec<PathBuf>,
    /// The folder, locked until the program ends; `None` on systems that lock no folders.
    _lock: Option<File>,
}

impl Folder {
    /// Creates a folder for the files of a run.
    ///
    /// # Errors
    /// [`Error::Usage`] if it exists or cannot be created, or if another run writes there.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let is_new = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let created: Vec<_> = path.ancestors().take_while(is_new).map(PathBuf::from).collect();
        let parents = path.parent().map_or(Ok(()), fs::create_dir_all);
        parents.and_then(|()| fs::create_dir(path)).map_err(|error| {
            created.iter().skip(1).for_each(|folder| drop(fs::remove_dir(folder)));
            let reason = match path.is_dir() {
                true => {
                    "it exists already; name a new one with --out, or continue the run in it with --resume"
                        .into()
                }
                false => format!("{error}; name another one with --out"),
            };
            Error::Usage(format!("cannot write to the folder {}: {reason}", path.display()))
        })?;
        Self::locked(path, created)
    }

    /// Opens the folder of a run to continue it.
    ///
    /// # Errors
    /// [`Error::Usage`] if the folder has no state of a run, or if another run writes there.
    pub fn reopen(path: &Path) -> Result<Self, Error> {
        match path.join(STATE_FILE).is_file() {
            true => Self::locked(path, Vec::new()),
            false => Err(Error::Usage(format!(
                "the folder {} contains no run to continue; leave out --resume, or name another one with --out",
                path.display()
            ))),
        }
    }

    fn locked(path: &Path, created: Vec<PathBuf>) -> Result<Self, Error> {
        let lock = File::open(path).ok();
        match lock.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => Err(Error::Usage(format!(
                "another run is writing to the folder {}; wait until it has ended",
                path.display()
            ))),
            _ => Ok(Self { path: path.into(), created, _lock: lock }),
        }
    }

    /// Writes one file, which `content` fills. It appears when it is complete, or, if it `is_durable`, when
    /// it is on the disk, and replaces one of its name.
    ///
    /// # Errors
    /// [`Error::Write`] if the disk is full or `content` fails. The folder is then as it was.
    pub fn write(
        &self,
        name: &str,
        is_durable: bool,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let path = self.path.join(name);
        whole::replace(&path, is_durable, content).map_err(|source| Error::Write { path, source })
    }

    /// Removes a folder that was created here, with its files, and the folders around it that are empty.
    pub fn abandon(self) {
        if let [folder, around @ ..] = &self.created[..] {
            let _ = fs::remove_dir_all(folder);
            around.iter().for_each(|folder| drop(fs::remove_dir(folder)));
        }
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

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;
    use crate::output::frame_file;

    fn names(folder: &Path) -> io::Result<Vec<String>> {
        let names = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
        let mut names = names.collect::<io::Result<Vec<_>>>()?;
        names.sort();
        Ok(names)
    }

    #[test]
    fn files_are_in_their_place_at_once_and_go_if_nothing_came_of_them()
    -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let target = scratch.path().join("a/b");
        let folder = Folder::create(&target)?;
        folder.write(&frame_file(0), false, |file| file.write_all(b"one"))?;
        folder.write("summary.json", true, |file| file.write_all(b"two"))?;
        let failed = folder.write(&frame_file(1), false, |_| Err(io::Error::other("a full disk")));
        assert!(failed.is_err_and(|error| error.to_string().contains("frame_0001.ply: a full disk")));
        assert_eq!(names(&target)?, ["frame_0000.ply", "summary.json"]);
        folder.abandon();
        assert_eq!(names(scratch.path())?, [""; 0]);
        Ok(())
    }

    #[test]
    fn one_run_at_a_time_writes_to_a_folder() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let target = scratch.path().join("out");
        let folder = Folder::create(&target)?;
        folder.write(STATE_FILE, false, |file| file.write_all(b"{}"))?;
        if cfg!(unix) {
            let refused = Folder::reopen(&target);
            assert!(refused.is_err_and(|error| error.to_string().contains("another run is writing")));
        }
        drop(folder);
        assert!(Folder::reopen(&target).is_ok());
        Ok(())
    }
}
