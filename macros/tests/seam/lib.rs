//! The modules of piola that generated code names, from their own files.
//!
//! Cases of the macro's messages depend on it in the place of piola, whose solvers take a minute to compile.

extern crate self as piola;

#[expect(dead_code, reason = "what batches read of materials")]
#[path = "../../../runtime/src"]
mod runtime {
    pub mod lanes;
    pub mod material;
    pub mod quotient;
    pub mod univariate;
}

pub use piola_macros::material;
pub use runtime::lanes::Real;
pub use runtime::material::{Inversion, Material};
pub use runtime::univariate::{Spline, Univariate};
pub use runtime::{lanes, material, quotient, univariate};
