//! Time integration: implicit steps as minimisations, by Newton's method with a line search; and statics.
//!
//! From the public entry down: `simulation` keeps the state of a body and steps it, `integrator` divides a
//! step into minimisations, `newton` minimises, `solver` solves its linear systems, `line_search` shortens
//! steps, `objective` is the function that decreases, to which a `term` adds further energies, such as
//! contact; `minimisation` passes it to `newton`. `staged` keeps the state between steps. `equilibrium`
//! classifies a body that has come to rest. Reports are values; nothing prints.
//!
//! All of it is in f64.

#[cfg(feature = "faer")]
mod equilibrium;
mod error;
mod integrator;
mod line_search;
mod minimisation;
mod newton;
mod objective;
mod simulation;
mod solver;
mod spring;
mod staged;
mod term;
#[cfg(test)]
mod testing;

#[cfg(feature = "faer")]
pub use equilibrium::{Equilibrium, Stability};
pub use error::{NewtonError, SetupError, StepError};
pub use integrator::Integrator;
pub use newton::{Convergence, Filtering, NewtonReport, NewtonSettings};
pub use simulation::{AdaptiveReport, Energies, Simulation, SimulationSettings, StepReport};
pub use solver::{LinearSolver, SparseSolver};
pub use spring::Spring;
pub use term::{EnergyChange, NodeBlocks, Term, TermViolation, check_term};

/// Interfaces for codes that divide a body among machines: a [`Simulation`] of the part of each
/// [`Machine`](divided::Machine).
///
/// A machine solves the linear systems, and its [`Division`](divided::Division) exchanges the vectors of
/// nodes that several machines share. The methods of [`Simulation::divided`] are those of one machine, or
/// have names that end in `_here`. [`Preconditioner`](divided::Preconditioner) is for conjugate gradients on
/// a divided stiffness. The crate in `distributed/` uses all of it.
#[doc(hidden)]
pub mod divided {
    pub use super::objective::Objective;
    pub use super::solver::{Machine, OneMachine, Preconditioner, Solution, System};
    pub use crate::system::linear::conjugate_gradients::{End, Iteration};
    pub use crate::system::linear::multigrid::{Division, LastLevel, LastSolver, Undivided};
}
