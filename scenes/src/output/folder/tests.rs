//! Folders with files of runs and of others.

use super::*;

type TestResult = Result<(), Box<dyn std::error::Error>>;

const NAMES: Names = Names { last_frame: 2, vtu: false };

fn content(folder: &Path) -> Vec<(String, String)> {
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
    files
}

#[track_caller]
fn check(folder: &Path, expected: &[(&str, &str)]) {
    let expected: Vec<_> = expected.iter().map(|&(name, text)| (name.to_owned(), text.to_owned())).collect();
    assert_eq!(content(folder), expected);
}

/// Writes so many frames, with a text.
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
    let mut folder = Folder::prepare(&target, NAMES, false)?;
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
fn a_complete_run_replaces_an_earlier_one_and_nothing_else() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    fs::write(target.join("notes.txt"), "mine")?;
    fs::write(target.join("frame_of_mind.ply"), "mine")?;
    let mut folder = Folder::prepare(target, NAMES, false)?;
    fill(&mut folder, 3, "long")?;
    assert_eq!(folder.finish(true)?, target);

    let mut folder = Folder::prepare(target, NAMES, false)?;
    fill(&mut folder, 2, "short")?;
    assert_eq!(fs::read_to_string(target.join("frame_0000.ply"))?, "long", "replaced too early");
    assert_eq!(folder.finish(true)?, target);
    let replaced = [
        ("frame_0000.ply", "short"),
        ("frame_0001.ply", "short"),
        ("frame_of_mind.ply", "mine"),
        ("notes.txt", "mine"),
        ("summary.json", "short"),
    ];
    check(target, &replaced);

    // One that is cut off does not, and can be found.
    let mut folder = Folder::prepare(target, NAMES, false)?;
    fill(&mut folder, 1, "cut off")?;
    let kept = folder.finish(false)?;
    check(&kept, &[("frame_0000.ply", "cut off"), ("summary.json", "cut off")]);
    let folder = Folder::prepare(target, NAMES, false)?;
    assert_eq!(folder.leftovers(), std::slice::from_ref(&kept));
    folder.abandon();
    fs::remove_dir_all(kept)?;
    check(target, &replaced);
    Ok(())
}

#[test]
fn files_of_others_are_refused_or_replaced_on_request() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    let theirs =
        [("frame_0001.ply", "mine"), ("frame_0007.ply", "mine"), ("notes", "mine"), ("summary.json", "mine")];
    for (name, text) in theirs {
        fs::write(target.join(name), text)?;
    }
    let Err(Error::ForeignFiles { names, .. }) = Folder::prepare(target, NAMES, false) else {
        panic!("refused")
    };
    assert_eq!(names, ["frame_0001.ply", "frame_0007.ply", "summary.json"]);
    check(target, &theirs);
    assert!(!target.join(LISTING).exists());

    Folder::prepare(target, NAMES, true)?.abandon();
    check(target, &theirs);
    assert!(!target.join(LISTING).exists());

    let mut folder = Folder::prepare(target, NAMES, true)?;
    fill(&mut folder, 1, "new")?;
    folder.finish(true)?;
    check(
        target,
        &[("frame_0000.ply", "new"), ("frame_0007.ply", "mine"), ("notes", "mine"), ("summary.json", "new")],
    );
    Ok(())
}

#[test]
fn what_is_no_file_is_in_the_way() -> TestResult {
    let scratch = tempfile::tempdir()?;
    fs::create_dir(scratch.path().join("frame_0002.ply"))?;
    for force in [false, true] {
        let prepared = Folder::prepare(scratch.path(), NAMES, force);
        assert!(matches!(prepared, Err(Error::InTheWay { .. })), "{prepared:?}");
    }
    // No run of these names comes there.
    Folder::prepare(scratch.path(), Names { last_frame: 1, ..NAMES }, false)?.abandon();
    Ok(())
}

#[test]
fn one_run_at_a_time() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let first = Folder::prepare(scratch.path(), NAMES, false)?;
    let second = Folder::prepare(scratch.path(), NAMES, true);
    assert!(matches!(second, Err(Error::Busy { .. })), "{second:?}");
    first.abandon();
    Ok(())
}

