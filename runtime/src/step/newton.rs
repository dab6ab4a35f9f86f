//! Newton's method with filtered second derivatives and a line search.
//!
//! This module knows neither masses nor terms: it sees an objective of nodal positions.

use std::fmt;

use crate::message::number;
use crate::point::Filter;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::{Body, LinearError, Pins};

use super::filtering::{Filtering, Model};
use super::line_search::{Line, Outcome, Search};
use super::objective::{Objective, product};
use super::solver::{Choice, Definiteness, LinearSolver, SolveError, Solver};
use super::term::NodeBlocks;

/// Settings of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct NewtonSettings {
    /// Treatment of negative eigenvalues of dP/dF.
    pub filtering: Filtering,
    /// Positions from which the iteration starts.
    pub start: InitialGuess,
    /// Number of iterations after which to stop; 1 is the mode of the paper.
    pub max_iterations: usize,
    /// Share of the first gradient's norm at which the minimum counts as found.
    pub tolerance: f64,
    /// Share of the error in time that a step has anyway at which the minimum counts as found as well; 0 for
    /// the tolerance alone. Has no effect in statics and on the energy–momentum method.
    ///
    /// The error is judged by accelerations: by τ² |a|, or by τ² times the change of a of methods of higher
    /// order, for the length τ of a stage. The error of the minimum is judged by the displacements d of two
    /// iterations, as q/(1 − q) |d| with their ratio q \[HW96, IV.8\].
    ///
    /// \[HW96\] Hairer, Wanner, *Solving Ordinary Differential Equations II*, 1996.
    pub error_share: f64,
    /// Solver of the linear systems.
    pub linear: LinearSolver,
}

impl Default for NewtonSettings {
    /// Full Newton to a relative 10⁻⁶ from the positions before, with eigenvalues clamped where the matrix
    /// demands it and a linear solver chosen by the size of the body.
    fn default() -> Self {
        Self {
            filtering: Filtering::OnDemand,
            start: InitialGuess::Position,
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

crate::chained::chained!(NewtonSettings {
    with_filtering(filtering: Filtering),
    with_start(start: InitialGuess),
    with_max_iterations(max_iterations: usize),
    with_tolerance(tolerance: f64),
    with_error_share(error_share: f64),
    with_linear(linear: LinearSolver),
});

/// Positions from which an iteration starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum InitialGuess {
    /// The current positions.
    #[default]
    Position,
    /// The positions to which the velocities would take the body, if they are admissible and no worse. The
    /// first residual, to which the tolerance is relative, is then taken there. Equal to `Position` in
    /// statics and where pins move.
    Velocity,
    /// The positions to which velocities and the accelerations of the stage or step before would take the
    /// body, otherwise as `Velocity`: closer to where smooth motions go.
    Acceleration,
}

/// Reason why Newton's method stopped, from the best on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Convergence {
    /// The gradient, or what was left to go, fell below the tolerance.
    Tolerance,
    /// All further gain is below the rounding error of the objective.
    Rounding,
    /// The limit of iterations is reached, as always in the mode of one iteration.
    Limit,
}

/// Report of a minimisation, or of all those of a step of several stages together.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct NewtonReport {
    /// Reason why it stopped; the worst one of several stages.
    pub convergence: Convergence,
    /// Number of directions that were found.
    pub iterations: usize,
    /// Norm of the gradient over the free nodes before the first iteration, N. Where pins move, right after
    /// they have.
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
    /// Largest multiple of inertia, or in statics of a small part of the stiffness, that had to be added for
    /// a positive definite matrix; 0 as a rule.
    pub shift: f64,
    /// Number of iterations of the linear solver, over all systems: 0 for [`LinearSolver::Cholesky`].
    pub linear_iterations: usize,
    /// Number of linear systems that were given up before their tolerance, for negative curvature or at the
    /// limit of iterations. Their directions descend, but do not make for fast convergence.
    pub truncated: usize,
}

