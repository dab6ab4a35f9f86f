//! A catalogue of isotropic hyperelastic energies, each declared once with
//! [`#[piola::material]`](macro@piola::material), one file each: citation, formula, domain, deviation from the source.
//!
//! Each energy is a type with a checked constructor; all of them can also be chosen by name at run time, from
//! [`CATALOGUE`].
//!
//! ```
//! use piola::{Inversion, Material};
//! use piola_materials::NeoHookean;
//!
//! # fn main() -> Result<(), piola::material::Inadmissible> {
//! let rubber = NeoHookean::new(1e6, 5e6)?.with_inversion(Inversion::Extend { epsilon: 0.1 })?;
//! assert_eq!(rubber.energy([1.0, 1.0, 1.0]), 0.0);
//! assert!(rubber.energy([1.1, 1.0, -0.2]) > 0.0); // inverted, and defined
//! # Ok(())
//! # }
//! ```
//!
//! # Typical parameters
//!
//! Each energy names parameters of some real material and their source; [`Entry::typical`] has them for programs. Those
//! *fitted to \[Treloar 1944\]* are least squares of the relative difference between the nominal stresses of the
//! incompressible solid and those that Treloar, *Stress-strain data for vulcanised rubber under various types of
//! deformation*, Trans. Faraday Soc. 40, 1944, measured in uniaxial tension, equibiaxial tension and pure shear. With
//! them goes a bulk modulus of 20 MPa, Poisson's ratio 0.49, as is common in simulation; rubber itself has about 2 GPa.
//!
//! The crate holds no derivative and no algorithm: those come from the macro and from `piola`.

mod arap;
mod arruda_boyce;
mod blatz_ko;
mod catalogue;
mod fixed_corotated;
mod fung;
mod gent;
mod hencky;
mod mooney_rivlin;
mod mooney_rivlin_coupled;
mod neo_hookean;
mod ogden;
mod rotated_linear;
mod st_venant_kirchhoff;
mod stable_neo_hookean;
mod stretch_spline;
mod symmetric_dirichlet;
mod varga;
mod yeoh;

pub use arap::Arap;
pub use arruda_boyce::ArrudaBoyce;
pub use blatz_ko::BlatzKo;
pub use catalogue::{CATALOGUE, Entry, Visitor, find};
pub use fixed_corotated::FixedCorotated;
pub use fung::Fung;
pub use gent::Gent;
pub use hencky::Hencky;
pub use mooney_rivlin::MooneyRivlin;
pub use mooney_rivlin_coupled::MooneyRivlinCoupled;
pub use neo_hookean::NeoHookean;
pub use ogden::Ogden;
pub use rotated_linear::RotatedLinear;
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use stable_neo_hookean::StableNeoHookean;
pub use stretch_spline::StretchSpline;
pub use symmetric_dirichlet::SymmetricDirichlet;
pub use varga::Varga;
pub use yeoh::Yeoh;
