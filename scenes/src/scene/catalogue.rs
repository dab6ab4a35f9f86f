//! The scenes that come with the program.
//!
//! \[Tre44\] Treloar, *Stress-strain data for vulcanised rubber under various types of deformation*, 1944.
//! \[Ogden72\] Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment
//! for incompressible rubberlike solids*, 1972.

use piola_bodies::mesh::Bounds;

use super::{Amplitude, Body, Motion, Pull, Scene, Shape, Start};
use crate::material::{MaterialSpec, ogden, soft_moduli};
use crate::region::EVERYWHERE;

/// All scenes, in the order in which they are listed.
pub const SCENES: &[&Scene] =
    &[&HORSE, &DINOSAUR, &DINOSAUR_OVERSTRETCHED, &TWIST, &STRETCH, &SCRAMBLE, &INSIDE_OUT, &POINT];

/// Defaults of most scenes: a free horse at rest, lightly damped, for ten seconds.
const COMMON: Scene = Scene {
    name: "",
    about: "",
    body: Body::HORSE,
    material: || MaterialSpec::matching("rotated linear", soft_moduli()),
    density: 1000.0,
    damping: 2.0,
    dt: 1.0 / 30.0,
    frames: 300,
    pinned: None,
    start: Start::Rest,
    pulls: &[],
    gauge: None,
};

/// Lowest part of a body, up to this share of its height.
const fn below(share: f64) -> Option<Bounds> {
    Some(Bounds { max: [f64::INFINITY, share, f64::INFINITY], ..EVERYWHERE })
}

/// Nodes at the upper end of a body.
const UPPER_END: Bounds = Bounds { min: [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY], ..EVERYWHERE };

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
    pinned: below(0.05),
    start: Start::Flattened,
    ..COMMON
};

/// Head of the dinosaur.
const HEAD: Bounds = Bounds { min: [0.8, 0.8, f64::NEG_INFINITY], ..EVERYWHERE };

/// A dinosaur whose head is drawn aside by one and a half body heights and let go.
pub const DINOSAUR: Scene = Scene {
    name: "dinosaur",
    about: "a dinosaur with pinned feet is pulled aside by its head, one and a half body heights far, and let go",
    body: Body::DINOSAUR,
    material: || ogden(soft_moduli()),
    frames: 360,
    pinned: below(0.08),
    pulls: &[Pull { region: HEAD, motion: Motion::Shift([0.0, 0.0, 1.5]), reached: 1.5, released: 2.0 }],
    ..COMMON
};

/// A dinosaur whose head is drawn aside by five body heights, so that elements turn inside out on the way.
///
/// Ogden's energy ends at det F = 0; its extension lets them pass (det F reaches about −0.2, and −0.4 on the
/// way back) and restores them.
pub const DINOSAUR_OVERSTRETCHED: Scene = Scene {
    name: "dinosaur-overstretched",
    about: "the same pull, five body heights far, so that elements turn inside out before it is let go",
    pulls: &[Pull { region: HEAD, motion: Motion::Shift([0.0, 0.0, 5.0]), reached: 2.0, released: 2.5 }],
    frames: 375,
    ..DINOSAUR
};

/// A bar whose upper end is turned twice around and let go: only the body, not the rotation of its end,
/// remembers the way back.
///
/// Held a little longer, until 2.5 s, the bar comes to rest in another equilibrium.
pub const TWIST: Scene = Scene {
    name: "twist",
    about: "an upright bar with a pinned foot is twisted by 720° at its upper end and let go",
    body: Body::BAR,
    material: || MaterialSpec::matching("fixed corotated", soft_moduli()),
    pinned: below(0.0),
    pulls: &[Pull { region: UPPER_END, motion: Motion::Turn(2.0), reached: 2.0, released: 2.4 }],
    ..COMMON
};

/// A bar that is drawn to seven times its length, where Treloar's rubber \[Tre44\] stiffens, and held there.
///
/// The ends are held across as well, so that the bar is uniform only away from them: the stretch is that of
/// the gauge. The material has Ogden's three terms for this rubber at 20 °C, as \[Ogden72\] gives them. The
/// source is incompressible. The bulk modulus is that of ordinary rubber, 1 GPa, two thousand times the shear
/// modulus.
pub const STRETCH: Scene = Scene {
    name: "stretch",
    about: "an upright bar of Treloar's rubber is drawn to seven times its length and held there",
    body: Body { shape: Shape::Box { cells: [3, 18, 3], size: [0.16, 1.0, 0.16] }, ..Body::BAR },
    material: || {
        let rubber = MaterialSpec::new("Ogden").with_parameter("mu", [0.63e6, 0.0012e6, -0.01e6]);
        rubber.with_parameter("alpha", [1.3, 5.0, -2.0]).with_parameter("kappa", [1e9])
    },
    damping: 8.0,
    frames: 240,
    pinned: below(0.0),
    pulls: &[Pull {
        region: UPPER_END,
        motion: Motion::Shift([0.0, 6.0, 0.0]),
        reached: 4.0,
        released: f64::INFINITY,
    }],
    gauge: Some([0.4, 0.6]),
    ..COMMON
};

/// A body whose nodes are displaced at random; beyond half a mean edge length, many elements are inside out.
pub const SCRAMBLE: Scene = Scene {
    name: "scramble",
    about: "every node of a free body is displaced at random, by up to --amplitude mean edge lengths along each axis",
    start: Start::Scrambled { seed: 1, amplitude: Amplitude::Edges(0.3) },
    ..COMMON
};

/// A body that is reflected: every element is inside out and none distorted. For an energy with ψ(F) = ψ(−F)
/// this is rest.
pub const INSIDE_OUT: Scene = Scene {
    name: "inside_out",
    about: "a free body is reflected through its centre, x ↦ −x, so that all of it is inside out",
    material: || MaterialSpec::matching("stable neo-Hookean", soft_moduli()),
    start: Start::Mirrored,
    ..COMMON
};

/// A body with all nodes in one place: F = 0, where all directions are alike and U = V = I by convention.
pub const POINT: Scene = Scene {
    name: "point",
    about: "all nodes of a free body are in one point",
    start: Start::Collapsed,
    ..COMMON
};
