//! Time steps of a body that is divided among ranks.

use piola_bodies::step::divided::{InStage, Pace, Repeatable, StagedSteps, advance_within, minimize};
use piola_bodies::step::{LinearSolver, NewtonReport, SimulationSettings, Spring};

use crate::elastic::{Elastic, MaterialPart};
use crate::error::Error;
use crate::minimisation::{Limits, Objective, StageMinimisation};
use crate::petsc::GhostedVector;
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Regularisation, in its units, that is added in statics for a body that can move as a whole.
const DRIFT: f64 = 1e-4;

/// Report of a stage of a step, equal on all ranks.
#[derive(Clone, Debug, PartialEq)]
pub struct StageReport {
    /// Report of Newton's method.
    pub newton: NewtonReport,
    /// Number of iterations of the linear solver in each linear system, including failed attempts.
    pub systems: Vec<usize>,
}

/// Energies of the body, J, with the definitions of [`piola_bodies::step::Energies`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

/// Divided body with its state, on one rank. All ranks must call all functions.
pub struct Simulation {
    team: Team,
    share: Share,
    settings: SimulationSettings,
    /// α of damping proportional to mass, 1/s.
    damping: f64,
    limits: Limits,
    elastic: Elastic,
    exchange: GhostedVector,
    system: LinearSystem,
    /// Masses of owned nodes, kg.
    masses: Vec<f64>,
    steps: StagedSteps,
    static_regularisation: f64,
    pins: usize,
}

impl Simulation {
    /// Simulation that starts at rest, with the nodes at the start positions of the share.
    ///
    /// # Errors
    /// An [`Error`] of an element, a material, a setting or of PETSc.
    pub fn new(
        team: &Team,
        share: Share,
        parts: &[MaterialPart],
        settings: SimulationSettings,
    ) -> Result<Self, Error> {
        let damping = settings.damping;
        let LinearSolver::ConjugateGradients { tolerance, max_iterations } = settings.newton.linear else {
            return Err(not_divided("a linear solver other than conjugate gradients"));
        };
        let elastic = team.agree(Elastic::new(&share, parts))?;
        let exchange = GhostedVector::new(team.library(), 3, share.owned, &share.copies)?;
        let mut masses = vec![0.0; share.ids.len()];
        elastic.add_masses(&mut masses);
        GhostedVector::new(team.library(), 1, share.owned, &share.copies)?.sum(&mut masses)?;
        masses.truncate(share.owned);
        let [stiffness, mass] = team.sum([elastic.stiffness(), masses.iter().sum()]);

        let start: Vec<[f64; 3]> = share.places.iter().map(|place| place.start).collect();
        let steps =
            team.agree(StagedSteps::new(settings.integrator, &start, &share.pinned()).map_err(Error::from))?;
        let matrix = team.agree(elastic.nodal_stiffness())?;
        Ok(Self {
            pins: team.count(share.owned - share.free),
            system: LinearSystem::new(team, &share, matrix)?,
            team: team.clone(),
            settings,
            damping,
            limits: Limits { tolerance, max_iterations },
            elastic,
            exchange,
            masses,
            steps,
            static_regularisation: 1e-4 * stiffness / mass,
            share,
        })
    }

    /// Nodes and elements of this rank.
    #[must_use]
    pub fn share(&self) -> &Share {
        &self.share
    }

    /// Positions, m, velocities, m/s, and accelerations, m/s², of the nodes of this rank, copies included.
    #[must_use]
    pub fn state(&self) -> &StagedSteps {
        &self.steps
    }

    /// Replaces the state of the nodes of this rank, copies included. Accelerations are the ones at the end
    /// of the previous step.
    ///
    /// # Errors
    /// [`Error::OnRank`] unless there is one finite vector of each for each node.
    pub fn set_state(
        &mut self,
        positions: &[[f64; 3]],
        velocities: &[[f64; 3]],
        accelerations: Option<&[[f64; 3]]>,
    ) -> Result<(), Error> {
        let steps = &mut self.steps;
        let set =
            steps.set_positions(positions).and_then(|()| steps.set_velocities(velocities)).and_then(|()| {
                accelerations.map_or(Ok(()), |accelerations| steps.set_accelerations(accelerations))
            });
        self.team.agree(set.map_err(Error::from))
    }

    /// Prescribes the positions of pinned nodes of this rank and its copies after the next step, m; `None`
    /// leaves a node as it is.
    ///
    /// # Errors
    /// [`Error::OnRank`] for a position that is not finite.
    pub fn prescribe(&mut self, place: impl Fn(usize) -> Option<[f64; 3]>) -> Result<(), Error> {
        let pinned = self.steps.pinned().to_vec();
        let set = pinned
            .into_iter()
            .try_for_each(|node| place(node).map_or(Ok(()), |place| self.steps.prescribe(node, place)));
        self.team.agree(set.map_err(Error::from))
    }

