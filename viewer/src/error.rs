//! Why a viewer refuses an act, a state or a recording.

use std::io;
use std::path::PathBuf;

use piola_scenes::error::Error as SceneError;
use piola_scenes::output::SealError;

/// Why a viewer refuses an act, a state or a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene cannot start or go on.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A file is not a saved state.
    #[error("{}: is not a saved state: {source}", path.display())]
    NotState {
        /// The file.
        path: PathBuf,
        /// Reason.
        source: SealError,
    },
    /// A file is not a recording.
    #[error("{}:{line}: is not a line of a recording: {reason}", path.display())]
    NotRecording {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// Reason.
        reason: String,
    },
    /// A recording is as long as one can be.
    #[error("a recording has at most {0}")]
    RecordingFull(
        /// The limit.
        &'static str,
    ),
    /// The file of a recording to be made holds something else.
    #[error(
        "{}: holds something else than a recording, and is left as it is; name another file with --record",
        path.display()
    )]
    NotRecordedOver {
        /// The file.
        path: PathBuf,
    },
    /// The text of an energy is longer than the viewer takes.
    #[error(
        "the text of an energy has at most {most} bytes here, and this one has {bytes}; put a longer one into a file, for `piola view --material FILE.rs`"
    )]
    LongText {
        /// Its length, in bytes.
        bytes: usize,
        /// The greatest length, in bytes.
        most: usize,
    },
    /// There is no state to go back to.
    #[error("no state has been saved yet")]
    NothingSaved,
}
