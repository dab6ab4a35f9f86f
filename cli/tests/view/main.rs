//! The viewer, talked to as a page would: over sockets on this machine, and without them.

mod files;
mod motion;
mod page;
mod saving;
mod sockets;

use piola_cli::view::Viewer;
use piola_scenes::scene::Scene;
use piola_scenes::settings::Settings;
use piola_viewer::protocol::Act;
use piola_viewer::session::Session;

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

/// A viewer of the dinosaur at a port of its own.
fn viewer() -> Viewer {
    Viewer::start(session(), 0, None).expect("a viewer")
}
