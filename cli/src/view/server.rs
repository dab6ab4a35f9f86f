//! The server: connections to 127.0.0.1, a limited number at a time and each on a thread of its own.

use std::io::Write;
use std::net::{Shutdown, TcpListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread;

use piola_viewer::driver::Order;
use tungstenite::Bytes;

use super::connection;
use super::page;
use super::patience::{ANSWER, TimedStream};
use super::request::{self, Door, Request};

/// A browser opens half a dozen for the files of a page and keeps one.
const MAX_CONNECTIONS: usize = 32;

/// Takes connections until it is over. They are numbered from `first` on; below it, drags of a loaded state
/// may still pull.
pub(super) fn run(
    listener: &TcpListener,
    door: &Door,
    topology: &Bytes,
    orders: &SyncSender<Order>,
    is_over: &AtomicBool,
    first: u64,
) {
    // Each connection holds a share of it.
    let open = Arc::new(());
    for (stream, number) in listener.incoming().zip(first..) {
        if is_over.load(Ordering::Relaxed) {
            return;
        }
        // A connection that fails before it begins concerns no other.
        let Ok(stream) = stream else { continue };
        let mut stream = TimedStream::new(stream);
        let place = Arc::clone(&open);
        if Arc::strong_count(&open) > 1 + MAX_CONNECTIONS {
            answer(&mut stream, page::denied("503 Service Unavailable", "there are too many connections"));
            continue;
        }
        let (door, topology, orders) = (door.clone(), topology.clone(), orders.clone());
        let talk = move || {
            let _place = place;
            match request::read(&mut stream, &door) {
                None => {}
                Some(Request::File { path }) => answer(&mut stream, page::file(&path)),
                Some(Request::Socket(response)) => {
                    connection::serve(stream, &response, number, topology, &orders);
                }
                Some(Request::Denied(status, reason)) => answer(&mut stream, page::denied(status, reason)),
            }
        };
        // Where the system has no thread left, the browser sees a connection that ends.
        let _ = thread::Builder::new().name(format!("page {number}")).spawn(talk);
    }
}

/// Writes an answer; if it is not read, nothing is lost.
fn answer(stream: &mut TimedStream, (header, content): (String, &'static str)) {
    stream.allow(ANSWER);
    let _ = stream
        .write_all(header.as_bytes())
        .and_then(|()| stream.write_all(content.as_bytes()))
        .and_then(|()| stream.stream.shutdown(Shutdown::Write));
}

#[cfg(test)]
mod tests {
    use std::io::Read;
    use std::net::{Ipv4Addr, SocketAddr, TcpStream};
    use std::sync::mpsc::{Receiver, sync_channel};
    use std::time::{Duration, Instant};

    use tungstenite::client::IntoClientRequest;
    use tungstenite::{Message, WebSocket};

    use super::super::token::Token;
    use super::*;

    /// A server to which nobody gives a body.
    fn serve() -> (SocketAddr, Token, Receiver<Order>) {
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).expect("a port");
        let address = listener.local_addr().expect("an address");
        let door = Door { port: address.port(), token: Token::new().expect("a system") };
        let token = door.token.clone();
        let (orders, taken) = sync_channel(256);
        let (topology, is_over) = (Bytes::from_static(b"body"), AtomicBool::new(false));
        thread::spawn(move || run(&listener, &door, &topology, &orders, &is_over, 0));
        (address, token, taken)
    }

    fn page(address: SocketAddr, token: &Token) -> WebSocket<TcpStream> {
        let stream = TcpStream::connect(address).expect("somebody listens");
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        let uri = format!("ws://{address}/socket?token={token}");
        let mut request = uri.into_client_request().expect("a request");
        let origin = format!("http://{address}").parse().expect("an origin");
        request.headers_mut().insert("Origin", origin);
        let (mut socket, _) = tungstenite::client(request, stream).expect("a socket");
        assert_eq!(socket.read().expect("topology").into_data(), "body");
        socket
    }

    /// Reads until the other side closes the line.
    fn time_to_the_end(stream: &mut TcpStream) -> Duration {
        stream.set_read_timeout(Some(Duration::from_secs(20))).expect("a socket");
        let start = Instant::now();
        let _ = stream.read_to_end(&mut Vec::new());
        start.elapsed()
    }

    /// Ten times the longest limit in tests: a machine may be busy.
    const SOON: Duration = Duration::from_secs(5);

    #[test]
    fn connections_that_say_nothing_or_never_end_are_closed() {
        let (address, _, _taken) = serve();
        for word in ["", "GET / HTTP/1.1\r\nHost"] {
            let mut stream = TcpStream::connect(address).expect("somebody listens");
            stream.write_all(word.as_bytes()).expect("somebody reads");
            assert!(time_to_the_end(&mut stream) < SOON, "{word}");
        }
        // A byte now and then is not a request either.
        let mut stream = TcpStream::connect(address).expect("somebody listens");
        let start = Instant::now();
        while stream.write_all(b"G").is_ok() {
            assert!(start.elapsed() < SOON, "a request without end is listened to");
            thread::sleep(Duration::from_millis(10));
        }
    }

    #[test]
    fn a_page_that_answers_pings_stays_and_others_are_closed() {
        let (address, token, _taken) = serve();
        let mut alive = page(address, &token);
        let dead = page(address, &token);
        // One that drops bytes of a message without end.
        let mut dripping = page(address, &token);
        dripping.get_mut().write_all(&[0x81, 0xfe, 0x10, 0x00, 0, 0, 0, 0]).expect("somebody reads");
        let drip = thread::spawn(move || {
            let start = Instant::now();
            while start.elapsed() < SOON && dripping.get_mut().write_all(b"a").is_ok() {
                thread::sleep(Duration::from_millis(10));
            }
            start.elapsed()
        });
        let mut dead = dead.into_inner();
        let dead = thread::spawn(move || time_to_the_end(&mut dead));
        let (start, mut pings) = (Instant::now(), 0);
        while start.elapsed() < Duration::from_secs(2) {
            // Reading answers.
            assert!(matches!(alive.read(), Ok(Message::Ping(_))));
            pings += 1;
        }
        assert!(pings > 2, "{pings} pings");
        assert!(dead.join().expect("no panic") < SOON, "a dead page is kept");
        assert!(drip.join().expect("no panic") < SOON, "a page that never ends its message is kept");
    }
}
