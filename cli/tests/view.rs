//! The viewer, talked to as a page would: over sockets on this machine, and without them.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tungstenite::client::IntoClientRequest;
use tungstenite::{Message, WebSocket};

use piola_cli::error::Error;
use piola_cli::view::protocol::Act;
use piola_cli::view::recording::{Recorder, Recording};
use piola_cli::view::session::Session;
use piola_cli::view::state::State;
use piola_cli::view::{Begin, Options, Viewer};
use piola_scenes::measure;
use piola_scenes::output::{Sealer, Summary};
use piola_scenes::scene::Scene;
use piola_scenes::settings::{Files, Settings};

/// Vertices on the tip of the dinosaur's tail, on its back and on a leg.
const TAIL: usize = 5;
const BACK: usize = 5000;
const LEG: usize = 2925;

fn settings() -> Settings {
    Settings::new(Scene::find("dinosaur").expect("a scene"))
}

fn session() -> Session {
    Session::new(settings()).expect("a scene that plays")
}

fn pull(vertex: usize, target: [f64; 3]) -> Act {
    Act::Pull { drag: 1, vertex, target }
}

fn steps(session: &mut Session, count: usize) {
    for _ in 0..count {
        session.step().expect("a step");
    }
}

/// All of a state, to the last bit.
fn bits(session: &Session) -> String {
    serde_json::to_string(&session.state()).expect("JSON")
}

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
        std::fs::write(&file, sealed).expect("a scratch file");
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
    check(&|state| state["pulls"] = json!({ u64::MAX.to_string(): held(1, 0.0) }), "too many pulls");
    for (text, guilty) in [
        ("{", "EOF"),
        (
            r#"{"format":"piola state 1","settings":{}}"#,
            "the format is `piola state 1`, where `piola state 2` can be read",
        ),
        (r#"{"crc32":"00000000","content":{"format":"piola state 3"}}"#, "the checksum is wrong"),
    ] {
        std::fs::write(&file, text).expect("a scratch file");
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

    let text = std::fs::read_to_string(&file).expect("a recording");
    std::fs::write(&file, text + "{\"crc32\": \"").expect("a scratch file");
    let error = Recording::read(&file).expect_err("cut off").to_string();
    assert!(error.contains(":12:") && error.contains("cut off"), "{error}");
    let mut recorder = Recorder::begin(&file, session.state()).expect("a file");
    recorder.end(2).expect("a file");
    recorder.end(1).expect("a file");
    let error = Recording::read(&file).expect_err("back in time").to_string();
    assert!(error.contains(":3:") && error.contains("back in time"), "{error}");
}

#[test]
fn another_material_takes_over_where_the_body_is() {
    let mut session = session();
    session.apply(&pull(TAIL, [-3.0, 2.0, 0.5])).expect("a pull");
    steps(&mut session, 5);
    let place = |session: &Session| session.play().simulation().positions().to_vec();
    let before = place(&session);
    let mu = session.play().moduli().mu;
    session.apply(&Act::Material { name: "neo_hookean".into(), as_stiff: true }).expect("a material");
    assert_eq!(session.play().material(), "neo_hookean");
    // As tight as the scaling promises.
    assert!((session.play().moduli().mu / mu - 1.0).abs() <= 1e-12);
    assert_eq!(place(&session), before);
    steps(&mut session, 1);
    assert_ne!(place(&session), before);

    let before = bits(&session);
    for act in [
        Act::Parameter { name: "mu".into(), values: vec![-1.0] },
        Act::Parameter { name: "alpha".into(), values: vec![1.0] },
        Act::Material { name: "steel".into(), as_stiff: false },
        Act::TimeStep { seconds: 0.0 },
        Act::TimeStep { seconds: f64::INFINITY },
        Act::Restore {},
        pull(1_000_000, [0.0; 3]),
        pull(TAIL, [f64::NAN, 0.0, 0.0]),
        pull(TAIL, [0.0, 1e9, 0.0]),
    ] {
        session.apply(&act).expect_err("nonsense");
        assert!(bits(&session) == before, "{act:?} left its mark");
    }
    session.apply(&Act::Material { name: "ogden".into(), as_stiff: true }).expect("a material");
    assert_eq!(session.play().moduli().mu, mu, "the scene's own material is that of the scene");
}

#[test]
fn pulls_are_numbered_and_limited() {
    let mut session = session();
    for drag in 0..64 {
        session.apply(&Act::Pull { drag, vertex: BACK, target: [0.0, 2.0, 0.0] }).expect("a pull");
    }
    session.apply(&Act::Pull { drag: 7, vertex: BACK, target: [0.0, 2.1, 0.0] }).expect("the same drag");
    let error = session.apply(&Act::Pull { drag: 64, vertex: BACK, target: [0.0; 3] }).expect_err("too many");
    assert!(error.to_string().contains("64"), "{error}");
    session.apply(&Act::ReleaseAll {}).expect("a release");
    assert_eq!(session.pulls().count(), 0);
}

/// The tail drawn across the body, five heights far, and a leg torn until elements stay inside out.
#[test]
fn pulled_several_heights_far_and_inside_out_it_comes_back() {
    let rest = session().geometry().mesh.clone();
    let judge = |session: &Session| {
        let positions = session.play().simulation().positions();
        let far = measure::max_distance(&rest.positions, positions) / rest.bounds().size()[1];
        (far, measure::inverted(&rest.positions, positions, &rest.tets))
    };
    for (vertex, target, distance, inside_out) in
        [(TAIL, [9.0, 2.0, 0.0], 5.0, false), (LEG, [-5.0, -0.2, -2.5], 1.5, true)]
    {
        let mut session = session();
        // The scene's own pull ends after two seconds, and the body is at rest after six.
        steps(&mut session, 180);
        session.apply(&pull(vertex, target)).expect("a pull");
        steps(&mut session, 90);
        let (far, inverted) = judge(&session);
        assert!(
            far > distance && (inverted > 0) == inside_out,
            "{vertex}: {far} heights, {inverted} inverted"
        );
        session.apply(&Act::Release { drag: 1 }).expect("a release");
        steps(&mut session, 300);
        let (far, inverted) = judge(&session);
        // As `piola run` judges it.
        assert!(far <= Summary::RECOVERED && inverted == 0, "{vertex}: {far} heights, {inverted} inverted");
    }
}

/// A viewer of the dinosaur at a port of its own.
fn viewer() -> Viewer {
    let begin = Begin::Scene(Box::new(settings()));
    Viewer::start(Options::new(begin)).expect("a viewer")
}

/// A page without a browser.
struct Page {
    socket: WebSocket<TcpStream>,
    figures: Value,
    setup: Value,
    refusals: Vec<Value>,
    positions: Vec<f32>,
}

impl Page {
    fn open(address: SocketAddr) -> Self {
        let stream = TcpStream::connect(address).expect("somebody listens");
        // No answer in so long is none at all.
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        let mut request = format!("ws://{address}/socket").into_client_request().expect("a request");
        let origin = format!("http://{address}").parse().expect("an origin");
        request.headers_mut().insert("Origin", origin);
        let (socket, _) = tungstenite::client(request, stream).expect("a page's own socket");
        let mut page = Self {
            socket,
            figures: Value::Null,
            setup: Value::Null,
            refusals: Vec::new(),
            positions: Vec::new(),
        };
        let topology = page.socket.read().expect("a message").into_data();
        assert_eq!(word(&topology, 0), 0, "topology comes first");
        assert_eq!(topology.len() as u32, 12 + 12 * word(&topology, 1) + 8 * word(&topology, 2));
        page
    }

    fn send(&mut self, message: Value) {
        self.socket.send(Message::text(message.to_string())).expect("somebody listens");
    }

    /// The next frame.
    fn look(&mut self) -> &Value {
        self.send(json!({ "look": {} }));
        loop {
            match self.socket.read().expect("a frame") {
                Message::Text(text) => {
                    let told: Value = serde_json::from_str(&text).expect("JSON");
                    match told.as_object().and_then(|object| object.iter().next()) {
                        Some((kind, figures)) if kind == "figures" => self.figures = figures.clone(),
                        Some((kind, setup)) if kind == "setup" => self.setup = setup.clone(),
                        Some((kind, refusal)) if kind == "refused" => self.refusals.push(refusal.clone()),
                        _ => panic!("{text}"),
                    }
                }
                Message::Binary(data) => {
                    let coordinates = data[12..].chunks_exact(4);
                    let coordinates = coordinates.map(|x| f32::from_le_bytes([x[0], x[1], x[2], x[3]]));
                    self.positions = coordinates.collect();
                    assert_eq!(word(&data, 0), 1);
                    assert_eq!(self.positions.len() as u32, 3 * (word(&data, 1) + word(&data, 2)));
                    assert!(self.positions.iter().all(|x| x.is_finite()));
                    return &self.figures;
                }
                other => panic!("{other:?}"),
            }
        }
    }

    /// Looks until it is so.
    #[track_caller]
    fn wait(&mut self, what: &str, is_so: impl Fn(&Self) -> bool) {
        let start = Instant::now();
        while !is_so(self) {
            assert!(start.elapsed() < Duration::from_secs(20), "{what}: {}", self.figures);
            self.look();
        }
    }

    fn frame(&self) -> u64 {
        self.figures["frame"].as_u64().unwrap_or_default()
    }

    fn vertex(&self, vertex: usize) -> [f32; 3] {
        std::array::from_fn(|c| self.positions[3 * vertex + c])
    }
}

fn word(data: &[u8], index: usize) -> u32 {
    let bytes = &data[4 * index..][..4];
    u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]])
}

