//! What happens to a body: a [`Scene`] is a description, one in each file.
//!
//! Places and distances are shares of the body's bounding box and height, so that any body can take any part.
//! y points upwards.
//!
//! This module knows no solver: [`crate::run`] turns a description into motion.

mod dinosaur;
mod horse;

pub use dinosaur::{DINOSAUR, DINOSAUR_OVERSTRETCHED};
pub use horse::HORSE;

use piola::mesh::Bounds;
use piola::step::Damping;

use crate::energy::Energy;
use crate::error::Error;
use crate::render::Style;

/// Every scene, in the order in which they are listed.
pub const SCENES: &[&Scene] = &[&HORSE, &DINOSAUR, &DINOSAUR_OVERSTRETCHED];

/// A body, what it is made of and what is done to it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it is called on the command line.
    pub name: &'static str,
    /// What happens, in a sentence.
    pub about: &'static str,
    /// The body's tetrahedra, as a Gmsh file.
    pub mesh: Asset,
    /// The surface embedded in them, as an OBJ file.
    pub surface: Asset,
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
    /// Where the body is held, in shares of its bounding box.
    pub pinned: Bounds,
    /// What it looks like before the first step.
    pub start: Start,
    /// What pulls at it.
    pub pulls: &'static [Pull],
    /// What it looks like in pictures.
    pub style: Style,
}

/// A file that is part of the program.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    /// Its name, for messages.
    pub name: &'static str,
    /// What is in it.
    pub text: &'static str,
}

/// Where the nodes are before the first step, all at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// Where the mesh has them.
    Rest,
    /// All that are not pinned are moved straight down, or up, into the horizontal plane under the surface's lowest
    /// vertex.
    Flattened,
}

/// Springs from some of the nodes to points that move away from them, until they are let go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// Which nodes, in shares of the bounding box.
    pub region: Bounds,
    /// How far, in body heights.
    pub by: [f64; 3],
    /// The distance grows steadily until this time, s, and is then held.
    pub reached: f64,
    /// The springs vanish at this time, s.
    pub released: f64,
}

impl Pull {
    /// The share of the full distance at a time, None once released.
    #[must_use]
    pub fn share_at(&self, time: f64) -> Option<f64> {
        (time < self.released).then(|| (time / self.reached).clamp(0.0, 1.0))
    }
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
