//! A bar that is wound up.

use piola::mesh::Bounds;
use piola::step::Damping;

use super::{Motion, Pull, Scene, Start, body};
use crate::energy::{Energy, soft};
use crate::region::EVERYWHERE;

/// Turned by two whole turns, which a rotation does not remember, and let go: the way back is in the body alone.
pub const TWIST: Scene = Scene {
    name: "twist",
    about: "an upright bar with a pinned foot is twisted by 720° at its upper end and let go",
    body: body::BAR,
    energy: || Energy::like("fixed corotated", soft()),
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 300,
    pinned: Some(Bounds { max: [f64::INFINITY, 0.0, f64::INFINITY], ..EVERYWHERE }),
    start: Start::Rest,
    pulls: &[Pull { region: UPPER_END, motion: Motion::Turn(2.0), reached: 2.0, released: 2.5 }],
    gauge: None,
};

const UPPER_END: Bounds = Bounds { min: [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY], ..EVERYWHERE };
