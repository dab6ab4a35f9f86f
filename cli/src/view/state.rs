//! A body in the middle of a motion, as a file.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::session::Held;
use piola_scenes::clock::Clock;
use piola_scenes::energy::Energy;
use piola_scenes::error::Error;
use piola_scenes::output::write_whole;
use piola_scenes::settings::Settings;

/// The first field of a file, by which it is known for what it is, and what its version is.
const FORMAT: &str = "piola state 1";

/// All that the steps to come depend on. JSON keeps every bit of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    format: Format,
    /// The scene, with material and time step as they are now.
    pub settings: Settings,
    /// The material as it was at the start.
    pub energy_at_start: Energy,
    /// Which step it is.
    pub clock: Clock,
    /// Position of each node, m.
    pub positions: Vec<[f64; 3]>,
    /// Velocity of each node, m/s.
    pub velocities: Vec<[f64; 3]>,
    /// The pulls that last, beside those of the scene, by their hands.
    pub pulls: BTreeMap<u64, Held>,
}

/// Stands in a file for [`FORMAT`].
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub(super) struct Format;

impl From<Format> for String {
    fn from(_: Format) -> Self {
        FORMAT.into()
    }
}

impl TryFrom<String> for Format {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        match text == FORMAT {
            true => Ok(Self),
            false => Err(format!("the format is `{text}`, where `{FORMAT}` can be read")),
        }
    }
}

impl State {
    pub(super) fn new(
        settings: Settings,
        energy_at_start: Energy,
        clock: Clock,
        [positions, velocities]: [&[[f64; 3]]; 2],
        pulls: BTreeMap<u64, Held>,
    ) -> Self {
        let (positions, velocities) = (positions.to_vec(), velocities.to_vec());
        Self { format: Format, settings, energy_at_start, clock, positions, velocities, pulls }
    }

    /// Writes the file, in whose place an earlier one of the same name stays until it is complete.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let failure = |reason: String| Error::Write { path: path.into(), reason };
        let mut text = serde_json::to_vec(self).map_err(|error| failure(error.to_string()))?;
        text.push(b'\n');
        write_whole(path, &text)
    }

    /// Reads the file. Whether what it says fits its scene is seen by who plays it.
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let failure = |reason: String| Error::File { reason: format!("{}: {reason}", path.display()) };
        let text = fs::read(path).map_err(|error| failure(format!("cannot be read: {error}")))?;
        serde_json::from_slice(&text).map_err(|error| failure(format!("is no state to go on from: {error}")))
    }
}
