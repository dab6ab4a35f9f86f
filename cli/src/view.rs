//! A scene in a browser, to be pulled with the mouse: a server of one page on this machine.
//!
//! The body and its interactions are in `piola-viewer`. `driver` runs it on a thread of its own; `connection`
//! exchanges messages between it and a page; `server`, `request` and `token` control access, and `page` holds
//! the files of the page.
//!
//! Nothing is loaded from elsewhere, and only requests of this viewer's pages are answered. A random token in
//! the address of the page keeps out other users of this machine; whoever has that address can pull, and save
//! to the file that was named at the start. The page gets the names of files, without paths.

mod connection;
mod driver;
mod page;
mod request;
mod server;
mod token;

use std::io;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::mpsc::sync_channel;
use std::thread;

use piola_scenes::error::Error as SceneError;
use piola_viewer::conversation::Conversation;
use piola_viewer::session::Session;
use piola_viewer::topology;
use rayon::ThreadPoolBuilder;

use crate::error::Error;
use request::Door;
use server::Server;
use token::Token;

/// Orders that wait for the driver; connections with more of them wait themselves, in turn. A page waits
/// behind at most this number of orders of others, and one of each connection.
const ORDERS: usize = 16;

/// Starts to play, and opens a port on 127.0.0.1 for the page, or with 0 any that is free. When the page's
/// button is pressed, the state is written to a file, or without one kept in memory.
pub(crate) fn open(session: Session, port: u16, save: Option<PathBuf>) -> Result<Server, Error> {
    let no_port = |source: io::Error| {
        Error::usage(format_args!(
            "cannot serve the page at port {port}: {source}; name another one with --port, or 0 for any"
        ))
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(no_port)?;
    let door = Door { port: listener.local_addr().map_err(no_port)?.port(), token: Token::new()? };
    let play = session.play();
    let threads = ThreadPoolBuilder::new().num_threads(play.settings.threads).build();
    let threads = threads.map_err(SceneError::from)?;
    let topology = topology(&play.geometry).into();
    let first = Conversation::after(session.pulls().map(|(drag, _)| drag));
    let (orders, taken) = sync_channel(ORDERS);
    let drive = move || driver::run(threads, session, save, &taken);
    thread::Builder::new().name("driver".into()).spawn(drive).map_err(Error::system("start a thread"))?;
    Ok(Server { listener, door, topology, orders, first })
}
