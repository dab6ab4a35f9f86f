//! Calculus on expression graphs: exact fractions, derivatives, quotients, continuation and normal forms.
//!
//! It is independent of declarations and of Rust: of `read` and of all later stages.

pub mod by_parameters;
pub mod calls;
pub mod cancellation;
pub mod diff;
pub mod dimension;
pub mod divided;
pub mod elementary;
pub mod excess;
pub mod expand;
pub mod expr;
pub mod extension;
pub mod increment;
pub mod interpret;
pub mod invariants;
pub mod power_sums;
pub mod quotient;
pub mod rational;
pub mod simplify;
pub mod volume;
