//! Settings of Newton's method.

use piola::point::Filter;

use crate::step::solver::LinearSolver;

/// Settings of Newton's method.
///
/// ```
/// use piola_bodies::step::{LinearSolver, NewtonSettings, SimulationSettings};
///
/// let newton = NewtonSettings { linear: LinearSolver::Cholesky, tolerance: 1e-9, ..Default::default() };
/// let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], newton, ..Default::default() };
/// assert_eq!(settings.newton.max_iterations, NewtonSettings::default().max_iterations);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct NewtonSettings {
    /// Treatment of negative eigenvalues of dP/dF.
    pub filtering: Filtering,
    /// Maximum number of iterations; 1 is the mode of the paper.
    pub max_iterations: usize,
    /// Relative tolerance of the gradient: the share of its first norm at which the minimum counts as found.
    pub tolerance: f64,
    /// Tolerance relative to the time error of the step: the share of it at which the minimum counts as found
    /// as well; 0 for the tolerance alone. Has no effect in statics.
    ///
    /// The error is judged by accelerations: by τ² |a|, or by τ² times the change of a for methods of higher
    /// order, for the length τ of a stage. The error of the minimum is judged by the displacements d of two
    /// iterations, as q/(1 − q) |d| with their ratio q \[HW96, IV.8\].
    ///
    /// \[HW96\] Hairer, Wanner, *Solving Ordinary Differential Equations II*, 1996.
    pub error_share: f64,
    /// Solver of the linear systems.
    pub linear: LinearSolver,
}

/// Choice of the filter in each iteration of Newton's method.
///
/// Without a filter Newton's method converges fastest, but its matrix is positive definite only near a
/// minimum. Clamped eigenvalues are safe everywhere; absolute ones are safer for an energy that curves
/// downwards, and slower otherwise. So the choice may depend on the matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Filtering {
    /// One filter in all iterations.
    Always(Filter),
    /// No filter if the matrix is positive definite without one, and clamped eigenvalues if it is not, which
    /// costs a second linearisation and factorisation. Compared with clamping always, it takes half the
    /// iterations or fewer if steps are solved to their end (`cargo speed-report --only steps`).
    OnDemand,
}

impl Default for NewtonSettings {
    /// Full Newton to a relative 10⁻⁶ from the positions before, with eigenvalues clamped if the matrix
    /// requires it and a linear solver chosen by the size of the body.
    fn default() -> Self {
        Self {
            filtering: Filtering::OnDemand,
            max_iterations: 50,
            tolerance: 1e-6,
            error_share: 0.0,
            linear: LinearSolver::Automatic,
        }
    }
}

impl NewtonSettings {
    /// One iteration per step, as in the paper, with clamped eigenvalues: the gradient after it is not
    /// evaluated.
    #[must_use]
    pub fn single() -> Self {
        Self { filtering: Filtering::Always(Filter::Clamp), max_iterations: 1, ..Self::default() }
    }
}
