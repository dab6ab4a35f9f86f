//! Files of a run: surfaces and a summary. All or nothing.
//!
//! This module knows files only: no bodies, no scenes.

mod folder;
mod ply;
mod sealed;
mod summary;
mod vtu;
mod whole;

pub use folder::Folder;
pub use ply::write_ply;
pub use sealed::{SealError, Sealer, Unsealer};
pub use summary::{FinalPlace, FinalState, Newton, Summary, TensileReading};
pub use vtu::{Field, write_pvd, write_vtu};
pub use whole::write_whole;

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

/// Name of the file with the summary.
pub const SUMMARY_FILE: &str = "summary.json";
