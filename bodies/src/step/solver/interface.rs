//! Interface of Newton's method to the machine that simulates a body or its part, and to its linear solver.

use crate::step::error::NewtonError;
use crate::step::objective::Objective;
use crate::step::term::NodeBlocks;
use crate::system::linear::LinearError;
use crate::system::linear::multigrid::Division;
use crate::system::{Body, NodalStiffness};

/// Linear system K d = −g of a Newton iteration, for a direction d that is zero at pinned nodes.
#[derive(Clone, Copy)]
pub struct System<'a> {
    /// Objective with the second derivatives K, except for those of the elements, which the machine has.
    pub objective: &'a Objective<'a>,
    /// Position of each node, m.
    pub x: &'a [[f64; 3]],
    /// Gradient g, N.
    pub gradient: &'a [[f64; 3]],
    /// Relative tolerance, which takes effect if it is tighter than the solver's own.
    pub tolerance: f64,
    /// True if an indefinite K is left unsolved; otherwise it is made definite, or used until the
    /// indefiniteness shows.
    pub must_be_definite: bool,
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

/// Machine that simulates a body or, of a body that is divided among machines, its part, with the solver of
/// the linear systems and all its memory.
///
/// All machines must call all functions of their simulations, in the same order.
pub trait Machine {
    /// Division of the nodes.
    type Nodes: Division;

    /// Division of the nodes.
    fn nodes(&self) -> &Self::Nodes;

    /// Division of the nodes, for exchanges.
    fn nodes_mut(&mut self) -> &mut Self::Nodes;

    /// Nodes that are not pinned, in the order of the unknowns.
    fn free_nodes(&self) -> &[usize];

    /// Discards information from earlier systems, before the first one of a step: a step depends only on the
    /// state before it.
    fn begin(&mut self);

    /// Sets up a new solver if the blocks of terms join nodes without a block in its matrix.
    ///
    /// # Errors
    /// [`LinearError`].
    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let _ = (body, blocks);
        Ok(())
    }

    /// Calls `work` with the stiffness of the elements, which it replaces once before each system.
    fn with_stiffness<T>(&mut self, work: impl FnOnce(&mut NodalStiffness) -> T) -> T;

    /// Solves for the direction, once after each linearisation; a machine finds the direction of the nodes
    /// that it owns. Returns `None` if the matrix must be definite and is not.
    ///
    /// # Errors
    /// [`NewtonError::NotPositive`], [`NewtonError::NotFinite`] or [`NewtonError::Linear`], on all machines.
    fn solve(
        &mut self,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, NewtonError>;
}
