//! Functions of bodies that return a `Result` do so for any arguments: wrong lengths, NaN, infinities, the
//! ends of the range, nodes that are missing, repeated, or more than any memory holds.
//!
//! A module for each floor of the crate. `tests/tidy` checks that none of these functions is left out.
#![cfg(feature = "faer")]

#[path = "../../../runtime/tests/hostile/arguments.rs"]
mod arguments;
mod bodies;
mod meshes;
mod more_arguments;
mod steps;
