//! Invertible isotropic hyperelasticity.
//!
//! Declare an energy density in principal stretches with [`#[piola::material]`](macro@material) and get
//! everything an implicit simulator needs: energy, first Piola stress, tangent and its semidefinite
//! projection, element forces and stiffness, an implicit time step. No derivative is written by hand, no
//! spacing of the stretches is special, inverted elements are ordinary elements.
//!
//! ```
//! use piola::point::{Filter, evaluate};
//! use piola::{Material, material};
//!
//! /// Compressible neo-Hookean solid.
//! #[material(domain(J > 0.0), extend)]
//! pub fn Rubber(
//!     [l1, l2, l3]: [f64; 3],
//!     /// Shear modulus μ, Pa.
//!     mu: f64,
//!     /// First Lamé parameter λ, Pa.
//!     lambda: f64,
//! ) -> f64 {
//!     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let rubber = Rubber::new(1e6, 5e6)?;
//! let shear: [[f64; 3]; 3] = [[1.0, 0.2, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let point = evaluate(&rubber, &shear, Filter::Clamp);
//! assert!((point.stress[0][1] - 0.2e6).abs() < 1e-3);
//! piola::contract::check(&rubber, &Default::default())?;
//! # Ok(())
//! # }
//! ```
//!
//! Code that takes or keeps a material of any type writes [`DynMaterial`]: `&dyn DynMaterial<f64>` for points
//! and batches, `impl DynMaterial<f64> + 'static` or a `Box` for bodies. Only [`contract`](mod@contract)
//! takes an `impl` [`Material`], because it computes with dual numbers and in single precision too.
//!
//! From the bottom up, each module knowing only those above it:
//!
//! * [`lanes`]: the real numbers everything is generic over, one at a time or side by side in vector
//!   registers;
//! * [`material`](mod@material): the trait that energies implement, generated or by hand, and sums of them;
//! * [`univariate`]: curves as parameters of an energy;
//! * [`point`]: F to P and dP/dF through a signed singular value decomposition, and to other measures of
//!   stress;
//! * [`batch`]: slices of many points at once on lanes, for finite-element codes of any kind (feature
//!   `batch`);
//! * `convert`: matrices from and to nalgebra and glam (features `nalgebra` and `glam`);
//! * [`contract`](mod@contract): what a material must satisfy, as tests in one line or functions;
//! * [`mesh`]: tetrahedra, boxes of them, their files, embedded surfaces (feature `bodies`);
//! * [`system`]: forces, stiffness, its sparse assembly, pins, linear solvers (feature `bodies`);
//! * [`step`]: steps of time by Newton's method, implicit Euler and integrators of higher order (feature
//!   `bodies`);
//! * `interpreter`: materials whose energy is known at run time only, as `piola-declare` makes them (feature
//!   `interpreter`).
//!
//! Without features, which is the default, piola depends on no crate but its macro's, and builds in seconds:
//! enough to declare materials, test them and evaluate them at points. `batch` adds rayon; `f32` adds batches
//! in single precision; `bodies` adds `batch`, faer, and a minute or two.
//!
//! `serde` writes and reads settings, reports, splines and materials declared with the word `serde`. A number
//! that is not finite, such as the `min_det` of a survey of nothing, is `null` in JSON and cannot be read
//! back from there.
//!
//! There is no friction, no fracture, no plasticity and no higher-order element. Contact is a term of the
//! energy that the caller adds, as the example `ground` of `piola-materials` does.

// Modules that a feature adds, where it is off.
#![cfg_attr(not(feature = "batch"), doc = "", doc = "[`batch`]: https://docs.rs/piola/latest/piola/batch/")]
#![cfg_attr(
    not(feature = "bodies"),
    doc = "",
    doc = "[`mesh`]: https://docs.rs/piola/latest/piola/mesh/",
    doc = "[`step`]: https://docs.rs/piola/latest/piola/step/",
    doc = "[`system`]: https://docs.rs/piola/latest/piola/system/"
)]

extern crate self as piola;

#[doc(hidden)]
pub mod __private;
#[cfg(feature = "batch")]
pub mod batch;
#[cfg(feature = "bodies")]
mod chained;
pub mod contract;
#[cfg(any(feature = "glam", feature = "nalgebra", test))]
pub mod convert;
mod dynamic;
#[cfg(test)]
mod hand_written;
// Its kernels are not compiled a second time for the unit tests, none of which needs them.
#[cfg(all(feature = "interpreter", not(test)))]
pub mod interpreter;
#[cfg(feature = "batch")]
mod kernels;
pub mod lanes;
pub mod material;
#[cfg(feature = "bodies")]
pub mod mesh;
mod message;
#[cfg(feature = "batch")]
mod no_such_node;
pub mod point;
mod quotient;
mod random;
mod status;
#[cfg(feature = "bodies")]
pub mod step;
#[cfg(feature = "bodies")]
pub mod system;
pub mod univariate;

pub use dynamic::DynMaterial;
pub use lanes::Real;
pub use material::{Inversion, Material};
#[cfg(feature = "batch")]
pub use no_such_node::NoSuchNode;
pub use piola_macros::material;
pub use status::{Status, StatusCell, Survey};
pub use univariate::{Spline, Univariate};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
