//! Energies as functions of I1, I2 and J alone.
//!
//! Stress and tangent then need no singular value decomposition, only the first and second derivatives of ψ
//! by the invariants, such as
//!
//! ```text
//! P = 2 W1 F + 2 W2 (I1 F − F Fᵀ F) + WJ cof F,   W1 = ∂ψ/∂I1, W2 = ∂ψ/∂I2, WJ = ∂ψ/∂J
//! ```
//!
//! The declared expression is read once more with I1, I2 and J in the places of the three stretches of the
//! graph, so that the same calculus differentiates it. An energy that names a stretch is of this kind only
//! where [`power_sums`](super::power_sums) sees it.

use crate::algebra::expr::{Graph, Id};

/// An energy in which λ1, λ2, λ3 of the graph stand for I1, I2, J.
#[derive(Clone, Debug)]
pub struct ByInvariants {
    /// ψ.
    pub energy: Id,
    /// True if ψ is as accurate as by stretches.
    pub has_energy: bool,
    /// W1, W2, WJ.
    pub gradient: [Id; 3],
    /// W11, W22, WJJ, W12, W1J, W2J.
    pub hessian: [Id; 6],
    /// Expressions that are positive inside the domain, J apart.
    pub bounds: Vec<Id>,
    /// True if there is a domain, be it of J alone.
    pub has_domain: bool,
}

/// Second derivatives by invariants that do not vanish everywhere, of which the runtime compiles terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curvature {
    /// W11 of f(I1) + d I2, without J and without a condition on I2 or J.
    First,
    /// WJJ only.
    Volume,
    /// W11 and WJJ.
    Separate,
    /// All of them.
    All,
}

impl ByInvariants {
    /// The second derivatives that do not vanish everywhere.
    #[must_use]
    pub fn curvature(&self, graph: &Graph) -> Curvature {
        let [w11, w22, _, w12, w1j, w2j] = self.hessian.map(|derivative| !graph.is_zero(derivative));
        let [_, has_second, has_volume] = self.gradient.map(|derivative| !graph.is_zero(derivative));
        match (w11, w22 || w12 || w1j || w2j) {
            (_, false) if has_second && !has_volume && !self.has_domain => Curvature::First,
            (false, false) => Curvature::Volume,
            (true, false) => Curvature::Separate,
            (_, true) => Curvature::All,
        }
    }
}
