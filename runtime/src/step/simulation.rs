//! Simulation of a body in steps of time.

use std::fmt;
use std::ops::Range;

use crate::batch::TileMaterial;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::{Body, Pins};

use super::damping::{Damping, Viscosity};
use super::integrator::{Integrator, Stages, Tableau};
use super::line_search::LineSearchSettings;
use super::newton::{NewtonError, NewtonReport, NewtonSettings, NewtonWorkspace, minimize};
use super::objective::{Objective, Quadratic, Spring};

mod error;

pub use error::{SetupError, StepError};

/// Settings of a [`Simulation`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct SimulationSettings {
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// Forces against velocity.
    pub damping: Damping,
    /// Method by which steps advance in time.
    pub integrator: Integrator,
    /// Settings of the minimisation in each stage of a step.
    pub newton: NewtonSettings,
    /// Settings that shorten Newton steps.
    pub line_search: LineSearchSettings,
}

crate::chained::chained!(SimulationSettings {
    with_gravity(gravity: [f64; 3]),
    with_damping(damping: Damping),
    with_integrator(integrator: Integrator),
    with_newton(newton: NewtonSettings),
    with_line_search(line_search: LineSearchSettings),
});

/// Body with its state, stepped by implicit Euler or another [`Integrator`]. In f64.
///
/// ```math
/// v = (x − xₙ)/h,   M (v − vₙ)/h = −∇Ψ(x) − damping + M g − springs
/// ```
///
/// All memory is allocated by [`Simulation::new`], or by [`Simulation::set_settings`] for another linear
/// solver or integrator, except for the small lists of a report and the levels of multigrid. The same state
/// gives the same bits for any number of threads of the rayon pool in which `step` is called, and whatever
/// was before it.
///
/// A clone goes on with the same bits and is independent of the original: to try a step, or for ensembles. It
/// takes as much memory again, but for the materials and the symbolic factorisation, which are shared; to
/// undo steps later it is enough to keep positions and velocities.
#[derive(Clone)]
pub struct Simulation {
    body: Body,
    settings: SimulationSettings,
    springs: Vec<Spring>,
    /// Targets of the springs where the next step starts.
    targets_before: Vec<[f64; 3]>,
    positions: Vec<[f64; 3]>,
    velocities: Vec<[f64; 3]>,
    /// Positions of the pinned nodes, and only of them, after the next step.
    targets: Vec<[f64; 3]>,
    pins: Pins,
    elastic: Elastic,
    workspace: NewtonWorkspace,
    viscosity: Option<Viscosity>,
    /// Diagonal that a unit of regularisation adds for each mass in statics, 1/s².
    static_regularisation: f64,
    next: Vec<[f64; 3]>,
    stages: Stages,
    pins_move: Vec<[f64; 3]>,
    /// Survey of the elastic energies at `positions`, if these were evaluated last.
    evaluated: Option<Evaluated>,
}

impl fmt::Debug for Simulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation")
            .field("body", &self.body)
            .field("settings", &self.settings)
            .field("pinned", &self.pins.nodes().len())
            .finish_non_exhaustive()
    }
}

