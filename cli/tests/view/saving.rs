//! States that a page saves, and viewers that go on from them.

use piola_viewer::protocol::Act;
use piola_viewer::state::State;
use serde_json::json;

use crate::page::Page;
use crate::shell::Folder;
use crate::{TAIL, Viewer, session};

#[test]
fn a_viewer_saves_and_loads() {
    let folder = Folder::new();
    let first = Viewer::start(&folder, "dinosaur --save state.json");
    let mut page = Page::open(&first.url);
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.0] } } }));
    page.wait("steps", |page| page.frame() > 5);
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
    drop((page, first));

    let second = Viewer::start(&folder, "--load state.json --save again.json");
    let mut page = Page::open(&second.url);
    page.send(json!({ "run": { "pause": { "paused": true } } }));
    page.send(json!({ "act": { "restore": {} } }));
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |_| folder.path("again.json").exists());
    let [state, again] = ["state.json", "again.json"].map(|name| {
        let state = State::read(&folder.path(name)).expect("a state");
        serde_json::to_string(&state).expect("JSON")
    });
    assert!(again == state, "the state came back as another");
}

/// A page numbers its drags from 0, as other pages did in a saved state, and still moves none of theirs.
#[test]
fn a_page_moves_its_own_drags_and_not_those_of_a_state() {
    let mut session = session();
    for page in 0..4 {
        let pull = Act::Pull { drag: page << 32, vertex: TAIL, target: [0.0, 2.0, 0.0] };
        session.apply(&pull).expect("a pull");
    }
    let folder = Folder::new();
    session.state().write(&folder.path("state.json")).expect("a state");
    let viewer = Viewer::start(&folder, "--load state.json");
    let mut page = Page::open(&viewer.url);
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.5] } } }));
    page.wait("a pull", |page| page.figures["pulls"].as_array().is_some_and(|pulls| pulls.len() == 5));
}

#[test]
fn a_page_is_told_names_of_files_and_no_paths() {
    let folder = Folder::new();
    let viewer = Viewer::start(&folder, "dinosaur --save inside/state.json");
    let mut page = Page::open(&viewer.url);
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a refusal", |page| !page.refusals.is_empty());
    assert_eq!(page.setup["file"], "state.json");
    let reason = page.refusals[0]["reason"].as_str().expect("a reason");
    assert!(reason.contains("cannot write state.json") && !reason.contains("inside"), "{reason}");
    // It is kept in memory.
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
}
