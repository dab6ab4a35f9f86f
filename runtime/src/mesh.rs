//! Tetrahedral bodies and the surfaces drawn in their place: geometry at rest, boxes, files, embedding.
//!
//! This module knows no materials, no forces and no time.

pub mod boxes;
pub mod embed;
pub mod io;
pub mod tet;

pub use boxes::{BoxError, tetrahedral_box};
pub use embed::{EmbedError, Embedding};
pub use io::{ReadError, Surface, read_msh, read_surface_obj, read_tetgen};
pub use tet::{Bounds, Group, MeshError, RestShape, TetMesh};
