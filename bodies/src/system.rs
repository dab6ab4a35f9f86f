//! Linear tetrahedral finite elements: elements, masses, sparsity, assembly, pins, linear solvers.
//!
//! This module is independent of time: inertia and damping belong to [`crate::step`]. All of it is in f64,
//! materials included.

pub(crate) mod assemble;
mod body;
pub(crate) mod element;
pub(crate) mod graph;
pub(crate) mod linear;
pub(crate) mod lists;
mod lower_triangle;
pub(crate) mod memory;
pub(crate) mod nodal_stiffness;
pub(crate) mod parts;
mod pins;
mod response;
#[cfg(test)]
pub(crate) mod testing;

#[cfg(feature = "faer")]
pub(crate) use linear::cholesky::Cholesky;

pub use body::{Body, BodyError, Part, parts_of_tets};
pub use element::Tetrahedron;
pub use linear::LinearError;
pub use lower_triangle::LowerTriangle;
pub use nodal_stiffness::NodalStiffness;
pub use pins::{PinError, Pins};
pub use response::ElasticResponse;
