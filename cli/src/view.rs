//! A scene in a browser, to be pulled with the mouse: [`Viewer::start`] serves one page on this machine.
//!
//! From the body outwards: [`session`] is the body with what can be done to it, the same bits for the same acts;
//! `driver` makes its steps on a thread of its own and waits for nobody; `connection` passes between it and a page what
//! [`protocol`] allows in one direction and `show` says in the other; `server` and `request` decide who comes in, and
//! `page` is what they get. [`state`] and [`recording`] are the files.
//!
//! Nothing is loaded from elsewhere, and nobody but pages from this viewer is listened to. There is no other
//! protection: whoever can open the page on this machine can pull.

mod connection;
mod driver;
mod page;
pub mod protocol;
pub mod recording;
mod request;
mod server;
pub mod session;
mod show;
pub mod state;

use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::sync_channel;
use std::thread::{self, JoinHandle};

use driver::{Driver, Order};
use piola_scenes::error::Error;
use piola_scenes::settings::Settings;
use recording::{Recorder, Recording};
use server::Server;
use session::Session;
use state::State;

/// Orders that wait for the driver; a connection with more of them waits itself.
const ORDERS: usize = 256;

/// What to show, and where.
#[derive(Clone, Debug)]
pub struct Options {
    /// What happens.
    pub begin: Begin,
    /// The port on 127.0.0.1; 0 for any that is free.
    pub port: u16,
    /// The file for the page's button to save the state; without one, the state is kept in memory.
    pub save: Option<PathBuf>,
    /// The file that gets a recording.
    pub record: Option<PathBuf>,
}

/// Where a viewer begins.
#[derive(Clone, Debug)]
pub enum Begin {
    /// Before the first step of a scene.
    Scene(Box<Settings>),
    /// Where a state was saved.
    State(Box<State>),
    /// Where a recording began; it is played back, and then the page takes over.
    Replay(Box<Recording>),
}

/// A page that is being served. Once dropped it lets nobody in, and the body plays on until the last page is closed.
#[derive(Debug)]
pub struct Viewer {
    address: SocketAddr,
    is_over: Arc<AtomicBool>,
    server: Option<JoinHandle<()>>,
}

impl Viewer {
    /// Starts to play and to serve.
    ///
    /// # Errors
    /// Where the settings make no sense, the state does not fit its body, the port is taken, a file cannot be written, or there
    /// are no threads to be had.
    pub fn start(options: Options) -> Result<Self, Error> {
        let (session, replay) = match options.begin {
            Begin::Scene(settings) => (Session::new(*settings)?, None),
            Begin::State(state) => (Session::resume(*state)?, None),
            Begin::Replay(recording) => (Session::resume(recording.start().clone())?, Some(*recording)),
        };
        let no_port = |error: std::io::Error| Error::Port { port: options.port, reason: error.to_string() };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, options.port)).map_err(no_port)?;
        let address = listener.local_addr().map_err(no_port)?;
        let recorder = options.record.map(|path| Recorder::begin(&path, session.state())).transpose()?;

        let no_threads = |reason: String| Error::Threads { reason };
        let threads = rayon::ThreadPoolBuilder::new().num_threads(session.settings().threads).build();
        let threads = threads.map_err(|error| no_threads(error.to_string()))?;
        let topology = show::topology(session.geometry());
        let first = connection::after(session.pulls().map(|(hand, _)| hand));
        let (orders, taken) = sync_channel::<Order>(ORDERS);
        let is_over = Arc::new(AtomicBool::new(false));
        let driver = Driver { session, threads, save: options.save, recorder, replay };
        let server =
            Server { listener, port: address.port(), topology, orders, is_over: is_over.clone(), first };
        let start = |name: &str, work: Box<dyn FnOnce() + Send>| {
            let thread = thread::Builder::new().name(name.into()).spawn(work);
            thread.map_err(|error| no_threads(error.to_string()))
        };
        // The driver ends when the server and all its connections have.
        start("driver", Box::new(move || driver.run(&taken)))?;
        let server = Some(start("server", Box::new(move || server.run()))?);
        Ok(Self { address, is_over, server })
    }

    /// Where the page is.
    #[must_use]
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// Serves until the process is ended from outside.
    pub fn wait(mut self) {
        if let Some(server) = self.server.take() {
            // A server that panics has nothing to say.
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
