//! Runs that are killed, and disks that fill up: the folder holds a shorter run afterwards.
#![cfg(unix)]

#[path = "command/shell.rs"]
mod shell;

use std::collections::BTreeMap;
use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use piola::__private::random::Random;

use shell::{Folder, assert_contains};

/// Number of kills at random moments, unless the environment variable `PIOLA_KILLS` gives another.
const KILLS: usize = 4;
/// Number of kills without `PIOLA_FULL`.
const FEWER_KILLS: usize = 2;
/// Number of kills for each run that then continues to its end.
const SEQUELS: usize = 4;
/// Run of a cube: its steps take together about as long as the picture at its end.
const RUN: &str = "run horse --mesh cube.ele --dt 0.03 --frames 1500 --out out";
/// A cube of six tetrahedra around its diagonal.
const NODES: &str = "8 3\n1 0 0 0\n2 0 0 1\n3 0 1 0\n4 0 1 1\n5 1 0 0\n6 1 0 1\n7 1 1 0\n8 1 1 1\n";
const TETRAHEDRA: &str = "6 4\n1 1 5 7 8\n2 1 5 8 6\n3 1 3 8 7\n4 1 3 4 8\n5 1 2 6 8\n6 1 2 8 4\n";

type Files = BTreeMap<String, Vec<u8>>;

/// A folder with the cube.
fn with_cube() -> Folder {
    let folder = Folder::new();
    folder.write("cube.node", NODES);
    folder.write("cube.ele", TETRAHEDRA);
    folder
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

/// The files of a run; none if it has not begun.
fn files(folder: &Folder) -> Files {
    if folder.path("out").exists() { folder.content("out") } else { Files::new() }
}

fn frames(files: &Files) -> Vec<(&String, &Vec<u8>)> {
    files.iter().filter(|(name, _)| name.ends_with(".ply")).collect()
}

/// True if these are the first frames of a run, each of them whole.
fn is_beginning(some: &Files, whole: &Files) -> bool {
    frames(some).iter().zip(frames(whole)).all(|(one, other)| *one == other)
        && frames(some).len() <= frames(whole).len()
}

/// The run as it is if nothing happens.
struct Whole(Files);

impl Whole {
    fn new() -> Self {
        let folder = with_cube();
        folder.answer(RUN);
        Self(files(&folder))
    }

    /// Sends a signal to a run after some time, and checks its folder, which is that of a shorter run with a
    /// summary, or of one without if it was killed; true if the signal has come before the end.
    #[track_caller]
    fn strike(&self, folder: &Folder, after: Duration, signal: &str) -> bool {
        let run = folder.command(RUN).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        let came = kill(run.expect("the command starts"), after, signal);
        let now = files(folder);
        let context = format!("{signal} after {after:?}: {:?}", now.keys());
        assert!(is_beginning(&now, &self.0), "{context}");
        if now.contains_key("summary.json") {
            assert_eq!(folder.summary("out")["frames"], frames(&now).len() - 1, "{context}");
        } else {
            assert!(signal == "KILL" || frames(&now).is_empty(), "{context}");
        }
        came
    }

    /// Lets a run go on that was cut off, if it had saved a state.
    #[track_caller]
    fn go_on(&self, folder: &Folder, context: &str) {
        if folder.path("out/state.json").is_file() {
            folder.answer(&format!("{RUN} --resume"));
            assert!(frames(&files(folder)) == frames(&self.0), "{context}: it goes on otherwise");
        }
    }
}

#[test]
fn killed_at_any_moment() {
    let begun = Instant::now();
    let whole = Whole::new();
    let duration = begun.elapsed();
    let usual = if std::env::var_os("PIOLA_FULL").is_some() { KILLS } else { FEWER_KILLS };
    let kills = std::env::var("PIOLA_KILLS").map_or(usual, |text| text.parse().expect("a number"));
    let mut random = Random::new(17);
    let mut any_came = false;
    for number in 0..kills {
        let signal = ["KILL", "INT", "TERM"][number % 3];
        let folder = with_cube();
        let after = duration.mul_f64(random.uniform(0.0, 1.1));
        any_came |= whole.strike(&folder, after, signal);
        if number % SEQUELS == 0 {
            whole.go_on(&folder, &format!("kill {number} by {signal} after {after:?}"));
        }
    }
    assert!(any_came, "no signal came before the end");
}

/// A disk that is full at some frame leaves the frames before and a summary with the reason.
///
/// The disk is a small one in memory, for which the test needs namespaces of its own; on systems that allow
/// nobody to have them, there is nothing to fill.
#[test]
fn a_disk_that_fills_up() {
    let folder = Folder::new();
    let script = "mount -t tmpfs -o size=1m none disk && { \"$0\" run horse --frames 40 --out disk/out; echo $? >code; \
                  cp -r disk/out kept; umount disk; }";
    fs::create_dir(folder.path("disk")).expect("a folder");
    let mut unshare = Command::new("unshare");
    unshare.args(["--map-root-user", "--mount", "sh", "-c", script, env!("CARGO_BIN_EXE_piola")]);
    let output = unshare.current_dir(folder.path("")).output();
    let Ok(code) = fs::read_to_string(folder.path("code")) else {
        println!("not checked: no disk could be made: {output:?}");
        return;
    };
    let message = shell::stderr(&output.expect("unshare starts"));
    assert_eq!(code.trim(), "1", "{message}");
    assert_contains(&message, &["No space left", "--resume"]);
    let summary = folder.summary("kept");
    assert_eq!(summary["frames"], frames(&folder.content("kept")).len() - 1, "{summary}");
    assert_eq!(summary["ended"], "failed", "{summary}");
    assert_contains(summary["failures"][0].as_str().expect("a text"), &["frame_0002.ply", "No space left"]);
}
