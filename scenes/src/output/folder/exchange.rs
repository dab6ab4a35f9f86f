//! Files moved from folder to folder, all or none.

use std::fs;
use std::io;
use std::path::PathBuf;

/// Moves that can be taken back.
#[derive(Debug, Default)]
pub(super) struct Moves {
    done: Vec<(PathBuf, PathBuf)>,
}

impl Moves {
    /// Moves a file to a name that nothing has.
    pub(super) fn rename(&mut self, from: PathBuf, to: PathBuf) -> io::Result<()> {
        if fs::symlink_metadata(&to).is_ok() {
            let there = format!("{} is in the way", to.display());
            return Err(io::Error::new(io::ErrorKind::AlreadyExists, there));
        }
        fs::rename(&from, &to)?;
        self.done.push((from, to));
        Ok(())
    }

    /// Moves everything back, the last first. What cannot be moved back stays whole where it is.
    pub(super) fn undo(self) {
        for (from, to) in self.done.into_iter().rev() {
            let _ = fs::rename(to, from);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_are_taken_back() -> io::Result<()> {
        let scratch = tempfile::tempdir()?;
        let path = |name: &str| scratch.path().join(name);
        for name in ["a", "b"] {
            fs::write(path(name), name)?;
        }
        let mut moves = Moves::default();
        moves.rename(path("a"), path("c"))?;
        moves.rename(path("b"), path("a"))?;
        assert!(moves.rename(path("a"), path("c")).is_err(), "something is in the way");
        moves.undo();
        assert_eq!(
            (fs::read_to_string(path("a"))?, fs::read_to_string(path("b"))?),
            ("a".into(), "b".into())
        );
        Ok(())
    }
}
