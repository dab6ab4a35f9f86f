//! The bodies that come with the program.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serializer};

use crate::error::Error;

/// A body and its looks in pictures.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Name on the command line.
    pub name: &'static str,
    /// Its tetrahedra and its surface.
    pub shape: Shape,
    /// Its colour, and the side from which it is seen.
    pub style: Style,
}

/// Looks of a body in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Linear RGB reflectance of the body, each in [0, 1].
    pub colour: [f32; 3],
    /// Direction from which the camera looks, degrees: about the vertical axis y, from z towards x.
    pub azimuth: f32,
    /// Direction from which the camera looks, degrees above the horizon.
    pub elevation: f32,
}

/// Source of the tetrahedra of a body and of its surface.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Files, named after the body in messages.
    Files {
        /// The tetrahedra: the text of a Gmsh file.
        mesh: &'static str,
        /// The surface embedded in them: the text of an OBJ file.
        surface: &'static str,
    },
    /// A box, [generated](piola_bodies::mesh::tetrahedral_box); the surface is its boundary.
    Box {
        /// Number of cells, of six tetrahedra each, along each axis.
        cells: [usize; 3],
        /// Its lengths, m.
        size: [f64; 3],
    },
}

impl Body {
    /// A horse in a cage of 2646 tetrahedra.
    pub const HORSE: Self = Self {
        name: "horse",
        shape: Shape::Files {
            mesh: include_str!("../../assets/horse.msh"),
            surface: include_str!("../../assets/horse.obj"),
        },
        style: Style { colour: [0.42, 0.20, 0.10], azimuth: 35.0, elevation: 14.0 },
    };

    /// A dinosaur in a cage of 1031 tetrahedra.
    pub const DINOSAUR: Self = Self {
        name: "dinosaur",
        shape: Shape::Files {
            mesh: include_str!("../../assets/dinosaur.msh"),
            surface: include_str!("../../assets/dinosaur.obj"),
        },
        style: Style { colour: [0.20, 0.36, 0.13], azimuth: 60.0, elevation: 20.0 },
    };

    /// An upright bar of 1536 tetrahedra, four times as high as wide.
    pub const BAR: Self = Self {
        name: "bar",
        shape: Shape::Box { cells: [4, 16, 4], size: [0.25, 1.0, 0.25] },
        style: Style { colour: [0.12, 0.24, 0.42], azimuth: 30.0, elevation: 16.0 },
    };

    /// All bodies, in the order in which they are listed.
    pub const ALL: &[Self] = &[Self::HORSE, Self::DINOSAUR, Self::BAR];

    /// The body of a name.
    ///
    /// # Errors
    /// [`Error::Unknown`] with the names that exist.
    pub fn find(name: &str) -> Result<Self, Error> {
        let body = Self::ALL.iter().copied().find(|body| body.name == name);
        body.ok_or_else(|| Error::Unknown {
            kind: "body",
            name: name.into(),
            known: Self::ALL.iter().map(|body| body.name).collect(),
        })
    }

    /// Writes the name of a body in its place.
    pub(crate) fn serialize<S: Serializer>(body: &Self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(body.name)
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::find(&String::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}
