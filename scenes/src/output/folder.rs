//! A folder that gets all of a run's files at its end, or none.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// A folder that keeps its files aside, in a hidden folder inside it, until [`publish`](Self::publish) moves
/// them into place.
///
/// Dropped before that, it leaves the target as it found it.
#[derive(Debug)]
pub struct Folder {
    target: PathBuf,
    aside: PathBuf,
    names: Vec<String>,
    /// Folders that did not exist before, innermost first.
    created: Vec<PathBuf>,
}

impl Folder {
    /// Prepares a folder for files, creating it if it does not exist.
    ///
    /// # Errors
    /// [`Error::Folder`] if files cannot be written there.
    pub fn prepare(target: &Path) -> Result<Self, Error> {
        // The process number keeps two runs into one folder apart.
        let aside = target.join(format!(".unfinished-{}", std::process::id()));
        let existed = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let created = target.ancestors().take_while(existed).map(PathBuf::from).collect();
        let folder = Self { target: target.into(), aside, names: Vec::new(), created };
        match fs::create_dir_all(&folder.aside) {
            Ok(()) => Ok(folder),
            Err(source) => Err(Error::Folder { path: target.into(), source }),
        }
    }

    /// Writes one file, which `content` fills.
    ///
    /// # Errors
    /// [`Error::Write`] if the disk is full or `content` fails.
    pub fn write(
        &mut self,
        name: &str,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let written = File::create(self.aside.join(name)).and_then(|file| {
            let mut file = BufWriter::new(file);
            content(&mut file)?;
            file.flush()
        });
        written.map_err(|source| self.failure(name, source))?;
        self.names.push(name.into());
        Ok(())
    }

    /// Moves all files into place, over those of an earlier run; frames of an earlier, longer run are
    /// removed.
    ///
    /// # Errors
    /// [`Error::Write`] if a file of that name cannot be replaced.
    pub fn publish(mut self) -> Result<(), Error> {
        for stale in fs::read_dir(&self.target).into_iter().flatten().flatten() {
            let name = stale.file_name().to_string_lossy().into_owned();
            if is_frame(&name) && !self.names.contains(&name) {
                fs::remove_file(stale.path()).map_err(|source| self.failure(&name, source))?;
            }
        }
        for name in &self.names {
            fs::rename(self.aside.join(name), self.target.join(name))
                .map_err(|source| self.failure(name, source))?;
        }
        self.created.clear();
        Ok(())
    }

    fn failure(&self, name: &str, source: io::Error) -> Error {
        Error::Write { path: self.target.join(name), source }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // Nothing more can be done where cleaning up fails: the name of what stays says what it is.
        let _ = fs::remove_dir_all(&self.aside);
        for folder in &self.created {
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Whether it is a name that [`frame_file`](super::frame_file) or [`cage_file`](super::cage_file) gives.
fn is_frame(name: &str) -> bool {
    let digits =
        name.strip_prefix("frame_").and_then(|rest| rest.strip_suffix(".ply").or(rest.strip_suffix(".vtu")));
    digits.is_some_and(|digits| digits.len() >= 4 && digits.bytes().all(|byte| byte.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .expect("a folder")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn nothing_appears_before_everything_is_there() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::tempdir()?;
        let target = scratch.path().join("a/b");
        let mut folder = Folder::prepare(&target)?;
        folder.write("frame_0000.ply", |file| file.write_all(b"new"))?;
        assert!(!target.join("frame_0000.ply").exists(), "published too early");
        drop(folder);
        assert_eq!(names(scratch.path()), [""; 0], "an abandoned run leaves no folder");

        fs::create_dir_all(&target)?;
        for earlier in
            ["frame_0000.ply", "frame_0007.ply", "frame_0003.vtu", "frame_of_mind.ply", "notes.txt"]
        {
            fs::write(target.join(earlier), "old")?;
        }
        let mut folder = Folder::prepare(&target)?;
        folder.write("frame_0000.ply", |file| file.write_all(b"new"))?;
        folder.publish()?;
        assert_eq!(names(&target), ["frame_0000.ply", "frame_of_mind.ply", "notes.txt"]);
        assert_eq!(fs::read_to_string(target.join("frame_0000.ply"))?, "new");
        Ok(())
    }

    #[test]
    fn a_file_in_the_way_is_an_error() -> Result<(), Box<dyn std::error::Error>> {
        let scratch = tempfile::NamedTempFile::new()?;
        let error = Folder::prepare(&scratch.path().join("sub")).err().map(|error| error.to_string());
        let name = scratch.path().join("sub").display().to_string();
        assert!(error.as_ref().is_some_and(|error| error.contains(&name)), "{error:?}");
        Ok(())
    }
}
