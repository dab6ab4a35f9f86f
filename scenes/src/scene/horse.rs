//! A horse that stands up again.

use piola::mesh::Bounds;
use piola::step::Damping;

use super::{Scene, Start, body};
use crate::energy::{Energy, soft};
use crate::region::EVERYWHERE;

/// Flattened into the plane under its hooves, nearly every element a sheet of no volume, and released.
///
/// Rotated linear elasticity needs no extension: it is defined for every deformation gradient. Here most of them have
/// rank two or less, where the directions of the singular vectors say nothing about where the volume has gone.
pub const HORSE: Scene = Scene {
    name: "horse",
    about: "a horse is flattened into the ground under its pinned hooves and stands up again",
    body: body::HORSE,
    energy: || Energy::of("rotated linear").with("mu", [soft().mu]).with("lambda", [soft().lambda]),
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 150,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.05, f64::INFINITY], ..EVERYWHERE }),
    start: Start::Flattened,
    pulls: &[],
    gauge: None,
};
