//! Files of a run: surfaces, a summary, and a state from which the run can continue.
//!
//! This module handles files only: no bodies, no scenes.

mod folder;
mod ply;
mod sealed;
mod summary;
mod vtu;
mod whole;

pub use folder::Folder;
pub use ply::{read_vertices, write_ply};
pub use sealed::{SealError, seal, unseal};
pub use summary::{Ended, FinalPlace, FinalState, Newton, StepCounts, Summary, TensileReading};
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

/// Name of the file with a picture of some frames.
pub const PICTURE_FILE: &str = "frames.png";

/// Name of the file with the state from which a run can continue.
pub const STATE_FILE: &str = "state.json";

/// Name of the file with the summary.
pub const SUMMARY_FILE: &str = "summary.json";

/// Name of a file that reserves disk space during a run.
const RESERVE: &str = ".piola-reserve";

/// Name of a file that is being written.
const PARTIAL: &str = ".piola-partial";

/// True if any run could have written a file of this name.
fn is_result(name: &str) -> bool {
    [CAGES_FILE, PICTURE_FILE, STATE_FILE, SUMMARY_FILE, RESERVE, PARTIAL].contains(&name) || is_frame(name)
}

/// True if it is a name that [`frame_file`] or [`cage_file`] gives.
fn is_frame(name: &str) -> bool {
    let Some((digits, extension)) = name.strip_prefix("frame_").and_then(|rest| rest.split_once('.')) else {
        return false;
    };
    // At least four digits, and no zero in front of more.
    let is_number = digits.bytes().all(|byte| byte.is_ascii_digit())
        && (digits.len() == 4 || digits.len() > 4 && !digits.starts_with('0'));
    is_number && ["ply", "vtu"].contains(&extension)
}
