//! A body that is divided among ranks, stepped in time.

use piola::step::{
    Integrator, Pace, Repeatable, SetupError, Spring, Stage, StagedSteps, advance_within, on_the_way,
};

use crate::elastic::{Elastic, MaterialPart};
use crate::error::Error;
use crate::newton::{NewtonReport, NewtonSettings, Objective, minimize};
use crate::petsc::GhostedVector;
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Number of units of regularisation, in statics, for a body that may move as a whole.
const DRIFT: f64 = 1e-4;

/// Settings of a [`Simulation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulationSettings {
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// α of damping proportional to mass, 1/s.
    pub damping: f64,
    /// Method by which steps advance in time.
    pub integrator: Integrator,
    /// Settings of Newton's method.
    pub newton: NewtonSettings,
}

/// Energies of the body, J, as [`piola::step::Energies`] has them.
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

/// A divided body with its state, as one rank sees it. All functions are called by all ranks.
pub struct Simulation {
    team: Team,
    share: Share,
    settings: SimulationSettings,
    elastic: Elastic,
    exchange: GhostedVector,
    system: LinearSystem,
    /// Of owned nodes, kg.
    masses: Vec<f64>,
    steps: StagedSteps,
    /// The pinned nodes of this rank and its copies.
    pinned: Vec<usize>,
    /// Where pinned nodes are after the next step, m.
    targets: Vec<[f64; 3]>,
    springs: Vec<Spring>,
    targets_before: Vec<[f64; 3]>,
    static_regularisation: f64,
    pins: usize,
}

impl Simulation {
    /// A simulation that starts at rest where the share has its nodes.
    ///
    /// # Errors
    /// An [`Error`] of an element, a material, a setting or of PETSc.
    pub fn new(
        team: &Team,
        share: Share,
        parts: &[MaterialPart],
        settings: SimulationSettings,
    ) -> Result<Self, Error> {
        let elastic = team.agree(Elastic::new(&share, parts))?;
        let mut exchange = GhostedVector::new(team.library(), share.owned, &share.copies)?;
        let mut of_all = vec![0.0; share.ids.len()];
        elastic.add_masses(&mut of_all);
        exchange.begin_sum(&of_all.iter().map(|&mass| [mass, 0.0, 0.0]).collect::<Vec<_>>())?;
        let mut sums = vec![[0.0; 3]; share.owned];
        exchange.end_sum(&mut sums)?;
        let masses: Vec<f64> = sums.iter().map(|sum| sum[0]).collect();
        let [stiffness, mass] = team.sum([elastic.stiffness(), masses.iter().sum()]);

        let start: Vec<[f64; 3]> = share.places.iter().map(|place| place.start).collect();
        let steps = StagedSteps::new(settings.integrator, &start);
        let pinned = share.pinned();
        Ok(Self {
            pins: team.count(share.owned - share.free),
            system: LinearSystem::new(team, &share, &elastic)?,
            team: team.clone(),
            settings,
            elastic,
            exchange,
            masses,
            steps,
            pinned,
            targets: start,
            springs: Vec::new(),
            targets_before: Vec::new(),
            static_regularisation: 1e-4 * stiffness / mass,
            share,
        })
    }

    /// The nodes and elements of this rank.
    #[must_use]
    pub fn share(&self) -> &Share {
        &self.share
    }

    /// Positions, m, velocities, m/s, and accelerations, m/s², of the nodes of this rank and of its copies.
    #[must_use]
    pub fn state(&self) -> &StagedSteps {
        &self.steps
    }

    /// Replaces the state of the nodes of this rank and of its copies. Accelerations are those at the
    /// end of the step before.
    ///
    /// # Errors
    /// [`SetupError::Length`].
    pub fn set_state(
        &mut self,
        positions: &[[f64; 3]],
        velocities: &[[f64; 3]],
        accelerations: Option<&[[f64; 3]]>,
    ) -> Result<(), SetupError> {
        self.steps.set_state(positions, velocities)?;
        accelerations.map_or(Ok(()), |accelerations| self.steps.set_accelerations(accelerations))?;
        self.targets.copy_from_slice(positions);
        Ok(())
    }

    /// Prescribes where pinned nodes of this rank and its copies, are after the next step, m; others are left
    /// as they are.
    pub fn prescribe(&mut self, place: impl Fn(usize) -> Option<[f64; 3]>) {
        for &node in &self.pinned {
            self.targets[node] = place(node).unwrap_or(self.targets[node]);
        }
    }

    /// Replaces the springs at owned nodes. Each that is at the index and anchor of one before moves evenly
    /// to its new target.
    pub fn set_springs(&mut self, springs: Vec<Spring>) {
        let before = |(index, spring): (usize, &Spring)| match self.springs.get(index) {
            Some(old) if old.anchor == spring.anchor => self.targets_before[index],
            _ => spring.target,
        };
        self.targets_before = springs.iter().enumerate().map(before).collect();
        self.springs = springs;
    }

