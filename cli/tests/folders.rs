//! Files in the folder of a run, which is a new one; an interrupted run keeps its results.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    command.current_dir(folder).args(arguments);
    command
}

fn piola(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().expect("the command starts")
}

/// Runs a small body into the folder `out`.
fn run(folder: &Path, more: &[&str]) -> Output {
    piola(folder, &[&["run", "horse", "--body", "bar", "--out", "out"], more].concat())
}

#[track_caller]
fn assert_code(output: &Output, code: i32) {
    assert_eq!(output.status.code(), Some(code), "{}", stderr(output));
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The content of all files in a folder, by name.
fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let files = files.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_file()));
    files
        .map(|entry| {
            let name = entry.file_name().into_string().expect("UTF-8");
            (name, fs::read(entry.path()).expect("a file"))
        })
        .collect()
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("summary.json")).expect("a summary")).expect("JSON")
}

#[test]
fn a_run_begins_in_a_new_folder_and_leaves_others_alone() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let out = scratch.path().join("out");
    fs::create_dir(&out).expect("a folder");
    fs::write(out.join("frame_0001.ply"), "mine").expect("a file");
    // This number of steps would take minutes.
    let output = run(scratch.path(), &["--frames", "100000"]);
    assert_code(&output, 2);
    for word in ["the folder out: it exists already", "--out", "--resume"] {
        assert!(stderr(&output).contains(word), "{word}: {}", stderr(&output));
    }
    assert_eq!(content(&out), [("frame_0001.ply".to_owned(), b"mine".to_vec())].into());

    for folder in ["out/horse", "out/horse-2"] {
        let output = piola(scratch.path(), &["run", "horse", "--body", "bar", "--frames", "1"]);
        assert_code(&output, 0);
        assert!(String::from_utf8_lossy(&output.stdout).contains(&format!("are in {folder}\n")));
    }
    assert_same(&out.join("horse"), &out.join("horse-2"));
    assert_code(&piola(scratch.path(), &["run", "horse", "--resume"]), 2);
}

/// Asserts that two runs have the same frames, picture and results, except for the times of solving.
#[track_caller]
fn assert_same(one: &Path, other: &Path) {
    let (mut first, mut second) = (content(one), content(other));
    for files in [&mut first, &mut second] {
        files.remove("summary.json");
    }
    assert_eq!(first.keys().collect::<Vec<_>>(), second.keys().collect::<Vec<_>>());
    for (name, bytes) in first {
        assert!(second[&name] == bytes, "{name} differs");
    }
    let results = |folder: &Path| {
        let mut summary = summary(folder);
        let object = summary.as_object_mut().expect("an object");
        object.retain(|name, _| !["ms_per_step_median", "steps_per_second"].contains(&name.as_str()));
        summary
    };
    assert_eq!(results(one), results(other));
}

#[test]
fn a_run_goes_on_to_the_last_bit() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let dinosaur = |how: [&str; 2], more: &[&str]| {
        let [newton, integrator] = how;
        let whole = ["run", "dinosaur", "--newton", newton, "--integrator", integrator, "--vtu"];
        assert_code(&piola(scratch.path(), &[&whole[..], more].concat()), 0);
    };
    let euler = "implicit-euler";
    for how in [["single", euler], ["full", euler], ["full", "sdirk2"], ["full", "sdirk3"]] {
        let (whole, parts) = (how.join("-"), format!("{}-in-parts", how.join("-")));
        dinosaur(how, &["--frames", "3", "--out", &parts]);
        dinosaur(how, &["--frames", "5", "--out", &parts, "--resume", "--threads", "2"]);
        dinosaur(how, &["--frames", "8", "--out", &parts, "--resume"]);
        dinosaur(how, &["--frames", "8", "--out", &whole]);
        assert_same(&scratch.path().join(parts), &scratch.path().join(whole));
    }
}

#[test]
fn only_the_same_run_goes_on() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let refused = |more: &[&str], words: &[&str]| {
        let output = run(scratch.path(), more);
        assert_code(&output, 2);
        for word in words {
            assert!(stderr(&output).contains(word), "{word}: {}", stderr(&output));
        }
    };
    refused(&["--resume"], &["no run", "--resume"]);
    assert_code(&run(scratch.path(), &["--frames", "3"]), 0);
    let before = content(&scratch.path().join("out"));
    refused(&["--frames", "4", "--resume", "--dt", "0.01"], &["`dt`", "0.01"]);
    refused(&["--frames", "4", "--resume", "--gravity", "1"], &["`gravity`"]);
    refused(&["--frames", "4", "--resume", "--vtu"], &["--vtu"]);
    refused(&["--frames", "2", "--resume"], &["3 frames already", "2 are wanted"]);
    assert_eq!(content(&scratch.path().join("out")), before);

    // A state that was changed by a bit, and a frame that is missing.
    let path = scratch.path().join("out/state.json");
    let state = fs::read(&path).expect("a state");
    let mut changed = state.clone();
    changed[state.len() / 2] ^= 1;
    fs::write(&path, changed).expect("a file");
    refused(&["--frames", "4", "--resume"], &["its state cannot be read"]);
    fs::write(&path, state).expect("a file");
    fs::remove_file(scratch.path().join("out/frame_0001.ply")).expect("a frame");
    refused(&["--frames", "4", "--resume"], &["frame_0001.ply is missing"]);
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    use std::process::Stdio;

    let scratch = tempfile::tempdir().expect("a scratch folder");
    let full = || Stdio::from(fs::File::options().write(true).open("/dev/full").expect("/dev/full"));
    let mut sheets: Vec<Vec<&str>> = vec![vec!["materials"], vec!["--help"], vec!["curve", "gent"]];
    sheets.push(vec!["run", "horse", "--body", "bar", "--frames", "1"]);
    for arguments in sheets {
        let output = command(scratch.path(), &arguments).stdout(full()).stderr(Stdio::piped()).output();
        let output = output.expect("the command starts");
        assert_code(&output, 1);
    }
    // A reader who goes away has seen enough.
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = command(scratch.path(), &["materials"]).stdout(writer).output().expect("the command starts");
    assert_code(&output, 0);
}
