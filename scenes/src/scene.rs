//! What happens to a body: a [`Scene`] is a description, one in each file.
//!
//! Places and distances are shares of the body's bounding box and height, so that any body can take any part.
//! y points upwards.
//!
//! This module knows no solver: [`crate::run`] turns a description into motion.

pub mod body;
mod dinosaur;
mod horse;
mod motion;
mod scramble;
mod start;
mod stretch;
mod twist;

pub use body::Body;
pub use dinosaur::{DINOSAUR, DINOSAUR_OVERSTRETCHED};
pub use horse::HORSE;
pub use motion::{Motion, Pull};
pub use scramble::{INSIDE_OUT, POINT, SCRAMBLE};
pub use start::{Amplitude, Start};
pub use stretch::STRETCH;
pub use twist::TWIST;

use piola::mesh::Bounds;
use piola::step::Damping;

use crate::energy::Energy;
use crate::error::Error;

/// Every scene, in the order in which they are listed.
pub const SCENES: &[&Scene] =
    &[&HORSE, &DINOSAUR, &DINOSAUR_OVERSTRETCHED, &TWIST, &STRETCH, &SCRAMBLE, &INSIDE_OUT, &POINT];

/// A body, what it is made of and what is done to it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What happens, in a sentence.
    pub about: &'static str,
    /// To whom.
    pub body: Body,
    /// What the body is made of.
    pub energy: fn() -> Energy,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
    /// What works against velocity.
    pub damping: Damping,
    /// Time step, s.
    pub dt: f64,
    /// How many steps of it.
    pub frames: usize,
    /// Where the body is held, in shares of its bounding box; `None` for a free body.
    pub pinned: Option<Bounds>,
    /// What it looks like before the first step.
    pub start: Start,
    /// What pulls at it.
    pub pulls: &'static [Pull],
    /// Between which heights, in shares of the body's, its stretch is measured against the stress in it, where it is a
    /// specimen in a testing machine.
    pub gauge: Option<[f64; 2]>,
}

/// The scene of that name.
///
/// # Errors
/// With the names that exist, where it is none of them.
pub fn find(name: &str) -> Result<&'static Scene, Error> {
    let scene = SCENES.iter().copied().find(|scene| scene.name == name);
    scene.ok_or_else(|| Error::UnknownScene {
        name: name.into(),
        known: SCENES.iter().map(|scene| scene.name).collect(),
    })
}

/// A scene in files: its name.
pub(crate) mod by_name {
    use serde::de::Error as _;
    use serde::{Deserialize, Deserializer, Serializer};

    use super::{Scene, find};

    pub(crate) fn serialize<S: Serializer>(scene: &&'static Scene, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(scene.name)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<&'static Scene, D::Error> {
        find(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}
