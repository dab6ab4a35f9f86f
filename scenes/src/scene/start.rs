//! Positions of the nodes before the first step.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Positions of the nodes before the first step, without velocity. Pinned nodes are where the mesh has them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Start {
    /// The positions of the mesh.
    Rest,
    /// Flattened vertically into the horizontal plane under the surface's lowest vertex.
    Flattened,
    /// Displaced at random.
    Scrambled {
        /// Seed of the random displacements: equal seeds give equal starts on every machine.
        seed: u64,
        /// Largest displacement of a node.
        amplitude: Amplitude,
    },
    /// Reflected through the middle of the bounding box.
    Mirrored,
    /// All nodes in the middle of the bounding box.
    Collapsed,
}

/// Bound of random displacements.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Amplitude {
    /// Largest displacement of each coordinate, either way, in mean edge lengths of the tetrahedra.
    Edges(f64),
    /// Anywhere in the bounding box of the body.
    Box,
}

impl FromStr for Amplitude {
    type Err = &'static str;

    /// Parses `box` or a number of mean edge lengths.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "box" => Ok(Self::Box),
            number => {
                number.parse().map(Self::Edges).map_err(|_| "write a number of mean edge lengths, or `box`")
            }
        }
    }
}