#[test]
fn a_vertex_is_dragged_and_comes_back() {
    let viewer = viewer();
    let mut page = Page::open(viewer.address());
    page.send(json!({ "run": { "pause": { "paused": true } } }));
    page.wait("a pause", |page| page.figures["paused"] == true);
    page.send(json!({ "act": { "reset": {} } }));
    page.wait("a reset", |page| page.frame() == 0);
    let rest = page.vertex(TAIL);
    assert_eq!(page.setup["scene"], "dinosaur");
    assert_eq!(page.setup["materials"].as_array().map(Vec::len), Some(piola_materials::CATALOGUE.len()));

    // One body height to the side.
    let height = page.setup["bounds"][1][1].as_f64().expect("a height") as f32;
    let target = [rest[0], rest[1], rest[2] + height];
    page.send(json!({ "act": { "pull": { "drag": 3, "vertex": TAIL, "target": target } } }));
    page.send(json!({ "run": { "pace": { "real_time": false } } }));
    page.send(json!({ "run": { "pause": { "paused": false } } }));
    page.wait("a pull", |page| page.vertex(TAIL)[2] > rest[2] + 0.8 * height);
    assert!(page.figures["from_rest"].as_f64().is_some_and(|far| far > 0.5), "{}", page.figures);
    assert_eq!(page.figures["pulls"], json!([[TAIL, target]]));
    assert!(page.figures["steps_per_second"].as_f64().is_some_and(|speed| speed > 1.0));
    assert_eq!(page.figures["newton_iterations"], 1);

    page.send(json!({ "act": { "release": { "drag": 3 } } }));
    // The scene's own pull has ended then, too; a body is back as `piola run` judges it.
    page.wait("the way back", |page| {
        page.figures["from_rest"].as_f64().is_some_and(|far| far < 1e-3) && page.frame() > 60
    });
    assert_eq!(page.figures["pulls"], json!([]));
    assert_eq!(page.figures["inverted"], 0);
}

