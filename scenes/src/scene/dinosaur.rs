//! A dinosaur pulled by its head.

use piola_bodies::mesh::Bounds;

use super::{Body, COMMON, Motion, Pull, Scene};
use crate::material::{ogden, soft_moduli};
use crate::region::EVERYWHERE;

const HEAD: Bounds = Bounds { min: [0.8, 0.8, f64::NEG_INFINITY], ..EVERYWHERE };

/// A dinosaur whose head is drawn aside by one and a half body heights and let go.
pub const DINOSAUR: Scene = Scene {
    name: "dinosaur",
    about: "a dinosaur with pinned feet is pulled aside by its head, one and a half body heights far, and let go",
    body: Body::DINOSAUR,
    material: || ogden(soft_moduli()),
    frames: 360,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.08, f64::INFINITY], ..EVERYWHERE }),
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
