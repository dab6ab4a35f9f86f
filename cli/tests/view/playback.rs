//! Recordings that are made, and played back to a page.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use piola_cli::view::{Begin, Options, Viewer};
use piola_viewer::protocol::Act;
use piola_viewer::recording::{Recorder, Recording};
use piola_viewer::state::State;
use serde_json::{Value, json};

use crate::page::Page;
use crate::{TAIL, pull, session, settings};

#[test]
fn a_viewer_records_saves_and_plays_back() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (save, record) = (folder.path().join("state.json"), folder.path().join("recording.jsonl"));
    let begin = Begin::Scene(Box::new(settings()));
    let options = Options::new(begin).with_save(save.clone()).with_record(record.clone());
    let viewer = Viewer::start(options).expect("a viewer");
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.0] } } }));
    page.wait("steps", |page| page.frame() > 5);
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
    let state = State::read(&save).expect("a state");
    drop((page, viewer));

    let again = folder.path().join("again.json");
    let options = Options::new(replay(&record)).with_save(again.clone());
    let viewer = Viewer::start(options).expect("a viewer");
    let mut page = Page::open(&viewer.url());
    page.wait("the end", |page| page.figures["replays"] == false && page.figures["paused"] == true);
    assert!(!again.exists(), "a recording has written a file");
    // What was saved while recording is kept in memory.
    page.send(json!({ "act": { "restore": {} } }));
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |_| again.exists());
    let again = State::read(&again).expect("a state");
    let bits = |state: &State| serde_json::to_string(state).expect("JSON");
    assert!(bits(&again) == bits(&state), "the recording was played back in another way");
}

/// The beginning of a viewer that plays a recording back.
fn replay(record: &Path) -> Begin {
    Begin::Replay(Box::new(Recording::read(record).expect("a recording")))
}

/// Starts a viewer with these acts in a recording, each after a number of steps, up to an end.
fn replay_of(acts: impl Iterator<Item = (u64, Act)>, end: u64) -> Viewer {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let record = folder.path().join("recording.jsonl");
    let mut recorder = Recorder::begin(&record, session().state()).expect("a file");
    for (steps, act) in acts {
        recorder.act(steps, &act).expect("a file");
    }
    recorder.end(end).expect("a file");
    Viewer::start(Options::new(replay(&record))).expect("a viewer")
}

/// Ends the recording, which must be running, and pulls at the body.
fn take_over(page: &mut Page) {
    let start = Instant::now();
    page.wait("a frame", |page| page.figures["replays"] == true);
    page.send(json!({ "act": { "reset": {} } }));
    page.wait("a refusal", |page| !page.refusals.is_empty());
    let reason = page.refusals[0]["reason"].as_str().expect("a reason");
    assert!(reason.contains("take over"), "{reason}");
    page.send(json!({ "run": { "take_over": {} } }));
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.5] } } }));
    page.wait("the end of the recording", |page| page.figures["replays"] == false);
    page.wait("a pull", |page| page.figures["pulls"] != json!([]));
    // A turn of acts takes 20 ms or one act, and each of the five answers above waits for a turn or two.
    assert!(start.elapsed() < Duration::from_secs(5), "{:?}", start.elapsed());
    assert_eq!(page.refusals.len(), 1);
}

#[test]
fn a_flood_of_recorded_acts_does_not_lock_the_page() {
    let material = |index: usize| Act::Material {
        name: ["neo_hookean", "stable_neo_hookean"][index % 2].into(),
        as_stiff: true,
    };
    let viewer = replay_of((0..200_000).map(|index| (0, material(index))), 0);
    let mut page = Page::open(&viewer.url());
    take_over(&mut page);
    let frame = page.frame();
    page.wait("steps", |page| page.frame() > frame + 3);
}

#[test]
fn a_recording_without_end_does_not_lock_the_page() {
    let last = 1_000_000_000;
    let viewer = replay_of([(last, Act::Reset {})].into_iter(), last);
    take_over(&mut Page::open(&viewer.url()));
}

/// Two pages and a recording number their drags from 0, and still do not take each other for the same.
#[test]
fn a_page_moves_its_own_drags_and_not_those_of_a_recording() {
    let drags = (0..4).map(|page| (0, Act::Pull { drag: page << 32, vertex: TAIL, target: [0.0, 2.0, 0.0] }));
    let viewer = replay_of(drags, 1);
    let mut page = Page::open(&viewer.url());
    page.wait("the end", |page| page.figures["replays"] == false);
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.5] } } }));
    page.wait("a pull", |page| page.figures["pulls"].as_array().is_some_and(|pulls| pulls.len() == 5));
}

#[test]
fn single_steps_of_a_recording_do_its_acts() {
    let viewer = replay_of([(0, pull(TAIL, [-3.0, 2.0, 0.5])), (2, Act::ReleaseAll {})].into_iter(), 900);
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "run": { "pause": { "paused": true } } }));
    page.wait("a pause", |page| page.figures["paused"] == true);
    for frame in page.frame() + 1..page.frame() + 6 {
        page.send(json!({ "run": { "step": {} } }));
        page.wait("a step", |page| page.frame() == frame);
        assert!(frame != 1 || page.figures["pulls"] != json!([]), "no pull before the first step");
        assert!(frame != 3 || page.figures["pulls"] == json!([]), "no release before the third");
    }
    assert_eq!(page.figures["replays"], true);
}

#[test]
fn a_page_is_told_names_of_files_and_no_paths() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let inside = folder.path().join("inside");
    fs::create_dir(&inside).expect("a scratch folder");
    let options = Options::new(Begin::Scene(Box::new(settings()))).with_save(inside.join("state.json"));
    let viewer = Viewer::start(options).expect("a viewer");
    fs::remove_dir(&inside).expect("an empty folder");
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a refusal", |page| !page.refusals.is_empty());
    assert_eq!(page.setup["file"], "state.json");
    let reason = page.refusals[0]["reason"].as_str().expect("a reason");
    assert!(reason.contains("cannot write state.json") && !reason.contains("inside"), "{reason}");
    // It is kept in memory.
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
}

/// The recording goes into a pipe whose reader goes away.
#[cfg(unix)]
#[test]
fn the_end_of_a_recording_is_told_until_the_end() {
    use std::io::{BufRead, BufReader};

    let folder = tempfile::tempdir().expect("a scratch folder");
    let pipe = folder.path().join("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().is_ok_and(|status| status.success()));
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || {
            let mut lines = BufReader::new(fs::File::open(pipe).expect("a pipe"));
            lines.read_line(&mut String::new()).expect("a line")
        }
    });
    let options = Options::new(Begin::Scene(Box::new(settings()))).with_record(pipe);
    let viewer = Viewer::start(options).expect("a viewer");
    assert!(reader.join().expect("a reader that ends") > 0);
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.5] } } }));
    let told = |page: &Page| {
        page.figures["recording_ended"]
            .as_str()
            .is_some_and(|told| told.contains("the recording ends here: cannot write pipe"))
    };
    page.wait("the end of the recording", told);
    for paused in [true, false] {
        page.send(json!({ "run": { "pause": { "paused": paused } } }));
        page.wait("a pause, or none", |page| page.figures["paused"] == paused);
        assert!(told(&page) && page.figures["trouble"] == Value::Null, "{}", page.figures);
    }
}
