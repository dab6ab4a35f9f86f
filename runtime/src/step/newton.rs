//! Newton's method with filtered second derivatives and a line search.
//!
//! This module knows neither masses nor terms: it sees an objective of nodal positions.

use crate::point::Filter;
use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;

use super::filtering::Filtering;
use super::line_search::{LineSearchSettings, Outcome, backtrack};
use super::objective::{Objective, product};
use super::solver::Definiteness;

mod error;
mod report;
mod settings;
mod workspace;

pub use error::NewtonError;
pub use report::{Convergence, NewtonReport};
pub use settings::NewtonSettings;
pub(crate) use workspace::NewtonWorkspace;

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
    line_search: &LineSearchSettings,
) -> Result<(NewtonReport, Evaluated), NewtonError> {
    demand_admissible(&survey, objective.body, objective.elastic)?;
    if let Some(term) = objective.terms.refusing(x) {
        return Err(NewtonError::TermRefuses { term });
    }
    workspace.solver.begin();
    let report = NewtonReport::before(settings);
    Iteration { objective, workspace, settings, line_search, survey, report, moved: None }.run(x, pins_move)
}

/// A minimisation under way.
struct Iteration<'a, 'b> {
    objective: &'a mut Objective<'b>,
    workspace: &'a mut NewtonWorkspace,
    settings: &'a NewtonSettings,
    line_search: &'a LineSearchSettings,
    /// Survey of the energies evaluated last.
    survey: Evaluated,
    report: NewtonReport,
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
        self.linearise(filtering.choice(), x, pins_move)?;
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
        let NewtonWorkspace { direction, trial, gradient, .. } = &mut *self.workspace;
        let slope = product(gradient, direction);
        if !slope.is_finite() {
            return Err(NewtonError::NotFinite);
        }
        let first = self.objective.terms.longest_step(x, direction);
        let mut line = self.objective.along(x, direction, trial, gradient);
        let outcome = backtrack(&mut line, first, slope, self.line_search);
        drop(line);
        match outcome {
            Outcome::Accepted { step, difference, refused, by_slope, .. } => {
                x.copy_from_slice(trial);
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
