//! Tetrahedral bodies and the surfaces drawn instead of them: geometry at rest, boxes, files, embedding.
//!
//! This module is independent of materials, forces and time. Coordinates are in f64.

mod anchor;
mod boxes;
mod elements;
mod io;
mod tet;

pub use anchor::{Anchor, EmbedError, embed};
pub use boxes::{BoxError, tetrahedra_of_cell, tetrahedral_box};
pub use elements::ElementCounts;
pub use io::{ReadError, Surface, parse_msh, parse_surface_obj, read_msh, read_surface_obj, read_tetgen};
pub(crate) use tet::no_such_group;
pub use tet::{Bounds, Group, MeshError, RestShape, TetMesh};