impl Simulation {
    /// A simulation that starts at rest in the rest shape. Does the symbolic part of all linear algebra to
    /// come.
    ///
    /// # Errors
    /// [`SetupError::NoSuchNode`] for a pin, [`SetupError::Setting`], [`SetupError::Linear`].
    pub fn new(body: Body, pins: &Pins, settings: SimulationSettings) -> Result<Self, SetupError> {
        let nodes = body.rest().len();
        if let Some(&node) = pins.nodes().last().filter(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        check_settings(&settings)?;
        let workspace = NewtonWorkspace::new(&body, pins, &settings.newton)?;
        Ok(Self {
            settings,
            springs: Vec::new(),
            targets_before: Vec::new(),
            positions: body.rest().to_vec(),
            velocities: vec![[0.0; 3]; nodes],
            targets: body.rest().to_vec(),
            pins: pins.clone(),
            elastic: Elastic::new(&body),
            workspace,
            viscosity: settings.damping.viscosity(&body),
            static_regularisation: static_regularisation(&body),
            next: vec![[0.0; 3]; nodes],
            stages: Stages::new(settings.integrator, nodes),
            pins_move: vec![[0.0; 3]; nodes],
            evaluated: None,
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
        &self.positions
    }

    /// Current velocity of each node, m/s.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; 3]] {
        &self.velocities
    }

    /// Indices of the pinned nodes, ascending.
    #[must_use]
    pub fn pinned(&self) -> &[usize] {
        self.pins.nodes()
    }

    /// Sets the position of each node, m, however deformed or collapsed the body then is. Pins hold their
    /// nodes there.
    ///
    /// # Errors
    /// [`SetupError::Length`] or [`SetupError::NotFinite`] unless there is one finite position for each node.
    pub fn set_positions(&mut self, positions: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(positions)?;
        self.positions.copy_from_slice(positions);
        self.targets.copy_from_slice(positions);
        self.evaluated = None;
        Ok(())
    }

    /// Sets the velocity of each node, m/s; of a pinned node it lasts until the next step.
    ///
    /// # Errors
    /// [`SetupError::Length`] or [`SetupError::NotFinite`] unless there is one finite velocity for each node.
    pub fn set_velocities(&mut self, velocities: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(velocities)?;
        self.velocities.copy_from_slice(velocities);
        Ok(())
    }

    /// Prescribes the position of a pinned node, m, after the next step and from then on.
    ///
    /// # Errors
    /// [`SetupError::NotPinned`] or [`SetupError::NotFinite`].
    pub fn prescribe(&mut self, node: usize, position: [f64; 3]) -> Result<(), SetupError> {
        if self.pinned().binary_search(&node).is_err() {
            return Err(SetupError::NotPinned { node });
        }
        if position.iter().any(|x| !x.is_finite()) {
            return Err(SetupError::NotFinite { node });
        }
        self.targets[node] = position;
        Ok(())
    }

    /// Replaces all springs.
    ///
    /// A spring at the same index and anchor as one before has its target moved: evenly in the course of the
    /// next step. Implicit Euler looks at the end of a step only, and other integrators at what is between.
    ///
    /// # Errors
    /// [`SetupError::SpringAcrossElements`] if the nodes of a spring do not belong to one element,
    /// [`SetupError::Spring`] if its stiffness is negative or a number is not finite,
    /// [`SetupError::NoSuchNode`]. The springs then stay as they were.
    pub fn set_springs(&mut self, springs: &[Spring]) -> Result<(), SetupError> {
        springs.iter().enumerate().try_for_each(|(index, spring)| self.check_spring(index, spring))?;
        let before = |(index, spring): (usize, &Spring)| match self.springs.get(index) {
            Some(old) if old.anchor == spring.anchor => self.targets_before[index],
            _ => spring.target,
        };
        self.targets_before = springs.iter().enumerate().map(before).collect();
        self.springs.clear();
        self.springs.extend_from_slice(springs);
        Ok(())
    }

    /// Springs that pull at the body.
    #[must_use]
    pub fn springs(&self) -> &[Spring] {
        &self.springs
    }

    /// Current settings.
    #[must_use]
    pub fn settings(&self) -> &SimulationSettings {
        &self.settings
    }

    /// Replaces the settings from the next step on. Another linear solver, or another tolerance of it, is set
    /// up as by [`Simulation::new`].
    ///
    /// # Errors
    /// [`SetupError::Setting`], [`SetupError::Linear`]. The settings then stay as they were.
    pub fn set_settings(&mut self, settings: SimulationSettings) -> Result<(), SetupError> {
        check_settings(&settings)?;
        let (new, old) = (&settings.newton, &self.settings.newton);
        if (new.linear, new.filtering) != (old.linear, old.filtering) {
            self.workspace = NewtonWorkspace::new(&self.body, &self.pins, new)?;
        }
        if settings.integrator != self.settings.integrator {
            self.stages = Stages::new(settings.integrator, self.positions.len());
        }
        if settings.damping != self.settings.damping {
            self.viscosity = settings.damping.viscosity(&self.body);
        }
        self.settings = settings;
        Ok(())
    }

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
        let shortest = self.settings.integrator.tableau().diagonal * dt;
        let has_inertia =
            (heaviest / shortest / shortest).is_finite() && shortest * shortest >= f64::MIN_POSITIVE;
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
        self.next.copy_from_slice(&self.positions);
        let mut survey = match self.evaluated.take() {
            Some(survey) => survey,
            None => self.elastic.evaluate(&self.body, &self.positions),
        };
        let is_static = dt == f64::INFINITY;
        let integrator = if is_static { Integrator::ImplicitEuler } else { self.settings.integrator };
        let Tableau { diagonal, before, last } = integrator.tableau();
        let length = diagonal * dt;
        if let Some(viscosity) = self.viscosity.as_mut().filter(|_| !is_static) {
            viscosity.linearise(&self.body, &mut self.elastic, self.settings.damping.time() / length);
        }
        let mut stages_before: Option<NewtonReport> = None;
        for (stage, coefficients) in before.iter().enumerate() {
            self.stages.begin(coefficients, dt, &self.positions, &self.velocities);
            let share = coefficients.iter().sum::<f64>() + diagonal;
            self.stages.pull(&self.springs, &self.targets_before, share);
            let report;
            (report, survey) = self.minimize_stage(true, length, share, survey)?;
            self.stages.end(stage, length, &self.next);
            stages_before = Some(report.after(stages_before));
        }
        let has_stages = !before.is_empty();
        if has_stages {
            self.stages.begin(last, dt, &self.positions, &self.velocities);
            self.stages.pull(&self.springs, &self.targets_before, 1.0);
        }
        let (report, survey) = self.minimize_stage(has_stages, length, 1.0, survey)?;

        let start = if has_stages { &self.stages.start } else { &self.positions };
        for (velocity, (next, start)) in self.velocities.iter_mut().zip(self.next.iter().zip(start)) {
            for c in 0..3 {
                velocity[c] = (next[c] - start[c]) / length;
            }
        }
        std::mem::swap(&mut self.positions, &mut self.next);
        for (before, spring) in self.targets_before.iter_mut().zip(&self.springs) {
            *before = spring.target;
        }
        self.evaluated = Some(survey);
        let newton = report.after(stages_before);
        Ok(StepReport { newton, min_det: survey.min_det, energies: self.energies_of(self.elastic.energy()) })
    }

    /// Moves `next` to the end of a stage: a step of implicit Euler of this length, which takes the pinned
    /// nodes to this share of their way.
    fn minimize_stage(
        &mut self,
        has_stages: bool,
        length: f64,
        share: f64,
        survey: Evaluated,
    ) -> Result<(NewtonReport, Evaluated), NewtonError> {
        let mut pins_move = false;
        for &node in self.pins.nodes() {
            for c in 0..3 {
                let way = self.targets[node][c] - self.positions[node][c];
                let done = self.next[node][c] - self.positions[node][c];
                self.pins_move[node][c] = share * way - done;
                pins_move |= self.pins_move[node][c] != 0.0;
            }
        }
        let is_static = length == f64::INFINITY;
        let regularisation = if is_static { self.static_regularisation } else { 1.0 / (length * length) };
        let may_drift = is_static && self.pins.nodes().len() < 3;
        let (start, velocities, springs) = if has_stages {
            (&self.stages.start, &self.stages.velocities, &self.stages.springs)
        } else {
            (&self.positions, &self.velocities, &self.springs)
        };
        let mut objective = Objective {
            body: &self.body,
            elastic: &mut self.elastic,
            quadratic: Quadratic {
                masses: self.body.masses(),
                start,
                velocities,
                dt: length,
                damping: self.settings.damping.rate(),
                regularisation,
                guard: if may_drift { DRIFT * regularisation } else { 0.0 },
                gravity: self.settings.gravity,
                springs,
            },
            viscosity: self.viscosity.as_ref().filter(|_| !is_static),
        };
        minimize(
            &mut objective,
            &mut self.workspace,
            &mut self.next,
            pins_move.then_some(&self.pins_move),
            survey,
            &self.settings.newton,
            &self.settings.line_search,
        )
    }

    /// Energies of the current state; the elastic one is NaN if an element is outside its domain.
    #[must_use]
    pub fn energies(&mut self) -> Energies {
        let survey =
            *self.evaluated.get_or_insert_with(|| self.elastic.evaluate(&self.body, &self.positions));
        self.energies_of(if survey.survey.is_clean() { self.elastic.energy() } else { f64::NAN })
    }

    fn energies_of(&self, elastic: f64) -> Energies {
        let mut energies = Energies { elastic, ..Energies::default() };
        for (node, mass) in self.body.masses().iter().enumerate() {
            for c in 0..3 {
                energies.kinetic += 0.5 * mass * self.velocities[node][c].powi(2);
                energies.gravity -=
                    mass * self.settings.gravity[c] * (self.positions[node][c] - self.body.rest()[node][c]);
            }
        }
        energies.springs = self.springs.iter().map(|spring| spring.energy(&self.positions)).sum();
        energies
    }

    fn check_nodal(&self, vectors: &[[f64; 3]]) -> Result<(), SetupError> {
        if vectors.len() != self.positions.len() {
            return Err(SetupError::Length { expected: self.positions.len(), found: vectors.len() });
        }
        match vectors.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            Some(node) => Err(SetupError::NotFinite { node }),
            None => Ok(()),
        }
    }

