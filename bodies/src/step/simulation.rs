//! Simulation of a body in steps of time.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use piola::batch::TileMaterial;

use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::linear::multigrid::Division;
use crate::system::{Body, Pins};

use super::error::SetupError;
use super::minimisation::NewtonWorkspace;
use super::objective::Terms;
use super::solver::{Choice, Machine, OneMachine};
use super::spring::Spring;
use super::staged::StagedSteps;
use super::term::{NodeBlocks, Term};

mod adaptive;
mod advance;
mod balance;
mod change;
mod energies;
mod settings;

pub use adaptive::AdaptiveReport;
pub use advance::StepReport;
pub use energies::Energies;
pub use settings::SimulationSettings;

use settings::check_settings;

/// Body with its state, stepped by implicit Euler or another [`Integrator`](super::Integrator). In f64.
///
/// ```math
/// M a = −∇Ψ(x) − damping + M g + forces − springs − other terms
/// ```
///
/// All memory is allocated by [`Simulation::new`], or by [`Simulation::set_settings`] for another linear
/// solver or integrator, except for the small lists of a report and the levels of multigrid. The same state
/// gives the same bits for any number of threads of the rayon pool in which `step` is called, and any earlier
/// history.
///
/// A clone continues with the same bits and is independent of the original: to try a step, or for ensembles.
/// It takes as much memory again, except for the materials and the symbolic factorisation, which are shared;
/// to undo steps later it is enough to keep positions and velocities.
///
/// With another `Machine` it is the part of a machine, of a body that is divided among machines.
#[derive(Clone)]
pub struct Simulation<M: Machine = OneMachine> {
    body: Body,
    settings: SimulationSettings,
    steps: StagedSteps,
    terms: Vec<Arc<dyn Term>>,
    /// Second derivatives of springs and terms, where they were linearised last.
    blocks: NodeBlocks,
    /// Given force on each node, N; empty without any.
    forces: Vec<[f64; 3]>,
    elastic: Elastic,
    workspace: NewtonWorkspace<M>,
    /// Diagonal that a unit of regularisation adds for each mass in statics, 1/s².
    static_regularisation: f64,
    /// Survey of the elastic energies at `positions`, if these were evaluated last.
    evaluated: Option<Evaluated>,
}

impl<M: Machine> fmt::Debug for Simulation<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("body", &self.body)
            .field("settings", &self.settings)
            .field("pinned", &self.pinned().len())
            .finish_non_exhaustive()
    }
}

impl Simulation {
    /// A simulation at rest in the rest shape. Does the symbolic part of all later linear algebra.
    ///
    /// # Errors
    /// [`SetupError`] for a pin that is no node, a setting out of range, or a failure of the linear solver.
    pub fn new(body: Body, pins: &Pins, settings: SimulationSettings) -> Result<Self, SetupError> {
        let choice = Choice::Setting(settings.newton.linear);
        Self::on(|body| OneMachine::new(body, pins, &[], choice), body, pins, settings)
    }

    /// The given force on each node, N; empty without any.
    #[must_use]
    pub fn forces(&self) -> &[[f64; 3]] {
        &self.forces
    }
}

impl<M: Machine> Simulation<M> {
    /// Simulation of a divided body, on a machine that has this part. Pins include copies of nodes of other
    /// machines.
    ///
    /// # Errors
    /// [`SetupError`] for a pin that is no node, or a setting out of range: on this machine alone.
    #[doc(hidden)]
    pub fn divided(
        machine: M,
        body: Body,
        pins: &Pins,
        settings: SimulationSettings,
    ) -> Result<Self, SetupError> {
        Self::on(|_| Ok(machine), body, pins, settings)
    }

    fn on(
        machine: impl FnOnce(&Body) -> Result<M, LinearError>,
        body: Body,
        pins: &Pins,
        settings: SimulationSettings,
    ) -> Result<Self, SetupError> {
        let steps = StagedSteps::new(settings.integrator, body.rest(), pins)?;
        check_settings(&settings)?;
        let workspace = NewtonWorkspace::new(machine(&body)?, body.rest().len());
        Ok(Self {
            settings,
            steps,
            terms: Vec::new(),
            blocks: NodeBlocks::default(),
            forces: Vec::new(),
            elastic: Elastic::new(&body),
            static_regularisation: static_regularisation(&body, workspace.machine.nodes()),
            evaluated: None,
            workspace,
            body,
        })
    }

    /// Body at rest.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Current position of each node, m.
    #[must_use]
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.steps.state.x
    }

    /// Current velocity of each node, m/s.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; 3]] {
        &self.steps.state.v
    }

    /// Acceleration of each node at the end of the last step, m/s², as its integrator defines it: for
    /// Runge–Kutta methods that of the last stage. Zero before the first step and after
    /// [`Simulation::equilibrate`].
    #[must_use]
    pub fn accelerations(&self) -> &[[f64; 3]] {
        &self.steps.state.a
    }

    /// Indices of the pinned nodes, ascending.
    #[must_use]
    pub fn pinned(&self) -> &[usize] {
        self.steps.pins.nodes()
    }

    /// Machine that simulates the body or its part.
    #[doc(hidden)]
    pub fn machine(&mut self) -> &mut M {
        &mut self.workspace.machine
    }

    /// Survey of the elastic energies at the current positions, evaluated if necessary.
    fn survey(&mut self) -> Evaluated {
        let x = &self.steps.state.x;
        *self.evaluated.get_or_insert_with(|| self.elastic.evaluate(&self.body, x))
    }

    pub(super) fn all_terms(&self) -> Terms<'_> {
        Terms { springs: &self.steps.springs, others: &self.terms }
    }

    /// Springs that pull at the body.
    #[must_use]
    pub fn springs(&self) -> &[Spring] {
        &self.steps.springs
    }

    /// Current settings.
    #[must_use]
    pub fn settings(&self) -> &SimulationSettings {
        &self.settings
    }
}

/// Small diagonal for each unit of mass, 1/s²: a ten-thousandth of the stiffness of elements over the mass of
/// the body.
fn static_regularisation(body: &Body, nodes: &impl Division) -> f64 {
    let stiffness = |(material, elements): (&dyn TileMaterial<f64>, Range<usize>)| -> f64 {
        let lengths = body.elements()[elements].iter().map(|element| element.shape.volume.cbrt());
        material.rest_stiffness().abs() * lengths.sum::<f64>()
    };
    let own = [body.materials().map(stiffness).sum(), body.masses().iter().sum()];
    let [stiffness, mass] = nodes.totals(own);
    1e-4 * stiffness / mass
}

#[cfg(all(test, feature = "faer"))]
mod tests;
