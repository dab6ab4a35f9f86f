//! Saved states.

use std::fs;
use std::path::Path;

use piola_scenes::output::seal;
use piola_scenes::settings::{Files, Settings};
use piola_scenes::unit::Unit;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;
use piola_viewer::state::State;
use serde_json::{Value, json};

use crate::{TAIL, bits, pull, session, settings, steps};

/// Gmsh text of a unit tetrahedron.
const TETRAHEDRON: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
                           $Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n\
                           $Elements\n1 1 4 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

#[test]
fn a_saved_state_goes_on_to_the_last_bit() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("state.json");
    let mut whole = session();
    whole.apply(&Act::TimeStep { seconds: 0.02 }).expect("an admissible step");
    whole.apply(&pull(TAIL, [-3.0, 2.0, 0.5])).expect("a pull");
    steps(&mut whole, 9);
    whole.apply(&Act::Parameter { name: "kappa".into(), values: vec![2.5e6] }).expect("admissible");
    steps(&mut whole, 4);
    whole.state().write(&file).expect("a file");
    steps(&mut whole, 9);
    let mut rest = Session::resume(State::read(&file).expect("a state")).expect("a state that plays");
    steps(&mut rest, 9);
    assert!(bits(&rest) == bits(&whole), "the state went on in another way");

    whole.apply(&Act::Release { drag: 1 }).expect("a release");
    steps(&mut whole, 3);
    rest.apply(&Act::Restore {}).expect("the state that it was loaded from");
    steps(&mut rest, 9);
    rest.apply(&Act::ReleaseAll {}).expect("a release");
    steps(&mut rest, 3);
    assert!(bits(&rest) == bits(&whole), "the state came back as another");
}

#[test]
fn what_is_no_state_is_refused() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("state.json");
    let state = serde_json::to_value(session().state()).expect("JSON");
    let check = |change: &dyn Fn(&mut Value), guilty: &str| {
        let mut changed = state.clone();
        change(&mut changed);
        let sealed = seal(&changed).expect("JSON");
        fs::write(&file, sealed).expect("a scratch file");
        let error = State::read(&file).and_then(Session::resume).expect_err(guilty).to_string();
        assert!(error.contains(guilty), "`{guilty}` is not in: {error}");
    };
    check(&|state| state["format"] = json!("piola state 3"), "piola state 3");
    check(&|state| state["moment"]["body"] = json!(7), "another body than dinosaur");
    check(&|state| state["moment"]["settings"]["files"] = json!({ "mesh": "/etc/passwd" }), "files");
    check(&|state| state["colour"] = json!(1), "colour");
    check(&|state| state["moment"]["settings"]["scene"] = json!("hrose"), "hrose");
    check(&|state| state["moment"]["settings"]["density"] = json!(-1.0), "density");
    check(&|state| state["moment"]["clock"]["since_frame"] = json!(7), "clock");
    for field in ["positions", "velocities", "accelerations"] {
        check(&|state| state["moment"][field] = json!([[0.0, 0.0, 0.0]]), "found 1");
    }
    let held =
        |vertex: u64, place: f64| json!({ "vertex": vertex, "target": [0, 0, 0], "place": [place, 0, 0] });
    check(&|state| state["pulls"] = json!({ "1": held(1 << 40, 0.0) }), "vertex");
    check(&|state| state["pulls"] = json!({ "1": held(1, 1e9) }), "target");
    check(&|state| state["pulls"] = json!({ u64::MAX.to_string(): held(1, 0.0) }), "2^62");
    let many: Value = (0..65).map(|drag| (drag.to_string(), held(1, 0.0))).collect();
    check(&|state| state["pulls"] = many.clone(), "more than 64 pulls");
    for (text, guilty) in [
        ("{", "EOF"),
        (r#"{"crc32":"00000000","content":{"format":"piola state 3"}}"#, "the checksum is wrong"),
    ] {
        fs::write(&file, text).expect("a scratch file");
        let error = State::read(&file).expect_err(text).to_string();
        assert!(error.contains("is not a saved state") && error.contains(guilty), "{error}");
    }
}

#[test]
fn states_have_a_limit() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("state.json");
    for length in [256 << 20, (256 << 20) + 1] {
        fs::File::create(&file).and_then(|file| file.set_len(length)).expect("a scratch file");
        let error = State::read(&file).expect_err("zeros").to_string();
        assert_eq!(error.contains("longer than 256 MiB"), length > 256 << 20, "{error}");
    }
}

#[test]
fn a_body_from_files_is_given_again() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (mesh, other) = (folder.path().join("cage.msh"), folder.path().join("other.msh"));
    fs::write(&mesh, TETRAHEDRON).expect("a scratch file");
    fs::write(&other, TETRAHEDRON.replace("0 0 1\n$", "0 0 2\n$")).expect("a scratch file");
    let files = |mesh: &Path| Some(Files { mesh: mesh.into(), surface: None });
    let state = folder.path().join("state.json");
    let of_mesh = |unit| Settings { files: files(&mesh), unit, ..settings() };
    let mut session = Session::new(of_mesh(Unit::M)).expect("a scene that plays");
    steps(&mut session, 2);
    session.state().write(&state).expect("a file");
    let text = fs::read_to_string(&state).expect("a file");
    assert!(!text.contains("cage.msh"), "the state names the mesh");

    let load = |files| Session::resume(State::read(&state).expect("a state").with_files(files));
    let mut again = load(files(&mesh)).expect("a state that plays");
    assert!(bits(&again) == bits(&session));
    again.apply(&Act::Restore {}).expect("the same body");
    for files in [None, files(&other)] {
        let error = load(files).expect_err("another body").to_string();
        assert!(error.contains("another body"), "{error}");
    }
    // The unit is not given again.
    let mut session = Session::new(of_mesh(Unit::In)).expect("a scene that plays");
    steps(&mut session, 2);
    session.state().write(&state).expect("a file");
    let again = Session::resume(State::read(&state).expect("a state").with_files(files(&mesh)));
    assert!(bits(&again.expect("a state that plays")) == bits(&session));
}
