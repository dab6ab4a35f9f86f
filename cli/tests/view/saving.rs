//! States that a page saves, and viewers that go on from them.

use std::fs;
use std::path::Path;

use piola_cli::view::Viewer;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;
use piola_viewer::state::State;
use serde_json::json;

use crate::page::Page;
use crate::{TAIL, session};

fn viewer(session: Session, save: &Path) -> Viewer {
    Viewer::start(session, 0, Some(save.to_owned())).expect("a viewer")
}

#[test]
fn a_viewer_saves_and_loads() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (save, again) = (folder.path().join("state.json"), folder.path().join("again.json"));
    let first = viewer(session(), &save);
    let mut page = Page::open(&first.url());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.0] } } }));
    page.wait("steps", |page| page.frame() > 5);
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
    let state = State::read(&save).expect("a state");
    drop((page, first));

    let second = viewer(Session::resume(state.clone()).expect("a state that plays"), &again);
    let mut page = Page::open(&second.url());
    page.send(json!({ "run": { "pause": { "paused": true } } }));
    page.send(json!({ "act": { "restore": {} } }));
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |_| again.exists());
    let again = State::read(&again).expect("a state");
    let bits = |state: &State| serde_json::to_string(state).expect("JSON");
    assert!(bits(&again) == bits(&state), "the state came back as another");
}

/// A page numbers its drags from 0, as other pages did in a saved state, and still moves none of theirs.
#[test]
fn a_page_moves_its_own_drags_and_not_those_of_a_state() {
    let mut session = session();
    for page in 0..4 {
        let pull = Act::Pull { drag: page << 32, vertex: TAIL, target: [0.0, 2.0, 0.0] };
        session.apply(&pull).expect("a pull");
    }
    let viewer = Viewer::start(session, 0, None).expect("a viewer");
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.5] } } }));
    page.wait("a pull", |page| page.figures["pulls"].as_array().is_some_and(|pulls| pulls.len() == 5));
}

#[test]
fn a_page_is_told_names_of_files_and_no_paths() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let inside = folder.path().join("inside");
    fs::create_dir(&inside).expect("a scratch folder");
    let viewer = viewer(session(), &inside.join("state.json"));
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
