//! Steps of a simulation whose length follows from their error.

use crate::step::error::StepError;
use crate::step::halving::{self, Pace, Repeatable};
use crate::step::staged::StagedSteps;

use super::{Simulation, StepReport};

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
    /// Length of the shortest step that was taken, s.
    pub shortest: f64,
    /// Estimated errors of all steps together, m.
    pub error: f64,
}

/// Tolerance of each minimisation, as a share of the error of the step: it saves a tenth to a third of the
/// iterations compared with a tolerance of 10⁻⁶, with the same steps.
const ENOUGH: f64 = 0.03;

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
    /// use piola_bodies::step::{Integrator, NewtonSettings, Simulation, SimulationSettings};
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
    /// let settings = SimulationSettings::default().with_integrator(Integrator::Sdirk2);
    /// let mut bar = Simulation::new(body, &Pins::at([0, 1, 2, 3]), settings.with_gravity([0.0, -9.81, 0.0]))?;
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
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(StepError::Tolerance { tolerance });
        }
        let newton = self.settings.newton;
        self.settings.newton.error_share = newton.error_share.max(ENOUGH);
        let pace = halving::advance_within(&mut Course(self), duration, tolerance * duration);
        self.settings.newton = newton;
        let Pace { reports, taken, refused, unresolved, shortest, error } = pace?;
        let mut sum: Option<StepReport> = None;
        for report in reports {
            let newton = report.newton.after(sum.map(|sum| sum.newton));
            sum = Some(StepReport { newton, ..report });
        }
        let Some(step) = sum else { return Err(StepError::TimeStep { dt: duration }) };
        Ok(AdaptiveReport { step, taken, refused, unresolved, shortest, error })
    }
}

/// A simulation whose steps are tried.
struct Course<'a>(&'a mut Simulation);

impl Repeatable for Course<'_> {
    type Report = StepReport;
    type Error = StepError;

    fn steps(&self) -> &StagedSteps {
        &self.0.steps
    }

    fn steps_mut(&mut self) -> &mut StagedSteps {
        &mut self.0.steps
    }

    fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        self.0.step(dt)
    }

    fn forget(&mut self) {
        self.0.evaluated = None;
    }
}

#[cfg(test)]
mod tests;
