//! Solvers of the linear systems of Newton's method.
//!
//! Memory is taken for the form of the second derivatives that the chosen solver works on. All see the same
//! objective and find the same direction, up to their tolerance.

mod assembled;
mod conjugate;
mod interface;
mod one_machine;
mod preconditioner;
mod user_defined;

pub use interface::{Machine, Solution, System};
pub(super) use one_machine::Choice;
pub use one_machine::OneMachine;
pub use preconditioner::Preconditioner;
pub use user_defined::SparseSolver;

/// Solver of the linear systems A p = b of Newton's method, b being minus the gradient.
///
/// Norms are Euclidean ones over the free nodes, N, as for
/// [`NewtonReport::residual`](super::NewtonReport::residual): where Newton's method takes whole steps,
/// `tolerance` is about the share of the gradient that an iteration leaves. It must be between 0 and 1;
/// residuals below the rounding of the matrix, u ‖A‖ ‖p‖, cannot be reached. It holds for the first system of
/// a step; later ones are solved the better the faster the residual r falls, to 0.9 (r/r before)² \[EW96,
/// choice 2\] but not beyond the requirement of
/// [`NewtonSettings::tolerance`](super::NewtonSettings::tolerance), so that Newton's method keeps its fast
/// convergence. A system given up before its tolerance still leaves a direction of descent, and a report
/// counts it as [`truncated`](super::NewtonReport::truncated).
///
/// \[EW96\] Eisenstat, Walker, *Choosing the forcing terms in an inexact Newton method*, 1996.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum LinearSolver {
    /// Solver chosen by the number of elements: `Cholesky` up to 4000 elements, beyond that and without the
    /// feature `faer` [`ConjugateGradients`](Self::ConjugateGradients) to 10⁻³ in at most 1000 iterations.
    ///
    /// The limit is that of compact bodies on one thread (`cargo speed-report --only growth`); thin ones,
    /// whose factors stay sparse, are faster with a factor beyond it.
    #[default]
    Automatic,
    /// Sparse Cholesky factorisation, with the feature `faer`.
    ///
    /// The fastest solver for bodies of up to a few thousand elements (`cargo speed-report --only growth`),
    /// and the only one without a tolerance. An indefinite matrix gets inertia until it is definite.
    #[cfg(feature = "faer")]
    Cholesky,
    /// Conjugate gradients until ‖b − A p‖ ≤ tolerance ‖b‖, preconditioned by the 3×3 blocks on the diagonal
    /// or, if these take many iterations, by multigrid (smoothed aggregation), whose iterations hardly grow
    /// with the number of elements.
    ///
    /// The fastest solver from some thousand elements on. Memory grows linearly with the elements: about a
    /// kilobyte each, and as much again if levels of multigrid are made. The choice between the two
    /// preconditioners depends on the matrix and on numbers of iterations, so that each run makes the same.
    /// The system is given up at negative curvature, with the direction so far or that of steepest descent in
    /// the first iteration, as in Nocedal and Wright, *Numerical Optimization*, algorithm 7.1.
    ConjugateGradients {
        /// Relative residual ‖b − A p‖/‖b‖ at which to stop.
        tolerance: f64,
        /// Maximum number of iterations.
        max_iterations: usize,
    },
}

impl LinearSolver {
    /// The solver that [`LinearSolver::Automatic`] chooses.
    pub(super) fn for_elements(elements: usize) -> Self {
        match elements {
            #[cfg(feature = "faer")]
            ..=4000 => Self::Cholesky,
            _ => Self::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 },
        }
    }

    /// The rule that these settings break, if any.
    pub(super) fn broken_rule(&self) -> Option<&'static str> {
        let Self::ConjugateGradients { tolerance, max_iterations } = *self else { return None };
        if !(tolerance > 0.0 && tolerance < 1.0) {
            Some("the tolerance of the linear solver must be between 0 and 1")
        } else if max_iterations == 0 {
            Some("conjugate gradients need at least one iteration")
        } else {
            None
        }
    }
}

#[cfg(all(test, feature = "faer"))]
mod tests;
