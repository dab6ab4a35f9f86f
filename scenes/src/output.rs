//! What a run leaves behind in its folder: surfaces and a summary. All or nothing.
//!
//! This module knows files only: no bodies, no scenes.

mod folder;
mod ply;
mod summary;
mod vtu;
mod whole;

pub use folder::Folder;
pub use ply::write_ply;
pub use summary::{Newton, Place, Reading, Standing, Summary};
pub use vtu::{Field, write_pvd, write_vtu};
pub use whole::write_whole;

/// The file of a frame's surface.
#[must_use]
pub fn frame_file(frame: usize) -> String {
    format!("frame_{frame:04}.ply")
}

/// The file of a frame's tetrahedra.
#[must_use]
pub fn cage_file(frame: usize) -> String {
    format!("frame_{frame:04}.vtu")
}

/// The times of the tetrahedra's files.
pub const CAGES_FILE: &str = "frames.pvd";

/// The summary.
pub const SUMMARY_FILE: &str = "summary.json";