/// Memory of Newton's method.
#[derive(Clone)]
pub(crate) struct NewtonWorkspace {
    solver: Box<dyn Solver>,
    choice: Choice,
    pins: Pins,
    pub(super) model: Option<Model>,
    gradient: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
}

impl NewtonWorkspace {
    /// Allocates the memory for a body with these pins.
    pub(crate) fn new(
        body: &Body,
        pins: &Pins,
        choice: Choice,
        filtering: Filtering,
    ) -> Result<Self, LinearError> {
        let nodes = body.rest().len();
        Ok(Self {
            solver: choice.set_up(body, pins, &[])?,
            choice,
            pins: pins.clone(),
            model: filtering.model(body),
            gradient: vec![[0.0; 3]; nodes],
            direction: vec![[0.0; 3]; nodes],
            trial: vec![[0.0; 3]; nodes],
        })
    }

    /// Whether the linear solver is a caller's own.
    pub(super) fn has_own_solver(&self) -> bool {
        matches!(self.choice, Choice::Own(_))
    }

    /// Replaces the pins, with a solver that is set up anew where the old one cannot serve.
    pub(super) fn set_pins(&mut self, body: &Body, pins: &Pins) -> Result<(), LinearError> {
        if !self.solver.set_pins(pins) {
            self.solver = self.choice.set_up(body, pins, &[])?;
        }
        self.pins = pins.clone();
        Ok(())
    }

    /// Sets the solver up anew if the terms' blocks join nodes that its matrix does not.
    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let is_free = |node: &usize| self.pins.nodes().binary_search(node).is_err();
        let is_missing = |[a, b]: &[usize; 2]| is_free(a) && is_free(b) && !self.solver.joins(*a, *b);
        if blocks.pairs().any(|pair| is_missing(&pair)) {
            let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
            self.solver = self.choice.set_up(body, &self.pins, &pairs)?;
        }
        Ok(())
    }

    /// The nodes that are not pinned.
    pub(super) fn free_nodes(&self) -> &[usize] {
        self.solver.free_nodes()
    }

    /// Norm of the gradient over the free nodes.
    fn free_norm(&self) -> f64 {
        let square = |g: [f64; 3]| g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        self.solver.free_nodes().iter().map(|&node| square(self.gradient[node])).sum::<f64>().sqrt()
    }
}

/// Moves `x` towards a minimum, the pinned nodes by `pins_move` (zero elsewhere) where it is given.
///
/// Energies must have been evaluated at `x`, and on success they have been again, with the survey that is
/// returned.
pub(crate) fn minimize(
    objective: &mut Objective<'_>,
    workspace: &mut NewtonWorkspace,
    x: &mut [[f64; 3]],
    pins_move: Option<&[[f64; 3]]>,
    survey: Evaluated,
    settings: &NewtonSettings,
    line_search: Search<'_>,
) -> Result<(NewtonReport, Evaluated), NewtonError> {
    demand_admissible(&survey, objective.body, objective.elastic)?;
    if let Some(term) = objective.terms.refusing(x) {
        return Err(NewtonError::TermRefuses { term });
    }
    workspace.solver.begin();
    let report = NewtonReport::before(settings);
    Iteration { objective, workspace, settings, line_search, survey, report, ratio: None, moved: None }
        .run(x, pins_move)
}

/// A minimisation under way.
struct Iteration<'a, 'b> {
    objective: &'a mut Objective<'b>,
    workspace: &'a mut NewtonWorkspace,
    settings: &'a NewtonSettings,
    line_search: Search<'a>,
    /// Survey of the energies evaluated last.
    survey: Evaluated,
    report: NewtonReport,
    /// Ratio of actual to predicted decrease in the step before, where a prediction was made.
    ratio: Option<f64>,
    /// The largest displacement of a node in the iteration before, m.
    moved: Option<f64>,
}

