//! Newton's method with filtered second derivatives and a line search.
//!
//! This module knows neither masses nor springs: it sees an objective of nodal positions.

use std::fmt;

use crate::point::Filter;
use crate::system::element::Survey;
use crate::system::linear::LinearError;

use super::line_search::{LineSearchSettings, Outcome, backtrack};
use super::objective::{Objective, product};
use super::solver::{LinearSolver, Solver};

/// How to minimise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonSettings {
    /// What happens to negative eigenvalues of dP/dF.
    pub filter: Filter,
    /// After how many iterations to stop; 1 is the mode of the paper.
    pub max_iterations: usize,
    /// Where the gradient has fallen to this part of its first norm, the minimum is found.
    pub tolerance: f64,
    /// How linear systems are solved.
    pub linear: LinearSolver,
}

impl Default for NewtonSettings {
    /// Full Newton to a relative 10⁻⁶ with clamped eigenvalues and a Cholesky factorisation.
    fn default() -> Self {
        Self { filter: Filter::Clamp, max_iterations: 50, tolerance: 1e-6, linear: LinearSolver::Cholesky }
    }
}

impl NewtonSettings {
    /// One iteration per step, as in the paper: the gradient after it is not even looked at.
    #[must_use]
    pub fn single() -> Self {
        Self { max_iterations: 1, ..Self::default() }
    }
}

/// Why the iteration ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// The gradient fell below the tolerance.
    Tolerance,
    /// What is left to gain is below the rounding error of the objective.
    Rounding,
    /// The limit of iterations is reached: the rule in the mode of one iteration.
    Limit,
}

/// What the iteration did.
#[derive(Clone, Debug, PartialEq)]
pub struct NewtonReport {
    /// Why it ended.
    pub convergence: Convergence,
    /// How many linear systems were solved.
    pub iterations: usize,
    /// Norm of the gradient over the free nodes before the first iteration, N. Where pins move, right after they have.
    pub first_residual: f64,
    /// The same where it was evaluated last, N: in the mode of one iteration equal to the first.
    pub residual: f64,
    /// Length of each step, 1 for a whole one.
    pub step_lengths: Vec<f64>,
    /// Trials of line searches that left the domain of a material.
    pub refused_trials: usize,
    /// Largest number of elements in an iteration whose tangent the filter changed.
    pub filtered: usize,
    /// Largest number of elements in an iteration whose tangent is at a pole.
    pub bounded: usize,
    /// Largest multiple of inertia that had to be added for a positive definite matrix; 0 as a rule.
    pub shift: f64,
    /// How many iterations the linear solver took, over all systems: 0 for [`LinearSolver::Cholesky`].
    pub linear_iterations: usize,
    /// How many linear systems were given up before their tolerance, for negative curvature or at the limit of iterations.
    /// Their directions are as good as any for a line search, but do not make for fast convergence.
    pub truncated: usize,
}

/// Memory of the iteration.
pub(crate) struct Workspace {
    pub(crate) solver: Box<dyn Solver>,
    gradient: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
}

impl Workspace {
    pub(crate) fn new(nodes: usize, solver: Box<dyn Solver>) -> Self {
        Self {
            solver,
            gradient: vec![[0.0; 3]; nodes],
            direction: vec![[0.0; 3]; nodes],
            trial: vec![[0.0; 3]; nodes],
        }
    }

    /// Norm of the gradient over the free nodes.
    fn free_norm(&self) -> f64 {
        let square = |g: [f64; 3]| g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        self.solver.free_nodes().iter().map(|&node| square(self.gradient[node])).sum::<f64>().sqrt()
    }
}

