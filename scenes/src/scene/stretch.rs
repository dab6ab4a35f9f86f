//! Rubber in a testing machine.
//!
//! \[Tre44\] Treloar, *Stress-strain data for vulcanised rubber under various types of deformation*, 1944.
//! \[Ogden72\] Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment
//! for incompressible rubberlike solids*, 1972.

use piola_bodies::mesh::Bounds;

use super::{Body, COMMON, Motion, Pull, Scene, Shape};
use crate::material::MaterialSpec;
use crate::region::EVERYWHERE;

/// A bar that is drawn to seven times its length, where Treloar's rubber \[Tre44\] stiffens, and held there.
///
/// The ends are held across as well, so that the bar is uniform only away from them: the stretch is that of
/// the gauge.
pub const STRETCH: Scene = Scene {
    name: "stretch",
    about: "an upright bar of Treloar's rubber is drawn to seven times its length and held there",
    body: Body { shape: Shape::Box { cells: [3, 18, 3], size: [0.16, 1.0, 0.16] }, ..Body::BAR },
    material: treloar,
    damping: 8.0,
    frames: 240,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.0, f64::INFINITY], ..EVERYWHERE }),
    pulls: &[Pull {
        region: Bounds { min: [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY], ..EVERYWHERE },
        motion: Motion::Shift([0.0, 6.0, 0.0]),
        reached: 4.0,
        released: f64::INFINITY,
    }],
    gauge: Some([0.4, 0.6]),
    ..COMMON
};

/// Ogden's three terms for the rubber of \[Tre44\] at 20 °C, as \[Ogden72\] gives them.
///
/// The source is incompressible. The bulk modulus is that of ordinary rubber, 1 GPa, two thousand times the
/// shear modulus.
fn treloar() -> MaterialSpec {
    let mu = [0.63e6, 0.0012e6, -0.01e6];
    MaterialSpec::new("Ogden")
        .with_parameter("mu", mu)
        .with_parameter("alpha", [1.3, 5.0, -2.0])
        .with_parameter("kappa", [1e9])
}