    /// Replaces the springs at owned nodes. If a spring has the index and anchor of a previous spring, its
    /// target moves uniformly to the new one.
    ///
    /// # Errors
    /// [`Error::OnRank`] for a spring that is not finite, or is attached to a node that does not exist.
    pub fn set_springs(&mut self, springs: &[Spring]) -> Result<(), Error> {
        let set = self.steps.set_springs(springs);
        self.team.agree(set.map_err(Error::from))
    }

    /// Advances the state by `dt`, s; returns the reports of the stages.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn step(&mut self, dt: f64) -> Result<Vec<StageReport>, Error> {
        let mut reports = Vec::new();
        for stage in 0..self.steps.begin(dt) {
            let moves = self.steps.begin_stage(stage);
            let moves = self.team.count(usize::from(moves)) > 0;
            let [tau, sigma] = self.steps.stage().lengths();
            let is_static = tau == f64::INFINITY;
            let regularisation = if is_static { self.static_regularisation } else { 1.0 / (tau * sigma) };
            let may_drift = is_static && self.pins < 3;
            let InStage { stage: current, springs, pins_move, end } = self.steps.in_stage();
            let objective = Objective {
                team: &self.team,
                share: &self.share,
                elastic: &mut self.elastic,
                exchange: &mut self.exchange,
                masses: &self.masses,
                stage: current,
                damping: self.damping,
                gravity: self.settings.gravity,
                springs,
                regularisation,
                guard: if may_drift { DRIFT * regularisation } else { 0.0 },
            };
            let mut minimisation =
                StageMinimisation::new(objective, &mut self.system, self.limits, end, pins_move)?;
            let newton = minimize(&mut minimisation, moves, &self.settings.newton)?;
            reports.push(StageReport { newton, systems: minimisation.systems() });
            self.steps.end_stage(stage);
        }
        self.steps.finish();
        Ok(reports)
    }

    /// Advances the state over a time interval, s, with adaptive steps. The error of positions stays within
    /// `tolerance`, m/s, times the interval, as in [`piola_bodies::step::Simulation::advance_within`].
    /// Returns the steps, with the reports of all of their stages, including refused steps.
    ///
    /// # Errors
    /// An [`Error`] of the shortest step, or of PETSc.
    pub fn advance_within(&mut self, duration: f64, tolerance: f64) -> Result<Pace<Vec<StageReport>>, Error> {
        advance_within(self, duration, tolerance * duration)
    }

    /// Moves the body to equilibrium: a minimum of its energy with gravity and springs, without inertia.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn equilibrate(&mut self) -> Result<StageReport, Error> {
        let mut reports = self.step(f64::INFINITY)?;
        // Statics have one stage.
        Ok(reports.remove(0))
    }

    /// Evaluates the energies of all elements at the current state; the error is the tag of an element
    /// without an energy.
    fn evaluate(&mut self) -> Result<(), u64> {
        let x = self.steps.positions();
        self.elastic.evaluate(x);
        let tag = self.team.min(self.elastic.refused().map_or(f64::INFINITY, |tag| tag as f64));
        if tag.is_finite() { Err(tag as u64) } else { Ok(()) }
    }

    /// Energies of the current state; the elastic energy is NaN if an element is outside the domain of its
    /// material.
    #[must_use]
    pub fn energies(&mut self) -> Energies {
        let is_admissible = self.evaluate().is_ok();
        let (x, v) = (self.steps.positions(), self.steps.velocities());
        let [mut kinetic, mut gravity] = [0.0; 2];
        for (node, mass) in self.masses.iter().enumerate() {
            for c in 0..3 {
                kinetic += 0.5 * mass * v[node][c].powi(2);
                gravity -= mass * self.settings.gravity[c] * (x[node][c] - self.share.places[node].rest[c]);
            }
        }
        let springs = self.steps.springs().iter().map(|spring| spring.energy(x)).sum();
        let [elastic, kinetic, gravity, springs] =
            self.team.sum([self.elastic.energy(), kinetic, gravity, springs]);
        Energies { elastic: if is_admissible { elastic } else { f64::NAN }, kinetic, gravity, springs }
    }
}

/// Error for a setting that is not supported for bodies divided among ranks.
fn not_divided(setting: &str) -> Error {
    Error::Options(format!("{setting} is not supported for a body that is divided among ranks"))
}

impl Repeatable for Simulation {
    type Report = Vec<StageReport>;
    type Error = Error;

    fn steps(&self) -> &StagedSteps {
        &self.steps
    }

    fn steps_mut(&mut self) -> &mut StagedSteps {
        &mut self.steps
    }

    fn step(&mut self, dt: f64) -> Result<Vec<StageReport>, Error> {
        Simulation::step(self, dt)
    }

    fn largest(&self, distance: f64) -> f64 {
        self.team.max(distance)
    }

    fn is_final(error: &Error) -> bool {
        error.is_final()
    }
}