/// A file that somebody puts in the way while the run goes on.
#[test]
fn an_exchange_that_fails_leaves_both_runs() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    let mut folder = Folder::prepare(target, NAMES, false)?;
    fill(&mut folder, 1, "old")?;
    folder.finish(true)?;
    let mut folder = Folder::prepare(target, NAMES, false)?;
    fill(&mut folder, 2, "new")?;
    fs::write(target.join("frame_0001.ply"), "mine")?;
    let Err(Error::Exchange { kept, .. }) = folder.finish(true) else { panic!("in the way") };
    check(&kept, &[("frame_0000.ply", "new"), ("frame_0001.ply", "new"), ("summary.json", "new")]);
    fs::remove_dir_all(kept)?;
    let both = [("frame_0000.ply", "old"), ("frame_0001.ply", "mine"), ("summary.json", "old")];
    check(target, &both);
    let next = Folder::prepare(target, NAMES, false);
    assert!(matches!(next, Err(Error::ForeignFiles { ref names, .. }) if names == &["frame_0001.ply"]));
    Ok(())
}

/// Files that may be replaced stay those of somebody else where they are not.
#[test]
fn files_that_were_given_up_and_not_replaced_stay_foreign() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let target = scratch.path();
    fs::write(target.join("frame_0000.ply"), "mine")?;
    let mut folder = Folder::prepare(target, NAMES, true)?;
    fill(&mut folder, 2, "new")?;
    fs::write(target.join("frame_0001.ply"), "mine")?;
    assert!(matches!(folder.finish(true), Err(Error::Exchange { .. })));
    let next = Folder::prepare(target, NAMES, false);
    assert!(matches!(next, Err(Error::ForeignFiles { ref names, .. }) if names.len() == 2), "{next:?}");
    assert!(!target.join(LISTING).exists());
    Ok(())
}

#[test]
fn a_file_that_appears_meanwhile_stays() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let mut folder = Folder::prepare(scratch.path(), NAMES, false)?;
    fs::write(scratch.path().join("frame_0000.ply"), "mine")?;
    assert!(fill(&mut folder, 1, "new").is_err());
    folder.finish(false)?;
    check(scratch.path(), &[("frame_0000.ply", "mine")]);
    let next = Folder::prepare(scratch.path(), NAMES, false);
    assert!(matches!(next, Err(Error::ForeignFiles { .. })), "{next:?}");
    Ok(())
}

#[test]
fn a_run_goes_on_in_its_folder() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let reopened = Folder::reopen(scratch.path(), NAMES);
    assert!(matches!(reopened, Err(Error::NothingToResume { .. })), "{reopened:?}");
    let mut folder = Folder::prepare(scratch.path(), NAMES, false)?;
    fill(&mut folder, 2, "before")?;
    drop(folder);
    let mut folder = Folder::reopen(scratch.path(), NAMES)?;
    assert!(folder.contains("frame_0001.ply") && !folder.contains("frame_0002.ply"));
    folder.write("frame_0001.ply", |file| file.write_all(b"again"))?;
    folder.finish(true)?;
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
    let error = Folder::prepare(&target, NAMES, false).err().map(|error| error.to_string());
    let name = target.display().to_string();
    assert!(error.as_ref().is_some_and(|error| error.contains(&name)), "{error:?}");
    Ok(())
}

/// Files of the user with names close to those that piola uses for a moment.
#[test]
fn names_for_a_moment_are_nobody_elses() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let theirs = ["piola-files.new", "piola-files.tmp", ".partial", ".reserve", "state.json.new"];
    for name in theirs {
        fs::write(scratch.path().join(name), "mine")?;
    }
    for _ in 0..2 {
        let mut folder = Folder::prepare(scratch.path(), NAMES, false)?;
        folder.reserve()?;
        fill(&mut folder, 2, "new")?;
        folder.finish(true)?;
    }
    for name in theirs {
        assert_eq!(fs::read_to_string(scratch.path().join(name))?, "mine", "{name}");
    }
    Ok(())
}