#[test]
fn what_is_refused_is_said_and_changes_nothing() {
    let viewer = viewer();
    let mut page = Page::open(viewer.address());
    page.send(json!({ "act": { "parameter": { "name": "kappa", "values": [-1.0] } } }));
    page.wait("a refusal", |page| !page.refusals.is_empty());
    assert_eq!(page.refusals[0]["act"]["parameter"]["name"], "kappa");
    assert!(page.refusals[0]["reason"].as_str().is_some_and(|reason| reason.contains("kappa")));
    page.send(json!({ "act": { "material": { "name": "gent", "as_stiff": false } } }));
    page.wait("another material", |page| page.setup["material"]["name"] == "gent");
    let frame = page.frame();
    page.wait("steps", |page| page.frame() > frame + 3);
    page.send(json!({ "run": { "step": {} } }));
    page.wait("a pause", |page| page.figures["paused"] == true);
    let frame = page.frame();
    page.send(json!({ "run": { "step": {} } }));
    page.look();
    assert_eq!(page.frame(), frame + 1);
}

#[test]
fn malformed_messages_end_a_connection_and_nothing_else() {
    let viewer = viewer();
    let mut witness = Page::open(viewer.address());
    let messages = [
        (Message::text("nonsense"), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 1, "vertex": 1, "target": [1e999, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 4294967296, "vertex": 1, "target": [0, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"run": {"jump": {}}}"#), 1008),
        (Message::binary(vec![1, 2, 3]), 1003),
        (Message::text("a".repeat(20_000)), 1009),
    ];
    for (message, code) in messages {
        let mut page = Page::open(viewer.address());
        page.socket.send(message.clone()).expect("somebody listens");
        let Ok(Message::Close(Some(close))) = page.socket.read() else { panic!("{message:?} is taken") };
        assert_eq!(u16::from(close.code), code, "{message:?}: {}", close.reason);
    }
    // A frame that the protocol does not know.
    let mut page = Page::open(viewer.address());
    page.socket.get_mut().write_all(&[0xff, 0x80, 0, 0, 0, 0]).expect("somebody listens");
    assert!(matches!(page.socket.read(), Ok(Message::Close(_))));
    let frame = witness.look()["frame"].as_u64();
    witness.wait("steps", |page| Some(page.frame()) > frame);
}

#[test]
fn a_page_that_goes_away_lets_go() {
    let viewer = viewer();
    let mut witness = Page::open(viewer.address());
    let mut page = Page::open(viewer.address());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": BACK, "target": [0.0, 2.0, 0.0] } } }));
    witness.wait("a pull", |page| page.figures["pulls"] != json!([]));
    drop(page);
    witness.wait("a release", |page| page.figures["pulls"] == json!([]));
    let frame = witness.frame();
    witness.wait("steps", |page| page.frame() > frame);
}

#[test]
fn nobody_waits_for_a_page_that_does_not_read() {
    let viewer = viewer();
    let mut deaf = Page::open(viewer.address());
    let mut witness = Page::open(viewer.address());
    witness.send(json!({ "run": { "pace": { "real_time": false } } }));
    for _ in 0..500 {
        deaf.send(json!({ "look": {} }));
    }
    let frame = witness.look()["frame"].as_u64().expect("a number");
    let start = Instant::now();
    witness.wait("steps", |page| page.frame() > frame + 100);
    // 100 steps take a second at most where two cores are shared; the deaf page is given up after ten.
    assert!(start.elapsed() < Duration::from_secs(8), "{:?}", start.elapsed());
    // A page that has not asked for frames finds none, however many there were.
    let mut quiet = Page::open(viewer.address());
    let frame = witness.frame();
    witness.wait("steps", |page| page.frame() > frame + 20);
    quiet.socket.get_mut().set_read_timeout(Some(Duration::from_millis(300))).expect("a socket");
    assert!(quiet.socket.read().is_err(), "frames were kept");
}

#[test]
fn strangers_are_not_let_in() {
    let viewer = viewer();
    let ask = |request: String| {
        let mut stream = TcpStream::connect(viewer.address()).expect("somebody listens");
        stream.write_all(request.as_bytes()).expect("somebody reads");
        let mut answer = String::new();
        stream.read_to_string(&mut answer).expect("an answer");
        answer
    };
    let own = viewer.address();
    let socket = |host: &str, origin: &str| {
        ask(format!(
            "GET /socket HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nUpgrade: websocket\r\n\
             Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        ))
    };
    assert!(socket(&own.to_string(), "http://evil.example").starts_with("HTTP/1.1 403"));
    assert!(socket("evil.example", "http://evil.example").starts_with("HTTP/1.1 403"));
    let page = ask(format!("GET / HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("<!doctype html>"), "{page}");
    assert!(page.contains("Content-Security-Policy: default-src 'none'"), "{page}");
    let file = ask(format!("GET /../../etc/passwd HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(file.starts_with("HTTP/1.1 404"), "{file}");
    let long = ask(format!("GET / HTTP/1.1\r\nHost: {own}\r\nCookie: {}", "a".repeat(17_000)));
    assert!(long.starts_with("HTTP/1.1 431"), "{long}");
    // The page names no place but its own.
    for file in ["/", "/page.js", "/link.js", "/stage.js", "/drag.js", "/orbit.js", "/panel.js", "/slider.js"]
    {
        let text = ask(format!("GET {file} HTTP/1.1\r\nHost: {own}\r\n\r\n"));
        assert!(text.starts_with("HTTP/1.1 200"), "{file}");
        assert!(!text.contains("http://") && !text.contains("https://"), "{file} loads from elsewhere");
    }
}

#[test]
fn a_port_that_is_taken_is_named() {
    let viewer = viewer();
    let port = viewer.address().port();
    let begin = Begin::Scene(Box::new(settings()));
    let error = Viewer::start(Options::new(begin).with_port(port)).expect_err("taken");
    assert!(error.to_string().contains(&port.to_string()), "{error}");
    assert_eq!(error.exit_code(), 2);
}

#[test]
fn a_viewer_records_saves_and_plays_back() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (save, record) = (folder.path().join("state.json"), folder.path().join("recording.jsonl"));
    let begin = Begin::Scene(Box::new(settings()));
    let options = Options::new(begin).with_save(save.clone()).with_record(record.clone());
    let viewer = Viewer::start(options).expect("a viewer");
    let mut page = Page::open(viewer.address());
    page.send(json!({ "act": { "pull": { "drag": 0, "vertex": TAIL, "target": [-3.0, 2.0, 0.0] } } }));
    page.wait("steps", |page| page.frame() > 5);
    page.send(json!({ "act": { "save": {} } }));
    page.wait("a saved state", |page| page.setup["is_saved"] == true);
    let state = State::read(&save).expect("a state");
    drop((page, viewer));

    let recording = Recording::read(&record).expect("a recording");
    let begin = Begin::Replay(Box::new(recording));
    let again = folder.path().join("again.json");
    let options = Options::new(begin).with_save(again.clone());
    let viewer = Viewer::start(options).expect("a viewer");
    let mut page = Page::open(viewer.address());
    page.wait("the end", |page| page.figures["replays"] == false && page.figures["paused"] == true);
    let again = State::read(&again).expect("a state");
    let bits = |state: &State| serde_json::to_string(state).expect("JSON");
    assert!(bits(&again) == bits(&state), "the recording was played back in another way");
}

/// Gmsh text of a unit tetrahedron.
const TETRAHEDRON: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n\
                           $Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n\
                           $Elements\n1 1 4 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

#[test]
fn a_body_from_files_is_given_again() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (mesh, other) = (folder.path().join("cage.msh"), folder.path().join("other.msh"));
    std::fs::write(&mesh, TETRAHEDRON).expect("a scratch file");
    std::fs::write(&other, TETRAHEDRON.replace("0 0 1\n$", "0 0 2\n$")).expect("a scratch file");
    let files = |mesh: &std::path::Path| Some(Files { mesh: mesh.into(), surface: None });
    let (state, record) = (folder.path().join("state.json"), folder.path().join("recording.jsonl"));
    let mut session = Session::new(settings().with_files(files(&mesh))).expect("a scene that plays");
    Recorder::begin(&record, session.state()).expect("a file");
    steps(&mut session, 2);
    session.state().write(&state).expect("a file");
    for file in [&state, &record] {
        let text = std::fs::read_to_string(file).expect("a file");
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
