//! A dinosaur pulled by its head.

use piola::mesh::Bounds;
use piola::step::Damping;

use super::{Motion, Pull, Scene, Start, body};
use crate::energy::{ogden, soft};
use crate::region::EVERYWHERE;

const HEAD: Bounds = Bounds { min: [0.8, 0.8, f64::NEG_INFINITY], ..EVERYWHERE };

/// Its head is drawn aside by one and a half body heights and let go.
pub const DINOSAUR: Scene = Scene {
    name: "dinosaur",
    about: "a dinosaur with pinned feet is pulled aside by its head, one and a half body heights far, and let go",
    body: body::DINOSAUR,
    energy: || ogden(soft()),
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 360,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.08, f64::INFINITY], ..EVERYWHERE }),
    start: Start::Rest,
    pulls: &[Pull { region: HEAD, motion: Motion::Shift([0.0, 0.0, 1.5]), reached: 1.5, released: 2.0 }],
    gauge: None,
};

/// The same, five body heights far: elements turn inside out while the head is still being pulled.
///
/// Ogden's energy ends at det F = 0; its extension lets them pass (det F reaches about −0.2, and −0.4 on the way back) and
/// restores them.
pub const DINOSAUR_OVERSTRETCHED: Scene = Scene {
    name: "dinosaur-overstretched",
    about: "the same pull, five body heights far, so that elements turn inside out before it is let go",
    pulls: &[Pull { region: HEAD, motion: Motion::Shift([0.0, 0.0, 5.0]), reached: 2.0, released: 2.5 }],
    frames: 375,
    ..DINOSAUR
};
