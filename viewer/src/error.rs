//! Errors of the viewer.

use std::path::PathBuf;

use piola_scenes::error::Error as SceneError;
use piola_scenes::output::SealError;

/// Reason why the viewer rejects an act or a state.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene cannot start or continue.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file is not a saved state.
    #[error("{}: is not a saved state: {source}", path.display())]
    NotState {
        /// The file.
        path: PathBuf,
        /// Reason.
        source: SealError,
    },
    /// The text of an energy is longer than the limit of the viewer.
    #[error(
        "the text of an energy has at most {most} bytes here, and this one has {bytes}; put a longer one into a file, for `piola view --material FILE.rs`"
    )]
    LongText {
        /// Its length, in bytes.
        bytes: usize,
        /// The greatest length, in bytes.
        most: usize,
    },
    /// No saved state to return to.
    #[error("no state has been saved yet")]
    NothingSaved,
}
