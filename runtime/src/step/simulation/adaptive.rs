//! Steps of a simulation whose length follows from their error.

use crate::step::halving::{self, Pace, Repeatable, on_the_way};
use crate::step::integrator::State;
use crate::step::newton::NewtonReport;
use crate::step::spring::Spring;

use super::{Simulation, StepError, StepReport};

/// Report of [`Simulation::advance_within`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct AdaptiveReport {
    /// Energies and smallest det F at the end, and the minimisations of all steps together, those of refused
    /// attempts included.
    pub step: StepReport,
    /// Number of steps that were taken, each made as two halves.
    pub taken: usize,
    /// Number of attempts whose error was too large, or which failed.
    pub refused: usize,
    /// Number of steps that were taken although their error was too large, since they were the shortest.
    pub unresolved: usize,
    /// Length of the shortest step that was taken, s.
    pub shortest: f64,
    /// Estimated errors of all steps together, m.
    pub error: f64,
}

/// Share of the error of a step to which its minimum is found, at least: a tenth to a third of the iterations
/// less than with a tolerance of 10⁻⁶, and the same steps.
const ENOUGH: f64 = 0.03;

impl Simulation {
    /// Advances by a time, s, in steps so short that they make no error of positions above `tolerance`, m/s,
    /// times the time. Errors of the mesh are not its concern.
    ///
    /// Pinned nodes and targets of springs move evenly over the whole time. The first attempt takes it all at
    /// once, so that nothing but the state before decides. Motions too fast for any tolerance, as those of a
    /// body that has just been let go inside out, are followed in steps of 2⁻¹² of the time.
    ///
    /// ```
    /// use piola::mesh::tetrahedral_box;
    /// use piola::step::{Integrator, NewtonSettings, Simulation, SimulationSettings};
    /// use piola::system::{Body, Pins};
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
    /// [`StepError`] if a step of the shortest length fails, or neither the time nor the tolerance is positive
    /// and finite. The state before is then untouched.
    pub fn advance_within(&mut self, duration: f64, tolerance: f64) -> Result<AdaptiveReport, StepError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(StepError::Tolerance { tolerance });
        }
        let newton = self.settings.newton;
        self.settings.newton.error_share = newton.error_share.max(ENOUGH);
        let integrator = self.settings.integrator;
        let mut course = Course {
            duration,
            before: self.state.clone(),
            targets: self.targets.clone(),
            targets_before: self.targets_before.clone(),
            springs: self.springs.clone(),
            sum: None,
            simulation: self,
        };
        let result = halving::advance_within(&mut course, integrator, tolerance * duration);
        let Course { before, targets, targets_before, springs, sum, .. } = course;
        self.settings.newton = newton;
        self.targets.copy_from_slice(&targets);
        self.springs.copy_from_slice(&springs);
        if result.is_err() {
            self.restore(&before);
            self.targets_before.copy_from_slice(&targets_before);
        }
        let Pace { report, taken, refused, unresolved, shortest, error } = result?;
        let step = StepReport { newton: sum.unwrap_or_else(|| report.newton.clone()), ..report };
        Ok(AdaptiveReport { step, taken, refused, unresolved, shortest: duration * shortest, error })
    }

    fn restore(&mut self, state: &State) {
        self.state.clone_from(state);
        self.evaluated = None;
    }
}

/// The time that a simulation is advanced over, and what moves evenly meanwhile.
struct Course<'a> {
    simulation: &'a mut Simulation,
    duration: f64,
    /// Positions before.
    before: State,
    /// Positions of pinned nodes at the end.
    targets: Vec<[f64; 3]>,
    /// Targets of springs before.
    targets_before: Vec<[f64; 3]>,
    /// Springs at the end.
    springs: Vec<Spring>,
    /// The minimisations of all steps together.
    sum: Option<NewtonReport>,
}

impl Repeatable for Course<'_> {
    type State = State;
    type Report = StepReport;
    type Error = StepError;

    fn state(&self) -> State {
        self.simulation.state.clone()
    }

    fn restore(&mut self, state: &State) {
        self.simulation.restore(state);
    }

    fn distance(&self, from: &State) -> f64 {
        let pairs = self.simulation.state.x.as_flattened().iter().zip(from.x.as_flattened());
        pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    }

    fn step_between(&mut self, start: f64, end: f64) -> Result<StepReport, StepError> {
        let Self { simulation, .. } = self;
        for &node in simulation.pins.nodes() {
            simulation.targets[node] = on_the_way(self.before.x[node], self.targets[node], end);
        }
        for (index, (before, spring)) in self.targets_before.iter().zip(&self.springs).enumerate() {
            simulation.targets_before[index] = on_the_way(*before, spring.target, start);
            simulation.springs[index].target = on_the_way(*before, spring.target, end);
        }
        let report = simulation.step((end - start) * self.duration)?;
        self.sum = Some(report.newton.clone().after(self.sum.take()));
        Ok(report)
    }
}

#[cfg(test)]
mod tests;
