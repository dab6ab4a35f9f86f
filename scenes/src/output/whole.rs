//! Files that appear complete or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;

/// Number of bytes at the begin of a file that show its kind: of a chart, a state, source text in C.
const KIND: usize = 3;

/// Writes a file that replaces an earlier one of the same name only once it is complete and on the disk.
///
/// The earlier one must be of the same kind: a mesh or measurements are never meant to become a chart.
/// A replaced file keeps its permissions. A symbolic link stays, and the file that it leads to is replaced. A
/// device, a pipe or a file descriptor, such as /dev/stdout, is written into.
///
/// # Errors
/// [`Error::Write`]; an earlier file is then as it was.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Error> {
    // A file that replaced one that is open already would reach nobody.
    let is_open = ["/dev", "/proc"].iter().any(|open| path.starts_with(open));
    let written = match fs::canonicalize(path) {
        Ok(place) if place.is_file() && !is_open => {
            check_kind(&place, content).and_then(|()| replace(&place, true, |file| file.write_all(content)))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound && !path.is_symlink() => {
            replace(path, true, |file| file.write_all(content))
        }
        // What is begun through a link to no file can only be finished through it.
        _ => {
            let file = File::options().append(true).create(true).open(path);
            file.and_then(|mut file| file.write_all(content))
        }
    };
    written.map_err(|source| Error::Write { path: path.into(), source })
}

/// The text of a file with a length, in bytes, of `longest` at most.
///
/// # Errors
/// [`Error::Usage`] if it cannot be read, or is longer.
pub fn read_text(path: &Path, longest: u64) -> Result<String, Error> {
    let mut text = String::new();
    let read =
        File::open(path).and_then(|file| file.take(longest.saturating_add(1)).read_to_string(&mut text));
    let read = read.and_then(|length| match length as u64 > longest {
        true => Err(io::Error::other(format!("it is longer than {} MiB", longest >> 20))),
        false => Ok(text),
    });
    read.map_err(|error| Error::Usage(format!("{}: cannot be read: {error}", path.display())))
}

/// Checks that a file is empty or begins as the new one does.
fn check_kind(earlier: &Path, content: &[u8]) -> io::Result<()> {
    let mut begin = Vec::new();
    File::open(earlier)?.take(KIND as u64).read_to_end(&mut begin)?;
    let other = "a file of another kind has this name; name another one, or remove it";
    match content.starts_with(&begin) {
        true => Ok(()),
        false => Err(io::Error::new(io::ErrorKind::AlreadyExists, other)),
    }
}

/// Writes a file next to its final place and moves it there, after it is on the disk if that is wanted.
pub(super) fn replace(
    path: &Path,
    is_durable: bool,
    content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".piola-partial");
    let partial = PathBuf::from(partial);
    // One that a killed program has left. A new file is no link that leads elsewhere.
    let _ = fs::remove_file(&partial);
    let written = File::create_new(&partial).and_then(|file| {
        if let Ok(earlier) = fs::metadata(path) {
            file.set_permissions(earlier.permissions())?;
        }
        let mut file = BufWriter::new(file);
        content(&mut file)?;
        file.flush()?;
        if is_durable {
            file.get_ref().sync_all()?;
        }
        fs::rename(&partial, path)
    });
    if written.is_err() {
        let _ = fs::remove_file(&partial);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    type TestResult = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn a_file_is_replaced_and_nothing_is_left_beside_it() -> TestResult {
        let scratch = tempfile::tempdir()?;
        let path = scratch.path().join("map.svg");
        fs::write(&path, "")?;
        for content in ["<svg>one", "<svg>another"] {
            write_whole(&path, content.as_bytes())?;
            assert_eq!(fs::read_to_string(&path)?, content);
        }
        let refused = write_whole(&path, b"{}").expect_err("another kind").to_string();
        assert!(refused.contains("map.svg: a file of another kind"), "{refused}");
        assert!(replace(&path, false, |_| Err(io::Error::other("a full disk"))).is_err());
        assert_eq!(
            (fs::read_dir(scratch.path())?.count(), fs::read_to_string(&path)?),
            (1, "<svg>another".into())
        );
        assert!(write_whole(&scratch.path().join("no/map.svg"), b"").is_err());
        assert!(write_whole(scratch.path(), b"").is_err(), "a folder");
        Ok(())
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_stay_and_pipes_are_written_into() -> TestResult {
        use std::os::unix::fs::{PermissionsExt, symlink};

        let scratch = tempfile::tempdir()?;
        let [file, link, hanging, pipe] =
            ["file", "link", "hanging", "pipe"].map(|name| scratch.path().join(name));
        fs::write(&file, "text, old")?;
        fs::set_permissions(&file, fs::Permissions::from_mode(0o600))?;
        symlink("file", &link)?;
        write_whole(&link, b"text, new")?;
        assert_eq!((fs::read_to_string(&file)?, link.is_symlink()), ("text, new".into(), true));
        assert_eq!(fs::metadata(&file)?.permissions().mode() & 0o777, 0o600);

        symlink("made", &hanging)?;
        write_whole(&hanging, b"first")?;
        assert_eq!(fs::read_to_string(scratch.path().join("made"))?, "first");

        assert!(std::process::Command::new("mkfifo").arg(&pipe).status()?.success());
        let reader = std::thread::spawn(move || fs::read_to_string(pipe));
        write_whole(&scratch.path().join("pipe"), b"through")?;
        assert_eq!(reader.join().expect("a reader that ends")?, "through");
        Ok(())
    }
}
