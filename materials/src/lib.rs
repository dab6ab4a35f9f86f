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
//! # Energies
//!
//! | name | type | domain | beyond J > 0 |
//! |---|---|---|---|
//! | `anssari_benam_bucchi` | [`AnssariBenamBucchi`] | J > 0, I1b < 3 * n | the chains lock at I1b = 3n, which a flattened element exceeds before it inverts |
//! | `arap` | [`Arap`] | every deformation | it is defined for every deformation gradient already |
//! | `arruda_boyce` | [`ArrudaBoyce`] | J > 0 | extends |
//! | `blatz_ko` | [`BlatzKo`] | J > 0 | extends |
//! | `carroll` | [`Carroll`] | J > 0 | √I2 has a kink where two stretches vanish |
//! | `ciarlet_geymonat` | [`CiarletGeymonat`] | J > 0 | extends |
//! | `ciarlet_neo_hookean` | [`CiarletNeoHookean`] | J > 0 | extends |
//! | `exponentiated_hencky` | [`ExponentiatedHencky`] | J > 0 | the exponential of an extended logarithm leaves the range of the numbers just below the threshold |
//! | `extended_tube` | [`ExtendedTube`] | J > 0, delta * delta * (I1b - 3.0) < 1 | the chains lock at δ² (I1b − 3) = 1, which a flattened element exceeds before it inverts |
//! | `fixed_corotated` | [`FixedCorotated`] | every deformation | it is defined for every deformation gradient already |
//! | `fung` | [`Fung`] | every deformation | it is defined for every deformation gradient already |
//! | `gent` | [`Gent`] | J > 0, I1 - 3 < jm | extends |
//! | `gent_gent` | [`GentGent`] | J > 0, I1b - 3 < jm | ln I2 is singular where two stretches vanish |
//! | `gent_thomas` | [`GentThomas`] | J > 0 | ln I2 is singular where two stretches vanish |
//! | `hencky` | [`Hencky`] | J > 0 | extends |
//! | `isochoric_neo_hookean` | [`IsochoricNeoHookean`] | J > 0 | extends |
//! | `isochoric_ogden` | [`IsochoricOgden`] | J > 0 | extends |
//! | `knowles` | [`Knowles`] | J > 0 | extends |
//! | `lopez_pamies` | [`LopezPamies`] | J > 0 | extends |
//! | `mooney_rivlin` | [`MooneyRivlin`] | J > 0 | isochoric terms with (J − 1)² alone do not push a collapsed point open |
//! | `mooney_rivlin_coupled` | [`MooneyRivlinCoupled`] | J > 0 | extends |
//! | `neo_hookean_lnj` | [`NeoHookean`] | J > 0 | extends |
//! | `ogden` | [`Ogden`] | J > 0 | extends |
//! | `rotated_linear` | [`RotatedLinear`] | every deformation | it is defined for every deformation gradient already |
//! | `stable_neo_hookean` | [`StableNeoHookean`] | every deformation | it is defined for every deformation gradient already |
//! | `storakers` | [`Storakers`] | J > 0 | extends |
//! | `stretch_spline` | [`StretchSpline`] | every deformation | it is defined for every deformation gradient already |
//! | `stvk` | [`StVenantKirchhoff`] | every deformation | it is defined for every deformation gradient already |
//! | `symmetric_dirichlet` | [`SymmetricDirichlet`] | J != 0 | extends |
//! | `valanis_landel` | [`ValanisLandel`] | J > 0 | extends |
//! | `varga` | [`Varga`] | J > 0 | extends |
//! | `yeoh` | [`Yeoh`] | J > 0 | isochoric terms with (J − 1)² alone do not push a collapsed point open |
//!
//! Those that extend do so below a threshold stretch ε, with [`Inversion::Extend`](piola::Inversion::Extend); some only for
//! parameters with which the extension restores, as each says. A point of one that extends comes back from every inverted
//! or collapsed state that was tried if ε is small enough for how incompressible it is: where −ln J alone keeps the volume
//! from vanishing, in `ciarlet_geymonat`, `ciarlet_neo_hookean` and those with an isochoric part, an ε above about 2μ/κ
//! leaves a second equilibrium, a wide disc of hardly any thickness.
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

mod anssari_benam_bucchi;
mod arap;
mod arruda_boyce;
mod blatz_ko;
mod carroll;
mod catalogue;
mod ciarlet_geymonat;
mod ciarlet_neo_hookean;
mod exponentiated_hencky;
mod extended_tube;
mod fixed_corotated;
mod fung;
mod gent;
mod gent_gent;
mod gent_thomas;
mod hencky;
mod isochoric_neo_hookean;
mod isochoric_ogden;
mod knowles;
mod lopez_pamies;
mod matching;
mod mooney_rivlin;
mod mooney_rivlin_coupled;
mod neo_hookean;
mod ogden;
mod rotated_linear;
mod st_venant_kirchhoff;
mod stable_neo_hookean;
mod storakers;
mod stretch_spline;
mod symmetric_dirichlet;
mod valanis_landel;
mod varga;
mod yeoh;

pub use anssari_benam_bucchi::AnssariBenamBucchi;
pub use arap::Arap;
pub use arruda_boyce::ArrudaBoyce;
pub use blatz_ko::BlatzKo;
pub use carroll::Carroll;
pub use catalogue::{CATALOGUE, Entry, FittableVisitor, Visitor, find};
pub use ciarlet_geymonat::CiarletGeymonat;
pub use ciarlet_neo_hookean::CiarletNeoHookean;
pub use exponentiated_hencky::ExponentiatedHencky;
pub use extended_tube::ExtendedTube;
pub use fixed_corotated::FixedCorotated;
pub use fung::Fung;
pub use gent::Gent;
pub use gent_gent::GentGent;
pub use gent_thomas::GentThomas;
pub use hencky::Hencky;
pub use isochoric_neo_hookean::IsochoricNeoHookean;
pub use isochoric_ogden::IsochoricOgden;
pub use knowles::Knowles;
pub use lopez_pamies::LopezPamies;
pub use mooney_rivlin::MooneyRivlin;
pub use mooney_rivlin_coupled::MooneyRivlinCoupled;
pub use neo_hookean::NeoHookean;
pub use ogden::Ogden;
pub use rotated_linear::RotatedLinear;
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use stable_neo_hookean::StableNeoHookean;
pub use storakers::Storakers;
pub use stretch_spline::StretchSpline;
pub use symmetric_dirichlet::SymmetricDirichlet;
pub use valanis_landel::ValanisLandel;
pub use varga::Varga;
pub use yeoh::Yeoh;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
