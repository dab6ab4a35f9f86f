//! Interface of the linear solvers to Newton's method.

use crate::step::error::NewtonError;
use crate::step::objective::Objective;
use crate::step::term::NodeBlocks;
use crate::system::linear::LinearError;
use crate::system::linear::multigrid::Division;
use crate::system::{Body, NodalStiffness, Pins};

/// Requirement on the matrix of a linear system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Definiteness {
    /// An indefinite matrix is left unsolved.
    Required,
    /// An indefinite matrix is made definite, or used until the indefiniteness shows.
    Optional,
}

/// Outcome of a linear solve.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Solution {
    /// Multiple of inertia that was added.
    pub shift: f64,
    /// Number of iterations of the linear solver.
    pub iterations: usize,
    /// True if the iteration stopped before the tolerance.
    pub truncated: bool,
}

/// Machine that simulates a body or, of a body that is divided among machines, its part.
///
/// All machines must call all functions of their simulations, in the same order.
pub trait Machine {
    /// Division of the nodes.
    type Nodes: Division;

    /// Division of the nodes.
    fn nodes(&self) -> &Self::Nodes;

    /// Division of the nodes, for exchanges.
    fn nodes_mut(&mut self) -> &mut Self::Nodes;

    /// Solver of the linear systems.
    fn solver(&mut self) -> &mut dyn Solver;

    /// Sets up a new solver if the blocks of terms join nodes without a block in its matrix.
    ///
    /// # Errors
    /// [`LinearError`].
    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let _ = (body, blocks);
        Ok(())
    }
}

/// Solver of the linear systems of a simulation, with all its memory.
pub trait Solver {
    /// Nodes that are not pinned, in the order of the unknowns.
    fn free_nodes(&self) -> &[usize];

    /// Discards information from earlier systems, before the first one of a step: a step depends only on the
    /// state before it.
    fn begin(&mut self) {}

    /// Calls `work` with the stiffness of the elements, which it replaces once before each system.
    fn with_stiffness(&mut self, work: &mut dyn FnMut(&mut NodalStiffness));

    /// Adds the product of the stiffness of a body with a displacement of few nodes to `total`.
    fn add_product(&mut self, _: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        let mut product = vec![[0.0; 3]; total.len()];
        self.with_stiffness(&mut |stiffness| stiffness.matrix_mut().multiply(displacement, &mut product));
        for (total, product) in total.iter_mut().zip(product) {
            for c in 0..3 {
                total[c] += product[c];
            }
        }
    }

    /// Solves for the direction at `x`, zero at pinned nodes, once after each linearisation; a machine finds
    /// the direction of the nodes that it owns. Returns `None` if the matrix is indefinite and definiteness
    /// is required.
    ///
    /// `tolerance` takes effect if it is tighter than the solver's own.
    ///
    /// # Errors
    /// [`NewtonError::NotPositive`], [`NewtonError::NotFinite`] or [`NewtonError::Linear`], on all machines.
    fn solve(
        &mut self,
        objective: &Objective<'_>,
        x: &[[f64; 3]],
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, NewtonError>;
}

/// Solver of a body on one machine.
pub(crate) trait OwnSolver: Solver + Send + Sync {
    /// Replaces the pins; returns false if a new solver has to be set up for them.
    fn set_pins(&mut self, pins: &Pins) -> bool;

    fn boxed_clone(&self) -> Box<dyn OwnSolver>;
}

impl Clone for Box<dyn OwnSolver> {
    fn clone(&self) -> Self {
        self.as_ref().boxed_clone()
    }
}
