//! The linear systems of Newton's method, solved in one of several ways.
//!
//! A solver holds whatever form of the second derivatives it works on, so that memory is taken for the chosen one alone. All
//! see the same objective and leave the same direction, up to their tolerance.

mod assembled;
mod cholesky;
mod matrix_free;
mod refined;

use crate::point::Filter;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::linear::conjugate_gradients::{End, Iteration};
use crate::system::linear::refined::RefinedCholesky;
use crate::system::{Body, Pins};

use super::newton::NewtonError;
use super::objective::Objective;
use assembled::Assembled;
use cholesky::Exact;
use matrix_free::MatrixFree;
use refined::Refined;

/// How the linear systems A p = b of Newton's method are solved, b being minus the gradient.
///
/// Norms are Euclidean ones over the free nodes, N, as of [`NewtonReport::residual`](super::NewtonReport::residual): where
/// Newton's method takes whole steps, `tolerance` is about what an iteration leaves of the gradient. It must be between 0 and 1;
/// what is beyond the rounding of the matrix, u ‖A‖ ‖p‖, is not to be had. It holds for the first system of a step; later ones
/// are solved the better the faster the residual r falls, to 0.9 (r/r before)² \[EW96, choice 2\] but not beyond what
/// [`NewtonSettings::tolerance`](super::NewtonSettings::tolerance) asks for, so that Newton's method keeps its fast convergence. A
/// system given up before its tolerance still leaves a direction of descent, and a report counts it as
/// [`truncated`](super::NewtonReport::truncated).
///
/// \[EW96\] Eisenstat, Walker, *Choosing the forcing terms in an inexact Newton method*, 1996.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum LinearSolver {
    /// By the number of elements, as [`LinearSolver::for_elements`] says.
    #[default]
    Automatic,
    /// Sparse Cholesky factorisation in f64.
    ///
    /// As fast as any for bodies of a few thousand elements (`cargo speed-report` shows all of them from a thousand to a
    /// million), and the only one without a tolerance. An indefinite matrix gets inertia until it is definite.
    Cholesky,
    /// A factor in f32, of half the memory and traffic, and conjugate gradients in f64 that it preconditions, until
    /// ‖b − A p‖ ≤ tolerance ‖b‖.
    ///
    /// On one thread the fastest from ten to a hundred thousand elements. Stiffness may have any unit. A factor that fails in
    /// f32 gets a larger diagonal, which costs iterations but no accuracy. The system is given up at negative curvature and
    /// after a hundred iterations; a handful is the rule.
    RefinedCholesky {
        /// Where to stop.
        tolerance: f64,
    },
    /// Conjugate gradients without a matrix, preconditioned by the 3×3 blocks on the diagonal, taken anew with each
    /// linearisation, until ‖b − A p‖ ≤ tolerance ‖b‖.
    ///
    /// For bodies of hundreds of thousands of elements, whose factor does not fit into memory: its own grows with the elements,
    /// about a kilobyte each. Needs the more iterations the stiffer a body is for its time step, the finer and the thinner.
    /// The system is given up at negative curvature, with the direction so far or that of steepest descent in the first
    /// iteration, as in Nocedal and Wright, *Numerical Optimization*, algorithm 7.1.
    ConjugateGradients {
        /// Where to stop.
        tolerance: f64,
        /// After how many iterations to give up.
        max_iterations: usize,
    },
}

