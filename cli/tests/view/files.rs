//! States and recordings.

use std::fs;
use std::path::Path;

use piola_scenes::output::Sealer;
use piola_scenes::settings::Files;
use piola_viewer::error::Error;
use piola_viewer::protocol::Act;
use piola_viewer::recording::{Recorder, Recording};
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
        let sealed = Sealer::new().line(&changed).expect("JSON");
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
    check(&|state| state["moment"]["positions"] = json!([[0.0, 0.0, 0.0]]), "found 1");
    let held =
        |vertex: u64, place: f64| json!({ "vertex": vertex, "target": [0, 0, 0], "place": [place, 0, 0] });
    check(&|state| state["pulls"] = json!({ "1": held(1 << 40, 0.0) }), "vertex");
    check(&|state| state["pulls"] = json!({ "1": held(1, 1e9) }), "target");
    check(&|state| state["pulls"] = json!({ u64::MAX.to_string(): held(1, 0.0) }), "2^62");
    let many: Value = (0..65).map(|drag| (drag.to_string(), held(1, 0.0))).collect();
    check(&|state| state["pulls"] = many.clone(), "more than 64 pulls");
    for (text, guilty) in [
        ("{", "EOF"),
        (
            r#"{"format":"piola state 1","settings":{}}"#,
            "the format is `piola state 1`, where `piola state 2` can be read",
        ),
        (r#"{"crc32":"00000000","content":{"format":"piola state 3"}}"#, "the checksum is wrong"),
    ] {
        fs::write(&file, text).expect("a scratch file");
        let error = State::read(&file).expect_err(text);
        assert!(matches!(error, Error::NotState { .. }) && error.to_string().contains(guilty), "{error}");
    }
}

#[test]
fn a_recording_gives_the_same_motion_again() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("recording.jsonl");
    let mut session = session();
    let mut recorder = Recorder::begin(&file, session.state()).expect("a file");
    let acts = [
        pull(TAIL, [-3.0, 2.0, 0.5]),
        Act::Save {},
        pull(TAIL, [-3.0, 2.5, 0.0]),
        Act::Material { name: "stable_neo_hookean".into(), as_stiff: true },
        Act::TimeStep { seconds: 0.01 },
        Act::Restore {},
        Act::Release { drag: 1 },
        Act::Parameter { name: "kappa".into(), values: vec![1e6] },
        Act::Reset {},
    ];
    for act in &acts {
        session.apply(act).expect("an act");
        recorder.act(session.steps(), act).expect("a file");
        steps(&mut session, 3);
    }
    recorder.end(session.steps()).expect("a file");

    let mut recording = Recording::read(&file).expect("a recording");
    let mut again = Session::resume(recording.start().clone()).expect("a state that plays");
    while !recording.is_over(again.steps()) {
        while let Some(act) = recording.next_before(again.steps()) {
            again.apply(&act).expect("an act");
        }
        steps(&mut again, 1);
    }
    assert_eq!(again.steps(), session.steps());
    assert!(bits(&again) == bits(&session), "the motion was another");

    let text = fs::read_to_string(&file).expect("a recording");
    fs::write(&file, text + "{\"crc32\": \"").expect("a scratch file");
    let cut_off = Recording::read(&file).expect("a recording that was cut off in its last line");
    assert!(cut_off.is_due(0) && !cut_off.is_over(again.steps() - 1));
    let mut recorder = Recorder::begin(&file, session.state()).expect("a file");
    recorder.end(2).expect("a file");
    recorder.end(1).expect("a file");
    let error = Recording::read(&file).expect_err("back in time").to_string();
    assert!(error.contains(":3:") && error.contains("back in time"), "{error}");
}

/// A session with a single tetrahedron from a file.
fn small_session(folder: &Path) -> Session {
    let mesh = folder.join("cage.msh");
    fs::write(&mesh, TETRAHEDRON).expect("a scratch file");
    Session::new(settings().with_files(Some(Files { mesh, surface: None }))).expect("a scene that plays")
}

