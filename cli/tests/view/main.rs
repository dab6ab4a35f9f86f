//! The viewer, talked to as a page would: over sockets on this machine, and without them.

mod files;
mod motion;
mod page;
mod saving;
#[path = "../command/shell.rs"]
mod shell;
mod sockets;

use std::io::{BufRead, BufReader};
use std::process::{Child, Stdio};

use piola_scenes::scene::Scene;
use piola_scenes::settings::Settings;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;

use shell::Folder;

/// Vertices on the tip of the dinosaur's tail, on its back and on a leg.
const TAIL: usize = 5;
const BACK: usize = 5000;
const LEG: usize = 2925;

fn settings() -> Settings {
    Settings::new(Scene::find("dinosaur").expect("a scene"))
}

fn session() -> Session {
    Session::new(settings()).expect("a scene that plays")
}

fn pull(vertex: usize, target: [f64; 3]) -> Act {
    Act::Pull { drag: 1, vertex, target }
}

fn steps(session: &mut Session, count: usize) {
    for _ in 0..count {
        session.step().expect("a step");
    }
}

/// All of a state, to the last bit.
fn bits(session: &Session) -> String {
    serde_json::to_string(&session.state()).expect("JSON")
}

/// The command `piola view`, which ends with it.
struct Viewer {
    process: Child,
    /// Address of the page.
    url: String,
}

impl Viewer {
    /// Starts it in a folder, at a port of its own.
    fn start(folder: &Folder, arguments: &str) -> Self {
        let mut command = folder.command(&format!("view --port 0 {arguments}"));
        let mut process = command.stdout(Stdio::piped()).spawn().expect("the command starts");
        let mut line = String::new();
        let told = process.stdout.take().expect("a pipe");
        BufReader::new(told).read_line(&mut line).expect("an address");
        Self { process, url: line.split(' ').next().unwrap_or_default().into() }
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.process.kill().and_then(|()| self.process.wait());
    }
}

/// A viewer of the dinosaur.
fn viewer() -> Viewer {
    Viewer::start(&Folder::new(), "dinosaur")
}
