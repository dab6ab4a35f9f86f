//! Interface of the linear solvers to Newton's method.

use piola::point::Filter;

use crate::step::objective::Objective;
use crate::system::Pins;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::linear::conjugate_gradients::{End, Iteration};

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

/// A solver of the linear systems of a simulation, with all its memory.
pub(crate) trait Solver: Send + Sync {
    /// The nodes that are not pinned, in the order of the unknowns.
    fn free_nodes(&self) -> &[usize];

    /// True if the matrix has a block for two free nodes.
    fn joins(&self, a: usize, b: usize) -> bool;

    /// Replaces the pins; returns false if a new solver has to be set up for them.
    fn set_pins(&mut self, pins: &Pins) -> bool;

    /// Discards information from earlier systems, before the first one of a step: a step depends only on the
    /// state before it.
    fn begin(&mut self) {}

    /// Evaluates gradients and filtered second derivatives where the energies were evaluated last.
    fn linearise(&mut self, objective: &mut Objective<'_>, filter: Filter) -> Evaluated;

    /// Adds the product of the second derivatives with a displacement of few nodes.
    fn add_product(&mut self, objective: &Objective<'_>, displacement: &[[f64; 3]], total: &mut [[f64; 3]]);

    /// Solves for the direction at `x`, zero at pinned nodes, once after each linearisation. Returns `None`
    /// if the matrix is indefinite and definiteness is required.
    ///
    /// `tolerance` takes effect if it is tighter than the solver's own.
    fn solve(
        &mut self,
        objective: &Objective<'_>,
        x: &[[f64; 3]],
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError>;

    /// A copy with memory of its own.
    fn boxed_clone(&self) -> Box<dyn Solver>;
}

impl Clone for Box<dyn Solver> {
    fn clone(&self) -> Self {
        self.as_ref().boxed_clone()
    }
}

impl Solution {
    /// The outcome of an iterative solver.
    pub(super) fn of(
        Iteration { iterations, end }: Iteration,
        definiteness: Definiteness,
    ) -> Result<Option<Self>, SolveError> {
        match end {
            End::Converged => Ok(Some(Self { iterations, ..Self::default() })),
            End::NegativeCurvature if definiteness == Definiteness::Required => Ok(None),
            End::Limit | End::NegativeCurvature => {
                Ok(Some(Self { iterations, truncated: true, ..Self::default() }))
            }
            End::NotFinite => Err(SolveError::NotFinite),
        }
    }
}

/// Reason why a linear system has no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SolveError {
    /// The matrix is not positive definite even with this multiple of inertia added.
    NotPositive {
        /// The node in whose unknowns a pivot fails.
        node: usize,
        shift: f64,
    },
    /// The solution is infinite or NaN.
    NotFinite,
    /// The factorisation fails for another reason.
    Linear(LinearError),
}

impl From<LinearError> for SolveError {
    fn from(error: LinearError) -> Self {
        Self::Linear(error)
    }
}
