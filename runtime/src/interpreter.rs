//! Materials whose energies are programs found at run time.
//!
//! The compiler of declarations orders an energy and its derivatives into operations. `#[piola::material]`
//! writes these as Rust; the crate `piola-declare` keeps them as a `Program` and makes an [`Interpreted`]
//! material of it, which executes the operations one after the other. The operations are the same ones in the
//! same order, so that results are the same, bit by bit, for every kind of real number and on every back end.
//!
//! ```text
//! text → piola-codegen → operations → Rust → rustc → a material           compiled
//!                                   → Program      → Interpreted          at run time
//! ```
//!
//! Of the compiler this module has the operations and the volumes of a domain. It is independent of
//! declarations and of the meaning of an energy.

mod compute;
mod domain;
mod execute;
pub(crate) mod material;
pub(crate) mod parameters;
pub(crate) mod program;
mod registers;

pub use material::Interpreted;
