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

use piola::material;

/// Neo-Hookean solid, moduli in Pa.
#[material(domain(J > 0.0), extend)]
fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}
