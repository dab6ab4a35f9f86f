//! Runs that are killed, and disks that fill up: a folder is afterwards as before, or holds a shorter run.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use piola::__private::random::Random;

/// Number of kills at random moments, unless the environment variable `PIOLA_KILLS` gives another.
const KILLS: usize = 4;
/// Number of kills without `PIOLA_FULL`: one in a new folder and one in the folder of an earlier run.
const FEWER_KILLS: usize = 2;
/// Number of kills for each run that then continues to its end and is replaced by another one.
const SEQUELS: usize = 4;
/// Steps of a run of a cube: together about as long as the picture at its end.
const FRAMES: usize = 1500;
/// A cube of six tetrahedra around its diagonal.
const NODES: &str = "8 3\n1 0 0 0\n2 0 0 1\n3 0 1 0\n4 0 1 1\n5 1 0 0\n6 1 0 1\n7 1 1 0\n8 1 1 1\n";
const TETRAHEDRA: &str = "6 4\n1 1 5 7 8\n2 1 5 8 6\n3 1 3 8 7\n4 1 3 4 8\n5 1 2 6 8\n6 1 2 8 4\n";

/// True if the environment asks for the long form of the tests.
fn is_full() -> bool {
    std::env::var_os("PIOLA_FULL").is_some()
}

type Files = BTreeMap<String, Vec<u8>>;