/// Outcome of a line search.
#[derive(PartialEq, Eq)]
enum Progress {
    Decrease,
    /// The objective changed by no more than noise; the slope has decided.
    BelowNoise,
    /// Nothing is left to gain but noise.
    Nothing,
}

impl Iteration<'_, '_> {
    fn run(
        mut self,
        x: &mut [[f64; 3]],
        mut pins_move: Option<&[[f64; 3]]>,
    ) -> Result<(NewtonReport, Evaluated), NewtonError> {
        let share = match self.settings.start {
            InitialGuess::Position => None,
            InitialGuess::Velocity => Some(0.0),
            InitialGuess::Acceleration => Some(1.0),
        };
        if let Some(share) = share.filter(|_| pins_move.is_none()) {
            self.extrapolate(x, share);
        }
        // Iterations in a row that have gained nothing beyond noise, neither in the objective nor in the
        // gradient.
        let mut idle = 0;
        let mut progress = Progress::Decrease;
        // Tolerance of the second linear system and later ones.
        let mut forcing = 1.0;
        while self.report.iterations < self.settings.max_iterations {
            // After the first iteration the gradient alone, far cheaper than the stiffness, may end the loop.
            if self.report.iterations > 0 {
                let before = self.report.residual;
                if self.note_gradient(x)? {
                    break;
                }
                let is_idle = progress == Progress::BelowNoise && self.report.residual > 0.9 * before;
                idle = if is_idle { idle + 1 } else { 0 };
                // Twice, since the gradient of a filtered iteration need not fall each time.
                if idle == 2 {
                    self.report.convergence = Convergence::Rounding;
                    break;
                }
                forcing = self.forcing(before);
            }
            if !self.find_direction(x, pins_move, forcing)? {
                break;
            }
            if let Some(d) = pins_move.take()
                && !self.move_pins(x, d)?
            {
                // The tangent before the move says nothing about the state behind it; the next iteration
                // takes its own.
                self.report.step_lengths.push(0.0);
                continue;
            }
            progress = self.search(x)?;
            if progress == Progress::Nothing {
                self.report.convergence = Convergence::Rounding;
                break;
            }
            if self.is_close(x) {
                self.report.convergence = Convergence::Tolerance;
                break;
            }
        }
        Ok((self.report, self.survey))
    }

    /// Moves `x` on by the velocities and a share of the accelerations before, where that is admissible and
    /// does not increase the objective.
    fn extrapolate(&mut self, x: &mut [[f64; 3]], share: f64) {
        let NewtonWorkspace { solver, gradient, direction, trial, .. } = &mut *self.workspace;
        direction.fill([0.0; 3]);
        for &node in solver.free_nodes() {
            direction[node] = self.objective.quadratic.stage.extrapolation(node, x[node], share);
        }
        let change = self.objective.along(x, direction, trial, gradient).change(1.0);
        match change {
            Some(change) if change.difference <= 0.0 => {
                self.report.change += change.difference;
                x.copy_from_slice(trial);
                self.survey = self.objective.elastic.survey();
            }
            _ => self.survey = self.objective.evaluate(x),
        }
    }

    /// Whether what is left to go is small beside the error of the step, after the last displacement.
    fn is_close(&mut self, x: &[[f64; 3]]) -> bool {
        if self.settings.error_share == 0.0 {
            return false;
        }
        let step = self.report.step_lengths.last().copied().unwrap_or(0.0);
        let square = |d: &[f64; 3]| d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let squares = self.workspace.direction.iter().map(square);
        let moved = step * squares.fold(0.0, f64::max).sqrt();
        let ratio = self.moved.map_or(0.5, |before| moved / before);
        self.moved = Some(moved);
        let left = ratio / (1.0 - ratio) * moved;
        let enough = self.settings.error_share * self.objective.quadratic.stage.error_scale(x);
        step == 1.0 && ratio < 1.0 && left <= enough && enough.is_finite()
    }

