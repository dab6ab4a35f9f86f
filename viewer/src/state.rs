//! Files with the state of a body in motion.

use std::collections::BTreeMap;
use std::io::{self, ErrorKind};
use std::path::Path;

use piola_scenes::error::Error;
use piola_scenes::material::MaterialSpec;
use piola_scenes::moment::Moment;
use piola_scenes::output::{read_text, seal, unseal, write_whole};
use piola_scenes::settings::Files;
use serde::{Deserialize, Serialize};

/// The longest file that is written or read, in bytes: a state of two million nodes.
const MAX_LENGTH: u64 = 256 << 20;
/// Bound of the numbers of drags in files, which leaves numbers for later drags.
pub(crate) const MAX_DRAG: u64 = 1 << 62;

/// A state that determines all steps to come, to the last bit, with the pulls of pages at it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    format: Format,
    /// The scene in motion, with the current material and time step.
    pub moment: Moment,
    /// The material as it was at the start.
    pub material_at_start: MaterialSpec,
    /// Pulls with the mouse, by their numbers.
    pub pulls: BTreeMap<u64, Drag>,
}

/// A pull with the mouse.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// The vertex of the surface that is pulled.
    pub vertex: usize,
    /// The point that the mouse is at, m.
    pub target: [f64; 3],
    /// The point on the way to the target that a spring joins to the vertex, m.
    pub place: [f64; 3],
}

#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Format {
    #[serde(rename = "piola state 2")]
    Two,
}

impl State {
    pub(crate) fn new(moment: Moment, material_at_start: MaterialSpec, pulls: BTreeMap<u64, Drag>) -> Self {
        Self { format: Format::Two, moment, material_at_start, pulls }
    }

    /// Takes the body from files, or, with `None`, that of the program.
    #[must_use]
    pub fn with_files(mut self, files: Option<Files>) -> Self {
        self.moment.settings.files = files;
        self
    }

    /// Writes the file, which replaces an earlier one of the same name only once it is complete.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let failed = |source| Error::Write { path: path.into(), source };
        let text = seal(self).map_err(|error| failed(error.into()))?;
        if text.len() as u64 > MAX_LENGTH {
            return Err(failed(io::Error::new(ErrorKind::FileTooLarge, "it would be longer than 256 MiB")));
        }
        write_whole(path, &text)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`Error::Usage`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::parse(&read_text(path, MAX_LENGTH)?, path)
    }

    /// Parses the text of a file; `path` is for messages. Whether the state fits its scene is checked where a
    /// session resumes it.
    ///
    /// # Errors
    /// [`Error::Usage`].
    pub fn parse(text: &str, path: &Path) -> Result<Self, Error> {
        unseal(text)
            .map_err(|error| Error::Usage(format!("{}: is not a saved state: {error}", path.display())))
    }
}
