//! Adaptive steps, whose length follows from their error.
//!
//! A step of length h with the result x₁ is made again as two of h/2, with x₂. For a method of order p the
//! error of x₁ is near C hᵖ⁺¹, and the error of x₂ is 2ᵖ times smaller, therefore about
//!
//! ```text
//! max |x₂ − x₁| / (2ᵖ − 1)
//! ```
//!
//! If that is no more than the tolerance allows in the time h, x₂ is the state after h. Otherwise h is
//! halved, and the first of the two halves is already the x₁ of the next attempt. A step that fails is halved
//! too.
//!
//! Bodies that are suddenly pulled or let go move less smoothly than a third order demands: p is at most 2.

use crate::step::error::{NewtonError, StepError};
use crate::step::integrator::State;
use crate::step::solver::Machine;
use crate::step::staged::StagedSteps;
use crate::system::LinearError;
use crate::system::linear::multigrid::Division;

use super::{Simulation, StepReport};

/// Number of halvings after which a step is taken regardless of its error.
const MAX_HALVINGS: u32 = 12;

/// Share of its allowance below which an error lets the next step be twice as long.
const GROWS_BELOW: f64 = 0.1;

/// Report of [`Simulation::advance_within`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct AdaptiveReport {
    /// Energies and smallest det F at the end, and the minimisations of all steps together, those of refused
    /// attempts included.
    pub step: StepReport,
    /// Number of steps taken, each made as two halves.
    pub taken: usize,
    /// Number of attempts whose error was too large, or which failed.
    pub refused: usize,
    /// Number of steps taken at the shortest length although their error was too large.
    pub unresolved: usize,
    /// Estimated errors of all steps together, m.
    pub error: f64,
}

/// Tolerance of each minimisation, as a share of the error of the step: it saves a tenth to a third of the
/// iterations compared with a tolerance of 10⁻⁶, with the same steps.
const ENOUGH: f64 = 0.03;

/// Failure that shorter steps cannot avoid.
const EXTERNAL: StepError = StepError::Newton(NewtonError::Linear(LinearError::External));

impl Simulation {
    /// Advances by a time span, s, with adaptive steps that keep the error of positions below `tolerance`,
    /// m/s, times the span. Errors of the mesh are not included.
    ///
    /// Pinned nodes and targets of springs move evenly over the whole time. The first attempt takes it all at
    /// once, so that the lengths of steps depend only on the state before. Motions too fast for any
    /// tolerance, such as those of a body that has just been released inside out, are followed in steps of
    /// 2⁻¹² of the time.
    ///
    /// ```
    /// use piola_bodies::mesh::tetrahedral_box;
    /// use piola_bodies::step::{Integrator, Simulation, SimulationSettings};
    /// use piola_bodies::system::{Body, Pins};
    ///
    /// /// Rubber.
    /// #[piola::material(domain(J > 0.0))]
    /// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mesh = tetrahedral_box([4, 1, 1], [0.4, 0.1, 0.1])?;
    /// let body = Body::new(&mesh, Rubber::new(1e5, 4e5)?, 1000.0)?;
    /// let (gravity, integrator) = ([0.0, -9.81, 0.0], Integrator::Sdirk2);
    /// let settings = SimulationSettings { gravity, integrator, ..Default::default() };
    /// let mut bar = Simulation::new(body, &Pins::at([0, 1, 2, 3]), settings)?;
    /// // A thirtieth of a second, to 0.1 mm in each second.
    /// let report = bar.advance_within(1.0 / 30.0, 1e-4)?;
    /// assert!(report.error <= 1e-4 / 30.0 && report.unresolved == 0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`StepError`] if a step of the shortest length fails, or neither the time nor the tolerance is
    /// positive and finite. The state before is then untouched.
    pub fn advance_within(&mut self, duration: f64, tolerance: f64) -> Result<AdaptiveReport, StepError> {
        rayon::scope(|_| self.advance_within_here(duration, tolerance))
    }
}

