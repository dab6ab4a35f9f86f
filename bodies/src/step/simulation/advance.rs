//! A step from one state to the next, stage by stage.

use crate::step::error::{NewtonError, StepError};
use crate::step::minimisation::Minimisation;
use crate::step::newton::{NewtonReport, minimize};
use crate::step::objective::{Objective, Terms};
use crate::step::solver::Machine;
use crate::step::staged::StagedSteps;
use crate::system::element::Evaluated;
use crate::system::linear::multigrid::Division;

use super::{Energies, Simulation, SimulationSettings};

/// Report of a step.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct StepReport {
    /// Report of Newton's method.
    pub newton: NewtonReport,
    /// Smallest det F of an element after the step.
    pub min_det: f64,
    /// Energies after the step.
    pub energies: Energies,
}

/// Number of units of regularisation, in statics, for a body that may move as a whole.
const DRIFT: f64 = 1e-4;

impl Simulation {
    /// Advances by `dt`, s.
    ///
    /// Pinned nodes move evenly to their prescribed positions.
    ///
    /// # Errors
    /// [`StepError`] if there is no admissible next state. The state before the step is then untouched, and a
    /// shorter step may succeed.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        // As a whole on rayon's threads: a caller outside of the pool would otherwise wait for one at each of
        // the hundreds of parallel loops.
        rayon::scope(|_| self.step_here(dt))
    }

    /// Moves the body towards a minimum of its energy with gravity and springs, without inertia and damping,
    /// within the limits of the settings of Newton's method. Then it is at rest: its velocities are zero.
    ///
    /// If the second derivatives are not positive definite, small parts of the stiffness are added to them;
    /// for a body with fewer than three pinned nodes, which may move as a whole at no cost, one
    /// ten-thousandth of such a part always.
    ///
    /// The report tells whether the tolerance was reached: with
    /// [`Convergence::Limit`](crate::step::Convergence::Limit) the body is not in equilibrium yet.
    ///
    /// # Errors
    /// [`StepError::Unheld`] if nothing holds the body and the loads on it do not balance,
    /// [`StepError::Newton`] if there is no admissible next state. The state before is then untouched.
    pub fn equilibrate(&mut self) -> Result<StepReport, StepError> {
        rayon::scope(|_| self.equilibrate_here())
    }
}

impl<M: Machine> Simulation<M> {
    /// Advances as [`Simulation::step`] does, on the thread of the caller and those of its loops; for a body
    /// that is divided among machines.
    ///
    /// # Errors
    /// Those of [`Simulation::step`], on all machines.
    #[doc(hidden)]
    pub fn step_here(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let heaviest = self.body.masses().iter().copied().fold(0.0, f64::max);
        let heaviest = self.workspace.machine.nodes().largest(heaviest);
        let tau = self.settings.integrator.method().diagonal * dt;
        let has_inertia = (heaviest / tau / tau).is_finite() && tau * tau >= f64::MIN_POSITIVE;
        if !(dt > 0.0 && dt.is_finite() && has_inertia) {
            return Err(StepError::TimeStep { dt });
        }
        self.advance(dt)
    }

    /// Moves the body as [`Simulation::equilibrate`] does, as in [`Simulation::step_here`].
    ///
    /// # Errors
    /// Those of [`Simulation::equilibrate`], on all machines.
    #[doc(hidden)]
    pub fn equilibrate_here(&mut self) -> Result<StepReport, StepError> {
        self.demand_balance()?;
        self.advance(f64::INFINITY)
    }

    /// Demands that the loads on a body that nothing holds add up to zero, as its elastic forces do: to the
    /// tolerance of Newton's method, or to half of all digits.
    fn demand_balance(&self) -> Result<(), StepError> {
        let SimulationSettings { gravity, newton, .. } = self.settings;
        let holding = self.pinned().len() + self.springs().len() + self.terms.len();
        let mut own = [0.0, 0.0, 0.0, 0.0, holding as f64];
        for (node, mass) in self.body.masses().iter().enumerate() {
            for c in 0..3 {
                let force = self.forces.get(node).map_or(0.0, |force| force[c]);
                own[c] += mass * gravity[c] + force;
                own[3] += (mass * gravity[c]).abs() + force.abs();
            }
        }
        let [x, y, z, size, holding] = self.workspace.machine.nodes().totals(own);
        let force = x.hypot(y).hypot(z);
        match holding == 0.0 && force > newton.tolerance.max(1e-8) * size {
            true => Err(StepError::Unheld { force }),
            false => Ok(()),
        }
    }

    /// A step of any length, infinity included.
    fn advance(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let mut survey = self.survey();
        self.evaluated = None;
        let mut newton: Option<NewtonReport> = None;
        for stage in 0..self.steps.begin(self.settings.integrator, dt) {
            let report;
            (report, survey) = self.minimize_stage(stage, survey)?;
            self.steps.end_stage(stage);
            newton = Some(report.after(newton));
        }
        self.steps.finish();
        self.evaluated = Some(survey);
        Ok(StepReport {
            newton: newton.unwrap_or_else(|| NewtonReport::before(&self.settings.newton)),
            min_det: -self.workspace.machine.nodes().largest(-survey.min_det),
            energies: self.energies_of(self.elastic.energy()),
        })
    }

    /// Minimises over the positions at the end of a stage.
    fn minimize_stage(
        &mut self,
        stage: usize,
        survey: Evaluated,
    ) -> Result<(NewtonReport, Evaluated), NewtonError> {
        let pins_move = self.steps.begin_stage(stage);
        let nodes = self.workspace.machine.nodes();
        let is_own = |node: &&usize| **node < self.body.rest().len() - nodes.copies();
        let own = [usize::from(pins_move), self.pinned().iter().filter(is_own).count()];
        let [moves, pinned] = nodes.totals(own.map(|number| number as f64));
        let (pins_move, may_drift) = (moves > 0.0, pinned < 3.0);
        let StagedSteps { stage, stage_springs, pins_move: displacements, next, .. } = &mut self.steps;
        let tau = stage.length;
        let is_static = tau == f64::INFINITY;
        let regularisation = if is_static { self.static_regularisation } else { 1.0 / (tau * tau) };
        let objective = Objective {
            body: &self.body,
            elastic: &mut self.elastic,
            stage,
            damping: self.settings.damping,
            regularisation,
            guard: if is_static && may_drift { DRIFT * regularisation } else { 0.0 },
            gravity: self.settings.gravity,
            forces: &self.forces,
            terms: Terms { springs: stage_springs, others: &self.terms },
            blocks: &mut self.blocks,
        };
        let mut minimisation =
            Minimisation::new(objective, &mut self.workspace, &mut next.x, displacements, survey)?;
        let report = minimize(&mut minimisation, pins_move, &self.settings.newton)?;
        Ok((report, minimisation.survey))
    }
}