    /// Advances the state by `dt`, s; returns the reports of the stages.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn step(&mut self, dt: f64) -> Result<Vec<NewtonReport>, Error> {
        let is_static = dt == f64::INFINITY;
        let mut reports = Vec::new();
        for stage in 0..self.steps.begin(dt) {
            let moves = self.steps.begin_stage(stage, &self.pinned, &self.targets);
            let moves = self.team.count(usize::from(moves)) > 0;
            let share = self.steps.share(stage);
            let pairs = self.springs.iter().zip(&self.targets_before);
            let springs = pairs.map(|(&spring, &before)| Stage::pulled(spring, before, share)).collect();
            let mut x = self.steps.start().to_vec();
            let [tau, sigma] = self.steps.stage().lengths();
            let regularisation = if is_static { self.static_regularisation } else { 1.0 / (tau * sigma) };
            let may_drift = is_static && self.pins < 3;
            let objective = Objective {
                team: &self.team,
                share: &self.share,
                elastic: &mut self.elastic,
                exchange: &mut self.exchange,
                masses: &self.masses,
                stage: self.steps.stage(),
                damping: self.settings.damping,
                gravity: self.settings.gravity,
                springs: &springs,
                regularisation,
                guard: if may_drift { DRIFT * regularisation } else { 0.0 },
            };
            let pins_move = moves.then_some(self.steps.pins_move());
            let (system, newton) = (&mut self.system, &self.settings.newton);
            reports.push(minimize(objective, system, newton, &mut x, pins_move)?);
            self.steps.end_stage(stage, &x);
        }
        self.steps.finish();
        for (before, spring) in self.targets_before.iter_mut().zip(&self.springs) {
            *before = spring.target;
        }
        Ok(reports)
    }

    /// Advances the state by a time, s, in steps so short that they make no error of positions above
    /// `tolerance`, m/s, times the time, as [`piola::step::Simulation::advance_within`] does. Returns what
    /// became of the steps, with the reports of all of their stages, refused ones included.
    ///
    /// # Errors
    /// An [`Error`] of the shortest step, or of PETSc.
    pub fn advance_within(
        &mut self,
        duration: f64,
        tolerance: f64,
    ) -> Result<(Pace<()>, Vec<NewtonReport>), Error> {
        let (integrator, allowed) = (self.settings.integrator, tolerance * duration);
        let mut course = Course {
            duration,
            before: self.steps.positions().to_vec(),
            targets: self.targets.clone(),
            targets_before: self.targets_before.clone(),
            springs: self.springs.clone(),
            reports: Vec::new(),
            simulation: self,
        };
        let pace = advance_within(&mut course, integrator, allowed);
        let Course { targets, springs, reports, .. } = course;
        (self.targets, self.springs) = (targets, springs);
        Ok((pace?, reports))
    }

    /// Moves the body to a minimum of its energy with gravity and springs, without inertia, where it is at
    /// rest.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn equilibrate(&mut self) -> Result<NewtonReport, Error> {
        let mut reports = self.step(f64::INFINITY)?;
        // Statics are one stage.
        Ok(reports.remove(0))
    }

    /// Evaluates the energies of all elements at the current state; the tag of one without.
    fn evaluate(&mut self) -> Result<(), u64> {
        let x = self.steps.positions();
        self.elastic.evaluate_inner(x);
        self.elastic.evaluate_border(x);
        let tag = self.team.min(self.elastic.refused().map_or(f64::INFINITY, |tag| tag as f64));
        if tag.is_finite() { Err(tag as u64) } else { Ok(()) }
    }

    /// Energies of the current state; the elastic one is NaN if an element is outside its domain.
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
        let springs = self.springs.iter().map(|spring| spring.energy(x)).sum();
        let [elastic, kinetic, gravity, springs] =
            self.team.sum([self.elastic.energy(), kinetic, gravity, springs]);
        Energies { elastic: if is_admissible { elastic } else { f64::NAN }, kinetic, gravity, springs }
    }
}

/// The time that a simulation is advanced over, and what moves evenly meanwhile.
struct Course<'a> {
    simulation: &'a mut Simulation,
    duration: f64,
    /// Positions before, m.
    before: Vec<[f64; 3]>,
    /// Positions of pinned nodes at the end, m.
    targets: Vec<[f64; 3]>,
    /// Targets of springs before, m.
    targets_before: Vec<[f64; 3]>,
    /// Springs at the end.
    springs: Vec<Spring>,
    /// Reports of all stages of all steps.
    reports: Vec<NewtonReport>,
}

impl Repeatable for Course<'_> {
    type State = StagedSteps;
    type Report = ();
    type Error = Error;

    fn state(&self) -> StagedSteps {
        self.simulation.steps.clone()
    }

    fn restore(&mut self, state: &StagedSteps) {
        self.simulation.steps.clone_from(state);
    }

    fn distance(&self, from: &StagedSteps) -> f64 {
        let (x, y) = (self.simulation.steps.positions(), from.positions());
        let pairs = x.as_flattened().iter().zip(y.as_flattened());
        self.simulation.team.max(pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max))
    }

    fn step_between(&mut self, start: f64, end: f64) -> Result<(), Error> {
        let Self { simulation, .. } = self;
        for &node in &simulation.pinned {
            simulation.targets[node] = on_the_way(self.before[node], self.targets[node], end);
        }
        for (index, (before, spring)) in self.targets_before.iter().zip(&self.springs).enumerate() {
            simulation.targets_before[index] = on_the_way(*before, spring.target, start);
            simulation.springs[index].target = on_the_way(*before, spring.target, end);
        }
        let reports = simulation.step((end - start) * self.duration)?;
        self.reports.extend(reports);
        Ok(())
    }

    fn is_final(error: &Error) -> bool {
        error.is_final()
    }
}
