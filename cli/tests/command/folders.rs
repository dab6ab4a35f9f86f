//! Files in the folder of a run, which is a new one; an interrupted run keeps its results.

use std::fs;

use crate::{Folder, OGDEN, assert_contains, stderr};

/// Run of a small body into the folder `out`.
const BAR: &str = "run horse --body bar --out out";

#[test]
fn a_run_begins_in_a_new_folder_and_leaves_others_alone() {
    let folder = Folder::new();
    fs::create_dir(folder.path("out")).expect("a folder");
    folder.write("out/frame_0001.ply", "mine");
    // This number of steps would take minutes.
    let message = folder.refusal(&format!("{BAR} --frames 100000"));
    assert_contains(&message, &["the folder out: it exists already", "--out", "--resume"]);
    assert_eq!(folder.content("out"), [("frame_0001.ply".to_owned(), b"mine".to_vec())].into());

    for out in ["out/horse", "out/horse-2"] {
        let said = folder.answer("run horse --body bar --frames 1");
        assert_contains(&said, &[&format!("are in {out}\n")]);
    }
    assert_same(&folder, "out/horse", "out/horse-2");
    folder.refusal("run horse --resume");
}

/// Asserts that two runs have the same frames, picture and results, except for the times of solving.
#[track_caller]
fn assert_same(folder: &Folder, one: &str, other: &str) {
    let [first, second] = [one, other].map(|out| {
        let mut files = folder.content(out);
        files.remove("summary.json");
        files
    });
    assert_eq!(first.keys().collect::<Vec<_>>(), second.keys().collect::<Vec<_>>());
    for (name, bytes) in first {
        assert!(second[&name] == bytes, "{name} differs");
    }
    let [first, second] = [one, other].map(|out| {
        let mut summary = folder.summary(out);
        let object = summary.as_object_mut().expect("an object");
        object.retain(|name, _| !["ms_per_step_median", "steps_per_second"].contains(&name.as_str()));
        summary
    });
    assert_eq!(first, second);
}

#[test]
fn a_run_goes_on_to_the_last_bit() {
    let ogden = fs::read_to_string(OGDEN).expect("a file");
    let long = ogden.replace("#[", &format!("// {}\n#[", "x".repeat(20_000)));
    for how in [
        "--newton single --integrator implicit-euler --vtu",
        "--newton full --integrator implicit-euler --vtu",
        "--newton full --integrator sdirk2 --vtu",
        "--newton full --integrator sdirk3 --vtu",
        // The energy of a formula or a file is in the state, even a long one.
        "--energy 'mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2' --param mu=345kPa --param lambda=3.1MPa",
        "--material long.rs",
    ] {
        let folder = Folder::new();
        folder.write("long.rs", &long);
        let dinosaur = |more: &str| folder.answer(&format!("run dinosaur {how} {more}"));
        dinosaur("--out parts --frames 3");
        dinosaur("--out parts --frames 5 --resume --threads 2");
        dinosaur("--out parts --frames 8 --resume");
        dinosaur("--out whole --frames 8");
        assert_same(&folder, "parts", "whole");
    }
}

#[test]
fn only_the_same_run_goes_on() {
    let folder = Folder::new();
    let refused = |more: &str, words: &[&str]| {
        let before = folder.path("out").exists().then(|| folder.content("out"));
        assert_contains(&folder.refusal(&format!("{BAR} --resume {more}")), words);
        assert_eq!(folder.path("out").exists().then(|| folder.content("out")), before);
    };
    refused("", &["no run", "--resume"]);
    folder.answer(&format!("{BAR} --frames 3"));
    refused("--frames 4 --dt 0.01", &["`dt`", "0.01"]);
    refused("--frames 4 --gravity 1", &["`gravity`"]);
    refused("--frames 4 --vtu", &["--vtu"]);
    refused("--frames 2", &["3 frames already", "2 are wanted"]);

    // A state that was changed by a bit, and a frame that is missing.
    let state = folder.content("out")["state.json"].clone();
    let mut changed = state.clone();
    changed[state.len() / 2] ^= 1;
    folder.write("out/state.json", changed);
    refused("--frames 4", &["its state cannot be read"]);
    folder.write("out/state.json", state);
    fs::remove_file(folder.path("out/frame_0001.ply")).expect("a frame");
    refused("--frames 4", &["frame_0001.ply is missing"]);
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let folder = Folder::new();
    for arguments in ["materials", "--help", "curve gent", "run horse --body bar --frames 1"] {
        let full = fs::File::options().write(true).open("/dev/full").expect("/dev/full");
        let output = folder.command(arguments).stdout(full).output().expect("the command starts");
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    }
    // A reader who goes away has seen enough.
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    let output = folder.command("materials").stdout(writer).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
}