/// Moves `x` towards a minimum, the pinned nodes by `pins_move` (zero elsewhere) where it is given.
///
/// Energies must have been evaluated at `x`, and on success they have been again, with the survey that is returned.
///
/// Moving pins enter the first linear system with their displacement d: K p = −g − K d. Its tangent is that of the
/// state before they move, when elements next to them are not yet distorted; the line search starts behind the move.
pub(crate) fn minimize(
    objective: &mut Objective<'_>,
    workspace: &mut Workspace,
    x: &mut [[f64; 3]],
    pins_move: Option<&[[f64; 3]]>,
    mut survey: Survey,
    settings: &NewtonSettings,
    line_search: &LineSearchSettings,
) -> Result<(NewtonReport, Survey), NewtonError> {
    inadmissible(&survey).map_or(Ok(()), |element| Err(NewtonError::Inadmissible { element }))?;
    let mut pins_move = pins_move;
    let mut report = NewtonReport {
        convergence: Convergence::Limit,
        iterations: 0,
        first_residual: f64::NAN,
        residual: f64::NAN,
        step_lengths: Vec::with_capacity(settings.max_iterations.min(8)),
        refused_trials: 0,
        filtered: 0,
        bounded: 0,
        shift: 0.0,
        linear_iterations: 0,
        truncated: 0,
    };
    // Whether the step before changed the objective by no more than noise.
    let mut by_slope = false;
    while report.iterations < settings.max_iterations {
        // After the first iteration the gradient alone, far cheaper than the stiffness, may end the loop.
        if report.iterations > 0 {
            objective.elastic.evaluate_gradients(objective.body);
            objective.gradient(x, &mut workspace.gradient);
            let before = report.residual;
            if report.note_residual(workspace.free_norm(), settings)? {
                break;
            }
            if by_slope && report.residual > 0.5 * before {
                report.convergence = Convergence::Rounding;
                break;
            }
        }
        let tangents = workspace.solver.linearise(objective, settings.filter);
        inadmissible(&tangents).map_or(Ok(()), |element| Err(NewtonError::Inadmissible { element }))?;
        report.filtered = report.filtered.max(tangents.filtered);
        report.bounded = report.bounded.max(tangents.bounded);
        objective.gradient(x, &mut workspace.gradient);
        match pins_move {
            Some(d) => workspace.solver.add_product(objective, d, &mut workspace.gradient),
            None if report.iterations == 0 && report.note_residual(workspace.free_norm(), settings)? => {
                break;
            }
            None => {}
        }
        let Workspace { solver, gradient, direction, .. } = workspace;
        let solution = solver.solve(objective, gradient, direction)?;
        report.shift = report.shift.max(solution.shift);
        report.linear_iterations += solution.iterations;
        report.truncated += usize::from(solution.truncated);
        report.iterations += 1;

        if let Some(d) = pins_move.take() {
            for (x, d) in x.iter_mut().zip(d) {
                for c in 0..3 {
                    x[c] += d[c];
                }
            }
            survey = objective.evaluate(x);
            inadmissible(&survey).map_or(Ok(()), |element| Err(NewtonError::PinsMoveTooFar { element }))?;
            objective.elastic.evaluate_gradients(objective.body);
            objective.gradient(x, &mut workspace.gradient);
            report.note_residual(workspace.free_norm(), settings)?;
            if product(&workspace.gradient, &workspace.direction) >= 0.0 {
                // The tangent before the move says nothing about the state behind it; the next iteration takes its own.
                report.step_lengths.push(0.0);
                continue;
            }
        }
        let slope = product(&workspace.gradient, &workspace.direction);
        if !slope.is_finite() {
            return Err(NewtonError::NotFinite);
        }
        let outcome = {
            let Workspace { direction, trial, gradient, .. } = workspace;
            backtrack(&mut objective.along(x, direction, trial, gradient), slope, line_search)
        };
        match outcome {
            Outcome::Accepted { step, refused, by_slope: slope_decided, .. } => {
                by_slope = slope_decided;
                x.copy_from_slice(&workspace.trial);
                report.step_lengths.push(step);
                report.refused_trials += refused;
                survey = objective.elastic.survey();
            }
            Outcome::Failed { step, refused } => {
                report.refused_trials += refused;
                survey = objective.evaluate(x);
                if -slope > objective.elastic.difference_noise(objective.body) {
                    return Err(NewtonError::LineSearch { step, refused, residual: report.residual });
                }
                report.convergence = Convergence::Rounding;
                break;
            }
        }
    }
    Ok((report, survey))
}

impl NewtonReport {
    /// Keeps the norm of a gradient and says whether it is small enough.
    fn note_residual(&mut self, residual: f64, settings: &NewtonSettings) -> Result<bool, NewtonError> {
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

/// The element that has no meaningful energy, if there is one.
fn inadmissible(survey: &Survey) -> Option<usize> {
    (!survey.is_admissible()).then_some(survey.first_offender.unwrap_or_default())
}

/// Why there is no better state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NewtonError {
    /// An element is outside the domain of its material, or not finite, from the start.
    Inadmissible {
        /// Its tag.
        element: usize,
    },
    /// The motion of the pins alone takes an element out of the domain of its material.
    PinsMoveTooFar {
        /// Its tag.
        element: usize,
    },
    /// The matrix is not positive definite whatever is added.
    NotPositive {
        /// The node in whose unknowns a pivot fails.
        node: usize,
        /// The multiple of inertia added last.
        shift: f64,
    },
    /// A gradient, a direction or a slope is infinite or NaN.
    NotFinite,
    /// No step along a direction of descent decreases the objective.
    LineSearch {
        /// The smallest step tried.
        step: f64,
        /// How many trials left the domain of a material.
        refused: usize,
        /// Norm of the gradient, N.
        residual: f64,
    },
    /// The linear solver fails for another reason.
    Linear(LinearError),
}

impl fmt::Display for NewtonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Inadmissible { element } => {
                write!(f, "element {element} is outside the domain of its material before the step")
            }
            Self::PinsMoveTooFar { element } => write!(
                f,
                "the motion of the pins takes element {element} out of the domain of its material; take shorter time steps"
            ),
            Self::NotPositive { node, shift } => write!(
                f,
                "the matrix is not positive definite at node {node} (from 0), even with {shift:e} times the inertia added"
            ),
            Self::NotFinite => write!(
                f,
                "a force or the Newton direction is not finite; the motion leaves the range of the numbers"
            ),
            Self::LineSearch { step, refused, residual } => write!(
                f,
                "no step down to {step:e} of the Newton direction decreases the energy (residual {residual:e} N, \
                 {refused} trials outside the domain of a material)"
            ),
            Self::Linear(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for NewtonError {}
