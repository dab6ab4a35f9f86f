//! Simulation of a body that is divided among ranks: piola's simulation of the part of each rank.
//!
//! Newton's method is piola's instead of PETSc's SNES, which does not support pins that move into the first
//! system, a filter on demand, or an end below the rounding error of the energy.

use piola_bodies::step::{
    self, AdaptiveReport, Energies, LinearSolver, SimulationSettings, Spring, StepError, StepReport,
};
use piola_bodies::system::Pins;

use crate::error::{Error, Failure};
use crate::part::{self, MaterialPart};
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Divided body with its state, on one rank. All ranks must call all functions.
pub struct Simulation {
    team: Team,
    share: Share,
    failure: Failure,
    part: step::Simulation<LinearSystem>,
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
        let LinearSolver::ConjugateGradients { tolerance, max_iterations } = settings.newton.linear else {
            let reason = "a body that is divided among ranks needs conjugate gradients as linear solver";
            return Err(Error::Options(reason.to_owned()));
        };
        let (body, failure) = (team.agree(part::body(&share, parts))?, Failure::default());
        let limits = (tolerance, max_iterations);
        let system = LinearSystem::new(team, &share, body.as_ref(), limits, &failure)?;
        let start: Vec<[f64; 3]> = share.places.iter().map(|place| place.start).collect();
        let made = step::Simulation::divided(system, body, &Pins::at(share.pinned()), settings)
            .and_then(|mut part| part.set_positions(&start).map(|()| part));
        let part = team.agree(made.map_err(Error::from))?;
        Ok(Self { team: team.clone(), share, failure, part })
    }

    /// Nodes and elements of this rank.
    #[must_use]
    pub fn share(&self) -> &Share {
        &self.share
    }

    /// Simulation of the part of this rank: positions, m, velocities, m/s, and accelerations, m/s², of its
    /// nodes, copies included.
    #[must_use]
    pub fn part(&self) -> &step::Simulation<LinearSystem> {
        &self.part
    }

    /// Replaces positions, velocities and accelerations of the nodes of this rank, copies included.
    /// Accelerations are the ones at the end of the previous step.
    ///
    /// # Errors
    /// [`Error::OnRank`] unless there is one finite vector of each for each node.
    pub fn set_state(&mut self, [x, v, a]: [&[[f64; 3]]; 3]) -> Result<(), Error> {
        let part = &mut self.part;
        let set = part.set_positions(x).and_then(|()| part.set_velocities(v));
        let set = set.and_then(|()| part.set_accelerations(a));
        self.team.agree(set.map_err(Error::from))
    }

    /// Prescribes the positions of pinned nodes of this rank and its copies after the next step, m; `None`
    /// leaves a node as it is.
    ///
    /// # Errors
    /// [`Error::OnRank`] for a position that is not finite.
    pub fn prescribe(&mut self, place: impl Fn(usize) -> Option<[f64; 3]>) -> Result<(), Error> {
        let mut pinned = self.share.pinned().into_iter();
        let set =
            pinned.try_for_each(|node| place(node).map_or(Ok(()), |place| self.part.prescribe(node, place)));
        self.team.agree(set.map_err(Error::from))
    }

    /// Replaces the springs at owned nodes. If a spring has the index and anchor of a previous spring, its
    /// target moves uniformly to the new one.
    ///
    /// # Errors
    /// [`Error::OnRank`] for a spring that is not finite, or is attached to a node that does not exist.
    pub fn set_springs(&mut self, springs: &[Spring]) -> Result<(), Error> {
        self.team.agree(self.part.set_springs(springs).map_err(Error::from))
    }

    /// Advances the state by `dt`, s.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, Error> {
        let made = self.part.step_here(dt);
        self.judge(made)
    }

    /// Advances the state over a time interval, s, with adaptive steps. The error of positions stays within
    /// `tolerance`, m/s, times the interval, as in [`piola_bodies::step::Simulation::advance_within`].
    ///
    /// # Errors
    /// An [`Error`] of the shortest step, or of PETSc.
    pub fn advance_within(&mut self, duration: f64, tolerance: f64) -> Result<AdaptiveReport, Error> {
        let made = self.part.advance_within_here(duration, tolerance);
        self.judge(made)
    }

    /// Moves the body to equilibrium: a minimum of its energy with gravity and springs, without inertia.
    ///
    /// # Errors
    /// An [`Error`] of Newton's method or of PETSc.
    pub fn equilibrate(&mut self) -> Result<StepReport, Error> {
        let made = self.part.equilibrate_here();
        self.judge(made)
    }

    /// Result of a step, or the error of an exchange or a solver on the way.
    fn judge<T>(&self, made: Result<T, StepError>) -> Result<T, Error> {
        self.failure.take()?;
        Ok(made?)
    }

    /// Numbers of iterations of the linear systems since the last call, those of failed attempts included.
    pub fn take_systems(&mut self) -> Vec<usize> {
        self.part.machine().take_systems()
    }

    /// Energies of the current state, as those of one machine.
    #[must_use]
    pub fn energies(&mut self) -> Energies {
        self.part.energies()
    }
}
