//! Time: implicit Euler steps as minimisations, by Newton's method with a line search.
//!
//! From the public entry down: [`implicit_euler`] keeps the state of a body and steps it, `newton` minimises,
//! `solver` solves its linear systems, `line_search` shortens steps, `objective` is what decreases. [`equilibrium`] says what is known of a body that
//! has come to rest. Reports are values; nothing
//! prints.

pub mod damping;
pub mod equilibrium;
pub mod filtering;
pub mod implicit_euler;
pub mod line_search;
pub mod newton;
pub mod objective;
pub mod solver;

pub use damping::Damping;
pub use equilibrium::{Eigenvalue, Equilibrium, Verdict};
pub use filtering::Filtering;
pub use implicit_euler::{Energies, Settings, SetupError, Simulation, StepError, StepReport};
pub use line_search::{LineSearchSettings, Outcome};
pub use newton::{Convergence, Guess, NewtonError, NewtonReport, NewtonSettings};
pub use objective::Pull;
pub use solver::LinearSolver;
