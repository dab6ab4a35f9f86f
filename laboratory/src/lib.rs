//! A material on the bench: test curves, fits to measurements and stability of an energy, before any body is
//! made of it.
//!
//! * [`curve`](mod@curve): stress against stretch in the usual tests of laboratories, solved for the stretch
//!   of free sides;
//! * [`data`]: measured curves, and the agreement of an energy with them;
//! * [`fit`](mod@fit): the parameters with which it agrees best, and their uniqueness;
//! * [`ranking`]: several energies compared with the same measurements, in the order of their agreement;
//! * [`stability`]: the stretches at which an energy keeps the inequalities of a stable solid;
//! * [`chart`]: curves, fits and stability in pictures, with the feature `charts`, on by default.
//!
//! The crate uses materials only through the traits of [`piola::material`](mod@piola::material), and for fits
//! energies that are declared at run time ([`Energy`](piola_declare::Energy)), so that your own energy works
//! as well as one of the catalogue. There are no bodies here: each specimen is deformed homogeneously and
//! slowly, so that neither buckling nor viscosity, softening or friction at the plates is seen.

#[cfg(feature = "charts")]
pub mod chart;
pub mod curve;
mod cycle;
pub mod data;
pub mod fit;
pub mod ranking;
mod rest;
mod specimen;
pub mod stability;

/// A piece of any material, along whose principal axes forces are read: every [`Material`](piola::Material)
/// is a `Specimen<f64>`, with its methods at stretches λ1 ≥ λ2 ≥ λ3 > 0.
pub use piola::material::Response as Specimen;
pub use rest::AtRest;
