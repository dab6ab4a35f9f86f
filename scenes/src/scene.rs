//! Descriptions of scenes.
//!
//! Places and distances are shares of the body's bounding box and height, so that any body can take any part.
//! y points upwards.
//!
//! This module is independent of the solver: [`crate::play`] turns a description into motion.

mod body;
mod catalogue;
mod motion;
mod start;

pub use body::{Body, Shape, Style};
pub use catalogue::{
    DINOSAUR, DINOSAUR_OVERSTRETCHED, HORSE, INSIDE_OUT, POINT, SCENES, SCRAMBLE, STRETCH, TWIST,
};
pub use motion::{Motion, Pull};
pub use start::{Amplitude, Start};

use piola_bodies::mesh::Bounds;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serializer};

use crate::error::Error;
use crate::material::MaterialSpec;

/// A body, its material, and the loads and motions of a scene.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Name on the command line.
    pub name: &'static str,
    /// A sentence that describes the scene.
    pub about: &'static str,
    /// The body of the scene.
    pub body: Body,
    /// The material of the body.
    pub material: fn() -> MaterialSpec,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
    /// Rate of the damping, 1/s.
    pub damping: f64,
    /// Time step, s.
    pub dt: f64,
    /// Number of time steps.
    pub frames: usize,
    /// The part of the body that is held, in shares of its bounding box; `None` for a free body.
    pub pinned: Option<Bounds>,
    /// Positions of the nodes before the first step.
    pub start: Start,
    /// Springs that pull at the body.
    pub pulls: &'static [Pull],
    /// The heights, in shares of the body's, between which the stretch of a tensile specimen is measured;
    /// `None` for other bodies.
    pub gauge: Option<[f64; 2]>,
}

impl Scene {
    /// The scene of a name.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the names that exist.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        let scene = SCENES.iter().copied().find(|scene| scene.name == name);
        scene.ok_or_else(|| Error::Unknown {
            kind: "scene",
            name: name.into(),
            known: SCENES.iter().map(|scene| scene.name).collect(),
        })
    }

    /// Writes the name of a scene in its place.
    pub(crate) fn serialize<S: Serializer>(scene: &&'static Self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(scene.name)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<&'static Self, D::Error> {
        Self::find(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}
