//! A body in time.

use std::fmt;
use std::ops::Range;

use crate::batch::TileMaterial;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::linear::LinearError;
use crate::system::{Body, Pins};

use super::damping::{Damping, Viscosity};
use super::line_search::LineSearchSettings;
use super::newton::{NewtonError, NewtonReport, NewtonSettings, Workspace, minimize};
use super::objective::{Objective, Pull, Quadratic};

/// How a body is stepped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// What works against velocity.
    pub damping: Damping,
    /// How each step is minimised.
    pub newton: NewtonSettings,
    /// How Newton steps are shortened.
    pub line_search: LineSearchSettings,
}

/// A body with its state, stepped by implicit Euler.
///
/// ```math
/// v = (x − xₙ)/h,   M (v − vₙ)/h = −∇Ψ(x) − damping + M g − pulls
/// ```
///
/// All memory is allocated by [`Simulation::new`], or by [`Simulation::set_settings`] for another linear solver, but for the
/// small lists of a report. The same input gives the same bits for any number of threads of the rayon pool in which `step` is
/// called.
pub struct Simulation {
    body: Body,
    settings: Settings,
    pulls: Vec<Pull>,
    positions: Vec<[f64; 3]>,
    velocities: Vec<[f64; 3]>,
    /// Where the pinned nodes, and only they, are to be after the next step.
    targets: Vec<[f64; 3]>,
    pins: Pins,
    elastic: Elastic,
    workspace: Workspace,
    viscosity: Option<Viscosity>,
    /// What a unit of regularisation adds for each mass in statics, 1/s².
    static_regularisation: f64,
    next: Vec<[f64; 3]>,
    pins_move: Vec<[f64; 3]>,
    /// What the elastic energies at `positions` say, if they are what was evaluated last.
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
    /// A body at rest in its rest shape. Does the symbolic part of all linear algebra to come.
    ///
    /// # Errors
    /// Where a pin or a setting makes no sense, or memory does not suffice.
    pub fn new(body: Body, pins: &Pins, settings: Settings) -> Result<Self, SetupError> {
        let nodes = body.rest().len();
        if let Some(&node) = pins.nodes().last().filter(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        check_settings(&settings)?;
        let workspace = Workspace::new(&body, pins, &settings.newton).map_err(SetupError::Linear)?;
        Ok(Self {
            settings,
            pulls: Vec::new(),
            positions: body.rest().to_vec(),
            velocities: vec![[0.0; 3]; nodes],
            targets: body.rest().to_vec(),
            pins: pins.clone(),
            elastic: Elastic::new(&body),
            workspace,
            viscosity: settings.damping.viscosity(&body),
            static_regularisation: static_regularisation(&body),
            next: vec![[0.0; 3]; nodes],
            pins_move: vec![[0.0; 3]; nodes],
            evaluated: None,
            body,
        })
    }

    /// The body.
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

    /// The pinned nodes, ascending.
    #[must_use]
    pub fn pinned(&self) -> &[usize] {
        self.pins.nodes()
    }

    /// Puts each node somewhere, m, however deformed or collapsed the body then is. Pins hold their nodes there.
    ///
    /// # Errors
    /// Where there is not one finite position for each node.
    pub fn set_positions(&mut self, positions: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(positions)?;
        self.positions.copy_from_slice(positions);
        self.targets.copy_from_slice(positions);
        self.evaluated = None;
        Ok(())
    }

    /// Gives each node a velocity, m/s. That of a pinned node lasts until the next step.
    ///
    /// # Errors
    /// Where there is not one finite velocity for each node.
    pub fn set_velocities(&mut self, velocities: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(velocities)?;
        self.velocities.copy_from_slice(velocities);
        Ok(())
    }

    /// Says where a pinned node is to be, m, after the next step and from then on.
    ///
    /// # Errors
    /// Where the node is not pinned or the position not finite.
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

    /// Replaces all pulls.
    ///
    /// # Errors
    /// Where the nodes of a pull do not belong to one element, its stiffness is negative, or a number is not finite. The
    /// pulls before are then still there.
    pub fn set_pulls(&mut self, pulls: &[Pull]) -> Result<(), SetupError> {
        pulls.iter().enumerate().try_for_each(|(index, pull)| self.check_pull(index, pull))?;
        self.pulls.clear();
        self.pulls.extend_from_slice(pulls);
        Ok(())
    }

    /// The pulls.
    #[must_use]
    pub fn pulls(&self) -> &[Pull] {
        &self.pulls
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Replaces the settings from the next step on. Another linear solver, or another tolerance of it, is set up as by
    /// [`Simulation::new`].
    ///
    /// # Errors
    /// Where one makes no sense, or memory does not suffice. The settings before are then still there.
    pub fn set_settings(&mut self, settings: Settings) -> Result<(), SetupError> {
        check_settings(&settings)?;
        let (new, old) = (&settings.newton, &self.settings.newton);
        if (new.linear, new.filtering) != (old.linear, old.filtering) {
            self.workspace = Workspace::new(&self.body, &self.pins, new).map_err(SetupError::Linear)?;
        }
        if settings.damping != self.settings.damping {
            self.viscosity = settings.damping.viscosity(&self.body);
        }
        self.settings = settings;
        Ok(())
    }

    /// Advances by `dt`, s.
    ///
    /// # Errors
    /// Where there is no admissible next state. The state before the step is then untouched, and a shorter step may do.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, StepError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(StepError::TimeStep { dt });
        }
        self.advance(dt)
    }