/// The command for a run of the cube.
fn run(scratch: &Path, dt: &str, out: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
    let frames = FRAMES.to_string();
    for (name, text) in [("cube.node", NODES), ("cube.ele", TETRAHEDRA)] {
        fs::write(scratch.join(name), text).expect("a scratch file");
    }
    command.args(["run", "horse", "--mesh", "cube.ele", "--dt", dt, "--frames", &frames, "--out", out]);
    command.current_dir(scratch).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

fn start(scratch: &Path, dt: &str) -> Child {
    run(scratch, dt, "out").spawn().expect("the command starts")
}

#[track_caller]
fn complete(command: &mut Command) {
    let output = command.stderr(Stdio::piped()).output().expect("the command starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Sends a signal to a run after some time, and waits for its end; whether it has come before the end.
fn kill(mut run: Child, after: Duration, signal: &str) -> bool {
    std::thread::sleep(after);
    let was_running = run.try_wait().expect("a child").is_none();
    if was_running {
        // The shell's own: not every system has a program of that name.
        let sent = Command::new("sh").args(["-c", &format!("kill -s {signal} {}", run.id())]).status();
        assert!(sent.expect("a shell starts").success() || run.try_wait().expect("a child").is_some());
    }
    run.wait().expect("the command ends");
    was_running
}

/// The frames and other files of a folder, without figures of time and what is not part of a run.
fn files(folder: &Path) -> Files {
    let names = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
    let names = names.map(|name| name.into_string().expect("UTF-8"));
    let names = names.filter(|name| folder.join(name).is_file() && name != "piola-files.txt");
    names.map(|name| (name.clone(), fs::read(folder.join(&name)).expect("a file"))).collect()
}

fn frames(files: &Files) -> Vec<(&String, &Vec<u8>)> {
    files.iter().filter(|(name, _)| name.ends_with(".ply")).collect()
}

/// True if these are the first frames of a run, each of them whole.
fn is_beginning(some: &Files, whole: &Files) -> bool {
    frames(some).iter().zip(frames(whole)).all(|(one, other)| *one == other)
        && frames(some).len() <= frames(whole).len()
}

/// The runs that may be in a folder, and what the user keeps there.
struct Runs {
    scratch: tempfile::TempDir,
    old: Files,
    new: Files,
}

impl Runs {
    fn new() -> Self {
        let scratch = tempfile::tempdir().expect("a scratch folder");
        let whole = |dt, name: &str| {
            complete(&mut run(scratch.path(), dt, name));
            files(&scratch.path().join(name))
        };
        Self { old: whole("0.02", "old"), new: whole("0.03", "new"), scratch }
    }

    /// A folder with a file of the user, and with an earlier run or without.
    fn folder(&self, has_earlier: bool) -> tempfile::TempDir {
        let scratch = tempfile::tempdir().expect("a scratch folder");
        let out = scratch.path().join("out");
        fs::create_dir(&out).expect("a folder");
        if has_earlier {
            for entry in fs::read_dir(self.scratch.path().join("old")).expect("a folder") {
                let entry = entry.expect("an entry");
                fs::copy(entry.path(), out.join(entry.file_name())).expect("a copy");
            }
        }
        fs::write(out.join("frame_notes.txt"), "mine").expect("a file");
        scratch
    }

    /// Checks a folder after a run of `new` was killed in it.
    #[track_caller]
    fn check(&self, scratch: &Path, has_earlier: bool, context: &str) {
        let out = scratch.join("out");
        let mut now = files(&out);
        assert_eq!(now.remove("frame_notes.txt").as_deref(), Some(&b"mine"[..]), "{context}: the user's");
        let is_old = has_earlier && is_beginning(&now, &self.old);
        assert!(is_old || is_beginning(&now, &self.new), "{context}: {:?}", now.keys());
        if let Some(text) = now.get("summary.json") {
            let summary: serde_json::Value = serde_json::from_slice(text).expect("JSON");
            assert_eq!(summary["frames"], frames(&now).len() - 1, "{context}");
        }
    }

    /// Lets a run go on that was cut off, if it had made a step, and then runs another one.
    #[track_caller]
    fn go_on(&self, scratch: &Path, context: &str) {
        let out = scratch.join("out");
        let is_new = fs::read(out.join("frame_0001.ply")).ok().as_ref() == self.new.get("frame_0001.ply");
        if is_new && out.join("state.json").is_file() {
            complete(run(scratch, "0.03", "out").arg("--resume"));
            assert!(frames(&files(&out)) == frames(&self.new), "{context}: it goes on otherwise");
        }
        complete(&mut run(scratch, "0.03", "out"));
        assert!(frames(&files(&out)) == frames(&self.new), "{context}: the next run");
    }
}

#[test]
fn killed_at_any_moment() {
    let runs = Runs::new();
    let kills = std::env::var("PIOLA_KILLS")
        .map_or(if is_full() { KILLS } else { FEWER_KILLS }, |text| text.parse().expect("a number"));
    let mut random = Random::new(17);
    let begun = Instant::now();
    complete(&mut run(runs.folder(false).path(), "0.03", "out"));
    let duration = begun.elapsed();
    let mut counts = BTreeMap::new();
    for number in 0..kills {
        let has_earlier = number % 2 == 1;
        let signal = ["KILL", "INT", "TERM"][number / 2 % 3];
        let scratch = runs.folder(has_earlier);
        let after = duration.mul_f64(random.uniform(0.0, 1.1));
        let came = kill(start(scratch.path(), "0.03"), after, signal);
        *counts.entry((signal, came)).or_insert(0) += 1;
        let context = format!("kill {number} by {signal} after {after:?}");
        runs.check(scratch.path(), has_earlier, &context);
        if number % SEQUELS == 0 {
            runs.go_on(scratch.path(), &context);
        }
    }
    println!("{counts:?}");
    assert!(counts.keys().any(|(_, came)| *came), "no signal came before the end: {counts:?}");
}

/// A signal ends a run as a shorter one with a summary, whenever it comes: every 50 ms of a run if
/// `PIOLA_KILLS` is set, otherwise every 500 ms with `PIOLA_FULL`, or every two seconds.
#[test]
fn interrupted_at_every_moment() {
    let runs = Runs::new();
    let pause = match is_full() {
        _ if std::env::var_os("PIOLA_KILLS").is_some() => 50,
        true => 500,
        false => 2000,
    };
    for turn in 1.. {
        let scratch = runs.folder(false);
        let came = kill(start(scratch.path(), "0.03"), turn * Duration::from_millis(pause), "INT");
        runs.check(scratch.path(), false, &format!("interrupted at moment {turn}"));
        let files = files(&scratch.path().join("out"));
        let has_begun = !frames(&files).is_empty();
        assert_eq!(files.contains_key("summary.json"), has_begun, "{:?}", files.keys());
        if !came {
            break;
        }
    }
}

/// Two runs into one folder: one is refused, the other is whole.
#[test]
fn two_runs_into_one_folder() {
    let runs = Runs::new();
    for has_earlier in [false, true] {
        let scratch = runs.folder(has_earlier);
        let both = [(); 2].map(|()| start(scratch.path(), "0.03"));
        let mut codes = both.map(|mut run| run.wait().expect("the command ends").code());
        codes.sort_unstable();
        assert_eq!(codes, [Some(0), Some(2)]);
        assert!(frames(&files(&scratch.path().join("out"))) == frames(&runs.new));
    }
}

/// A disk that is full at some frame leaves the frames before and a summary with the reason.
///
/// The disk is a small one in memory, for which the test needs namespaces of its own; on systems that allow
/// nobody to have them, there is nothing to fill.
#[test]
fn a_disk_that_fills_up() {
    let scratch = tempfile::tempdir().expect("a scratch folder");
    let script = "mount -t tmpfs -o size=1m none disk && { \"$0\" run horse --frames 40 --out disk/out; echo $? >code; \
                  cp -r disk/out kept; umount disk; }";
    fs::create_dir(scratch.path().join("disk")).expect("a folder");
    let mut unshare = Command::new("unshare");
    unshare.args(["--map-root-user", "--mount", "sh", "-c", script, env!("CARGO_BIN_EXE_piola")]);
    let output = unshare.current_dir(scratch.path()).output();
    let Ok(code) = fs::read_to_string(scratch.path().join("code")) else {
        println!("not checked: no disk could be made: {output:?}");
        return;
    };
    let output = output.expect("unshare starts");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(code.trim(), "1", "{message}");
    assert!(message.contains("No space left") && message.contains("--resume"), "{message}");
    let kept = files(&scratch.path().join("kept"));
    let summary: serde_json::Value = serde_json::from_slice(&kept["summary.json"]).expect("JSON");
    assert_eq!(summary["frames"], frames(&kept).len() - 1, "{summary}");
    assert_eq!(summary["ended"], "failed", "{summary}");
    let reason = summary["failures"][0].as_str().expect("a text");
    assert!(reason.contains("frame_0002.ply") && reason.contains("No space left"), "{reason}");
}
