//! Requests of a browser over HTTP, and whether they are allowed.
//!
//! Page and socket require the token of the printed address, which other users of this machine do not have. A
//! page anywhere on the web can make a browser send requests here, too. It has no token, and it cannot choose
//! the browser's `Origin`; a name that it has pointed here shows up as `Host`. So both must be the viewer's
//! own.

use std::io::{ErrorKind, Read};
use std::time::Duration;

use tungstenite::Error;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::machine::TryParse;
use tungstenite::handshake::server::{Request as HttpRequest, Response, create_response};

use super::patience::{TimedStream, is_silence};
use super::token::Token;

/// Browsers send less than one kilobyte.
const MAX_LENGTH: usize = 16 * 1024;

/// The address at which requests arrive.
#[derive(Clone, Debug)]
pub(super) struct Door {
    pub(super) port: u16,
    pub(super) token: Token,
}

/// A request that may be answered.
#[derive(Debug)]
pub(super) enum Request {
    /// Request for a file of the page.
    File { path: String },
    /// Request for a socket, with the answer that opens it.
    Socket(Response),
}

/// Reason why a request is not answered: status and text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Denied(pub(super) &'static str, pub(super) &'static str);

/// Reads a request to a viewer at this address, if it comes in this time.
///
/// `None` if the other side goes away, which browsers do with connections that they open in advance.
pub(super) fn read(stream: &mut TimedStream, time: Duration, door: &Door) -> Option<Result<Request, Denied>> {
    stream.allow(time);
    let mut text = Vec::new();
    let mut part = [0; 4096];
    loop {
        match stream.read(&mut part) {
            Ok(0) => return None,
            Ok(count) => text.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) if is_silence(&error) => {
                return Some(Err(Denied("408 Request Timeout", "the request took too long")));
            }
            Err(_) => return None,
        }
        if let Some(result) = parse(&text, door) {
            return Some(result);
        }
        if text.len() > MAX_LENGTH {
            return Some(Err(Denied("431 Request Header Fields Too Large", "the request is too long")));
        }
    }
}

/// Parses and judges a request; `None` if more is to come.
fn parse(text: &[u8], door: &Door) -> Option<Result<Request, Denied>> {
    match HttpRequest::try_parse(text) {
        Ok(None) => None,
        // A page that sends before the socket stands breaks the protocol.
        Ok(Some((length, request))) if length == text.len() => Some(judge(&request, door)),
        Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => {
            Some(Err(Denied("405 Method Not Allowed", "files can be read and nothing else")))
        }
        _ => Some(Err(Denied("400 Bad Request", "the request is malformed"))),
    }
}

fn judge(request: &HttpRequest, Door { port, token }: &Door) -> Result<Request, Denied> {
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
    let path = request.uri().path();
    if ["/", "/index.html", "/socket"].contains(&path) && !token.is_in(request.uri().query()) {
        return Err(Denied(
            "403 Forbidden",
            "Open the address that `piola view` has printed: it ends with a token, which this one lacks.\n",
        ));
    }
    match path {
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

    /// A request for a socket with this token.
    fn socket(token: &Token) -> String {
        format!(
            "GET /socket?token={token} HTTP/1.1\r\nHost: 127.0.0.1:8017\r\nOrigin: http://127.0.0.1:8017\r\n\
             Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n\
             Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
        )
    }

    fn door() -> Door {
        Door { port: 8017, token: Token::new().expect("a system") }
    }

    /// Answer to that key in RFC 6455, section 1.3.
    const ACCEPT: &str = "s3pPLMBiTxaQ9kYGzzhZRbK+xOo=";

    /// Compares the path of a file, the key that opens a socket, or the status of a request that is denied.
    #[track_caller]
    fn check(door: &Door, text: &str, expected: Result<&str, &str>) {
        let found = parse(text.as_bytes(), door).expect("a whole request").map(|request| match request {
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
        let door = door();
        let (socket, token) = (socket(&door.token), &door.token);
        check(&door, "GET /page.js HTTP/1.1\r\nhost: localhost:8017\r\n\r\n", Ok("/page.js"));
        check(&door, &format!("GET /?token={token} HTTP/1.1\r\nHost: 127.0.0.1:8017\r\n\r\n"), Ok("/"));
        check(&door, &socket, Ok(ACCEPT));
        assert!(parse(&socket.as_bytes()[..socket.len() - 1], &door).is_none(), "more is to come");
    }

    #[test]
    fn others_are_not() {
        let door = door();
        let (token, other) = (&door.token, Token::new().expect("a system"));
        let page = |host: &str| format!("GET /?token={token} HTTP/1.1\r\n{host}\r\n");
        check(&door, &page(""), Err("403"));
        check(&door, &page("Host: evil.example:8017\r\n"), Err("403"));
        check(&door, &page("Host: 127.0.0.1:8018\r\n"), Err("403"));
        check(&door, &page("Host: 127.0.0.1:8017\r\nHost: evil.example\r\n"), Err("403"));
        check(&door, "POST / HTTP/1.1\r\nHost: 127.0.0.1:8017\r\n\r\n", Err("405"));
        for path in ["/", "/index.html", "/?token=", "/socket", &format!("/?token={other}")] {
            check(&door, &format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:8017\r\n\r\n"), Err("403"));
        }
        check(&door, &socket(&other), Err("403"));
        let socket = socket(token);
        for origin in ["https://evil.example", "null", "http://127.0.0.1", "https://127.0.0.1:8017"] {
            check(&door, &socket.replace("http://127.0.0.1:8017", origin), Err("403"));
        }
        check(&door, &socket.replace("Origin: http://127.0.0.1:8017\r\n", ""), Err("403"));
        check(&door, &socket.replace(": 13", ": 8"), Err("400"));
        check(&door, &socket.replace("Sec-WebSocket-Key", "Other-Key"), Err("400"));
        check(&door, &socket.replace("dGhl", ""), Err("400"));
        check(&door, &format!("{socket}early"), Err("400"));
        check(&door, "no request\r\n\r\n", Err("400"));
    }
}
