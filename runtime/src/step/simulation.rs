//! Simulation of a body in steps of time.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use crate::batch::TileMaterial;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::{Body, BodyError, Pins};

use super::conservation::Conservation;
use super::damping::{Damping, Viscosity};
use super::integrator::{Integrator, Method, Stages, State};
use super::line_search::{LineSearch, LineSearchSettings, Search};
use super::newton::{
    NewtonError, NewtonReport, NewtonSettings, NewtonWorkspace, demand_admissible, inadmissible, minimize,
};
use super::objective::{Objective, Quadratic, Terms};
use super::solver::{Choice, SparseSolver};
use super::spring::Spring;
use super::term::{NodeBlocks, Term};

mod adaptive;
mod error;

pub use adaptive::AdaptiveReport;
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
/// M a = −∇Ψ(x) − damping + M g + forces − springs − other terms
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
    terms: Vec<Arc<dyn Term>>,
    /// Second derivatives of springs and terms, where they were linearised last.
    blocks: NodeBlocks,
    /// A line search of the caller's own.
    line_search: Option<Arc<dyn LineSearch>>,
    /// Given force on each node, N; empty without any.
    forces: Vec<[f64; 3]>,
    state: State,
    /// Positions of the pinned nodes, and only of them, after the next step.
    targets: Vec<[f64; 3]>,
    pins: Pins,
    elastic: Elastic,
    workspace: NewtonWorkspace,
    viscosity: Option<Viscosity>,
    /// Memory of the energy–momentum method, made by its first step.
    conservation: Option<Box<Conservation>>,
    /// Diagonal that a unit of regularisation adds for each mass in statics, 1/s².
    static_regularisation: f64,
    next: State,
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
        let choice = Choice::Setting(settings.newton.linear);
        let workspace = NewtonWorkspace::new(&body, pins, choice, settings.newton.filtering)?;
        Ok(Self {
            settings,
            springs: Vec::new(),
            targets_before: Vec::new(),
            terms: Vec::new(),
            blocks: NodeBlocks::default(),
            line_search: None,
            forces: Vec::new(),
            state: State::at_rest(body.rest()),
            targets: body.rest().to_vec(),
            pins: pins.clone(),
            elastic: Elastic::new(&body),
            workspace,
            viscosity: settings.damping.viscosity(&body),
            conservation: None,
            static_regularisation: static_regularisation(&body),
            next: State::at_rest(body.rest()),
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
        &self.state.x
    }

    /// Current velocity of each node, m/s.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; 3]] {
        &self.state.v
    }

    /// Acceleration of each node at the end of the last step, m/s², as its integrator defines it: of
    /// Runge–Kutta methods that of the last stage. Zero before the first step and after
    /// [`Simulation::equilibrate`].
    #[must_use]
    pub fn accelerations(&self) -> &[[f64; 3]] {
        &self.state.a
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
        self.state.x.copy_from_slice(positions);
        self.targets.copy_from_slice(positions);
        self.evaluated = None;
        self.state.forget();
        Ok(())
    }

    /// Sets the velocity of each node, m/s; of a pinned node it lasts until the next step.
    ///
    /// # Errors
    /// [`SetupError::Length`] or [`SetupError::NotFinite`] unless there is one finite velocity for each node.
    pub fn set_velocities(&mut self, velocities: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(velocities)?;
        self.state.v.copy_from_slice(velocities);
        self.state.forget();
        Ok(())
    }

    /// Sets the acceleration of each node, m/s², from which Newmark's method and generalised α go on: with
    /// positions and velocities the whole state of a motion that is resumed.
    ///
    /// Without it, after positions or velocities have been set, they begin with the accelerations that the
    /// forces give.
    ///
    /// # Errors
    /// [`SetupError::Length`] or [`SetupError::NotFinite`] unless there is one finite acceleration for each
    /// node.
    pub fn set_accelerations(&mut self, accelerations: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(accelerations)?;
        self.state.a.copy_from_slice(accelerations);
        self.state.has_accelerations = true;
        Ok(())
    }

    /// Replaces the set of pinned nodes. A node that was not pinned before is held where it is.
    ///
    /// Pins among nodes that were free when the linear solver was set up cost nothing but the next
    /// factorisation; nodes let go that were pinned then cost a new symbolic analysis.
    ///
    /// # Errors
    /// [`SetupError::NoSuchNode`], [`SetupError::Linear`]. The pins then stay as they were.
    pub fn set_pins(&mut self, pins: &Pins) -> Result<(), SetupError> {
        let nodes = self.state.x.len();
        if let Some(&node) = pins.nodes().last().filter(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        self.workspace.set_pins(&self.body, pins)?;
        for node in 0..nodes {
            let was_pinned = self.pins.nodes().binary_search(&node).is_ok();
            if !(was_pinned && pins.nodes().binary_search(&node).is_ok()) {
                self.targets[node] = self.state.x[node];
                self.pins_move[node] = [0.0; 3];
            }
        }
        self.pins = pins.clone();
        Ok(())
    }

    /// Replaces the material of a part of the body, counted as [`Body::from_parts`] took them, from the next
    /// step on.
    ///
    /// # Errors
    /// [`BodyError::NoSuchPart`], [`BodyError::MaterialsForPoints`]. The material then stays as it was.
    pub fn set_material(
        &mut self,
        part: usize,
        material: impl TileMaterial<f64> + 'static,
    ) -> Result<(), BodyError> {
        self.body.set_material(part, material)?;
        self.static_regularisation = static_regularisation(&self.body);
        self.evaluated = None;
        Ok(())
    }

    /// Sets a force on each node, N, that keeps its size and direction from the next step on; an empty slice
    /// removes them.
    ///
    /// # Errors
    /// [`SetupError::Length`] or [`SetupError::NotFinite`] unless there is one finite force for each node.
    pub fn set_forces(&mut self, forces: &[[f64; 3]]) -> Result<(), SetupError> {
        if !forces.is_empty() {
            self.check_nodal(forces)?;
        }
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        Ok(())
    }

    /// Replaces all [terms](Term) of the energy but deformation, gravity and springs, from the next step on.
    ///
    /// ```
    /// # use piola::step::{NodeBlocks, Term};
    /// # struct Weight;
    /// # impl Term for Weight {
    /// #     fn energy(&self, x: &[[f64; 3]]) -> Option<f64> { Some(x.iter().map(|x| 10.0 * x[1]).sum()) }
    /// #     fn add_gradient(&self, _: &[[f64; 3]], g: &mut [[f64; 3]]) { g.iter_mut().for_each(|g| g[1] += 10.0) }
    /// #     fn add_second_derivatives(&self, _: &[[f64; 3]], _: &mut NodeBlocks) {}
    /// # }
    /// use std::sync::Arc;
    /// use piola::mesh::tetrahedral_box;
    /// use piola::step::{Simulation, SimulationSettings};
    /// use piola::system::{Body, Pins};
    ///
    /// /// Rubber.
    /// #[piola::material(domain(J > 0.0))]
    /// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let body = Body::new(&tetrahedral_box([1, 1, 1], [0.1; 3])?, Rubber::new(1e5, 4e5)?, 1000.0)?;
    /// let mut simulation = Simulation::new(body, &Pins::none(), SimulationSettings::default())?;
    /// simulation.set_terms(vec![Arc::new(Weight)]);
    /// let report = simulation.step(0.01)?;
    /// assert!(report.energies.terms < 10.0 * 8.0 * 0.1 && simulation.velocities()[0][1] < 0.0);
    /// # Ok(())
    /// # }
    /// ```
    pub fn set_terms(&mut self, terms: Vec<Arc<dyn Term>>) {
        self.terms = terms;
    }

    /// The given force on each node, N; empty without any.
    #[must_use]
    pub fn forces(&self) -> &[[f64; 3]] {
        &self.forces
    }

    /// Springs and other terms.
    pub(super) fn all_terms(&self) -> Terms<'_> {
        Terms { springs: &self.springs, others: &self.terms }
    }

    /// The terms of the energy but deformation, gravity and springs.
    #[must_use]
    pub fn terms(&self) -> &[Arc<dyn Term>] {
        &self.terms
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
        let is_other = (new.linear, new.filtering) != (old.linear, old.filtering);
        if is_other || self.workspace.has_own_solver() {
            let choice = Choice::Setting(new.linear);
            self.workspace = NewtonWorkspace::new(&self.body, &self.pins, choice, new.filtering)?;
        }
        if settings.integrator != self.settings.integrator {
            self.stages = Stages::new(settings.integrator, self.state.x.len());
        }
        if settings.damping != self.settings.damping {
            self.viscosity = settings.damping.viscosity(&self.body);
        }
        self.settings = settings;
        Ok(())
    }

    /// Solves the linear systems of Newton's method by a solver that is not piola's own, until the settings
    /// are replaced.
    ///
    /// # Errors
    /// [`SetupError::Linear`] with what the solver returns for the pattern. The solver before then stays.
    pub fn set_linear_solver(&mut self, solver: impl SparseSolver) -> Result<(), SetupError> {
        let (choice, filtering) = (Choice::Own(Arc::new(solver)), self.settings.newton.filtering);
        self.workspace = NewtonWorkspace::new(&self.body, &self.pins, choice, filtering)?;
        Ok(())
    }

    /// Shortens the steps of Newton's method by a line search that is not piola's own; `None` for that of the
    /// settings. The energy–momentum method, which has no objective, keeps to the settings.
    ///
    /// ```
    /// # use piola::mesh::tetrahedral_box;
    /// # use piola::step::{Line, Simulation, SimulationSettings};
    /// # use piola::system::{Body, Pins};
    /// # use std::sync::Arc;
    /// # /// Rubber.
    /// # #[piola::material(domain(J > 0.0))]
    /// # fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
    /// #     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    /// # }
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # let body = Body::new(&tetrahedral_box([1, 1, 1], [0.1; 3])?, Rubber::new(1e5, 4e5)?, 1000.0)?;
    /// # let mut simulation = Simulation::new(body, &Pins::at([0, 1]), SimulationSettings::default())?;
    /// // Whole steps, or half ones that go downhill.
    /// let search = |line: &mut dyn Line, longest: f64, _slope: f64| {
    ///     let mut steps = [longest, 0.5 * longest].into_iter();
    ///     steps.find(|&step| line.change(step).is_some_and(|change| change.difference < change.noise))
    /// };
    /// simulation.set_line_search(Some(Arc::new(search)));
    /// # simulation.step(0.01)?;
    /// # Ok(())
    /// # }
    /// ```
    pub fn set_line_search(&mut self, search: Option<Arc<dyn LineSearch>>) {
        self.line_search = search;
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
        let [tau, sigma] = self.settings.integrator.method(dt, &self.state).lengths(dt);
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
        let method = integrator.method(dt, &self.state);
        let mut survey = match self.evaluated.take() {
            Some(survey) => survey,
            None => self.elastic.evaluate(&self.body, &self.state.x),
        };
        if method.needs_accelerations() && !self.state.has_accelerations {
            demand_admissible(&survey, &self.body, &self.elastic).map_err(StepError::Newton)?;
            self.accelerate();
        }
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
        let (report, mut survey) = self.minimize_stage(&method, last, dt, survey)?;
        self.stages.finish(&method, dt, &self.state, &mut self.next);
        if !method.ends_with_last_stage() {
            survey = self.end_beyond_last_stage(dt)?;
        }

        std::mem::swap(&mut self.state, &mut self.next);
        self.state.has_accelerations = true;
        if integrator.looks_back() {
            self.state.come_from(&self.next, dt);
        } else {
            self.state.earlier = None;
        }
        for (before, spring) in self.targets_before.iter_mut().zip(&self.springs) {
            *before = spring.target;
        }
        self.evaluated = Some(survey);
        let newton = report.after(stages_before);
        Ok(StepReport { newton, min_det: survey.min_det, energies: self.energies_of(self.elastic.energy()) })
    }

    /// Sets the accelerations that the forces at the current state give, zero at pinned nodes. The energies
    /// must have been evaluated there last.
    fn accelerate(&mut self) {
        let forces = self.balance();
        for (node, (a, force)) in self.state.a.iter_mut().zip(forces).enumerate() {
            *a = force.map(|force| -force / self.body.masses()[node]);
        }
        self.pins.nodes().iter().for_each(|&node| self.state.a[node] = [0.0; 3]);
        self.state.has_accelerations = true;
    }

    /// Gradient of all energies at the current state, damping included and inertia not, N. The elastic
    /// energies must have been evaluated there last.
    fn balance(&mut self) -> Vec<[f64; 3]> {
        let State { x, v, .. } = &self.state;
        let mut total = vec![[0.0; 3]; x.len()];
        self.elastic.evaluate_gradients(&self.body);
        self.elastic.add_gradient(&self.body, &mut total);
        self.all_terms().add_gradient(x, &mut total);
        if let Some(viscosity) = &mut self.viscosity {
            viscosity.linearise(&self.body, &mut self.elastic, self.settings.damping.time());
            viscosity.add_product(&self.body, |node| v[node], &mut total);
        }
        let (rate, gravity) = (self.settings.damping.rate(), self.settings.gravity);
        for (node, (total, mass)) in total.iter_mut().zip(self.body.masses()).enumerate() {
            for c in 0..3 {
                let force = self.forces.get(node).map_or(0.0, |force| force[c]);
                total[c] += mass * (rate * v[node][c] - gravity[c]) - force;
            }
        }
        total
    }

    /// Sets how far the pinned nodes move in a stage that takes them to this share of their way; true if any
    /// does.
    fn drive_pins(&mut self, method: &Method, dt: f64, share: f64) -> bool {
        let mut is_moving = false;
        for &node in self.pins.nodes() {
            let (target, before) = (self.targets[node], self.state.x[node]);
            let way: [f64; 3] = std::array::from_fn(|c| target[c] - before[c]);
            for c in 0..3 {
                self.pins_move[node][c] = share * way[c] - (self.next.x[node][c] - before[c]);
                is_moving |= self.pins_move[node][c] != 0.0;
            }
            if method.needs_accelerations() {
                self.stages.drive(node, dt, way, std::array::from_fn(|c| before[c] + share * way[c]));
            }
        }
        is_moving
    }

    /// Evaluates the state after a step that lies beyond its last stage.
    fn end_beyond_last_stage(&mut self, dt: f64) -> Result<Evaluated, StepError> {
        for &node in self.pins.nodes() {
            let before = self.state.x[node];
            self.next.x[node] = self.targets[node];
            self.next.v[node] = std::array::from_fn(|c| (self.targets[node][c] - before[c]) / dt);
        }
        let survey = self.elastic.evaluate(&self.body, &self.next.x);
        match inadmissible(&survey, &self.body) {
            Some(element) => Err(StepError::EndsBeyondDomain { element }),
            None => Ok(survey),
        }
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
        let pins_move = self.drive_pins(method, dt, share);
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
        if !is_static && self.settings.integrator == Integrator::EnergyMomentum {
            let conservation =
                self.conservation.get_or_insert_with(|| Box::new(Conservation::new(&self.body)));
            let report = conservation.solve(
                &mut objective,
                self.workspace.free_nodes(),
                &mut self.next.x,
                pins_move.then_some(&self.pins_move),
                &self.settings.newton,
                &self.settings.line_search,
            )?;
            return Ok((report, survey));
        }
        minimize(
            &mut objective,
            &mut self.workspace,
            &mut self.next.x,
            pins_move.then_some(&self.pins_move),
            survey,
            &self.settings.newton,
            Search { settings: &self.settings.line_search, own: self.line_search.as_deref() },
        )
    }

    /// Force of the pins on each pinned node, N, in the order of [`Simulation::pinned`]: what the node needs
    /// beside all other forces to have its acceleration, at the end of the last step.
    ///
    /// In statics their sum balances gravity, given forces and springs.
    ///
    /// # Errors
    /// [`NewtonError::Inadmissible`] or [`NewtonError::ElementNotFinite`] for an element that has no forces at
    /// the current positions.
    pub fn reactions(&mut self) -> Result<Vec<[f64; 3]>, NewtonError> {
        let survey = *self.evaluated.get_or_insert_with(|| self.elastic.evaluate(&self.body, &self.state.x));
        demand_admissible(&survey, &self.body, &self.elastic)?;
        let forces = self.balance();
        let reaction = |&node: &usize| {
            std::array::from_fn(|c| forces[node][c] + self.body.masses()[node] * self.state.a[node][c])
        };
        Ok(self.pins.nodes().iter().map(reaction).collect())
    }

    /// Energies of the current state; the elastic one is NaN if an element is outside its domain.
    #[must_use]
    pub fn energies(&mut self) -> Energies {
        let survey = *self.evaluated.get_or_insert_with(|| self.elastic.evaluate(&self.body, &self.state.x));
        self.energies_of(if survey.survey.is_clean() { self.elastic.energy() } else { f64::NAN })
    }

    fn energies_of(&self, elastic: f64) -> Energies {
        let State { x, v, .. } = &self.state;
        let mut energies = Energies { elastic, ..Energies::default() };
        for (node, mass) in self.body.masses().iter().enumerate() {
            for c in 0..3 {
                let displacement = x[node][c] - self.body.rest()[node][c];
                energies.kinetic += 0.5 * mass * v[node][c].powi(2);
                energies.gravity -= mass * self.settings.gravity[c] * displacement;
                energies.forces -= self.forces.get(node).map_or(0.0, |force| force[c] * displacement);
            }
        }
        energies.springs += self.springs.iter().map(|spring| spring.energy(x)).sum::<f64>();
        energies.terms += self.all_terms().energy_of_others(x);
        energies
    }

    fn check_nodal(&self, vectors: &[[f64; 3]]) -> Result<(), SetupError> {
        if vectors.len() != self.state.x.len() {
            return Err(SetupError::Length { expected: self.state.x.len(), found: vectors.len() });
        }
        match vectors.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            Some(node) => Err(SetupError::NotFinite { node }),
            None => Ok(()),
        }
    }

    fn check_spring(&self, index: usize, spring: &Spring) -> Result<(), SetupError> {
        let nodes = self.state.x.len();
        if let Some(&node) = spring.anchor.nodes.iter().find(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        let numbers = spring.anchor.weights.iter().chain(&spring.target).chain([&spring.stiffness]);
        if spring.stiffness < 0.0 || !numbers.into_iter().all(|x| x.is_finite()) {
            return Err(SetupError::Spring { index });
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
    let SimulationSettings { gravity, damping, integrator, newton, line_search } = settings;
    let between = |x: f64, low: f64, high: f64| low < x && x < high;
    let checks = [
        (gravity.iter().all(|g| g.is_finite()), "gravity must be finite"),
        (newton.max_iterations > 0, "Newton's method needs at least one iteration"),
        (newton.tolerance >= 0.0 && newton.tolerance < 1.0, "the tolerance must be at least 0 and below 1"),
        (
            newton.error_share >= 0.0 && newton.error_share < 1.0,
            "the share of a step's error must be at least 0 and below 1",
        ),
        (
            between(line_search.sufficient_decrease, 0.0, 0.5),
            "the sufficient decrease must be between 0 and 1/2",
        ),
        (between(line_search.shrink, 0.0, 1.0), "the shrinking factor must be between 0 and 1"),
        (line_search.max_trials > 0, "the line search needs at least one trial"),
    ];
    let broken = checks.into_iter().find(|(holds, _)| !holds).map(|(_, rule)| rule);
    let broken = broken.or(damping.broken_rule()).or(integrator.broken_rule());
    let broken = broken.or(newton.filtering.broken_rule());
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
    /// Energy in the field of given forces, 0 in the rest shape.
    pub forces: f64,
    /// Energy of other terms.
    pub terms: f64,
}

impl Energies {
    /// Sum of all energies, J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.elastic + self.kinetic + self.gravity + self.springs + self.forces + self.terms
    }
}

#[cfg(test)]
mod tests;
