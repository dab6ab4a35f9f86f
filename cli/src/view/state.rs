//! Files with the state of a body in motion.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use piola_scenes::clock::Clock;
use piola_scenes::material::MaterialSpec;
use piola_scenes::output::write_whole;
use piola_scenes::settings::Settings;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// The first field of a file, which names its format and version.
const FORMAT: &str = "piola state 1";

/// A state that determines all steps to come, to the last bit. JSON keeps every bit of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    format: Format,
    /// The scene and its overrides, with material and time step as they are now.
    pub settings: Settings,
    /// The material as it was at the start.
    #[serde(rename = "energy_at_start")]
    pub material_at_start: MaterialSpec,
    /// Number and time of the last step.
    pub clock: Clock,
    /// Position of each node, m.
    pub positions: Vec<[f64; 3]>,
    /// Velocity of each node, m/s.
    pub velocities: Vec<[f64; 3]>,
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
        material_at_start: MaterialSpec,
        clock: Clock,
        [positions, velocities]: [&[[f64; 3]]; 2],
        pulls: BTreeMap<u64, Drag>,
    ) -> Self {
        let (positions, velocities) = (positions.to_vec(), velocities.to_vec());
        Self { format: Format, settings, material_at_start, clock, positions, velocities, pulls }
    }

    /// Writes the file, which replaces an earlier one of the same name only once it is complete.
    ///
    /// # Errors
    /// [`Error::Scene`].
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        // Numbers and strings: nothing that JSON could not say.
        let mut text = serde_json::to_vec(self).unwrap_or_default();
        text.push(b'\n');
        Ok(write_whole(path, &text)?)
    }

    /// Reads a file. Whether the state fits its scene is checked where a session resumes it.
    ///
    /// # Errors
    /// [`Error::Unreadable`] or [`Error::NotState`].
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = fs::read(path).map_err(|source| Error::Unreadable { path: path.into(), source })?;
        serde_json::from_slice(&text).map_err(|source| Error::NotState { path: path.into(), source })
    }
}
