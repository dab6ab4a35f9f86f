//! Files that a command line names twice, once of them to be written.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::error::Error;

/// An option that names a file, and the file.
pub(crate) type Named = (&'static str, PathBuf);

/// Refuses an output that is an input or another output, by any path or link.
///
/// # Errors
/// [`Error::NamedTwice`].
pub(crate) fn refuse_overlaps(
    inputs: impl IntoIterator<Item = Named>,
    outputs: impl IntoIterator<Item = Named>,
) -> Result<(), Error> {
    let mut named: Vec<_> = inputs.into_iter().map(|(option, path)| (option, place(&path))).collect();
    for (other, path) in outputs {
        let place = place(&path);
        if let Some(&(one, _)) = named.iter().find(|(_, earlier)| place.is_some() && *earlier == place) {
            return Err(Error::NamedTwice { path, one, other });
        }
        named.push((other, place));
    }
    Ok(())
}

/// Target of a path, which may not exist yet; `None` for a device or a pipe, in which nothing is lost, and
/// for a folder that does not exist, in which nothing can be written.
fn place(path: &Path) -> Option<PathBuf> {
    match fs::canonicalize(path) {
        Ok(place) => place.is_file().then_some(place),
        Err(error) => {
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = folder.unwrap_or(Path::new("."));
            match fs::read_link(path) {
                // Links that lead in a circle are another error.
                Ok(target) if error.kind() == ErrorKind::NotFound => place(&folder.join(target)),
                _ => Some(fs::canonicalize(folder).ok()?.join(path.file_name()?)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_a_file_is_the_same_place() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("data.csv"), "data").expect("a scratch file");
        fs::create_dir(at("sub")).expect("a scratch folder");
        let overlaps = |input: PathBuf, output: PathBuf| {
            refuse_overlaps([("--data", input)], [("--svg", output)]).is_err()
        };
        assert!(overlaps(at("data.csv"), at("data.csv")));
        assert!(overlaps(at("data.csv"), at("sub/../data.csv")));
        assert!(overlaps(at("new.csv"), at("sub/../new.csv")), "files that do not exist yet");
        assert!(!overlaps(at("data.csv"), at("new.csv")));
        assert!(!overlaps(at("no/new.csv"), at("no/new.csv")), "nothing can be written there");
        let outputs = [("--svg", at("one")), ("--save", at("one"))];
        let error = refuse_overlaps([], outputs).expect_err("one file twice").to_string();
        assert!(error.contains("--svg") && error.contains("--save"), "{error}");
    }

    #[cfg(unix)]
    #[test]
    fn links_lead_to_their_files_and_devices_lose_nothing() {
        use std::os::unix::fs::symlink;

        let folder = tempfile::tempdir().expect("a scratch folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("data.csv"), "data").expect("a scratch file");
        symlink("data.csv", at("soft")).expect("a link");
        symlink("new.csv", at("hanging")).expect("a link");
        symlink("round", at("round")).expect("a link");
        assert!(place(&at("soft")) == place(&at("data.csv")));
        assert!(place(&at("hanging")) == place(&at("new.csv")));
        assert!(place(&at("round")).is_some(), "a link to itself ends");
        assert_eq!(place(Path::new("/dev/null")), None);
    }
}
