//! A horse that stands up again.

use piola_bodies::mesh::Bounds;

use super::{COMMON, Scene, Start};
use crate::material::{MaterialSpec, soft_moduli};
use crate::region::EVERYWHERE;

/// A horse that is flattened into the plane under its hooves, nearly every element a sheet without volume,
/// and released.
///
/// Rotated linear elasticity needs no extension: it is defined for every deformation gradient. Here most of
/// them have rank two or less, where the directions of the singular vectors carry no information about the
/// lost volume.
pub const HORSE: Scene = Scene {
    name: "horse",
    about: "a horse is flattened into the ground under its pinned hooves and stands up again",
    material: || {
        let moduli = soft_moduli();
        let horse = MaterialSpec::new("rotated linear");
        horse.with_parameter("mu", [moduli.mu]).with_parameter("lambda", [moduli.lambda])
    },
    frames: 150,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.05, f64::INFINITY], ..EVERYWHERE }),
    start: Start::Flattened,
    ..COMMON
};
