//! Report of a minimisation.

use super::NewtonSettings;
use crate::step::error::NewtonError;

/// Reason why Newton's method stopped, in order from the best.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Convergence {
    /// The gradient, or the remaining distance, fell below the tolerance.
    Tolerance,
    /// All further gain is below the rounding error of the objective, though the slope of a kink may predict
    /// more. If a gradient that does not fit its energy predicts more, the step fails:
    /// [`NewtonError::WrongGradient`].
    Rounding,
    /// The limit of iterations was reached, as always in the mode of one iteration.
    #[default]
    Limit,
}

/// Report of a minimisation, or of all minimisations in a step of several stages.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct NewtonReport {
    /// Reason why it stopped; the worst one of several stages.
    pub convergence: Convergence,
    /// Number of directions found.
    pub iterations: usize,
    /// Norm of the gradient over the free nodes before the first iteration, N; if pins move, after their
    /// motion.
    pub first_residual: f64,
    /// Norm of the gradient evaluated last, N: in the mode of one iteration equal to the first.
    pub residual: f64,
    /// Change of the objective after the motion of the pins, J: never above the rounding error of its
    /// differences.
    pub change: f64,
    /// Length of each step, 1 for a whole one.
    pub step_lengths: Vec<f64>,
    /// Number of line-search trials that left the domain of a material or a term.
    pub refused_trials: usize,
    /// Largest number of elements in an iteration whose tangent the filter changed.
    pub filtered: usize,
    /// Largest number of elements in an iteration whose tangent is at a pole.
    pub bounded: usize,
    /// Largest multiple of inertia, or in statics of a small part of the stiffness, that was added to make
    /// the matrix positive definite; usually 0.
    pub shift: f64,
    /// Number of iterations of the linear solver, over all systems: 0 for
    /// [`LinearSolver::Cholesky`](crate::step::LinearSolver::Cholesky).
    pub linear_iterations: usize,
    /// Number of linear systems that were stopped before their tolerance, at negative curvature or at the
    /// limit of iterations. Their directions descend, but convergence is slower.
    pub truncated: usize,
}

impl NewtonReport {
    pub(crate) fn before(settings: &NewtonSettings) -> Self {
        let step_lengths = Vec::with_capacity(settings.max_iterations.min(8));
        Self { first_residual: f64::NAN, residual: f64::NAN, step_lengths, ..Self::default() }
    }

    /// Merges this report with those of earlier minimisations of the step.
    pub(crate) fn after(self, before: Option<Self>) -> Self {
        let Some(before) = before else { return self };
        let mut step_lengths = before.step_lengths;
        step_lengths.extend(self.step_lengths);
        Self {
            convergence: before.convergence.max(self.convergence),
            iterations: before.iterations + self.iterations,
            first_residual: before.first_residual,
            residual: self.residual,
            change: before.change + self.change,
            step_lengths,
            refused_trials: before.refused_trials + self.refused_trials,
            filtered: before.filtered.max(self.filtered),
            bounded: before.bounded.max(self.bounded),
            shift: before.shift.max(self.shift),
            linear_iterations: before.linear_iterations + self.linear_iterations,
            truncated: before.truncated + self.truncated,
        }
    }

    /// Records the norm of a gradient; returns true if it is small enough.
    pub(super) fn note_residual(
        &mut self,
        residual: f64,
        settings: &NewtonSettings,
    ) -> Result<bool, NewtonError> {
        if !residual.is_finite() {
            return Err(NewtonError::NotFinite);
        }
        if self.first_residual.is_nan() {
            self.first_residual = residual;
        }
        self.residual = residual;
        let converged = residual <= settings.tolerance * self.first_residual;
        if converged {
            self.convergence = Convergence::Tolerance;
        }
        Ok(converged)
    }
}
