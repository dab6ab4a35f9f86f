//! Names that generated code and the other crates of piola use: not part of the public interface, and
//! free to change with every version. The versions of `piola`, `piola-macros` and `piola-codegen` are pinned
//! to each other for this reason.
//!
//! Each expansion imports this module once, inside a `const _: () = { … }` that contains all implementations,
//! so that a declaration adds only the type to its module. It re-exports serde, so that a crate that declares
//! `#[material(serde)]` needs no dependency on it.

pub use crate::lanes::Mask;
pub use crate::material::condition::{Condition, Term};
pub use crate::material::constructor::*;
pub use crate::material::parameter::PerLane;
pub use crate::material::{
    Blocks, Curvature, Declared, Description, Form, Graded, Inversion, MaterialError, Moduli, Parameter,
    ParameterValue, Typical, Unit,
};
pub use crate::quotient::*;
#[cfg(feature = "serde")]
pub use serde;
pub use std::{borrow::Cow::Borrowed, option::Option, result::Result, vec::Vec};

pub use crate::Real;

/// Programs as the compiler of declarations fills them in.
#[cfg(all(feature = "interpreter", not(test)))]
pub mod interpreter {
    pub use crate::interpreter::material::{ByInvariants, Programs, Variant};
    pub use crate::interpreter::parameters::Value;
    pub use crate::interpreter::program::*;
}

/// Products of matrices, and stretches in their order, for other methods to be compared with.
pub mod matrix {
    pub use crate::point::matrix::{dot, multiply, multiply_transposed, to_world, transpose};
    pub use crate::point::svd::descending;
}

/// Quotations in the messages of all crates.
pub mod message {
    pub use crate::message::*;
}

/// Samples for the contract and for tests.
pub mod random {
    pub use crate::random::Random;
}

/// Computations as programs, for back ends that print them.
#[cfg(all(feature = "interpreter", not(test)))]
pub mod record {
    pub use crate::kernels::tetrahedron::{evaluate_tetrahedron, evaluate_vertex};
    pub use crate::lanes::recorded::program::{
        Binary, Id, RecordedFunction, RecordedOperation, RecordedProgram, Unary,
    };
    pub use crate::lanes::recorded::{Recorded, RecordedMask, define, parameter, record};
}
