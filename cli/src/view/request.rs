//! What a browser asks for over HTTP, and whether it may.
//!
//! A page anywhere on the web can make a browser send requests to this machine. It cannot choose the browser's `Origin`,
//! and a name that it has pointed here shows up as `Host`. So both must be the viewer's own.

use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

/// Browsers send less than one kilobyte.
const MAX_LENGTH: usize = 16 * 1024;
const MAX_HEADERS: usize = 64;
/// For all of a request.
const PATIENCE: Duration = Duration::from_secs(5);

/// A request that may be answered.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Request {
    /// For a file of the page.
    File { path: String },
    /// For a socket, with the browser's key.
    Socket { key: String },
}

/// Why a request is not answered: status and reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Denied(pub(super) &'static str, pub(super) &'static str);

/// Reads a request to a viewer at this port.
///
/// None where the other side goes away, which browsers do with connections that they open in advance.
pub(super) fn read(stream: &mut TcpStream, port: u16) -> Option<Result<Request, Denied>> {
    let deadline = Instant::now() + PATIENCE;
    let mut text = Vec::new();
    let mut part = [0; 4096];
    loop {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Some(Err(Denied("408 Request Timeout", "the request took too long")));
        }
        stream.set_read_timeout(Some(left)).ok()?;
        match stream.read(&mut part) {
            Ok(0) => return None,
            Ok(count) => text.extend_from_slice(&part[..count]),
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => continue,
                _ => return None,
            },
        }
        if let Some(result) = parse(&text, port) {
            return Some(result);
        }
        if text.len() > MAX_LENGTH {
            return Some(Err(Denied("431 Request Header Fields Too Large", "the request is too long")));
        }
    }
}

/// None where more is to come.
fn parse(text: &[u8], port: u16) -> Option<Result<Request, Denied>> {
    let mut headers = [httparse::EMPTY_HEADER; MAX_HEADERS];
    let mut request = httparse::Request::new(&mut headers);
    match request.parse(text) {
        Ok(httparse::Status::Partial) => None,
        // Who begins to speak before the socket stands breaks the protocol.
        Ok(httparse::Status::Complete(length)) if length == text.len() => Some(judge(&request, port)),
        Ok(httparse::Status::Complete(_)) | Err(_) => {
            Some(Err(Denied("400 Bad Request", "the request is malformed")))
        }
    }
}

fn judge(request: &httparse::Request<'_, '_>, port: u16) -> Result<Request, Denied> {
    let header = |wanted: &str| {
        let mut values = request.headers.iter().filter(|header| header.name.eq_ignore_ascii_case(wanted));
        let value = values.next().and_then(|header| std::str::from_utf8(header.value).ok());
        // Of two, nobody knows which one counts.
        if values.next().is_some() { None } else { value }
    };
    let has = |wanted: &str| request.headers.iter().any(|header| header.name.eq_ignore_ascii_case(wanted));
    let is_own =
        |host: &str| [format!("127.0.0.1:{port}"), format!("localhost:{port}")].iter().any(|own| own == host);
    if !header("host").is_some_and(is_own) {
        return Err(Denied("403 Forbidden", "this page is served to 127.0.0.1 and localhost only"));
    }
    let from_own = header("origin").and_then(|origin| origin.strip_prefix("http://")).is_some_and(is_own);
    if has("origin") && !from_own {
        return Err(Denied("403 Forbidden", "the request comes from another page"));
    }
    if request.method != Some("GET") {
        return Err(Denied("405 Method Not Allowed", "files can be read and nothing else"));
    }
    let path = request.path.unwrap_or_default();
    if path != "/socket" {
        return Ok(Request::File { path: path.into() });
    }
    if !from_own {
        return Err(Denied("403 Forbidden", "a socket needs an origin"));
    }
    let is_upgrade = header("upgrade").is_some_and(|name| name.eq_ignore_ascii_case("websocket"));
    match header("sec-websocket-key") {
        Some(key) if is_upgrade && header("sec-websocket-version") == Some("13") => {
            Ok(Request::Socket { key: key.into() })
        }
        _ => Err(Denied("400 Bad Request", "this is where the page's socket begins, of version 13")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOCKET: &str = "GET /socket HTTP/1.1\r\nHost: 127.0.0.1:8017\r\nOrigin: http://127.0.0.1:8017\r\n\
                          Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\
                          Sec-WebSocket-Key: a\r\n\r\n";

    #[track_caller]
    fn check(text: &str, expected: Result<Request, &str>) {
        let found = parse(text.as_bytes(), 8017).expect("a whole request");
        assert_eq!(found.map_err(|Denied(status, _)| &status[..3]), expected, "{text}");
    }

    #[test]
    fn own_requests_are_answered() {
        let file = Ok(Request::File { path: "/page.js".into() });
        check("GET /page.js HTTP/1.1\r\nhost: localhost:8017\r\n\r\n", file);
        check(SOCKET, Ok(Request::Socket { key: "a".into() }));
        assert!(parse(&SOCKET.as_bytes()[..SOCKET.len() - 1], 8017).is_none(), "more is to come");
    }

    #[test]
    fn others_are_not() {
        check("GET / HTTP/1.1\r\n\r\n", Err("403"));
        check("GET / HTTP/1.1\r\nHost: evil.example:8017\r\n\r\n", Err("403"));
        check("GET / HTTP/1.1\r\nHost: 127.0.0.1:8018\r\n\r\n", Err("403"));
        check("GET / HTTP/1.1\r\nHost: 127.0.0.1:8017\r\nHost: evil.example\r\n\r\n", Err("403"));
        check("POST / HTTP/1.1\r\nHost: 127.0.0.1:8017\r\n\r\n", Err("405"));
        for origin in ["https://evil.example", "null", "http://127.0.0.1", "https://127.0.0.1:8017"] {
            check(&SOCKET.replace("http://127.0.0.1:8017", origin), Err("403"));
        }
        check(&SOCKET.replace("Origin: http://127.0.0.1:8017\r\n", ""), Err("403"));
        check(&SOCKET.replace(": 13", ": 8"), Err("400"));
        check(&SOCKET.replace("Sec-WebSocket-Key: a\r\n", ""), Err("400"));
        check(&format!("{SOCKET}early"), Err("400"));
        check("no request\r\n\r\n", Err("400"));
    }
}
