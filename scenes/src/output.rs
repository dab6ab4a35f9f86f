//! Files of a run: surfaces, a summary, and a state from which the run can continue.
//!
//! This module handles files only: no bodies, no scenes.

mod folder;
mod ply;
mod sealed;
mod summary;
mod vtu;
mod whole;

pub use folder::{Folder, new_folder};
pub use ply::{read_vertices, write_ply};
pub use sealed::{seal, unseal};
pub(crate) use summary::short;
pub use summary::{Ended, FinalPlace, FinalState, Newton, Overview, StepCounts, Summary, TensileReading};
pub use vtu::{Field, write_pvd, write_vtu};
pub use whole::{read_text, write_whole};

/// Name of the file with the surface in a frame.
#[must_use]
pub fn frame_file(frame: usize) -> String {
    format!("frame_{frame:04}.ply")
}

/// Name of the file with the tetrahedra in a frame.
#[must_use]
pub fn cage_file(frame: usize) -> String {
    format!("frame_{frame:04}.vtu")
}

/// Name of the file with the times of the tetrahedra's files.
pub const CAGES_FILE: &str = "frames.pvd";

/// Name of the file with a picture of some frames.
pub const PICTURE_FILE: &str = "frames.png";

/// Name of the file with the state from which a run can continue.
pub const STATE_FILE: &str = "state.json";

/// Name of the file with the summary.
pub const SUMMARY_FILE: &str = "summary.json";
