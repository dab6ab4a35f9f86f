//! Simulation of a body that is divided among ranks: piola's simulation of the part of each rank.
//!
//! Newton's method is piola's instead of PETSc's SNES, which does not support pins that move into the first
//! system, a filter on demand, or an end below the rounding error of the energy.

use piola_bodies::step::{self, LinearSolver, SetupError, SimulationSettings, StepError};
use piola_bodies::system::Pins;
use piola_scenes::error::Error as SceneError;
use piola_scenes::material::MaterialPart;

use crate::error::Error;
use crate::part;
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Divided body with its state, on one rank. All ranks must call all functions.
pub(crate) struct Simulation {
    team: Team,
    /// Nodes and elements of this rank.
    pub(crate) share: Share,
    /// Simulation of the part of this rank: positions, m, velocities, m/s, and accelerations, m/s², of its
    /// nodes, copies included. Changes and steps are made by the functions below.
    pub(crate) part: step::Simulation<LinearSystem>,
}

impl Simulation {
    /// Simulation that starts at rest, with the nodes at the start positions of the share.
    pub(crate) fn new(
        team: &Team,
        share: Share,
        parts: &[MaterialPart],
        settings: SimulationSettings,
    ) -> Result<Self, Error> {
        let LinearSolver::ConjugateGradients { tolerance, max_iterations } = settings.newton.linear else {
            let reason = "a body that is divided among ranks needs conjugate gradients as linear solver";
            return Err(Error::usage(reason));
        };
        let body = team.agree(part::body(&share, parts))?;
        let system = LinearSystem::new(team, &share, &body, tolerance, max_iterations)?;
        let start: Vec<[f64; 3]> = share.places.iter().map(|place| place.start).collect();
        let made = step::Simulation::divided(system, body, &Pins::at(share.pinned()), settings)
            .and_then(|mut part| part.set_positions(&start).map(|()| part));
        let part = team.agree(made.map_err(|error| SceneError::from(error).into()))?;
        Ok(Self { team: team.clone(), share, part })
    }

    /// Changes the state, pins or springs of the part.
    pub(crate) fn set(
        &mut self,
        change: impl FnOnce(&mut step::Simulation<LinearSystem>) -> Result<(), SetupError>,
    ) -> Result<(), Error> {
        self.team.agree(change(&mut self.part).map_err(|error| SceneError::from(error).into()))
    }

    /// Advances the part by steps, or moves it to equilibrium.
    pub(crate) fn advance<T>(
        &mut self,
        advance: impl FnOnce(&mut step::Simulation<LinearSystem>) -> Result<T, StepError>,
    ) -> Result<T, Error> {
        let made = advance(&mut self.part);
        // The error of an exchange or a solver on the way is the reason of the error of a step.
        self.team.take_failure()?;
        Ok(made?)
    }
}
