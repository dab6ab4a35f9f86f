//! Newton's method with filtered second derivatives and a line search.
//!
//! This module is independent of nodes, masses and terms, which the methods of a [`Minimisation`] hide.

use piola::point::Filter;

use super::error::NewtonError;
use super::line_search::{Line, MARGIN, Outcome, backtrack};
use super::minimisation::Minimisation;
use super::solver::Machine;

mod report;
mod settings;

pub use report::{Convergence, NewtonReport};
pub use settings::{Filtering, NewtonSettings};

/// Moves x towards a minimum, and the pins with the first direction if `pins_move`.
///
/// The energies must have been evaluated at x, and on success they have been again.
pub(super) fn minimize<M: Machine>(
    minimisation: &mut Minimisation<'_, M>,
    pins_move: bool,
    settings: &NewtonSettings,
) -> Result<NewtonReport, NewtonError> {
    let report = NewtonReport::before(settings);
    Newton { minimisation, settings, report, moved: None }.run(pins_move)
}

struct Newton<'a, 'b, M> {
    minimisation: &'a mut Minimisation<'b, M>,
    settings: &'a NewtonSettings,
    report: NewtonReport,
    /// The largest displacement of a node in the iteration before, m.
    moved: Option<f64>,
}

#[derive(PartialEq, Eq)]
enum Progress {
    Decrease,
    /// The objective changed by no more than rounding noise; the slope was decisive.
    BelowNoise,
    /// Any further gain is below rounding noise.
    Nothing,
}

impl<M: Machine> Newton<'_, '_, M> {
    fn run(mut self, mut pins_move: bool) -> Result<NewtonReport, NewtonError> {
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
                if self.note_gradient()? {
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
            if !self.find_direction(pins_move, forcing)? {
                break;
            }
            if std::mem::take(&mut pins_move) {
                self.minimisation.move_pins()?;
                self.note_gradient()?;
                // The tangent before the move is not that of the state after it; if the direction does not
                // descend there, the next iteration takes its own.
                let descends = self.minimisation.descent() < 0.0;
                if !descends {
                    self.report.step_lengths.push(0.0);
                    continue;
                }
            }
            progress = self.search()?;
            if progress == Progress::Nothing {
                self.report.convergence = Convergence::Rounding;
                break;
            }
            if self.is_close() {
                self.report.convergence = Convergence::Tolerance;
                break;
            }
        }
        Ok(self.report)
    }

    /// True if the remaining distance is small compared with the error of the step, after the last
    /// displacement.
    fn is_close(&mut self) -> bool {
        if self.settings.error_share == 0.0 {
            return false;
        }
        let step = self.report.step_lengths.last().copied().unwrap_or(0.0);
        let moved = step * self.minimisation.displacement();
        let ratio = self.moved.map_or(0.5, |before| moved / before);
        self.moved = Some(moved);
        let left = ratio / (1.0 - ratio) * moved;
        let enough = self.settings.error_share * self.minimisation.error_scale();
        step == 1.0 && ratio < 1.0 && left <= enough && enough.is_finite()
    }

    /// Evaluates the gradient; returns true if it is small enough.
    fn note_gradient(&mut self) -> Result<bool, NewtonError> {
        let residual = self.minimisation.gradient();
        self.report.note_residual(residual, self.settings)
    }

    /// Relative tolerance for the next system [EW96, choice 2], not tighter than the last system requires.
    fn forcing(&self, before: f64) -> f64 {
        let NewtonReport { residual, first_residual, .. } = self.report;
        let enough = 0.5 * self.settings.tolerance * first_residual / residual;
        (0.9 * (residual / before).powi(2)).max(enough).max(f64::EPSILON)
    }

    /// Linearises and solves for a direction; returns false if the gradient is small enough already.
    ///
    /// Moving pins enter the first linear system with their displacement d: K p = −g − K d. Its tangent is
    /// that of the state before they move, when elements next to them are not yet distorted; the line search
    /// starts after the move.
    fn find_direction(&mut self, pins_move: bool, tolerance: f64) -> Result<bool, NewtonError> {
        let (filter, must_be_definite) = match self.settings.filtering {
            Filtering::Always(filter) => (filter, false),
            Filtering::OnDemand => (Filter::None, true),
        };
        let Self { minimisation, settings, report, .. } = self;
        let residual = minimisation.linearise(filter, pins_move, report)?;
        if !pins_move && report.iterations == 0 && report.note_residual(residual, settings)? {
            return Ok(false);
        }
        if !minimisation.solve(tolerance, must_be_definite, report)? {
            minimisation.linearise(Filter::Clamp, pins_move, report)?;
            minimisation.solve(tolerance, false, report)?;
        }
        report.iterations += 1;
        Ok(true)
    }

    /// Moves x along the direction by a step that the line search accepts.
    fn search(&mut self) -> Result<Progress, NewtonError> {
        let slope = self.minimisation.descent();
        if !slope.is_finite() {
            return Err(NewtonError::NotFinite);
        }
        let first = self.minimisation.longest_step();
        self.minimisation.set_base();
        match backtrack(self.minimisation, first, slope) {
            Outcome::Accepted { step, difference, refused, noise } => {
                let is_noise = difference.abs() <= noise;
                // The slope predicts a decrease above noise that no trial shows.
                if is_noise && -slope * first > MARGIN * noise {
                    self.minimisation.demand_true_gradients(first)?;
                    self.minimisation.change(step);
                }
                self.minimisation.accept();
                self.report.step_lengths.push(step);
                self.report.refused_trials += refused;
                self.report.change += difference;
                Ok(if is_noise { Progress::BelowNoise } else { Progress::Decrease })
            }
            Outcome::Failed { step, refused } => {
                self.report.refused_trials += refused;
                if -slope > self.minimisation.reject() {
                    self.minimisation.demand_true_gradients(first)?;
                    let residual = self.report.residual;
                    return Err(NewtonError::LineSearch { step, refused, residual });
                }
                Ok(Progress::Nothing)
            }
        }
    }
}

#[cfg(test)]
mod tests;
