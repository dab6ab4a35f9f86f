//! The server: connections to 127.0.0.1, a limited number at a time and each on a thread of its own.

use std::io::Write;
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::Duration;

use tungstenite::Bytes;

use super::connection;
use super::driver::Order;
use super::page;
use super::request::{self, Denied, Request};

/// A browser opens half a dozen for the files of a page and keeps one.
const MAX_CONNECTIONS: usize = 32;
/// For writing a file.
const PATIENCE: Duration = Duration::from_secs(10);

/// Everything that connections need.
pub(super) struct Server {
    pub(super) listener: TcpListener,
    pub(super) port: u16,
    pub(super) topology: Bytes,
    pub(super) orders: SyncSender<Order>,
    /// Whether no more connections are to be taken.
    pub(super) is_over: Arc<AtomicBool>,
    /// The number of the first connection; below it, drags of a loaded state may still pull.
    pub(super) first: u64,
}

impl Server {
    /// Takes connections until it is over.
    pub(super) fn run(self) {
        let open = Arc::new(AtomicUsize::new(0));
        for (stream, number) in self.listener.incoming().zip(self.first..) {
            if self.is_over.load(Ordering::Relaxed) {
                return;
            }
            // A connection that fails before it begins concerns no other.
            let Ok(stream) = stream else { continue };
            let slot = ConnectionSlot::take(&open);
            if slot.is_none() {
                answer(
                    stream,
                    page::denied(Denied("503 Service Unavailable", "there are too many connections")),
                );
                continue;
            }
            let (port, topology, orders) = (self.port, self.topology.clone(), self.orders.clone());
            let talk = move || {
                let _slot = slot;
                greet(stream, number, port, topology, &orders);
            };
            // Where the system has no thread left, the browser sees a connection that ends.
            let _ = thread::Builder::new().name(format!("page {number}")).spawn(talk);
        }
    }
}

/// One of so many connections, until dropped.
struct ConnectionSlot(Arc<AtomicUsize>);

impl ConnectionSlot {
    fn take(open: &Arc<AtomicUsize>) -> Option<Self> {
        let slot = Self(Arc::clone(open));
        (open.fetch_add(1, Ordering::Relaxed) < MAX_CONNECTIONS).then_some(slot)
    }
}

impl Drop for ConnectionSlot {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Answers the first request of a connection.
fn greet(mut stream: TcpStream, number: u64, port: u16, topology: Bytes, orders: &SyncSender<Order>) {
    match request::read(&mut stream, port) {
        None => {}
        Some(Ok(Request::File { path })) => answer(stream, page::file(&path)),
        Some(Ok(Request::Socket(response))) => connection::serve(stream, &response, number, topology, orders),
        Some(Err(denied)) => answer(stream, page::denied(denied)),
    }
}

/// Writes an answer; if it is not read, nothing is lost.
fn answer(mut stream: TcpStream, (header, content): (String, &'static str)) {
    let _ = stream
        .set_write_timeout(Some(PATIENCE))
        .and_then(|()| stream.write_all(header.as_bytes()))
        .and_then(|()| stream.write_all(content.as_bytes()))
        .and_then(|()| stream.shutdown(Shutdown::Write));
}
