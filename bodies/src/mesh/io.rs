//! Meshes and surfaces from files.
//!
//! The readers are the project's own: an error must name file and line, and surface vertices must keep the
//! order of the file. `mshio` gives neither lines nor physical names, `tobj` no lines, and it renumbers
//! vertices.

mod foreign;
mod msh;
mod obj;
mod tetgen;
mod text;

pub use msh::{parse_msh, read_msh};
pub use obj::{Surface, parse_surface_obj, read_surface_obj};
pub use tetgen::read_tetgen;
pub use text::ReadError;