    /// Moves the body towards a minimum of its energy in the field of gravity and pulls, without inertia and damping, as far as
    /// the settings of Newton's method say. Then it is at rest: its velocities are zero.
    ///
    /// Where the second derivatives are not positive definite, small parts of the stiffness are added to them; so they are,
    /// one ten-thousandth of one, for a body with fewer than three pinned nodes, which may move as a whole at no cost.
    ///
    /// # Errors
    /// Where there is no admissible next state. The state before is then untouched.
    pub fn equilibrate(&mut self) -> Result<StepReport, StepError> {
        self.advance(f64::INFINITY)
    }

    /// A step of any length, infinity included.
    fn advance(&mut self, dt: f64) -> Result<StepReport, StepError> {
        self.next.copy_from_slice(&self.positions);
        let mut pins_move = false;
        for &node in self.pins.nodes() {
            for c in 0..3 {
                self.pins_move[node][c] = self.targets[node][c] - self.positions[node][c];
                pins_move |= self.pins_move[node][c] != 0.0;
            }
        }
        let survey = match self.evaluated.take() {
            Some(survey) => survey,
            None => self.elastic.evaluate(&self.body, &self.positions),
        };
        let is_static = dt == f64::INFINITY;
        let viscosity = self.viscosity.as_mut().filter(|_| !is_static).map(|viscosity| {
            viscosity.linearise(&self.body, &mut self.elastic, self.settings.damping.time() / dt);
            &*viscosity
        });
        let regularisation = if is_static { self.static_regularisation } else { 1.0 / (dt * dt) };
        let may_drift = is_static && self.pins.nodes().len() < 3;
        let mut objective = Objective {
            body: &self.body,
            elastic: &mut self.elastic,
            quadratic: Quadratic {
                masses: self.body.masses(),
                start: &self.positions,
                velocities: &self.velocities,
                dt,
                damping: self.settings.damping.rate(),
                regularisation,
                guard: if may_drift { DRIFT * regularisation } else { 0.0 },
                gravity: self.settings.gravity,
                pulls: &self.pulls,
            },
            viscosity,
        };
        let (newton, survey) = minimize(
            &mut objective,
            &mut self.workspace,
            &mut self.next,
            pins_move.then_some(&self.pins_move),
            survey,
            &self.settings.newton,
            &self.settings.line_search,
        )
        .map_err(StepError::Newton)?;

        for (velocity, (next, position)) in
            self.velocities.iter_mut().zip(self.next.iter().zip(&self.positions))
        {
            for c in 0..3 {
                velocity[c] = (next[c] - position[c]) / dt;
            }
        }
        std::mem::swap(&mut self.positions, &mut self.next);
        self.evaluated = Some(survey);
        Ok(StepReport { newton, min_det: survey.min_det, energies: self.energies_of(self.elastic.energy()) })
    }

    /// Energies of the current state; NaN for the elastic one where an element is outside its domain.
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
        energies.pulls = self.pulls.iter().map(|pull| pull.energy(&self.positions)).sum();
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

