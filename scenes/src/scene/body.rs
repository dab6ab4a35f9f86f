//! The bodies that come with the program.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::error::Error;

/// A body and what it looks like in pictures. In files it is its name.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// What it is called on the command line.
    pub name: &'static str,
    /// Its tetrahedra and its surface.
    pub shape: Shape,
    /// Its colour and the side that it is seen from.
    pub style: Style,
}

impl Serialize for Body {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        find(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

/// What a picture looks like, beside the motion itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Linear RGB reflectance of the body, each in [0, 1].
    pub colour: [f32; 3],
    /// Where the camera looks from, degrees: about the vertical axis y, from z towards x.
    pub azimuth: f32,
    /// Where the camera looks from, degrees: above the horizon.
    pub elevation: f32,
}

/// Where the tetrahedra of a body and its surface come from.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Files.
    Files {
        /// The tetrahedra, as a Gmsh file.
        mesh: Asset,
        /// The surface embedded in them, as an OBJ file.
        surface: Asset,
    },
    /// A box, [generated](piola::mesh::tetrahedral_box); the surface is its boundary.
    Box {
        /// How many cells of six tetrahedra along each axis.
        cells: [usize; 3],
        /// Its lengths, m.
        size: [f64; 3],
    },
}

/// A file that is part of the program.
#[derive(Clone, Copy, Debug)]
pub struct Asset {
    /// Its name, for messages.
    pub name: &'static str,
    /// What is in it.
    pub text: &'static str,
}

/// A horse in a cage of 2646 tetrahedra.
pub const HORSE: Body = Body {
    name: "horse",
    shape: Shape::Files {
        mesh: Asset { name: "horse.msh", text: include_str!("../../assets/horse.msh") },
        surface: Asset { name: "horse.obj", text: include_str!("../../assets/horse.obj") },
    },
    style: Style { colour: [0.42, 0.20, 0.10], azimuth: 35.0, elevation: 14.0 },
};

/// A dinosaur in a cage of 1031 tetrahedra.
pub const DINOSAUR: Body = Body {
    name: "dinosaur",
    shape: Shape::Files {
        mesh: Asset { name: "dinosaur.msh", text: include_str!("../../assets/dinosaur.msh") },
        surface: Asset { name: "dinosaur.obj", text: include_str!("../../assets/dinosaur.obj") },
    },
    style: Style { colour: [0.20, 0.36, 0.13], azimuth: 60.0, elevation: 20.0 },
};

/// An upright bar of four times its width, of 1536 tetrahedra.
pub const BAR: Body = Body {
    name: "bar",
    shape: Shape::Box { cells: [4, 16, 4], size: [0.25, 1.0, 0.25] },
    style: Style { colour: [0.12, 0.24, 0.42], azimuth: 30.0, elevation: 16.0 },
};

/// Every body, in the order in which they are listed.
pub const BODIES: &[Body] = &[HORSE, DINOSAUR, BAR];

/// The body of that name.
///
/// # Errors
/// With the names that exist, where it is none of them.
pub fn find(name: &str) -> Result<Body, Error> {
    let body = BODIES.iter().copied().find(|body| body.name == name);
    body.ok_or_else(|| Error::UnknownBody {
        name: name.into(),
        known: BODIES.iter().map(|body| body.name).collect(),
    })
}
