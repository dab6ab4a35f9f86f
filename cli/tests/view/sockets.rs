//! Pages and others at the sockets of a viewer.

use std::io::{Read, Write};
use std::net::TcpStream;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;
use tungstenite::Message;

use crate::page::{Page, parts};
use crate::{BACK, TAIL, viewer};

#[test]
fn a_vertex_is_dragged_and_comes_back() {
    let viewer = viewer();
    let mut page = Page::open(&viewer.url);
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
    let mut page = Page::open(&viewer.url);
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
    let mut witness = Page::open(&viewer.url);
    let messages = [
        (Message::text("nonsense"), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 1, "vertex": 1, "target": [1e999, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 4294967296, "vertex": 1, "target": [0, 0, 0]}}}"#), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 1, "vertex": -7, "target": [0, 1, 2]}}}"#), 1008),
        (Message::text(r#"{"act": {"pull": {"drag": 1, "vertex": 7, "target": [0, 1]}}}"#), 1008),
        (Message::text(r#"{"run": {"jump": {}}}"#), 1008),
        (Message::text(r#"{"look": {"far": 1}}"#), 1008),
        (Message::text(r#"{"look": {}, "act": {}}"#), 1008),
        (Message::binary(vec![1, 2, 3]), 1003),
        (Message::text("a".repeat(20_000)), 1009),
    ];
    for (message, code) in messages {
        let mut page = Page::open(&viewer.url);
        page.socket.send(message.clone()).expect("somebody listens");
        let Ok(Message::Close(Some(close))) = page.socket.read() else { panic!("{message:?} is taken") };
        assert_eq!(u16::from(close.code), code, "{message:?}: {}", close.reason);
    }
    // A frame that the protocol does not know.
    let mut page = Page::open(&viewer.url);
    page.socket.get_mut().write_all(&[0xff, 0x80, 0, 0, 0, 0]).expect("somebody listens");
    assert!(matches!(page.socket.read(), Ok(Message::Close(_))));
    let frame = witness.look()["frame"].as_u64();
    witness.wait("steps", |page| Some(page.frame()) > frame);
}

#[test]
fn a_page_that_goes_away_lets_go() {
    let viewer = viewer();
    let mut witness = Page::open(&viewer.url);
    let mut page = Page::open(&viewer.url);
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
    let mut deaf = Page::open(&viewer.url);
    let mut witness = Page::open(&viewer.url);
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
    let mut quiet = Page::open(&viewer.url);
    let frame = witness.frame();
    witness.wait("steps", |page| page.frame() > frame + 20);
    quiet.socket.get_mut().set_read_timeout(Some(Duration::from_millis(300))).expect("a socket");
    assert!(quiet.socket.read().is_err(), "frames were kept");
}

/// Lines that say nothing, or never end their request, take all places until they are closed; a page that is
/// served stays served.
#[test]
fn silent_lines_shut_nobody_out_for_long() {
    let viewer = viewer();
    let mut witness = Page::open(&viewer.url);
    let line = |number: usize| {
        let mut line = TcpStream::connect(parts(&viewer.url).0).expect("somebody listens");
        line.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        // A line without a place is closed at once.
        let _ = line.write_all(["", "GET / HTTP/1.1\r\nHost"][number % 2].as_bytes());
        line
    };
    let mut lines: Vec<_> = (0..40).map(line).collect();
    let start = Instant::now();
    assert!(Page::try_open(&viewer.url).is_none(), "any number of connections is served");
    let frame = witness.look()["frame"].as_u64();
    witness.wait("steps", |page| Some(page.frame()) > frame);
    // The limit for a request is five seconds, which a byte now and then does not extend.
    while lines[0].write_all(b"G").is_ok() || Page::try_open(&viewer.url).is_none() {
        assert!(start.elapsed() < Duration::from_secs(20), "nobody is let in");
        thread::sleep(Duration::from_millis(100));
    }
    for line in &mut lines {
        let _ = line.read_to_end(&mut Vec::new());
    }
    assert!(start.elapsed() < Duration::from_secs(20), "a line is kept");
}

/// The viewer keeps no answers for a page that does not read: it stops reading its messages.
#[test]
fn answers_do_not_pile_up() {
    let viewer = viewer();
    let mut deaf = Page::open(&viewer.url);
    deaf.socket.get_mut().set_write_timeout(Some(Duration::from_millis(500))).expect("a socket");
    let act = json!({ "act": { "material": { "name": "a".repeat(15_000), "as_stiff": true } } }).to_string();
    // More than the buffers of both sides hold.
    let refused = (0..5_000).position(|_| deaf.socket.send(Message::text(act.clone())).is_err());
    assert!(refused.is_some(), "75 MB of answers are kept");
    Page::open(&viewer.url).look();
}

/// Asks the viewer at an address, and returns its answer.
fn ask(address: &str, request: &str) -> String {
    let mut stream = TcpStream::connect(address).expect("somebody listens");
    stream.write_all(request.as_bytes()).expect("somebody reads");
    let mut answer = String::new();
    stream.read_to_string(&mut answer).expect("an answer");
    answer
}

#[test]
fn strangers_are_not_let_in() {
    let (viewer, other) = (viewer(), viewer());
    let ((own, query), (_, others)) = (parts(&viewer.url), parts(&other.url));
    let port = own.trim_start_matches("127.0.0.1:");
    let check = |status: &str, request: &str| {
        let answer = ask(own, request);
        assert!(answer.starts_with(&format!("HTTP/1.1 {status} ")), "{status}: {request}{answer}");
        answer
    };
    let get =
        |status: &str, path: &str, host: &str| check(status, &format!("GET {path} HTTP/1.1\r\n{host}\r\n"));
    let host = format!("Host: {own}\r\n");
    let page = get("200", &format!("/{query}"), &host);
    assert!(page.contains("<!doctype html>"), "{page}");
    assert!(page.contains("Content-Security-Policy: default-src 'none'"), "{page}");
    get("200", &format!("/?a=b&{}", &query[1..]), &format!("host: localhost:{port}\r\n"));
    get("404", "/../../etc/passwd", &host);
    for host in
        ["", "Host: evil.example\r\n", "Host: 127.0.0.1:1\r\n", &format!("{host}Host: evil.example\r\n")]
    {
        get("403", &format!("/{query}"), host);
    }
    // Other users of this machine can send anything that a browser sends, except the token.
    let twice = format!("{others}&{}", &query[1..]);
    let upper = query.to_uppercase().replace("TOKEN", "token");
    for token in ["", "?token", "?token=", others, &twice, &format!("{query}0"), &upper] {
        for path in ["/", "/index.html", "/socket"] {
            let answer = get("403", &format!("{path}{token}"), &host);
            assert!(answer.contains("Open the address"), "{answer}");
        }
    }
    // The page names no place but its own.
    for file in ["page", "link", "line", "stage", "drag", "orbit", "panel", "editor", "slider"] {
        let text = get("200", &format!("/{file}.js"), &host);
        assert!(!text.contains("http://") && !text.contains("https://"), "{file} loads from elsewhere");
    }
    check("431", &format!("GET / HTTP/1.1\r\n{host}Cookie: {}", "a".repeat(17_000)));
    check("405", &format!("POST / HTTP/1.1\r\n{host}\r\n"));
    check("400", "no request\r\n\r\n");

    let socket = format!(
        "GET /socket{query} HTTP/1.1\r\n{host}Origin: http://{own}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
    );
    for origin in ["https://evil.example", "null", "http://127.0.0.1", &format!("https://{own}")] {
        check("403", &socket.replace(&format!("http://{own}"), origin));
    }
    check("403", &socket.replace(&format!("Origin: http://{own}\r\n"), ""));
    for (piece, other) in [(": 13", ": 8"), ("Sec-WebSocket-Key", "Other-Key"), ("dGhl", "")] {
        check("400", &socket.replace(piece, other));
    }
    check("400", &format!("{socket}early"));
}
