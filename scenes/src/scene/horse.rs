//! A horse that stands up again.

use piola::material::Moduli;
use piola::mesh::Bounds;
use piola::step::Damping;

use super::{Asset, Scene, Start};
use crate::energy::Energy;
use crate::region::EVERYWHERE;
use crate::render::Style;

/// Flattened into the plane under its hooves, nearly every element a sheet of no volume, and released.
///
/// Rotated linear elasticity needs no extension: it is defined for every deformation gradient. Here most of them have
/// rank two or less, where the directions of the singular vectors say nothing about where the volume has gone.
pub const HORSE: Scene = Scene {
    name: "horse",
    about: "a horse is flattened into the ground under its pinned hooves and stands up again",
    mesh: Asset { name: "horse.msh", text: include_str!("../../assets/horse.msh") },
    surface: Asset { name: "horse.obj", text: include_str!("../../assets/horse.obj") },
    energy: || {
        let moduli = Moduli::from_young_poisson(1e6, 0.45);
        Energy::of("rotated linear").with("mu", [moduli.mu]).with("lambda", [moduli.lambda])
    },
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 150,
    pinned: Bounds { max: [f64::INFINITY, 0.05, f64::INFINITY], ..EVERYWHERE },
    start: Start::Flattened,
    pulls: &[],
    style: Style { colour: [0.42, 0.20, 0.10], azimuth: 35.0, elevation: 14.0 },
};
