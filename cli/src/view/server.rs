//! The server: connections to 127.0.0.1, a limited number at a time and each on a thread of its own.

use std::io::Write;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::Duration;

use piola_viewer::driver::Order;
use tungstenite::Bytes;

use super::connection;
use super::page::{self, Answer};
use super::request::{self, Door};

/// A browser opens half a dozen for the files of a page and keeps one.
const MAX_CONNECTIONS: usize = 32;
/// Time after which a page that reads nothing is given up; on one machine a write takes milliseconds.
const ANSWER: Duration = Duration::from_secs(10);

/// A server of the page.
pub(crate) struct Server {
    pub(super) listener: TcpListener,
    pub(super) door: Door,
    /// The first message for each page.
    pub(super) topology: Bytes,
    pub(super) orders: SyncSender<Order>,
    /// Number of the first connection; drags of a loaded state may still pull below it.
    pub(super) first: u64,
}

impl Server {
    /// Address of the page, with the token that opens it.
    pub(crate) fn url(&self) -> String {
        let Door { port, token } = &self.door;
        format!("http://127.0.0.1:{port}/?token={token}")
    }

    /// Takes connections until the process is ended from outside.
    pub(crate) fn run(&self) {
        // Each connection holds a share of it.
        let open = Arc::new(());
        for (stream, number) in self.listener.incoming().zip(self.first..) {
            // A connection that fails before it begins concerns no other.
            let limited = stream.and_then(|stream| stream.set_write_timeout(Some(ANSWER)).map(|()| stream));
            let Ok(mut stream) = limited else { continue };
            let place = Arc::clone(&open);
            if Arc::strong_count(&open) > 1 + MAX_CONNECTIONS {
                answer(stream, page::denied("503 Service Unavailable", "there are too many connections"));
                continue;
            }
            let (door, topology, orders) = (self.door.clone(), self.topology.clone(), self.orders.clone());
            let talk = move || {
                let _place = place;
                match request::read(&mut stream, &door) {
                    None => {}
                    Some(Ok(response)) => connection::serve(stream, &response, number, topology, &orders),
                    Some(Err(other)) => answer(stream, other),
                }
            };
            // Where the system has no thread left, the browser sees a connection that ends.
            let _ = thread::Builder::new().name(format!("page {number}")).spawn(talk);
        }
    }
}

/// Writes an answer; if it is not read, nothing is lost.
fn answer(mut stream: TcpStream, (header, content): Answer) {
    let _ = stream
        .write_all(header.as_bytes())
        .and_then(|()| stream.write_all(content.as_bytes()))
        .and_then(|()| stream.shutdown(Shutdown::Write));
}
