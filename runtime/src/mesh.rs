//! Tetrahedral bodies and the surfaces drawn in their place: geometry at rest, files, embedding.
//!
//! This module knows no materials, no forces and no time.

pub mod embed;
pub mod io;
pub mod tet;

pub use embed::{EmbedError, Embedding};
pub use io::{ReadError, Surface, read_msh, read_surface_obj};
pub use tet::{Bounds, Group, MeshError, RestShape, TetMesh};
