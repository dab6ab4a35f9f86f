//! Whole body on one machine: its linear solver, with all that sets it up anew.

use crate::step::error::NewtonError;
use crate::step::term::NodeBlocks;
use crate::system::linear::LinearError;
use crate::system::linear::multigrid::Undivided;
use crate::system::{Body, NodalStiffness, Pins};

use super::LinearSolver;
use super::assembled::Assembled;
use super::conjugate::Conjugate;
use super::interface::{Machine, Solution, System};
use super::user_defined::AnySolver;

/// Machine that simulates a whole body.
#[derive(Clone)]
pub struct OneMachine {
    pub(in crate::step) choice: Choice,
    pins: Pins,
    nodes: Undivided,
    stiffness: NodalStiffness,
    /// Nodes that are not pinned, in the order of the unknowns.
    free: Vec<usize>,
    method: Method,
}

/// Solver of a simulation: one of the settings, or a user-defined one.
#[derive(Clone)]
pub(in crate::step) enum Choice {
    Setting(LinearSolver),
    UserDefined(Box<dyn AnySolver>),
}

/// Method of a solver, with its memory.
#[derive(Clone)]
enum Method {
    Assembled(Box<Assembled>),
    Conjugate(Box<Conjugate>),
}

impl OneMachine {
    /// Sets up the solver for a body with these pins, with blocks for all pairs of nodes that share an
    /// element, and for these pairs.
    pub(in crate::step) fn new(
        body: &Body,
        pins: &Pins,
        pairs: &[[usize; 2]],
        choice: Choice,
    ) -> Result<Self, LinearError> {
        let assembled = |solver: Box<dyn AnySolver>| -> Result<_, LinearError> {
            let stiffness = NodalStiffness::new(body, pairs, true)?;
            let assembled = Assembled::new(&stiffness, pins, solver)?;
            Ok((stiffness, assembled.matrix.free_nodes().to_vec(), Method::Assembled(Box::new(assembled))))
        };
        let (stiffness, free, method) = match &choice {
            Choice::Setting(LinearSolver::Automatic) => {
                let chosen = LinearSolver::for_elements(body.elements().len());
                return Self::new(body, pins, pairs, Choice::Setting(chosen));
            }
            #[cfg(feature = "faer")]
            Choice::Setting(LinearSolver::Cholesky) => {
                let of_nothing: Box<dyn AnySolver> = Box::new(crate::system::Cholesky::new(&[0], &[])?);
                assembled(of_nothing)?
            }
            Choice::UserDefined(solver) => assembled(solver.clone())?,
            Choice::Setting(LinearSolver::ConjugateGradients { tolerance, max_iterations }) => {
                let mut conjugate = Box::new(Conjugate::new(body.rest().len(), *tolerance, *max_iterations));
                let free = conjugate.set_pins(pins);
                (NodalStiffness::new(body, pairs, false)?, free, Method::Conjugate(conjugate))
            }
        };
        Ok(Self { choice, pins: pins.clone(), nodes: Undivided, stiffness, free, method })
    }

    /// Replaces the pins; sets up a new solver if the present one cannot handle them.
    pub(in crate::step) fn set_pins(&mut self, body: &Body, pins: &Pins) -> Result<(), LinearError> {
        let free = match &mut self.method {
            Method::Assembled(assembled) => assembled.set_pins(pins, body.rest().len()),
            Method::Conjugate(conjugate) => Some(conjugate.set_pins(pins)),
        };
        match free {
            Some(free) => (self.free, self.pins) = (free, pins.clone()),
            None => *self = Self::new(body, pins, &[], self.choice.clone())?,
        }
        Ok(())
    }
}

impl Machine for OneMachine {
    type Nodes = Undivided;

    fn nodes(&self) -> &Undivided {
        &self.nodes
    }

    fn nodes_mut(&mut self) -> &mut Undivided {
        &mut self.nodes
    }

    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn begin(&mut self) {
        if let Method::Conjugate(conjugate) = &mut self.method {
            conjugate.begin();
        }
    }

    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let is_free = |node: usize| self.pins.nodes().binary_search(&node).is_err();
        let pattern = self.stiffness.matrix().pattern();
        let is_apart = |[a, b]: [usize; 2]| is_free(a) && is_free(b) && pattern.block(a, b).is_none();
        if blocks.pairs().any(is_apart) {
            let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
            *self = Self::new(body, &self.pins, &pairs, self.choice.clone())?;
        }
        Ok(())
    }

    fn with_stiffness<T>(&mut self, work: impl FnOnce(&mut NodalStiffness) -> T) -> T {
        work(&mut self.stiffness)
    }

    fn solve(
        &mut self,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, NewtonError> {
        match &mut self.method {
            Method::Assembled(assembled) => assembled.solve(&self.stiffness, system, direction),
            Method::Conjugate(conjugate) => conjugate.solve(&mut self.stiffness, system, direction),
        }
    }
}
