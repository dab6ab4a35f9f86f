//! A step from one state to the next, stage by stage.

use crate::step::integrator::{Integrator, Method};
use crate::step::newton::{NewtonError, NewtonReport, minimize};
use crate::step::objective::{Objective, Quadratic, Terms};
use crate::system::element::Evaluated;

use super::{Energies, Simulation, StepError};

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
    /// Pinned nodes move evenly to where they are prescribed to be. Damping by the stiffness takes that of
    /// the state before the step.
    ///
    /// # Errors
    /// [`StepError`] if there is no admissible next state. The state before the step is then untouched, and a
    /// shorter step may succeed.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let heaviest = self.body.masses().iter().copied().fold(0.0, f64::max);
        let [tau, sigma] = self.settings.integrator.method().lengths(dt);
        let has_inertia = (heaviest / tau / sigma).is_finite() && tau * sigma >= f64::MIN_POSITIVE;
        if !(dt > 0.0 && dt.is_finite() && has_inertia) {
            return Err(StepError::TimeStep { dt });
        }
        self.advance(dt)
    }

    /// Moves the body towards a minimum of its energy with gravity and springs, without inertia and damping,
    /// as far as the settings of Newton's method allow. Then it is at rest: its velocities are zero.
    ///
    /// Where the second derivatives are not positive definite, small parts of the stiffness are added to
    /// them; for a body with fewer than three pinned nodes, which may move as a whole at no cost, one
    /// ten-thousandth of such a part always.
    ///
    /// # Errors
    /// [`StepError::Newton`] if there is no admissible next state. The state before is then untouched.
    pub fn equilibrate(&mut self) -> Result<StepReport, StepError> {
        self.advance(f64::INFINITY)
    }

    /// A step of any length, infinity included.
    ///
    /// Handed to rayon's threads as a whole: a caller that is none of them would otherwise wait for one at
    /// each of the hundreds of parallel loops.
    fn advance(&mut self, dt: f64) -> Result<StepReport, StepError> {
        rayon::scope(|_| self.advance_here(dt))
    }

    fn advance_here(&mut self, dt: f64) -> Result<StepReport, StepError> {
        let is_static = dt == f64::INFINITY;
        let integrator = if is_static { Integrator::ImplicitEuler } else { self.settings.integrator };
        let method = integrator.method();
        let mut survey = match self.evaluated.take() {
            Some(survey) => survey,
            None => self.elastic.evaluate(&self.body, &self.state.x),
        };
        self.next.x.copy_from_slice(&self.state.x);
        let [tau, _] = method.lengths(dt);
        if let Some(viscosity) = self.viscosity.as_mut().filter(|_| !is_static) {
            viscosity.linearise(&self.body, &mut self.elastic, self.settings.damping.time() / tau);
        }
        let last = method.stages() - 1;
        let mut stages_before: Option<NewtonReport> = None;
        for stage in 0..last {
            let report;
            (report, survey) = self.minimize_stage(&method, stage, dt, survey)?;
            self.stages.end(stage, &self.next.x);
            stages_before = Some(report.after(stages_before));
        }
        let (report, survey) = self.minimize_stage(&method, last, dt, survey)?;
        self.stages.finish(&mut self.next);
        std::mem::swap(&mut self.state, &mut self.next);
        for (before, spring) in self.targets_before.iter_mut().zip(&self.springs) {
            *before = spring.target;
        }
        self.evaluated = Some(survey);
        let newton = report.after(stages_before);
        Ok(StepReport { newton, min_det: survey.min_det, energies: self.energies_of(self.elastic.energy()) })
    }

    /// Sets how far the pinned nodes move in a stage that takes them to this share of their way; true if any
    /// does.
    fn drive_pins(&mut self, share: f64) -> bool {
        let mut is_moving = false;
        for &node in self.pins.nodes() {
            let (target, before) = (self.targets[node], self.state.x[node]);
            let way: [f64; 3] = std::array::from_fn(|c| target[c] - before[c]);
            for c in 0..3 {
                self.pins_move[node][c] = share * way[c] - (self.next.x[node][c] - before[c]);
                is_moving |= self.pins_move[node][c] != 0.0;
            }
        }
        is_moving
    }

    /// Moves `next` to the end of a stage.
    fn minimize_stage(
        &mut self,
        method: &Method,
        stage: usize,
        dt: f64,
        survey: Evaluated,
    ) -> Result<(NewtonReport, Evaluated), NewtonError> {
        let share = method.share(stage);
        self.stages.begin(method, stage, dt, &self.state);
        self.stages.pull(&self.springs, &self.targets_before, share);
        let pins_move = self.drive_pins(share);
        let [tau, sigma] = self.stages.current.lengths;
        let is_static = tau == f64::INFINITY;
        let regularisation = if is_static { self.static_regularisation } else { 1.0 / (tau * sigma) };
        let may_drift = is_static && self.pins.nodes().len() < 3;
        let mut objective = Objective {
            body: &self.body,
            elastic: &mut self.elastic,
            quadratic: Quadratic {
                masses: self.body.masses(),
                stage: &self.stages.current,
                damping: self.settings.damping.rate(),
                regularisation,
                guard: if may_drift { DRIFT * regularisation } else { 0.0 },
                gravity: self.settings.gravity,
                forces: &self.forces,
            },
            terms: Terms { springs: &self.stages.springs, others: &self.terms },
            blocks: &mut self.blocks,
            viscosity: self.viscosity.as_ref().filter(|_| !is_static),
        };
        minimize(
            &mut objective,
            &mut self.workspace,
            &mut self.next.x,
            pins_move.then_some(&self.pins_move),
            survey,
            &self.settings.newton,
            &self.settings.line_search,
        )
    }
}