    /// Evaluates the gradient; true where it is small enough.
    fn note_gradient(&mut self, x: &[[f64; 3]]) -> Result<bool, NewtonError> {
        self.objective.elastic.evaluate_gradients(self.objective.body);
        self.objective.gradient(x, &mut self.workspace.gradient);
        self.report.note_residual(self.workspace.free_norm(), self.settings)
    }

    /// A relative tolerance for the next system [EW96, choice 2], no tighter than the last one of all needs
    /// to be.
    fn forcing(&self, before: f64) -> f64 {
        let NewtonReport { residual, first_residual, .. } = self.report;
        let enough = 0.5 * self.settings.tolerance * first_residual / residual;
        (0.9 * (residual / before).powi(2)).max(enough).max(f64::EPSILON)
    }

    /// Linearises and solves for a direction; false where the gradient is small enough already.
    ///
    /// Moving pins enter the first linear system with their displacement d: K p = −g − K d. Its tangent is
    /// that of the state before they move, when elements next to them are not yet distorted; the line search
    /// starts behind the move.
    fn find_direction(
        &mut self,
        x: &[[f64; 3]],
        pins_move: Option<&[[f64; 3]]>,
        tolerance: f64,
    ) -> Result<bool, NewtonError> {
        let filtering = self.settings.filtering;
        self.linearise(filtering.choice(self.ratio), x, pins_move)?;
        if pins_move.is_none()
            && self.report.iterations == 0
            && self.report.note_residual(self.workspace.free_norm(), self.settings)?
        {
            return Ok(false);
        }
        let on_demand = filtering == Filtering::OnDemand;
        let definiteness = if on_demand { Definiteness::Required } else { Definiteness::Optional };
        if !self.solve(x, tolerance, definiteness)? {
            self.linearise(Filter::Clamp, x, pins_move)?;
            self.solve(x, tolerance, Definiteness::Optional)?;
        }
        self.report.iterations += 1;
        Ok(true)
    }

    /// Evaluates the gradient and the filtered second derivatives.
    fn linearise(
        &mut self,
        filter: Filter,
        x: &[[f64; 3]],
        pins_move: Option<&[[f64; 3]]>,
    ) -> Result<(), NewtonError> {
        self.objective.terms.linearise(x, self.objective.blocks);
        if let Some(node) = self.objective.blocks.missing() {
            return Err(NewtonError::NoSuchNode { node, nodes: x.len() });
        }
        self.workspace.join(self.objective.body, self.objective.blocks)?;
        let tangents = self.workspace.solver.linearise(self.objective, filter);
        demand_admissible(&tangents, self.objective.body, self.objective.elastic)?;
        self.report.filtered = self.report.filtered.max(tangents.survey.filtered);
        self.report.bounded = self.report.bounded.max(tangents.survey.bounded);
        let NewtonWorkspace { solver, gradient, .. } = &mut *self.workspace;
        self.objective.gradient(x, gradient);
        if let Some(d) = pins_move {
            solver.add_product(self.objective, d, gradient);
        }
        Ok(())
    }