    fn check_spring(&self, index: usize, spring: &Spring) -> Result<(), SetupError> {
        let nodes = self.positions.len();
        if let Some(&node) = spring.anchor.nodes.iter().find(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        let numbers = spring.anchor.weights.iter().chain(&spring.target).chain([&spring.stiffness]);
        if spring.stiffness < 0.0 || !numbers.into_iter().all(|x| x.is_finite()) {
            return Err(SetupError::Spring { index });
        }
        let is_free = |node: &usize| self.pinned().binary_search(node).is_err();
        let free = spring.weights().map(|(node, _)| node).filter(is_free);
        for a in free.clone() {
            if free.clone().any(|b| !self.workspace.solver.joins(a, b)) {
                return Err(SetupError::SpringAcrossElements { index });
            }
        }
        Ok(())
    }
}

/// Number of units of regularisation, in statics, for a body that may move as a whole.
const DRIFT: f64 = 1e-4;

/// Diagonal for each unit of mass, 1/s², that is small beside the stiffness of elements: a ten-thousandth of
/// their stiffness over the mass of the body.
fn static_regularisation(body: &Body) -> f64 {
    let stiffness = |(material, elements): (&dyn TileMaterial<f64>, Range<usize>)| -> f64 {
        let lengths = body.elements()[elements].iter().map(|element| element.shape.volume.cbrt());
        material.rest_stiffness().abs() * lengths.sum::<f64>()
    };
    1e-4 * body.materials().map(stiffness).sum::<f64>() / body.masses().iter().sum::<f64>()
}

fn check_settings(settings: &SimulationSettings) -> Result<(), SetupError> {
    let SimulationSettings { gravity, damping, integrator: _, newton, line_search } = settings;
    let between = |x: f64, low: f64, high: f64| low < x && x < high;
    let checks = [
        (gravity.iter().all(|g| g.is_finite()), "gravity must be finite"),
        (newton.max_iterations > 0, "Newton's method needs at least one iteration"),
        (newton.tolerance >= 0.0 && newton.tolerance < 1.0, "the tolerance must be at least 0 and below 1"),
        (
            between(line_search.sufficient_decrease, 0.0, 0.5),
            "the sufficient decrease must be between 0 and 1/2",
        ),
        (between(line_search.shrink, 0.0, 1.0), "the shrinking factor must be between 0 and 1"),
        (line_search.max_trials > 0, "the line search needs at least one trial"),
    ];
    let broken = checks.into_iter().find(|(holds, _)| !holds).map(|(_, rule)| rule);
    let broken = broken.or(damping.broken_rule()).or(newton.filtering.broken_rule());
    match broken.or(newton.linear.broken_rule()) {
        Some(rule) => Err(SetupError::Setting { rule }),
        None => Ok(()),
    }
}

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

/// Energies of a body, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Energies {
    /// Energy of deformation.
    pub elastic: f64,
    /// Energy of motion.
    pub kinetic: f64,
    /// Energy in the field of gravity, 0 in the rest shape.
    pub gravity: f64,
    /// Energy of the springs.
    pub springs: f64,
}

impl Energies {
    /// Sum of all energies, J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.elastic + self.kinetic + self.gravity + self.springs
    }
}

#[cfg(test)]
mod tests;
