//! Solver of a body on one machine, with all that sets it up anew.

use std::sync::Arc;

use crate::step::term::NodeBlocks;
use crate::system::linear::LinearError;
use crate::system::linear::multigrid::Undivided;
use crate::system::{Body, Pins};

use super::assembled::Assembled;
use super::interface::{Machine, OwnSolver, Solver};
use super::{LinearSolver, SparseSolver};

/// Machine that simulates a whole body.
#[derive(Clone)]
pub struct OneMachine {
    solver: Box<dyn OwnSolver>,
    pub(in crate::step) choice: Choice,
    pins: Pins,
    nodes: Undivided,
}

impl OneMachine {
    /// Sets up the solver for a body with these pins.
    pub(in crate::step) fn new(body: &Body, pins: &Pins, choice: Choice) -> Result<Self, LinearError> {
        Ok(Self { solver: choice.set_up(body, pins, &[])?, choice, pins: pins.clone(), nodes: Undivided })
    }

    /// Replaces the pins; sets up a new solver if the present one cannot handle them.
    pub(in crate::step) fn set_pins(&mut self, body: &Body, pins: &Pins) -> Result<(), LinearError> {
        if !self.solver.set_pins(pins) {
            self.solver = self.choice.set_up(body, pins, &[])?;
        }
        self.pins = pins.clone();
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

    fn solver(&mut self) -> &mut dyn Solver {
        &mut *self.solver
    }

    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let is_free = |node: usize| self.pins.nodes().binary_search(&node).is_err();
        let mut is_missing = false;
        self.solver.with_stiffness(&mut |stiffness| {
            let pattern = stiffness.matrix().pattern();
            let is_apart = |[a, b]: [usize; 2]| is_free(a) && is_free(b) && pattern.block(a, b).is_none();
            is_missing = blocks.pairs().any(is_apart);
        });
        if is_missing {
            let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
            self.solver = self.choice.set_up(body, &self.pins, &pairs)?;
        }
        Ok(())
    }
}

/// Solver of a simulation: one of the settings, or a user-defined one.
#[derive(Clone)]
pub(in crate::step) enum Choice {
    Setting(LinearSolver),
    UserDefined(Arc<SetUp>),
}

/// Sets a solver up for the pairs of nodes of a body's elements, and for more pairs.
type SetUp = dyn Fn(&Body, &Pins, &[[usize; 2]]) -> Result<Box<dyn OwnSolver>, LinearError> + Send + Sync;

impl Choice {
    pub(in crate::step) fn user_defined(solver: impl SparseSolver) -> Self {
        Self::UserDefined(Arc::new(move |body: &Body, pins: &Pins, pairs: &[[usize; 2]]| {
            let set_up: Box<dyn OwnSolver> = Box::new(Assembled::new(body, pins, pairs, solver.clone())?);
            Ok(set_up)
        }))
    }

    fn set_up(
        &self,
        body: &Body,
        pins: &Pins,
        pairs: &[[usize; 2]],
    ) -> Result<Box<dyn OwnSolver>, LinearError> {
        match self {
            Self::Setting(solver) => solver.set_up(body, pins, pairs),
            Self::UserDefined(set_up) => set_up(body, pins, pairs),
        }
    }
}
