//! Bodies whose shape is lost: at random, mirrored, or in one point.

use super::{Amplitude, COMMON, Scene, Start};
use crate::material::{MaterialSpec, soft_moduli};

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
    ..SCRAMBLE
};

/// A body with all nodes in one place: F = 0, where all directions are alike and U = V = I by convention.
pub const POINT: Scene = Scene {
    name: "point",
    about: "all nodes of a free body are in one point",
    start: Start::Collapsed,
    ..SCRAMBLE
};