    fn check_pull(&self, index: usize, pull: &Pull) -> Result<(), SetupError> {
        let nodes = self.positions.len();
        if let Some(&node) = pull.anchor.nodes.iter().find(|&&node| node >= nodes) {
            return Err(SetupError::NoSuchNode { node, nodes });
        }
        let numbers = pull.anchor.weights.iter().chain(&pull.target).chain([&pull.stiffness]);
        if pull.stiffness < 0.0 || !numbers.into_iter().all(|x| x.is_finite()) {
            return Err(SetupError::Pull { index });
        }
        let is_free = |node: &usize| self.pinned().binary_search(node).is_err();
        let free = pull.weights().map(|(node, _)| node).filter(is_free);
        for a in free.clone() {
            if free.clone().any(|b| !self.workspace.solver.joins(a, b)) {
                return Err(SetupError::PullAcrossElements { index });
            }
        }
        Ok(())
    }
}

/// How many units of regularisation a body gets in statics that may move as a whole.
const DRIFT: f64 = 1e-4;

/// What to add for each unit of mass, 1/s², so that it is small beside the stiffness of elements: a ten-thousandth of their
/// stiffness over the mass of the body.
fn static_regularisation(body: &Body) -> f64 {
    let stiffness = |(material, elements): (&dyn TileMaterial<f64>, Range<usize>)| -> f64 {
        let lengths = body.elements()[elements].iter().map(|element| element.shape.volume.cbrt());
        material.properties().rest_stiffness.abs() * lengths.sum::<f64>()
    };
    1e-4 * body.materials().map(stiffness).sum::<f64>() / body.masses().iter().sum::<f64>()
}

fn check_settings(settings: &Settings) -> Result<(), SetupError> {
    let Settings { gravity, damping, newton, line_search } = settings;
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

/// What a step did.
#[derive(Clone, Debug, PartialEq)]
pub struct StepReport {
    /// What Newton's method did.
    pub newton: NewtonReport,
    /// Smallest det F of an element after the step.
    pub min_det: f64,
    /// Energies after the step.
    pub energies: Energies,
}

/// Energies of a body, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Of deformation.
    pub elastic: f64,
    /// Of motion.
    pub kinetic: f64,
    /// In the field of gravity, 0 at rest.
    pub gravity: f64,
    /// Of the pulls.
    pub pulls: f64,
}

impl Energies {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.elastic + self.kinetic + self.gravity + self.pulls
    }
}

/// Why a body cannot be simulated this way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// A pin or pull names a node that does not exist.
    NoSuchNode {
        /// The node, from 0.
        node: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A motion is prescribed for a node that is not pinned.
    NotPinned {
        /// The node, from 0.
        node: usize,
    },
    /// Not one entry for each node.
    Length {
        /// How many nodes there are.
        expected: usize,
        /// How many entries were given.
        found: usize,
    },
    /// A position or velocity is infinite or NaN.
    NotFinite {
        /// Of this node, from 0.
        node: usize,
    },
    /// A pull has a negative stiffness or a number that is not finite.
    Pull {
        /// Which pull, from 0.
        index: usize,
    },
    /// The nodes of a pull do not belong to one element.
    PullAcrossElements {
        /// Which pull, from 0.
        index: usize,
    },
    /// A setting makes no sense.
    Setting {
        /// The rule that it breaks.
        rule: &'static str,
    },
    /// The linear solver cannot be set up.
    Linear(LinearError),
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchNode { node, nodes } => write!(f, "there is no node {node} (from 0) among {nodes}"),
            Self::NotPinned { node } => {
                write!(f, "node {node} (from 0) is not pinned, so its motion cannot be prescribed")
            }
            Self::Length { expected, found } => {
                write!(f, "expected one entry for each of {expected} nodes, found {found}")
            }
            Self::NotFinite { node } => write!(f, "the entry of node {node} (from 0) is not finite"),
            Self::Pull { index } => {
                write!(f, "pull {index} (from 0) has a negative stiffness or a number that is not finite")
            }
            Self::PullAcrossElements { index } => {
                write!(f, "the nodes of pull {index} (from 0) do not belong to one element")
            }
            Self::Setting { rule } => write!(f, "{rule}"),
            Self::Linear(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for SetupError {}

/// Why there is no next state. The state before the step is untouched.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// The time step is not a positive number.
    TimeStep {
        /// As given, s.
        dt: f64,
    },
    /// The minimisation fails.
    Newton(NewtonError),
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TimeStep { dt } => write!(f, "the time step is {dt} s; it must be a positive number"),
            Self::Newton(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StepError {}

#[cfg(test)]
mod tests;