    /// Solves for the direction; false if the matrix is indefinite and definiteness is required.
    fn solve(
        &mut self,
        x: &[[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<bool, NewtonError> {
        let NewtonWorkspace { solver, gradient, direction, .. } = &mut *self.workspace;
        let solution = solver.solve(self.objective, x, gradient, direction, tolerance, definiteness)?;
        let Some(solution) = solution else { return Ok(false) };
        self.report.shift = self.report.shift.max(solution.shift);
        self.report.linear_iterations += solution.iterations;
        self.report.truncated += usize::from(solution.truncated);
        Ok(true)
    }

    /// Moves the pins; false where the direction, found before they moved, does not descend behind the move.
    fn move_pins(&mut self, x: &mut [[f64; 3]], d: &[[f64; 3]]) -> Result<bool, NewtonError> {
        for (x, d) in x.iter_mut().zip(d) {
            for c in 0..3 {
                x[c] += d[c];
            }
        }
        self.survey = self.objective.evaluate(x);
        inadmissible(&self.survey, self.objective.body)
            .map_or(Ok(()), |element| Err(NewtonError::PinsMoveTooFar { element }))?;
        if let Some(term) = self.objective.terms.refusing(x) {
            return Err(NewtonError::TermRefuses { term });
        }
        self.note_gradient(x)?;
        Ok(product(&self.workspace.gradient, &self.workspace.direction) < 0.0)
    }

    /// Moves `x` along the direction as far as it is good.
    fn search(&mut self, x: &mut [[f64; 3]]) -> Result<Progress, NewtonError> {
        let NewtonWorkspace { model, direction, trial, gradient, .. } = &mut *self.workspace;
        let slope = product(gradient, direction);
        if !slope.is_finite() {
            return Err(NewtonError::NotFinite);
        }
        if let Some(model) = model {
            model.take(self.objective, slope, direction, trial);
        }
        let first = self.objective.terms.longest_step(x, direction);
        let mut line = self.objective.along(x, direction, trial, gradient);
        let outcome = self.line_search.run(&mut line, first, slope);
        drop(line);
        match outcome {
            Outcome::Accepted { step, difference, refused, by_slope, .. } => {
                x.copy_from_slice(trial);
                self.ratio = model.as_ref().map(|model| model.ratio(step, difference));
                self.report.step_lengths.push(step);
                self.report.refused_trials += refused;
                self.report.change += difference;
                self.survey = self.objective.elastic.survey();
                Ok(if by_slope { Progress::BelowNoise } else { Progress::Decrease })
            }
            Outcome::Failed { step, refused } => {
                self.report.refused_trials += refused;
                self.survey = self.objective.evaluate(x);
                if -slope > self.objective.noise(x) {
                    let residual = self.report.residual;
                    return Err(NewtonError::LineSearch { step, refused, residual });
                }
                Ok(Progress::Nothing)
            }
        }
    }
}

impl NewtonReport {
    /// The report before the first iteration.
    pub(super) fn before(settings: &NewtonSettings) -> Self {
        Self {
            convergence: Convergence::Limit,
            iterations: 0,
            first_residual: f64::NAN,
            residual: f64::NAN,
            change: 0.0,
            step_lengths: Vec::with_capacity(settings.max_iterations.min(8)),
            refused_trials: 0,
            filtered: 0,
            bounded: 0,
            shift: 0.0,
            linear_iterations: 0,
            truncated: 0,
        }
    }

    /// The report of this minimisation and those before it in a step.
    pub(super) fn after(self, before: Option<Self>) -> Self {
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

    /// Keeps the norm of a gradient; true where it is small enough.
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

/// Checks that all elements are admissible where the energies were evaluated last.
pub(super) fn demand_admissible(
    survey: &Evaluated,
    body: &Body,
    elastic: &Elastic,
) -> Result<(), NewtonError> {
    let Some(element) = inadmissible(survey, body) else { return Ok(()) };
    if survey.survey.refused == 0 {
        return Err(NewtonError::ElementNotFinite { element });
    }
    let mut all = body.elements().iter().zip(elastic.stretches());
    let stretches =
        all.find(|(other, _)| other.tag == element).map_or([f64::NAN; 3], |(_, stretches)| stretches);
    Err(NewtonError::Inadmissible { element, stretches })
}

/// Tag of the first element without a meaningful energy, if any.
pub(super) fn inadmissible(evaluated: &Evaluated, body: &Body) -> Option<usize> {
    evaluated.survey.first.map(|element| body.elements()[element].tag)
}

/// Reason why Newton's method failed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum NewtonError {
    /// An element is outside the domain of its material at the start.
    Inadmissible {
        /// Tag of the element.
        element: usize,
        /// Its principal stretches; NaN if unknown.
        stretches: [f64; 3],
    },
    /// The energy, a force or the stiffness of an element is infinite or NaN at the start, although its
    /// material admits its deformation.
    ElementNotFinite {
        /// Tag of the element.
        element: usize,
    },
    /// An element is inverted, before or after the step, which the energy–momentum method does not allow.
    Inverted {
        /// Tag of the element.
        element: usize,
    },
    /// The motion of the pins alone takes an element out of the domain of its material.
    PinsMoveTooFar {
        /// Tag of the element.
        element: usize,
    },
    /// A term has no energy before the step, or where the pins move.
    TermRefuses {
        /// Index of the term, from 0.
        term: usize,
    },
    /// A term names a node that does not exist.
    NoSuchNode {
        /// The node, from 0.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// The matrix is not positive definite with any multiple of inertia added.
    NotPositive {
        /// The node in whose unknowns a pivot fails.
        node: usize,
        /// The largest multiple of inertia that was tried.
        shift: f64,
    },
    /// A gradient, a direction or a slope is infinite or NaN.
    NotFinite,
    /// No step along a direction of descent decreases the objective.
    LineSearch {
        /// The smallest step tried.
        step: f64,
        /// Number of trials that left the domain of a material.
        refused: usize,
        /// Norm of the gradient, N.
        residual: f64,
    },
    /// The equation of an energy–momentum step is not solved, and so the energy would not be kept.
    NotSolved {
        /// Number of iterations.
        iterations: usize,
        /// Norm of the residual, N.
        residual: f64,
    },
    /// The linear solver failed for another reason.
    Linear(LinearError),
}

impl fmt::Display for NewtonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Inadmissible { element, stretches } => write!(
                f,
                "element {element} is outside the domain of its material before the step: its stretches are {} \
                 (`Inversion::Extend` continues an energy beyond J > 0 only: other conditions of its domain must hold)",
                stretches.map(number).join(", ")
            ),
            Self::ElementNotFinite { element } => write!(
                f,
                "the energy or a force of element {element} is not finite before the step: the deformation, the moduli of the \
                 material or the reciprocal of its `epsilon` exceed the range of f64"
            ),
            Self::Inverted { element } => write!(
                f,
                "element {element} is inverted, or would be after the step, and `Integrator::EnergyMomentum` needs strains that \
                 tell an element from its mirror image; take a shorter step, or another integrator"
            ),
            Self::PinsMoveTooFar { element } => write!(
                f,
                "the motion of the pins takes element {element} out of the domain of its material; take shorter time steps"
            ),
            Self::TermRefuses { term } => write!(
                f,
                "term {term} (from 0) has no finite energy before the step or where the pins move; set positions that it admits, \
                 or take shorter time steps"
            ),
            Self::NoSuchNode { node, nodes } => {
                write!(f, "a term names node {node} (from 0), but there are {nodes} nodes")
            }
            Self::NotPositive { node, shift } => write!(
                f,
                "the matrix is not positive definite at node {node} (from 0), even with {shift:e} times the inertia added; \
                 where elements are so flat that the energy's derivatives differ by more orders of magnitude than f64 has \
                 digits, extend it from a greater `epsilon`, or begin less flat"
            ),
            Self::NotFinite => write!(
                f,
                "a force or the Newton direction is not finite; the motion exceeds the range of f64"
            ),
            Self::LineSearch { step, refused, residual } => write!(
                f,
                "no step down to {step:e} of the Newton direction decreases the energy (residual {residual:e} N, \
                 {refused} trials outside the domain of a material)"
            ),
            Self::NotSolved { iterations, residual } => write!(
                f,
                "{iterations} iterations do not solve the equation of an energy–momentum step (residual {residual:e} N); take a \
                 shorter step, or another integrator"
            ),
            Self::Linear(error) => error.fmt(f),
        }
    }
}

crate::chained::wraps!(NewtonError { Linear(LinearError) });

impl From<SolveError> for NewtonError {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::NotPositive { node, shift } => Self::NotPositive { node, shift },
            SolveError::NotFinite => Self::NotFinite,
            SolveError::Linear(error) => Self::Linear(error),
        }
    }
}
