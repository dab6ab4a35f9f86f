//! The function that a step of implicit Euler minimises, or a stage of another integrator.
//!
//! With M the lumped masses, D the quadratic form of damping, α M, and with s, w
//! and the length τ of the stage, for which v = (x − s)/τ and a = (v − w)/τ:
//!
//! ```text
//! E(x) = ½‖x − s − τ w‖²_M / τ² + 1/(2τ) ‖x − s‖²_D + Ψ(x) − Σ (m g + f)·x + Σ terms
//! ```
//!
//! Where its gradient vanishes, M a = −∇Ψ(x) − D v + M g + f − ∇ terms. For implicit Euler s and w are the
//! state before the step, and τ is its length. Inertia, damping and given forces are quadratic, so that
//! along a line they need one slope and one curvature and no subtraction of close energies. Positions enter
//! as displacements from s.
//!
//! With τ = ∞ inertia and damping are zero by the arithmetic of infinity, and what is left is statics.

use std::iter;
use std::sync::Arc;

use piola::NoSuchNode;

use crate::system::assemble::Elastic;
use crate::system::{Body, NodalStiffness};

use super::integrator::Stage;
use super::spring::Spring;
use super::term::{EnergyChange, NodeBlocks, Term};

#[derive(Clone, Copy)]
pub(crate) struct Terms<'a> {
    pub(crate) springs: &'a Vec<Spring>,
    pub(crate) others: &'a [Arc<dyn Term>],
}

impl<'a> Terms<'a> {
    fn each(self) -> impl Iterator<Item = &'a dyn Term> {
        iter::once(self.springs as &dyn Term).chain(self.others.iter().map(Arc::as_ref))
    }

    /// Index of the first term, springs aside, that refuses these positions.
    pub(super) fn refusing(self, x: &[[f64; 3]]) -> Option<usize> {
        self.others.iter().position(|term| term.energy(x).is_none_or(|energy| !energy.is_finite()))
    }

    pub(crate) fn add_gradient(self, x: &[[f64; 3]], total: &mut [[f64; 3]]) {
        self.each().for_each(|term| term.add_gradient(x, total));
    }

    /// Replaces the blocks by those at `x`; an error for a block of a node that does not exist.
    pub(crate) fn linearise(self, x: &[[f64; 3]], blocks: &mut NodeBlocks) -> Result<(), NoSuchNode> {
        blocks.begin(x.len());
        self.each().for_each(|term| term.add_second_derivatives(x, blocks));
        match blocks.missing() {
            Some(node) => Err(NoSuchNode { element: None, node, nodes: x.len() }),
            None => Ok(()),
        }
    }

    /// Share of a displacement, at most 1, that a line search tries first; 0 if a term returns NaN.
    pub(super) fn longest_step(self, x: &[[f64; 3]], d: &[[f64; 3]]) -> f64 {
        self.others.iter().fold(1.0, |step: f64, term| step.min(term.longest_step(x, d).max(0.0)))
    }

    pub(super) fn change(self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Option<EnergyChange> {
        self.each().try_fold(EnergyChange::default(), |sum, term| {
            let EnergyChange { difference, noise } = term.change(from, to)?;
            Some(EnergyChange { difference: sum.difference + difference, noise: sum.noise + noise })
        })
    }
}

/// Objective of a stage of a step, or the part of a machine, with memory for its elastic part.
pub struct Objective<'a> {
    pub(crate) body: &'a Body,
    pub(crate) elastic: &'a mut Elastic,
    pub(crate) stage: &'a Stage,
    /// α of mass-proportional damping, 1/s.
    pub(crate) damping: f64,
    /// Diagonal that a unit of regularisation adds for each mass, 1/s².
    pub(crate) regularisation: f64,
    /// Diagonal that is always added for each mass to the second derivatives, not to the objective, 1/s².
    pub(crate) guard: f64,
    /// g, m/s².
    pub(crate) gravity: [f64; 3],
    /// f of each node, N; empty without any.
    pub(crate) forces: &'a [[f64; 3]],
    pub(crate) terms: Terms<'a>,
    /// Second derivatives of the terms, where they were linearised last.
    pub(crate) blocks: &'a mut NodeBlocks,
}

impl Objective<'_> {
    /// The gradient at `x`, after the elastic gradients or stiffnesses have been evaluated there.
    pub(crate) fn gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        self.quadratic_gradient(x, gradient);
        self.terms.add_gradient(x, gradient);
        self.elastic.add_gradient(self.body, gradient);
    }

    /// The gradient of inertia, damping and given forces, which are quadratic.
    pub(super) fn quadratic_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        gradient.fill([0.0; 3]);
        for (node, mass) in self.body.masses().iter().enumerate() {
            let [v, acceleration] = self.stage.motion(node, x[node]);
            for c in 0..3 {
                gradient[node][c] += mass * (acceleration[c] + self.damping * v[c] - self.gravity[c]);
            }
        }
        for (total, force) in gradient.iter_mut().zip(self.forces) {
            for c in 0..3 {
                total[c] -= force[c];
            }
        }
    }

    /// Second derivative of the quadratic part in each coordinate of a node: m (1/τ + α)/τ.
    fn diagonal(&self, node: usize) -> f64 {
        let tau = self.stage.length;
        self.body.masses()[node] * (1.0 / tau + self.damping) / tau
    }

    /// Curvature dᵀ H d of the quadratic part.
    pub(super) fn curvature(&self, d: &[[f64; 3]]) -> f64 {
        let square = |x: [f64; 3]| x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
        d.iter().enumerate().map(|(node, &d)| self.diagonal(node) * square(d)).sum()
    }

    /// Adds the product of the second derivatives, except for those of the elements, with a displacement.
    pub(super) fn add_product(&self, d: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for node in 0..d.len() {
            for c in 0..3 {
                total[node][c] += self.inertia(node) * d[node][c];
            }
        }
        self.blocks.add_product(d, total);
    }

    /// Rounding error of a difference of energies near `x`, the last point of evaluation, J.
    pub(super) fn noise(&self, x: &[[f64; 3]]) -> f64 {
        let of_terms = self.terms.change(x, x).map_or(0.0, |change| change.noise);
        self.elastic.difference_noise(self.body) + of_terms
    }

    /// Adds the second derivatives, except for those of the elements, to a stiffness.
    pub fn add_second_derivatives(&self, stiffness: &mut NodalStiffness) {
        for node in 0..self.body.masses().len() {
            stiffness.add_to_diagonal(node, self.inertia(node));
        }
        self.blocks.add_to_blocks(stiffness.matrix_mut());
    }

    /// Part of inertia and damping in the diagonal of a node, N/m, with the guard against drift.
    ///
    /// # Panics
    /// If there is no such node.
    #[must_use]
    pub fn inertia(&self, node: usize) -> f64 {
        self.diagonal(node) + self.body.masses()[node] * self.guard
    }

    /// Addition to the diagonal of a node, N/m, of which a solver adds multiples until the matrix is positive
    /// definite.
    ///
    /// # Panics
    /// If there is no such node.
    #[must_use]
    pub fn regularisation(&self, node: usize) -> f64 {
        self.body.masses()[node] * self.regularisation
    }
}

/// Inner product Σ a·b over the nodes.
pub(crate) fn product(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sum()
}
