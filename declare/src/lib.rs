//! Elastic energies declared at run time: text in, a material out, without a compiler.
//!
//! ```
//! use piola::Inversion;
//! use piola_declare::Energy;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let energy = Energy::from_formula("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2")?;
//! let rubber = energy.material(&[&[1e6], &[5e6]], Inversion::Refuse)?;
//! assert!(rubber.energy([2.0, 1.0, 0.5]) > 0.0);
//! # use piola::Material;
//! # Ok(())
//! # }
//! ```
//!
//! The text is a formula in the notation of papers ([`Energy::from_formula`]), or the Rust function that
//! [`#[piola::material]`](macro@piola::material) takes ([`Energy::from_rust`]), so that one file works for
//! both. It goes through the compiler of that attribute, `piola-codegen`, with its checks and messages; the
//! result is not Rust but a program, which an [`Interpreted`](piola::interpreter::Interpreted) material
//! executes. That computes what the compiled material does, bit by bit, for every kind of real number and on
//! every back end, and so keeps its digits.
//!
//! Texts need not be trusted: their length, their nesting and the size of the result are limited, and a
//! larger text is a [`Mistake`]. No text makes the crate panic.
//!
//! # What it does not do
//!
//! The only functions that can be parameters are [`Spline`](piola::Spline)s: other types need the declaration
//! to be compiled. There are no other derivatives of formulas than those of the compiler, and no branches.

mod constructor;
pub mod emit;
mod energy;
mod fit;
mod formula;
mod lower;
mod mistakes;
mod rust;
mod text;

pub use energy::Energy;
pub use fit::Constraint;
// For the judge of random energies, which compares each program with an oracle.
#[doc(hidden)]
pub use energy::programs;
pub use formula::FormulaOptions;
pub use mistakes::{Mistake, Mistakes, Place};
pub use piola_codegen::model::Limit;
// For messages of sister crates.
#[doc(hidden)]
pub use piola_codegen::read::spelling::nearest;
