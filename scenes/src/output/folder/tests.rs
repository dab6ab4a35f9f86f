//! Folders with files of runs and of others.

use super::*;

type TestResult = Result<(), Box<dyn std::error::Error>>;

#[track_caller]
fn check(folder: &Path, expected: &[(&str, &str)]) {
    let mut files: Vec<_> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry"))
        .map(|entry| {
            let text = fs::read_to_string(entry.path()).unwrap_or_else(|_| "(folder)".into());
            (entry.file_name().to_string_lossy().into_owned(), text)
        })
        .filter(|(name, _)| name != LISTING)
        .collect();
    files.sort();
    let expected: Vec<_> = expected.iter().map(|&(name, text)| (name.to_owned(), text.to_owned())).collect();
    assert_eq!(files, expected);
}

/// Writes `frames` frames, with a text.
fn fill(folder: &mut Folder, frames: usize, text: &str) -> Result<(), Error> {
    for frame in 0..frames {
        folder.write(&super::super::frame_file(frame), |file| file.write_all(text.as_bytes()))?;
    }
    folder.replace("summary.json", |file| file.write_all(text.as_bytes()))
}

#[test]
fn files_are_in_their_place_at_once_and_go_if_nothing_came_of_them() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path().join("a/b");
    let mut folder = Folder::prepare(&target)?;
    folder.reserve()?;
    assert_eq!(fs::metadata(target.join(RESERVE))?.len(), ROOM as u64);
    folder.release();
    fill(&mut folder, 2, "one")?;
    check(&target, &[("frame_0000.ply", "one"), ("frame_0001.ply", "one"), ("summary.json", "one")]);
    folder.abandon();
    check(scratch.path(), &[]);
    Ok(())
}

#[test]
fn a_run_replaces_an_earlier_one_and_nothing_else() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    let theirs =
        ["frame_of_mind.ply", "notes.txt", "piola-files.new", ".partial", ".reserve", "state.json.new"];
    for name in theirs {
        fs::write(target.join(name), "mine")?;
    }
    for (frames, text) in [(3, "long"), (1, "short")] {
        let mut folder = Folder::prepare(target)?;
        folder.reserve()?;
        fill(&mut folder, frames, text)?;
        folder.release();
    }
    for name in theirs {
        assert_eq!(fs::read_to_string(target.join(name))?, "mine", "{name}");
        fs::remove_file(target.join(name))?;
    }
    check(target, &[("frame_0000.ply", "short"), ("summary.json", "short")]);
    Ok(())
}

#[test]
fn files_of_others_are_refused() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    let theirs = [
        ("frame_0001.ply", "mine"),
        ("frame_0007.ply", "mine"),
        ("notes", "mine"),
        ("summary.json", "(folder)"),
    ];
    for (name, text) in &theirs[..3] {
        fs::write(target.join(name), text)?;
    }
    fs::create_dir(target.join("summary.json"))?;
    let Err(Error::ForeignFiles { names, .. }) = Folder::prepare(target) else { panic!("refused") };
    assert_eq!(names, ["frame_0001.ply", "frame_0007.ply", "summary.json"]);
    check(target, &theirs);
    assert!(!target.join(LISTING).exists());
    Ok(())
}

#[test]
fn one_run_at_a_time() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let mut first = Folder::prepare(scratch.path())?;
    fill(&mut first, 1, "first")?;
    let second = Folder::prepare(scratch.path());
    assert!(matches!(second, Err(Error::Busy { .. })), "{second:?}");
    check(scratch.path(), &[("frame_0000.ply", "first"), ("summary.json", "first")]);
    Ok(())
}

#[test]
fn a_file_that_appears_meanwhile_stays() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let mut folder = Folder::prepare(scratch.path())?;
    fs::write(scratch.path().join("frame_0000.ply"), "mine")?;
    assert!(fill(&mut folder, 1, "new").is_err());
    drop(folder);
    check(scratch.path(), &[("frame_0000.ply", "mine")]);
    let next = Folder::prepare(scratch.path());
    assert!(matches!(next, Err(Error::ForeignFiles { .. })), "{next:?}");
    Ok(())
}

#[test]
fn a_run_goes_on_in_its_folder() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let reopened = Folder::reopen(scratch.path());
    assert!(matches!(reopened, Err(Error::NothingToResume { .. })), "{reopened:?}");
    let mut folder = Folder::prepare(scratch.path())?;
    fill(&mut folder, 2, "before")?;
    drop(folder);
    let mut folder = Folder::reopen(scratch.path())?;
    assert!(folder.contains("frame_0001.ply") && !folder.contains("frame_0002.ply"));
    folder.write("frame_0001.ply", |file| file.write_all(b"again"))?;
    check(
        scratch.path(),
        &[("frame_0000.ply", "before"), ("frame_0001.ply", "again"), ("summary.json", "before")],
    );
    Ok(())
}

#[test]
fn a_file_in_place_of_the_folder_is_an_error() -> TestResult {
    let scratch = tempfile::NamedTempFile::new()?;
    let target = scratch.path().join("sub");
    let error = Folder::prepare(&target).err().map(|error| error.to_string());
    let name = target.display().to_string();
    assert!(error.as_ref().is_some_and(|error| error.contains(&name)), "{error:?}");
    Ok(())
}
