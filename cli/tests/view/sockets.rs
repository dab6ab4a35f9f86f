//! Pages and others at the sockets of a viewer.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use piola_cli::view::{Begin, Options, Viewer};
use serde_json::json;
use tungstenite::Message;

use crate::page::{Page, parts};
use crate::{BACK, TAIL, settings, viewer};

#[test]
fn a_vertex_is_dragged_and_comes_back() {
    let viewer = viewer();
    let mut page = Page::open(&viewer.url());
    page.send(json!({ "run": { "pause": { "paused": true } } }));
    page.wait("a pause", |page| page.figures["paused"] == true);
    page.send(json!({ "act": { "reset": {} } }));
    page.wait("a reset", |page| page.frame() == 0);
    let rest = page.vertex(TAIL);
    assert_eq!(page.setup["scene"], "dinosaur");
    assert_eq!(page.setup["materials"].as_array().map(Vec::len), Some(piola_materials::DECLARATIONS.len()));

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
    let mut page = Page::open(&viewer.url());
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
    let mut witness = Page::open(&viewer.url());
    let messages = [
        (Message::text("nonsense"), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 1, "vertex": 1, "target": [1e999, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 4294967296, "vertex": 1, "target": [0, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"run": {"jump": {}}}"#), 1008),
        (Message::binary(vec![1, 2, 3]), 1003),
        (Message::text("a".repeat(20_000)), 1009),
    ];
    for (message, code) in messages {
        let mut page = Page::open(&viewer.url());
        page.socket.send(message.clone()).expect("somebody listens");
        let Ok(Message::Close(Some(close))) = page.socket.read() else { panic!("{message:?} is taken") };
        assert_eq!(u16::from(close.code), code, "{message:?}: {}", close.reason);
    }
    // A frame that the protocol does not know.
    let mut page = Page::open(&viewer.url());
    page.socket.get_mut().write_all(&[0xff, 0x80, 0, 0, 0, 0]).expect("somebody listens");
    assert!(matches!(page.socket.read(), Ok(Message::Close(_))));
    let frame = witness.look()["frame"].as_u64();
    witness.wait("steps", |page| Some(page.frame()) > frame);
}

#[test]
fn a_page_that_goes_away_lets_go() {
    let viewer = viewer();
    let mut witness = Page::open(&viewer.url());
    let mut page = Page::open(&viewer.url());
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
    let mut deaf = Page::open(&viewer.url());
    let mut witness = Page::open(&viewer.url());
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
    let mut quiet = Page::open(&viewer.url());
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
    let (url, own) = (viewer.url(), viewer.address());
    let (_, token) = parts(&url);
    let wrong = format!("?token={}", "0".repeat(32));
    let socket = |host: &str, origin: &str, query: &str| {
        ask(format!(
            "GET /socket{query} HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nUpgrade: websocket\r\n\
             Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        ))
    };
    let (host, origin) = (own.to_string(), format!("http://{own}"));
    assert!(socket(&host, "http://evil.example", token).starts_with("HTTP/1.1 403"));
    assert!(socket("evil.example", "http://evil.example", token).starts_with("HTTP/1.1 403"));
    // Another user of this machine can send anything that a browser sends, except the token.
    assert!(socket(&host, &origin, "").starts_with("HTTP/1.1 403"));
    assert!(socket(&host, &origin, &wrong).starts_with("HTTP/1.1 403"));
    let get = |path: &str| ask(format!("GET {path} HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    for path in ["/", "/index.html", &format!("/{wrong}")] {
        let answer = get(path);
        assert!(answer.starts_with("HTTP/1.1 403") && answer.contains("Open the address"), "{answer}");
    }
    let page = get(&format!("/{token}"));
    assert!(page.starts_with("HTTP/1.1 200") && page.contains("<!doctype html>"), "{page}");
    assert!(page.contains("Content-Security-Policy: default-src 'none'"), "{page}");
    let again = Viewer::start(Options::new(Begin::Scene(Box::new(settings())))).expect("a viewer");
    assert_ne!(parts(&again.url()).1, token, "one token for all");
    let file = ask(format!("GET /../../etc/passwd HTTP/1.1\r\nHost: {own}\r\n\r\n"));
    assert!(file.starts_with("HTTP/1.1 404"), "{file}");
    let long = ask(format!("GET / HTTP/1.1\r\nHost: {own}\r\nCookie: {}", "a".repeat(17_000)));
    assert!(long.starts_with("HTTP/1.1 431"), "{long}");
    // The page names no place but its own.
    for file in [
        &format!("/{token}"),
        "/page.js",
        "/link.js",
        "/stage.js",
        "/drag.js",
        "/orbit.js",
        "/panel.js",
        "/editor.js",
        "/slider.js",
    ] {
        let text = get(file);
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