impl<M: Machine> Simulation<M> {
    /// Advances as [`Simulation::advance_within`] does, as in [`Simulation::step_here`].
    ///
    /// # Errors
    /// Those of [`Simulation::advance_within`], on all machines.
    #[doc(hidden)]
    pub fn advance_within_here(
        &mut self,
        duration: f64,
        tolerance: f64,
    ) -> Result<AdaptiveReport, StepError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(StepError::Tolerance { tolerance });
        }
        let newton = self.settings.newton;
        self.settings.newton.error_share = newton.error_share.max(ENOUGH);
        let whole = self.steps.clone();
        let mut course = Course { body: self, whole, duration, report: None };
        let made = course.run(tolerance * duration);
        let Course { whole, .. } = course;
        self.settings.newton = newton;
        if made.is_err() {
            self.steps = whole;
            self.evaluated = None;
        }
        made
    }
}

/// Time span of the integration.
struct Course<'a, M: Machine> {
    body: &'a mut Simulation<M>,
    /// State at the start, with the prescribed motion of the nodes until the end.
    whole: StagedSteps,
    duration: f64,
    /// Report of all steps together, those of refused attempts included.
    report: Option<StepReport>,
}

impl<M: Machine> Course<'_, M> {
    fn run(&mut self, allowed: f64) -> Result<AdaptiveReport, StepError> {
        let weight = f64::from((1_u32 << self.body.settings.integrator.order().min(2)) - 1);
        let parts = 1_u32 << MAX_HALVINGS;
        let (mut taken, mut refused, mut unresolved, mut error) = (0, 0, 0, 0.0);
        let (mut at, mut length) = (0, parts);
        // The state after a whole step from here, where an earlier attempt has found it.
        let mut whole: Option<State> = None;
        loop {
            let before = self.state();
            let attempt = self.attempt(at, length, whole.take());
            let is_shortest = length == 1;
            match attempt {
                Ok((distance, first_half)) => {
                    let estimate = distance / weight;
                    let share = f64::from(length) / f64::from(parts);
                    if estimate <= allowed * share || is_shortest {
                        at += length;
                        taken += 1;
                        unresolved += usize::from(estimate > allowed * share);
                        error += estimate;
                        if at == parts {
                            let step = self.report.take();
                            let step = step.ok_or(StepError::TimeStep { dt: self.duration })?;
                            return Ok(AdaptiveReport { step, taken, refused, unresolved, error });
                        }
                        // A longer step ends where one of its length would, counted from the start.
                        if estimate <= GROWS_BELOW * allowed * share && at % (2 * length) == 0 {
                            length *= 2;
                        }
                        continue;
                    }
                    whole = Some(first_half);
                }
                // What an external solver reports may be an error of one machine alone.
                Err(error) if is_shortest || error == EXTERNAL => return Err(error),
                Err(_) => {}
            }
            refused += 1;
            self.restore(&before);
            length /= 2;
        }
    }

    /// Makes a step of `length` parts from `at` as two halves. Returns the largest distance along an axis, m,
    /// between a node after these and after the whole step, and the state after the first half.
    fn attempt(&mut self, at: u32, length: u32, whole: Option<State>) -> Result<(f64, State), StepError> {
        let parts = f64::from(1_u32 << MAX_HALVINGS);
        let (start, end) = (f64::from(at) / parts, f64::from(at + length) / parts);
        let middle = 0.5 * (start + end);
        let whole = match whole {
            Some(whole) => whole,
            None => {
                let before = self.state();
                self.step_between(start, end)?;
                let whole = self.state();
                self.restore(&before);
                whole
            }
        };
        self.step_between(start, middle)?;
        let first_half = self.state();
        self.step_between(middle, end)?;
        let pairs = self.body.positions().as_flattened().iter().zip(whole.x.as_flattened());
        let own = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        let distance = self.body.workspace.machine.nodes().largest(own);
        Ok((distance, first_half))
    }

    /// Makes one step between two shares of the whole time.
    fn step_between(&mut self, start: f64, end: f64) -> Result<(), StepError> {
        self.body.steps.drive(&self.whole, start, end);
        let report = self.body.step_here((end - start) * self.duration)?;
        let newton = report.newton.after(self.report.take().map(|before| before.newton));
        self.report = Some(StepReport { newton, ..report });
        Ok(())
    }

    fn state(&self) -> State {
        self.body.steps.state.clone()
    }

    fn restore(&mut self, state: &State) {
        self.body.steps.state.clone_from(state);
        self.body.evaluated = None;
    }
}

#[cfg(test)]
mod tests;
