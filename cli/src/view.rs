//! A scene in a browser, to be pulled with the mouse: [`Viewer::start`] serves one page on this machine.
//!
//! The body and its interactions are in `piola-viewer`. `driver` runs it on a thread of its own; `connection`
//! exchanges messages between it and a page; `server`, `request` and `token` control access, and `page` holds
//! the files of the page.
//!
//! Nothing is loaded from elsewhere, and only requests of this viewer's pages are answered. A random token in
//! the [address of the page](Viewer::url) keeps out other users of this machine; whoever has that address can
//! pull, and save to the file that was named at the start. The page gets the names of files, without paths.

mod connection;
mod driver;
mod page;
mod request;
mod server;
mod token;

use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread::{self, JoinHandle};

use piola_laboratory::AtRest;
use piola_laboratory::curve::Volume;
use piola_scenes::error::Error as SceneError;
use piola_viewer::conversation::Conversation;
use piola_viewer::driver::Order;
use piola_viewer::session::Session;
use piola_viewer::topology;
use tungstenite::Bytes;

use crate::error::Error;
use request::Door;
use token::Token;

/// Orders that wait for the driver; connections with more of them wait themselves, in turn. A page waits
/// behind at most this number of orders of others, and one of each connection.
const ORDERS: usize = 16;

/// A page that is being served. Once dropped it accepts no page, and the body plays on until the last page is
/// closed.
#[derive(Debug)]
pub struct Viewer {
    /// Address at which it listens.
    pub address: SocketAddr,
    /// Small-strain moduli of the material with which it begins.
    pub at_rest: AtRest,
    /// Properties of the body that may be unintended.
    pub warnings: Vec<String>,
    token: Token,
    is_over: Arc<AtomicBool>,
    server: Option<JoinHandle<()>>,
}

impl Viewer {
    /// Starts to play and to serve, at a port on 127.0.0.1, or with 0 at any that is free. When the page's
    /// button is pressed, the state is written to a file, or without one kept in memory.
    ///
    /// # Errors
    /// [`SceneError::Usage`] for a port at which nothing can be served, or [`Error::System`].
    pub fn start(session: Session, port: u16, save: Option<PathBuf>) -> Result<Self, Error> {
        let no_port = |source: std::io::Error| {
            Error::usage(format_args!(
                "cannot serve the page at port {port}: {source}; name another one with --port, or 0 for any"
            ))
        };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(no_port)?;
        let address = listener.local_addr().map_err(no_port)?;
        let token = Token::new()?;
        let play = session.play();
        let threads = rayon::ThreadPoolBuilder::new().num_threads(play.settings.threads).build();
        let threads = threads.map_err(SceneError::from)?;
        let warnings = play.warnings();
        let topology = Bytes::from(topology(&play.geometry));
        let at_rest = AtRest { moduli: play.moduli, volume: Volume::Free };
        let first = Conversation::after(session.pulls().map(|(drag, _)| drag));
        let (orders, taken) = sync_channel::<Order>(ORDERS);
        let is_over = Arc::new(AtomicBool::new(false));
        let door = Door { port: address.port(), token: token.clone() };
        let start = |name: &str, work: Box<dyn FnOnce() + Send>| {
            thread::Builder::new().name(name.into()).spawn(work).map_err(Error::system("start a thread"))
        };
        // The driver ends when the server and all its connections have.
        start("driver", Box::new(move || driver::run(threads, session, save, &taken)))?;
        let is_stopped = is_over.clone();
        let serve = move || server::run(&listener, &door, &topology, &orders, &is_stopped, first);
        let server = Some(start("server", Box::new(serve))?);
        Ok(Self { address, at_rest, token, is_over, server, warnings })
    }

    /// Address of the page, with the token that opens it.
    #[must_use]
    pub fn url(&self) -> String {
        format!("http://{}/?token={}", self.address, self.token)
    }

    /// Serves until the process is ended from outside.
    pub fn wait(mut self) {
        if let Some(server) = self.server.take() {
            // A server that panics has no message.
            let _ = server.join();
        }
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        // The server looks up when somebody comes.
        if self.server.is_some() && TcpStream::connect(self.address).is_ok() {
            let _ = self.server.take().map(JoinHandle::join);
        }
    }
}
