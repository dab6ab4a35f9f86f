//! Requests of a browser over HTTP, and whether they are allowed.
//!
//! A page anywhere on the web can make a browser send requests to this machine. It cannot choose the
//! browser's `Origin`, and a name that it has pointed here shows up as `Host`. So both must be the viewer's
//! own.

use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use tungstenite::Error;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::machine::TryParse;
use tungstenite::handshake::server::{Request as HttpRequest, Response, create_response};

/// Browsers send less than one kilobyte.
const MAX_LENGTH: usize = 16 * 1024;
/// For all of a request.
const PATIENCE: Duration = Duration::from_secs(5);

/// A request that may be answered.
#[derive(Debug)]
pub(super) enum Request {
    /// For a file of the page.
    File { path: String },
    /// For a socket, with the answer that opens it.
    Socket(Response),
}

/// Why a request is not answered: status and reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Denied(pub(super) &'static str, pub(super) &'static str);

/// Reads a request to a viewer at this port.
///
/// `None` if the other side goes away, which browsers do with connections that they open in advance.
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

/// Parses and judges a request; `None` if more is to come.
fn parse(text: &[u8], port: u16) -> Option<Result<Request, Denied>> {
    match HttpRequest::try_parse(text) {
        Ok(None) => None,
        // A page that sends before the socket stands breaks the protocol.
        Ok(Some((length, request))) if length == text.len() => Some(judge(&request, port)),
        Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => {
            Some(Err(Denied("405 Method Not Allowed", "files can be read and nothing else")))
        }
        _ => Some(Err(Denied("400 Bad Request", "the request is malformed"))),
    }
}

fn judge(request: &HttpRequest, port: u16) -> Result<Request, Denied> {
    // Of two values of a header, none is taken: which one counts is not defined.
    let header = |name: &str| {
        let mut values = request.headers().get_all(name).iter();
        values.next().filter(|_| values.next().is_none()).and_then(|value| value.to_str().ok())
    };
    let is_own =
        |host: &str| [format!("127.0.0.1:{port}"), format!("localhost:{port}")].iter().any(|own| own == host);
    if !header("host").is_some_and(is_own) {
        return Err(Denied("403 Forbidden", "this page is served to 127.0.0.1 and localhost only"));
    }
    let from_own = header("origin").and_then(|origin| origin.strip_prefix("http://")).is_some_and(is_own);
    if request.headers().contains_key("origin") && !from_own {
        return Err(Denied("403 Forbidden", "the request comes from another page"));
    }
    match request.uri().path() {
        "/socket" if !from_own => Err(Denied("403 Forbidden", "a socket needs an origin")),
        "/socket" => create_response(request)
            .map(Request::Socket)
            .map_err(|_| Denied("400 Bad Request", "the page's socket is a WebSocket of version 13")),
        path => Ok(Request::File { path: path.into() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOCKET: &str = "GET /socket HTTP/1.1\r\nHost: 127.0.0.1:8017\r\nOrigin: http://127.0.0.1:8017\r\n\
                          Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\
                          Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    /// Answer to that key in RFC 6455, section 1.3.
    const ACCEPT: &str = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

    /// Compares the path of a file, the key that opens a socket, or the status of a request that is denied.
    #[track_caller]
    fn check(text: &str, expected: Result<&str, &str>) {
        let found = parse(text.as_bytes(), 8017).expect("a whole request").map(|request| match request {
            Request::File { path } => path,
            Request::Socket(response) => {
                response.headers()["sec-websocket-accept"].to_str().expect("ASCII").into()
            }
        });
        let found = found.as_deref().map_err(|Denied(status, _)| &status[..3]);
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn own_requests_are_answered() {
        check("GET /page.js HTTP/1.1\r\nhost: localhost:8017\r\n\r\n", Ok("/page.js"));
        check(SOCKET, Ok(ACCEPT));
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
        check(&SOCKET.replace("Sec-WebSocket-Key", "Other-Key"), Err("400"));
        check(&SOCKET.replace("dGhl", ""), Err("400"));
        check(&format!("{SOCKET}early"), Err("400"));
        check("no request\r\n\r\n", Err("400"));
    }
}
