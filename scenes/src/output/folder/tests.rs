//! Folders of runs, new and continued.

use std::io::Write;

use super::*;
use crate::output::frame_file;

type TestResult = Result<(), Box<dyn std::error::Error>>;

/// Names of what is in a folder.
fn names(folder: &Path) -> io::Result<Vec<String>> {
    let names = fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<io::Result<Vec<_>>>()?;
    names.sort();
    Ok(names)
}

fn write(folder: &Folder, name: &str, text: &str) -> Result<(), Error> {
    folder.write(name, |file| file.write_all(text.as_bytes()))
}

#[test]
fn files_are_in_their_place_at_once_and_go_if_nothing_came_of_them() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path().join("a/b");
    let folder = Folder::create(&target)?;
    write(&folder, &frame_file(0), "one")?;
    folder.replace("summary.json", |file| file.write_all(b"two"))?;
    let failed = folder.write(&frame_file(1), |_| Err(io::Error::other("a full disk")));
    assert!(failed.is_err_and(|error| error.to_string().contains("frame_0001.ply: a full disk")));
    assert_eq!(names(&target)?, ["frame_0000.ply", "summary.json"]);
    folder.abandon();
    assert_eq!(names(scratch.path())?, [""; 0]);
    Ok(())
}

#[test]
fn a_run_begins_in_a_new_folder() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path().join("out");
    fs::write(scratch.path().join("file"), "mine")?;
    assert!(matches!(Folder::reopen(&target), Err(Error::NothingToResume { .. })));
    write(&Folder::create(&target)?, STATE_FILE, "{}")?;
    assert!(matches!(Folder::create(&target), Err(Error::Folder { .. })));
    assert!(matches!(Folder::create(&scratch.path().join("file")), Err(Error::Folder { .. })));
    assert!(matches!(Folder::create(&scratch.path().join("file/out")), Err(Error::Folder { .. })));
    assert_eq!(names(scratch.path())?, ["file", "out"]);
    Folder::reopen(&target)?.abandon();
    assert_eq!(names(&target)?, ["state.json"]);
    Ok(())
}
