//! A bar that is wound up.

use piola_bodies::mesh::Bounds;

use super::{Body, COMMON, Motion, Pull, Scene};
use crate::material::{MaterialSpec, soft_moduli};
use crate::region::EVERYWHERE;

/// A bar whose upper end is turned twice around and let go: only the body, not the rotation of its end,
/// remembers the way back.
///
/// Held a little longer, until 2.5 s, the bar comes to rest in another equilibrium.
pub const TWIST: Scene = Scene {
    name: "twist",
    about: "an upright bar with a pinned foot is twisted by 720° at its upper end and let go",
    body: Body::BAR,
    material: || MaterialSpec::matching("fixed corotated", soft_moduli()),
    pinned: Some(Bounds { max: [f64::INFINITY, 0.0, f64::INFINITY], ..EVERYWHERE }),
    pulls: &[Pull { region: UPPER_END, motion: Motion::Turn(2.0), reached: 2.0, released: 2.4 }],
    ..COMMON
};

const UPPER_END: Bounds = Bounds { min: [f64::NEG_INFINITY, 1.0, f64::NEG_INFINITY], ..EVERYWHERE };
