//! Requests of a browser over HTTP, and whether they are allowed.
//!
//! Page and socket require the token of the printed address, which other users of this machine do not have. A
//! page anywhere on the web can make a browser send requests here, too. It has no token, and it cannot choose
//! the browser's `Origin`; a name that it has pointed here shows up as `Host`. So both must be the viewer's
//! own.

use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use tungstenite::Error;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::machine::TryParse;
use tungstenite::handshake::server::{Request, Response, create_response};

use super::page::{self, Answer};
use super::token::Token;

/// Browsers send less than one kilobyte.
const MAX_LENGTH: usize = 16 * 1024;
/// Limit for a whole request, which holds one of a few places; a browser sends it at once.
const PATIENCE: Duration = Duration::from_secs(5);

/// The address at which requests arrive.
#[derive(Clone)]
pub(super) struct Door {
    pub(super) port: u16,
    pub(super) token: Token,
}

/// The response that opens a socket, or else the answer to any other request.
type Judged = Result<Response, Answer>;

/// Reads a request to a viewer at this address, and judges it.
///
/// `None` if the other side goes away, which browsers do with connections that they open in advance.
pub(super) fn read(stream: &mut TcpStream, door: &Door) -> Option<Judged> {
    let start = Instant::now();
    let mut text = Vec::new();
    let mut part = [0; 4096];
    while let Some(left) = PATIENCE.checked_sub(start.elapsed()).filter(|left| !left.is_zero()) {
        stream.set_read_timeout(Some(left)).ok()?;
        match stream.read(&mut part) {
            Ok(0) => return None,
            Ok(count) => text.extend_from_slice(&part[..count]),
            // The first two are errors of systems when a read takes too long.
            Err(error) => match error.kind() {
                ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted => continue,
                _ => return None,
            },
        }
        if let Some(judged) = parse(&text, door) {
            return Some(judged);
        }
        if text.len() > MAX_LENGTH {
            return Some(Err(page::denied("431 Request Header Fields Too Large", "the request is too long")));
        }
    }
    Some(Err(page::denied("408 Request Timeout", "the request took too long")))
}

/// Parses and judges a request; `None` if more is to come.
fn parse(text: &[u8], door: &Door) -> Option<Judged> {
    match Request::try_parse(text) {
        Ok(None) => None,
        // A page that sends before the socket stands breaks the protocol.
        Ok(Some((length, request))) if length == text.len() => Some(judge(&request, door)),
        Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => {
            Some(Err(page::denied("405 Method Not Allowed", "files can be read and nothing else")))
        }
        _ => Some(Err(page::denied("400 Bad Request", "the request is malformed"))),
    }
}

fn judge(request: &Request, Door { port, token }: &Door) -> Judged {
    let forbidden = |reason| Err(page::denied("403 Forbidden", reason));
    // Of two values of a header, none is taken: which one counts is not defined.
    let header = |name: &str| {
        let mut values = request.headers().get_all(name).iter();
        values.next().filter(|_| values.next().is_none()).and_then(|value| value.to_str().ok())
    };
    let is_own =
        |host: &str| [format!("127.0.0.1:{port}"), format!("localhost:{port}")].iter().any(|own| own == host);
    if !header("host").is_some_and(is_own) {
        return forbidden("this page is served to 127.0.0.1 and localhost only");
    }
    let from_own = header("origin").and_then(|origin| origin.strip_prefix("http://")).is_some_and(is_own);
    if request.headers().contains_key("origin") && !from_own {
        return forbidden("the request comes from another page");
    }
    let path = request.uri().path();
    if ["/", "/index.html", "/socket"].contains(&path) && !token.is_in(request.uri().query()) {
        return forbidden(
            "Open the address that `piola view` has printed: it ends with a token, which this one lacks.\n",
        );
    }
    match path {
        "/socket" if !from_own => forbidden("a socket needs an origin"),
        "/socket" => create_response(request)
            .map_err(|_| page::denied("400 Bad Request", "the page's socket is a WebSocket of version 13")),
        path => Err(page::file(path)),
    }
}
