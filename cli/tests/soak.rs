//! Some seconds of hostile clients: a page is served all the while, and memory stays.
//!
//! `cli/browser/soak.mjs` is the long form, with a real browser and one body.

#[expect(dead_code, reason = "other tests need more of a page")]
#[path = "view/page.rs"]
mod page;

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::json;
use tungstenite::Message;

use page::{Page, parts};

/// For each of the two rounds.
const ROUND: Duration = Duration::from_secs(3);
/// The longest that a frame may take meanwhile. A step of the bar takes milliseconds; all share the cores.
const FRAME: Duration = Duration::from_secs(3);
/// What allocators may keep, MiB, for threads that come and go. If each of the tens of thousands of messages
/// below were kept, that would be far more.
const GROWTH: f64 = 16.0;

/// The program with a page, ended when dropped.
struct Program {
    child: Child,
    url: String,
}

impl Program {
    fn start() -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_piola"));
        let mut child = command
            .args(["view", "twist", "--port", "0"])
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut line = String::new();
        let said = child.stdout.take().map(|out| BufReader::new(out).read_line(&mut line));
        assert!(matches!(said, Some(Ok(_))));
        let url = line.split_whitespace().next().expect("an address").into();
        Self { child, url }
    }

    /// Memory in use, MiB, if the system reports it.
    fn memory(&self) -> Option<f64> {
        let status = fs::read_to_string(format!("/proc/{}/status", self.child.id())).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
        line.trim().strip_suffix(" kB")?.parse::<f64>().ok().map(|kib| kib / 1024.0)
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// A client that does its worst again and again; where it is shut out, it comes back.
type Hostile = fn(&str, &AtomicBool);

const HOSTILE: [Hostile; 6] = [idle, half_a_request, wrong_token, garbage, flood, refused_acts];

fn connect(url: &str) -> Option<TcpStream> {
    let stream = TcpStream::connect(parts(url).0).ok()?;
    stream.set_read_timeout(Some(Duration::from_millis(200))).ok()?;
    stream.set_write_timeout(Some(Duration::from_millis(200))).ok()?;
    Some(stream)
}

/// Says nothing, on several lines.
fn idle(url: &str, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        let lines: Vec<_> = (0..8).filter_map(|_| connect(url)).collect();
        thread::sleep(Duration::from_millis(500));
        drop(lines);
    }
}

fn half_a_request(url: &str, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        let Some(mut stream) = connect(url) else { continue };
        let _ = stream.write_all(b"GET /page.js HTTP/1.1\r\nHost: 127.0.0.1");
        thread::sleep(Duration::from_millis(20));
    }
}

fn wrong_token(url: &str, is_over: &AtomicBool) {
    let (address, _) = parts(url);
    while !is_over.load(Ordering::Relaxed) {
        for path in ["/", "/socket?token=00000000000000000000000000000000", "/../../etc/passwd"] {
            let Some(mut stream) = connect(url) else { continue };
            let request = format!(
                "GET {path} HTTP/1.1\r\nHost: {address}\r\nOrigin: http://{address}\r\nUpgrade: websocket\r\n\
                 Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
            );
            let _ = stream.write_all(request.as_bytes());
            let mut answer = String::new();
            let _ = stream.read_to_string(&mut answer);
            let is_denied =
                ["403", "404", "503"].iter().any(|status| answer.starts_with(&format!("HTTP/1.1 {status}")));
            assert!(answer.is_empty() || is_denied, "{answer}");
        }
    }
}

/// Opens a socket and breaks the protocol in all sorts of ways.
fn garbage(url: &str, is_over: &AtomicBool) {
    let mut random = 1_u64;
    while !is_over.load(Ordering::Relaxed) {
        let Some(mut page) = Page::try_open(url) else { continue };
        let bytes: Vec<u8> = (0..300)
            .map(|_| {
                // Knuth's linear congruential generator, the high bits of which are good enough here.
                random =
                    random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (random >> 56) as u8
            })
            .collect();
        let _ = page.socket.get_mut().write_all(&bytes);
    }
}

/// Pulls, looks and never reads.
fn flood(url: &str, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        let Some(mut page) = Page::try_open(url) else { continue };
        let _ = page.socket.get_mut().set_write_timeout(Some(Duration::from_millis(200)));
        for drag in 0..2_000_u64 {
            let target = [0.1 * (drag % 7) as f64, 1.0, 0.0];
            let pull =
                json!({ "act": { "pull": { "drag": drag % 8, "vertex": drag % 50, "target": target } } });
            let is_sent = page.socket.send(Message::text(pull.to_string())).is_ok()
                && page.socket.send(Message::text(r#"{"look": {}}"#)).is_ok();
            if !is_sent || is_over.load(Ordering::Relaxed) {
                break;
            }
        }
    }
}

/// Asks for what is refused, so that every message has an answer, and never reads.
fn refused_acts(url: &str, is_over: &AtomicBool) {
    let name = "a".repeat(10_000);
    let act = json!({ "act": { "material": { "name": name, "as_stiff": true } } }).to_string();
    while !is_over.load(Ordering::Relaxed) {
        let Some(mut page) = Page::try_open(url) else { continue };
        let _ = page.socket.get_mut().set_write_timeout(Some(Duration::from_millis(200)));
        for _ in 0..500 {
            if page.socket.send(Message::text(act.clone())).is_err() || is_over.load(Ordering::Relaxed) {
                break;
            }
        }
    }
}

/// Looks at frames for a while, each of which must come in time.
fn watch(page: &mut Page) {
    let (start, first) = (Instant::now(), page.frame());
    while start.elapsed() < ROUND {
        let asked = Instant::now();
        page.look();
        assert!(asked.elapsed() < FRAME, "a frame took {:?}: {}", asked.elapsed(), page.figures["trouble"]);
    }
    assert!(page.frame() > first + 10, "only {} steps in {ROUND:?}", page.frame() - first);
}

#[test]
fn hostile_clients_shut_nobody_out() {
    let program = Program::start();
    let is_over = AtomicBool::new(false);
    let mut page = Page::open(&program.url);
    let memory = thread::scope(|scope| {
        let (url, is_over) = (&program.url, &is_over);
        for hostile in HOSTILE {
            scope.spawn(move || hostile(url, is_over));
        }
        // Ends the others also where the page is not served.
        let over = Over(is_over);
        watch(&mut page);
        let warm = program.memory();
        watch(&mut page);
        drop(over);
        warm.zip(program.memory())
    });
    if let Some((warm, end)) = memory {
        println!("{} steps, memory {warm:.1} MiB after {ROUND:?}, {end:.1} MiB at the end", page.frame());
        assert!(end < warm + GROWTH, "memory grew from {warm} to {end} MiB");
    }
    // Whoever comes later is served, too, once the dead connections are gone.
    let start = Instant::now();
    let mut late = loop {
        match Page::try_open(&program.url) {
            Some(page) => break page,
            None => assert!(start.elapsed() < Duration::from_secs(20), "nobody is let in"),
        }
    };
    late.look();
    page.look();
}

/// Says that it is over when dropped.
struct Over<'a>(&'a AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