impl LinearSolver {
    /// What [`LinearSolver::Automatic`] stands for: [`Cholesky`](Self::Cholesky) up to 10 000 elements,
    /// [`RefinedCholesky`](Self::RefinedCholesky) to 10⁻⁶ up to 100 000, beyond that
    /// [`ConjugateGradients`](Self::ConjugateGradients) to 10⁻³ in at most 1000 iterations.
    ///
    /// This is what `cargo speed-report` finds for compact bodies on one thread; thin ones, whose factors stay sparse, are
    /// served well by a factor beyond these limits.
    #[must_use]
    pub fn for_elements(elements: usize) -> Self {
        match elements {
            ..=10_000 => Self::Cholesky,
            10_001..=100_000 => Self::RefinedCholesky { tolerance: 1e-6 },
            _ => Self::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 },
        }
    }

    /// The rule that it breaks, if it breaks one.
    pub(super) fn broken_rule(&self) -> Option<&'static str> {
        let (tolerance, max_iterations) = match *self {
            Self::Automatic | Self::Cholesky => return None,
            Self::RefinedCholesky { tolerance } => (tolerance, usize::MAX),
            Self::ConjugateGradients { tolerance, max_iterations } => (tolerance, max_iterations),
        };
        if !(tolerance > 0.0 && tolerance < 1.0) {
            Some("the tolerance of the linear solver must be between 0 and 1")
        } else if max_iterations == 0 {
            Some("conjugate gradients need at least one iteration")
        } else {
            None
        }
    }

    /// A solver with all the memory that it will need.
    pub(super) fn set_up(self, body: &Body, pins: &Pins) -> Result<Box<dyn Solver>, LinearError> {
        Ok(match self {
            Self::Automatic => return Self::for_elements(body.elements().len()).set_up(body, pins),
            Self::Cholesky => Box::new(Assembled::<Exact>::new(body, pins, Exact::new)?),
            Self::RefinedCholesky { tolerance } => Box::new(Assembled::new(body, pins, |pattern| {
                Ok(Refined { factor: RefinedCholesky::new(pattern.entries())?, tolerance })
            })?),
            Self::ConjugateGradients { tolerance, max_iterations } => {
                Box::new(MatrixFree::new(body, pins, tolerance, max_iterations))
            }
        })
    }
}

/// What solves the linear systems of a simulation.
pub(crate) trait Solver: Send + Sync {
    /// The nodes that are not pinned, in the order of the unknowns.
    fn free_nodes(&self) -> &[usize];

    /// Whether an element joins two free nodes.
    fn joins(&self, a: usize, b: usize) -> bool;

    /// Evaluates gradients and filtered second derivatives where the energies were evaluated last.
    fn linearise(&mut self, objective: &mut Objective<'_>, filter: Filter) -> Evaluated;

    /// Adds the product of the second derivatives with a displacement of few nodes.
    fn add_product(&mut self, objective: &Objective<'_>, displacement: &[[f64; 3]], total: &mut [[f64; 3]]);

    /// Solves for the direction, zero at pinned nodes; None where the matrix is indefinite and must not be.
    fn solve(
        &mut self,
        objective: &Objective<'_>,
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        demand: Demand,
    ) -> Result<Option<Solution>, NewtonError>;
}

/// What is asked of a solution beside the settings of its solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Demand {
    /// A tolerance that may be tighter than the solver's own.
    pub(crate) tolerance: f64,
    /// Whether an indefinite matrix is to be refused, rather than to be made definite or used as far as it goes.
    pub(crate) definite: bool,
}

/// How a system was solved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Solution {
    /// The multiple of inertia that was added.
    pub(crate) shift: f64,
    pub(crate) iterations: usize,
    /// Whether it was given up before its tolerance.
    pub(crate) truncated: bool,
}

impl Solution {
    /// Of an iteration that has left finite numbers.
    fn of(Iteration { iterations, end }: Iteration, demand: Demand) -> Result<Option<Self>, NewtonError> {
        match end {
            End::Converged => Ok(Some(Self { iterations, ..Self::default() })),
            End::NegativeCurvature if demand.definite => Ok(None),
            End::Limit | End::NegativeCurvature => {
                Ok(Some(Self { iterations, truncated: true, ..Self::default() }))
            }
            End::NotFinite => Err(NewtonError::NotFinite),
        }
    }
}

#[cfg(test)]
mod tests;