#[test]
fn every_bit_and_every_cut_is_noticed() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (state, record) = (folder.path().join("state.json"), folder.path().join("recording.jsonl"));
    let mut session = small_session(folder.path());
    let mut recorder = Recorder::begin(&record, session.state()).expect("a file");
    for act in [pull(1, [0.5, 0.5, 0.0]), Act::TimeStep { seconds: 0.01 }] {
        session.apply(&act).expect("an act");
        recorder.act(session.steps(), &act).expect("a file");
        steps(&mut session, 2);
    }
    recorder.end(session.steps()).expect("a file");
    session.state().write(&state).expect("a file");

    let nowhere = Path::new("");
    let check = |whole: &Path, is_taken: &dyn Fn(&str) -> bool, may_end: &dyn Fn(&[u8]) -> bool| {
        let whole = fs::read(whole).expect("a file");
        // Reading refuses what is not UTF-8.
        let is_taken = |bytes: &[u8]| std::str::from_utf8(bytes).is_ok_and(is_taken);
        assert!(is_taken(&whole));
        for bit in 0..8 * whole.len() {
            let mut changed = whole.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert!(!is_taken(&changed), "bit {bit}: {}", String::from_utf8_lossy(&changed));
        }
        for length in 0..whole.len() {
            let cut = &whole[..length];
            assert_eq!(is_taken(cut), may_end(cut), "the first {length} bytes of {}", whole.len());
        }
    };
    // Nothing of a state is missing without its line end.
    let length = fs::metadata(&state).expect("a file").len();
    let is_whole = |cut: &[u8]| cut.len() as u64 == length - 1;
    check(&state, &|text| State::parse(text, nowhere).is_ok(), &is_whole);
    // An interrupted viewer may leave part of a line, but for the first.
    let first = fs::read_to_string(&record).expect("a file").find('\n').expect("a line");
    let has_start = |cut: &[u8]| cut.len() >= first;
    check(&record, &|text| Recording::parse(text, nowhere).is_ok(), &has_start);
}

#[test]
fn recordings_have_limits() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("recording.jsonl");
    let start = small_session(folder.path()).state();
    let act = |steps: u64, act: Act| json!({ "act": { "steps": steps, "act": act } });
    let refused = |lines: &mut dyn Iterator<Item = Value>, guilty: &str| {
        let mut sealer = Sealer::new();
        let mut text = sealer.line(&json!({ "start": start })).expect("JSON");
        lines.for_each(|line| text.extend(sealer.line(&line).expect("JSON")));
        fs::write(&file, text).expect("a scratch file");
        let error = Recording::read(&file).map(drop).expect_err(guilty).to_string();
        assert!(error.contains(guilty), "`{guilty}` is not in: {error}");
    };
    let pull = |drag: u64| Act::Pull { drag, vertex: 0, target: [0.0; 3] };
    refused(
        &mut [act(0, pull(u64::MAX))].into_iter(),
        ":2: is not a line of a recording: the number of a drag",
    );
    refused(&mut [act(0, Act::Release { drag: 1 << 62 })].into_iter(), "2^62");
    refused(&mut [json!({ "until": { "steps": u64::MAX } })].into_iter(), "thousand million steps");
    let values = vec![0.125; 20_000];
    let parameter = Act::Parameter { name: "mu".into(), values: values.clone() };
    refused(&mut [act(0, parameter.clone())].into_iter(), "64 KiB");
    let line = act(3, Act::Reset {});
    refused(
        &mut std::iter::repeat_n(line, 1_000_001),
        ":1000002: is not a line of a recording: there are more than a million",
    );

    // What could not be read again is not written.
    let record = folder.path().join("record");
    let mut recorder = Recorder::begin(&record, start.clone()).expect("a file");
    assert!(matches!(recorder.act(0, &parameter), Err(Error::RecordingFull(_))));
    let mut recorder = Recorder::begin(&record, start.clone()).expect("a file");
    assert!(matches!(recorder.end(u64::MAX), Err(Error::RecordingFull(_))));
    let mut recorder = Recorder::begin(&record, start).expect("a file");
    for _ in 0..1_000_000 {
        recorder.act(0, &Act::Reset {}).expect("a file");
    }
    assert!(matches!(recorder.act(0, &Act::Reset {}), Err(Error::RecordingFull(_))));
    Recording::read(&record).expect("the longest recording");

    for length in [256 << 20, (256 << 20) + 1] {
        fs::File::create(&file).and_then(|file| file.set_len(length)).expect("a scratch file");
        let is_long = |error: Error| error.to_string().contains("longer than 256 MiB");
        let told = [State::read(&file).map(|_| ()), Recording::read(&file).map(|_| ())];
        assert_eq!(told.map(|told| is_long(told.expect_err("zeros"))), [length > 256 << 20; 2]);
    }
}

