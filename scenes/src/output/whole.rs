//! Files that appear complete or not at all.

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::Path;

use crate::error::Error;

/// Writes a file that replaces an earlier one of the same name only once it is complete and on the disk.
///
/// A replaced file keeps its permissions. A symbolic link stays, and the file that it leads to is replaced. A
/// device, a pipe or a file descriptor, such as /dev/stdout, is written into.
///
/// # Errors
/// [`Error::Write`]; an earlier file is then as it was.
pub fn write_whole(path: &Path, content: &[u8]) -> Result<(), Error> {
    write(path, content).map_err(|source| Error::Write { path: path.into(), source })
}

fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    match fs::metadata(path) {
        Ok(earlier) if earlier.is_file() && !is_descriptor(path) => {
            replace(&fs::canonicalize(path)?, content, Some(earlier.permissions()))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound && !path.is_symlink() => {
            replace(path, content, None)
        }
        // What is begun through a link to no file can only be finished through it.
        _ => File::options().append(true).create(true).open(path)?.write_all(content),
    }
}

/// True if a path leads to something that is open already: a file that replaced it would reach nobody.
fn is_descriptor(path: &Path) -> bool {
    ["/dev/fd", "/dev/stdin", "/dev/stdout", "/dev/stderr", "/proc"].iter().any(|open| path.starts_with(open))
}

/// Writes a temporary file next to the final one, and moves it there.
fn replace(path: &Path, content: &[u8], earlier: Option<Permissions>) -> io::Result<()> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".piola-");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // Nobody has given the name of a temporary file that such an error has.
    let mut aside = builder.tempfile_in(folder).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => {
            io::Error::other(format!("the folder {} does not exist", folder.display()))
        }
        kind => io::Error::from(kind),
    })?;
    if let Some(earlier) = earlier {
        aside.as_file().set_permissions(earlier)?;
    }
    aside.write_all(content)?;
    aside.as_file().sync_all()?;
    aside.persist(path).map_err(|error| error.error)?;
    // Makes the name as durable as the file; systems that cannot do so do it in their own time.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    type TestResult = Result<(), Box<dyn std::error::Error>>;

    #[test]
    fn a_file_is_replaced_and_nothing_is_left_beside_it() -> TestResult {
        let scratch = tempfile::tempdir()?;
        let path = scratch.path().join("map.svg");
        for content in ["one", "another"] {
            write_whole(&path, content.as_bytes())?;
            assert_eq!(fs::read_to_string(&path)?, content);
        }
        assert_eq!(fs::read_dir(scratch.path())?.count(), 1);
        assert!(write_whole(&scratch.path().join("no/map.svg"), b"").is_err());
        assert!(write_whole(scratch.path(), b"").is_err(), "a folder");
        Ok(())
    }

    /// Shared memory is not a descriptor, though it is listed next to them.
    #[test]
    fn descriptors_are_told_from_files_beside_them() {
        for (path, expected) in [
            ("/dev/stdout", true),
            ("/dev/fd/3", true),
            ("/proc/self/fd/1", true),
            ("/dev/shm/map.svg", false),
            ("dev/stdout", false),
        ] {
            assert_eq!(is_descriptor(Path::new(path)), expected, "{path}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn permissions_and_links_stay_and_pipes_are_written_into() -> TestResult {
        use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};

        let scratch = tempfile::tempdir()?;
        let [file, link, hanging, pipe] =
            ["file", "link", "hanging", "pipe"].map(|name| scratch.path().join(name));
        fs::write(&file, "old")?;
        fs::set_permissions(&file, Permissions::from_mode(0o600))?;
        symlink("file", &link)?;
        write_whole(&link, b"new")?;
        assert_eq!(fs::read_to_string(&file)?, "new");
        assert_eq!(fs::metadata(&file)?.permissions().mode() & 0o777, 0o600);
        assert!(link.is_symlink());

        symlink("made", &hanging)?;
        write_whole(&hanging, b"first")?;
        assert_eq!(fs::read_to_string(scratch.path().join("made"))?, "first");
        assert!(hanging.is_symlink());

        assert!(std::process::Command::new("mkfifo").arg(&pipe).status()?.success());
        let reader = std::thread::spawn({
            let pipe = pipe.clone();
            move || fs::read_to_string(pipe)
        });
        write_whole(&pipe, b"through")?;
        assert_eq!(reader.join().expect("a reader that ends")?, "through");
        assert!(fs::symlink_metadata(&pipe)?.file_type().is_fifo());
        Ok(())
    }
}
