//! Bodies whose shape is lost: at random, mirrored, or in one point.

use piola::step::Damping;

use super::{Amplitude, Scene, Start, body};
use crate::energy::{Energy, soft};

/// Every node somewhere else; beyond half a mean edge length, many elements are inside out.
pub const SCRAMBLE: Scene = Scene {
    name: "scramble",
    about: "every node of a free body is displaced at random, by up to --amplitude mean edge lengths along each axis",
    body: body::HORSE,
    energy: || Energy::like("rotated linear", soft()),
    density: 1000.0,
    damping: Damping::Mass { rate: 2.0 },
    dt: 1.0 / 30.0,
    frames: 300,
    pinned: None,
    start: Start::Scrambled { seed: 1, amplitude: Amplitude::Edges(0.3) },
    pulls: &[],
    gauge: None,
};

/// Every element inside out, and none of them distorted: for an energy that cannot tell F from −F this is rest.
pub const INSIDE_OUT: Scene = Scene {
    name: "inside_out",
    about: "a free body is reflected through its centre, x ↦ −x, so that all of it is inside out",
    energy: || Energy::like("stable neo-Hookean", soft()),
    start: Start::Mirrored,
    ..SCRAMBLE
};

/// Every node in one place: F = 0, where all directions are alike and U = V = I by convention.
pub const POINT: Scene = Scene {
    name: "point",
    about: "all nodes of a free body are in one point",
    start: Start::Collapsed,
    ..SCRAMBLE
};