#[test]
fn only_a_recording_is_recorded_over() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let file = folder.path().join("file");
    let mut session = small_session(folder.path());
    let begin = |session: &Session| Recorder::begin(&file, session.state()).map(|_| ());
    for precious in ["$MeshFormat\n", "{", r#"{"crc32":"12345678","content":{"format":"piola state 2"}}"#] {
        fs::write(&file, precious).expect("a scratch file");
        let error = begin(&session).expect_err(precious).to_string();
        assert!(error.contains("something else than a recording"), "{error}");
        assert_eq!(fs::read_to_string(&file).expect("a file"), precious);
    }
    fs::write(&file, "").expect("a scratch file");
    for _ in 0..3 {
        begin(&session).expect("an empty file, then a recording");
        Recording::read(&file).expect("a recording");
        steps(&mut session, 1);
    }
}

/// A recording does not name the mesh, so that any name of a mesh will do.
#[cfg(target_os = "linux")]
#[test]
fn a_mesh_may_have_any_name() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = tempfile::tempdir().expect("a scratch folder");
    let mesh = folder.path().join(OsStr::from_bytes(b"cage-\xff.msh"));
    fs::write(&mesh, TETRAHEDRON).expect("a scratch file");
    let settings = settings().with_files(Some(Files { mesh, surface: None }));
    let session = Session::new(settings).expect("a scene that plays");
    let record = folder.path().join("recording.jsonl");
    Recorder::begin(&record, session.state()).expect("a file");
    Recording::read(&record).expect("a recording");
}

#[test]
fn a_body_from_files_is_given_again() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (mesh, other) = (folder.path().join("cage.msh"), folder.path().join("other.msh"));
    fs::write(&mesh, TETRAHEDRON).expect("a scratch file");
    fs::write(&other, TETRAHEDRON.replace("0 0 1\n$", "0 0 2\n$")).expect("a scratch file");
    let files = |mesh: &Path| Some(Files { mesh: mesh.into(), surface: None });
    let (state, record) = (folder.path().join("state.json"), folder.path().join("recording.jsonl"));
    let mut session = Session::new(settings().with_files(files(&mesh))).expect("a scene that plays");
    Recorder::begin(&record, session.state()).expect("a file");
    steps(&mut session, 2);
    session.state().write(&state).expect("a file");
    for file in [&state, &record] {
        let text = fs::read_to_string(file).expect("a file");
        assert!(!text.contains("cage.msh"), "{} names the mesh", file.display());
    }

    let load = |files| Session::resume(State::read(&state).expect("a state").with_files(files));
    let replay = |files| {
        let recording = Recording::read(&record).expect("a recording").with_files(files);
        Session::resume(recording.start().clone())
    };
    let mut again = load(files(&mesh)).expect("a state that plays");
    assert!(bits(&again) == bits(&session));
    again.apply(&Act::Restore {}).expect("the same body");
    replay(files(&mesh)).expect("a state that plays");
    for files in [None, files(&other)] {
        let error = load(files.clone()).expect_err("another body").to_string();
        assert!(error.contains("another body"), "{error}");
        replay(files).expect_err("another body");
    }
}
