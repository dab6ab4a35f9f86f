//! Invertible isotropic hyperelasticity.
//!
//! Declare an energy density in principal stretches with [`#[piola::material]`](macro@material) and get everything an
//! implicit simulator needs: energy, first Piola stress, tangent and its semidefinite projection, element forces and
//! stiffness, an implicit time step. No derivative is written by hand, no spacing of the stretches is special,
//! inverted elements are ordinary elements.

extern crate self as piola;

pub mod contract;
#[cfg(test)]
mod hand_written;
pub mod lanes;
pub mod material;
pub mod mesh;
pub mod point;
pub mod quotient;
mod random;
pub mod step;
pub mod system;

pub use lanes::Real;
pub use material::{Inversion, Material};
pub use piola_macros::material;
