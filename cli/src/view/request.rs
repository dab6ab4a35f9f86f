//! Requests of a browser over HTTP, and whether they are allowed.
//!
//! Page and socket require the token of the printed address, which other users of this machine do not have. A
//! page anywhere on the web can make a browser send requests here, too. It has no token, and it cannot choose
//! the browser's `Origin`; a name that it has pointed here shows up as `Host`. So both must be the viewer's
//! own.

use std::io::{ErrorKind, Read};

use tungstenite::Error;
use tungstenite::error::ProtocolError;
use tungstenite::handshake::machine::TryParse;
use tungstenite::handshake::server::{Request as HttpRequest, Response, create_response};

use super::patience::{REQUEST, TimedStream, is_silence};
use super::token::Token;

/// Browsers send less than one kilobyte.
const MAX_LENGTH: usize = 16 * 1024;

/// The address at which requests arrive.
#[derive(Clone, Debug)]
pub(super) struct Door {
    pub(super) port: u16,
    pub(super) token: Token,
}

/// A request, judged.
#[derive(Debug)]
pub(super) enum Request {
    /// Request for a file of the page.
    File { path: String },
    /// Request for a socket, with the answer that opens it.
    Socket(Response),
    /// A request that is not answered, with status and reason.
    Denied(&'static str, &'static str),
}

/// Reads a request to a viewer at this address, if it comes in time.
///
/// `None` if the other side goes away, which browsers do with connections that they open in advance.
pub(super) fn read(stream: &mut TimedStream, door: &Door) -> Option<Request> {
    stream.allow(REQUEST);
    let mut text = Vec::new();
    let mut part = [0; 4096];
    loop {
        match stream.read(&mut part) {
            Ok(0) => return None,
            Ok(count) => text.extend_from_slice(&part[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => continue,
            Err(error) if is_silence(&error) => {
                return Some(Request::Denied("408 Request Timeout", "the request took too long"));
            }
            Err(_) => return None,
        }
        if let Some(request) = parse(&text, door) {
            return Some(request);
        }
        if text.len() > MAX_LENGTH {
            return Some(Request::Denied("431 Request Header Fields Too Large", "the request is too long"));
        }
    }
}

/// Parses and judges a request; `None` if more is to come.
fn parse(text: &[u8], door: &Door) -> Option<Request> {
    match HttpRequest::try_parse(text) {
        Ok(None) => None,
        // A page that sends before the socket stands breaks the protocol.
        Ok(Some((length, request))) if length == text.len() => Some(judge(&request, door)),
        Err(Error::Protocol(ProtocolError::WrongHttpMethod)) => {
            Some(Request::Denied("405 Method Not Allowed", "files can be read and nothing else"))
        }
        _ => Some(Request::Denied("400 Bad Request", "the request is malformed")),
    }
}

fn judge(request: &HttpRequest, Door { port, token }: &Door) -> Request {
    // Of two values of a header, none is taken: which one counts is not defined.
    let header = |name: &str| {
        let mut values = request.headers().get_all(name).iter();
        values.next().filter(|_| values.next().is_none()).and_then(|value| value.to_str().ok())
    };
    let is_own =
        |host: &str| [format!("127.0.0.1:{port}"), format!("localhost:{port}")].iter().any(|own| own == host);
    if !header("host").is_some_and(is_own) {
        return Request::Denied("403 Forbidden", "this page is served to 127.0.0.1 and localhost only");
    }
    let from_own = header("origin").and_then(|origin| origin.strip_prefix("http://")).is_some_and(is_own);
    if request.headers().contains_key("origin") && !from_own {
        return Request::Denied("403 Forbidden", "the request comes from another page");
    }
    let path = request.uri().path();
    if ["/", "/index.html", "/socket"].contains(&path) && !token.is_in(request.uri().query()) {
        return Request::Denied(
            "403 Forbidden",
            "Open the address that `piola view` has printed: it ends with a token, which this one lacks.\n",
        );
    }
    match path {
        "/socket" if !from_own => Request::Denied("403 Forbidden", "a socket needs an origin"),
        "/socket" => create_response(request).map_or(
            Request::Denied("400 Bad Request", "the page's socket is a WebSocket of version 13"),
            Request::Socket,
        ),
        path => Request::File { path: path.into() },
    }
}
