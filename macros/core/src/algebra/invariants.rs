//! Energies as functions of I1, I2 and J alone.
//!
//! Stress then needs no singular value decomposition:
//!
//! ```text
//! P = 2 W1 F + 2 W2 (I1 F − F Fᵀ F) + WJ cof F,   W1 = ∂ψ/∂I1, W2 = ∂ψ/∂I2, WJ = ∂ψ/∂J
//! ```
//!
//! The declared expression is read once more with I1, I2 and J in the places of the three stretches of the
//! graph, so that the same calculus differentiates it. An energy that names a stretch is not of this kind,
//! whatever it may equal.

use crate::algebra::diff::Differentiator;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::simplify::simplify;

/// An energy in which λ1, λ2, λ3 of the graph stand for I1, I2, J.
#[derive(Clone, Debug)]
pub struct ByInvariants {
    /// ψ.
    pub energy: Id,
    /// W1, W2, WJ.
    pub gradient: [Id; 3],
    /// Expressions that are positive inside the domain, J apart.
    pub bounds: Vec<Id>,
}

/// The derivatives of an energy of I1, I2, J, with the bounds of its domain.
pub fn by_invariants(graph: &mut Graph, energy: Id, bounds: Vec<Id>) -> ByInvariants {
    let mut d = Differentiator::default();
    let gradient = [0, 1, 2].map(|k| {
        let derivative = d.by_stretch(graph, energy, k);
        simplify(graph, derivative)
    });
    ByInvariants { energy, gradient, bounds }
}
