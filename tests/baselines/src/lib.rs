//! Methods for dP/dF used elsewhere, and their errors at the reference cases.
//!
//! From the same singular value decomposition and the same derivatives of the energy:
//!
//! * [`quotients`]: the same fifteen numbers with quotients as they are usually written;
//! * [`svd_gradients`]: \[SZLSB11\] by its equations, regularised as it says;
//! * [`coincidences`]: P = F S(C) differentiated on paper, with a formula for each coincidence of the
//!   stretches;
//! * [`clamped`]: all of it at stretches that may not become small.
//!
//! From other derivatives, or none:
//!
//! * [`invariants`]: \[TSIF05\], through tr C, C:C and det C;
//! * [`direct`]: through I1, I2 and J, without a decomposition;
//! * [`polar`]: rotated linear elasticity through F = R S;
//! * [`automatic`]: by dual numbers;
//! * [`differences`]: by central differences of P.
//!
//! And what they are made of:
//!
//! * [`decompositions`]: singular values by other methods and libraries;
//! * [`eigen`]: the projection of a 9×9 matrix that is known by its entries only.
//!
//! [`stability`] is the table of their errors and those of piola, `tests/STABILITY.md`.
//!
//! They are written as a good engineer would write them, generic over the real type, and nothing in them is
//! slower or less exact than its method asks for.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011. \[TSIF05\] Teran, Sifakis, Irving, Fedkiw, *Robust quasistatic finite elements and flesh
//! simulation*, 2005.

use ::nalgebra::RealField;
use num_dual::{DualNum, DualNumFloat};
use piola::Real;

pub mod automatic;
pub mod clamped;
pub mod coincidences;
pub mod decompositions;
pub mod differences;
pub mod direct;
pub mod eigen;
pub mod invariants;
mod matrix;
pub mod polar;
pub mod quotients;
pub mod stability;
pub mod svd_gradients;
#[cfg(test)]
mod testing;

/// A format that every method computes in, whatever its library asks for: `f64` or `f32`.
pub trait LibraryNumber:
    Real<Mask = bool> + RealField + ::faer::traits::RealField + DualNumFloat + DualNum<Self>
{
}

impl LibraryNumber for f64 {}

impl LibraryNumber for f32 {}
