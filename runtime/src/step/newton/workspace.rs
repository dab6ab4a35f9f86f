//! Memory of Newton's method.

use crate::step::solver::{Choice, Solver};
use crate::step::term::NodeBlocks;
use crate::system::{Body, LinearError, Pins};

/// Memory of Newton's method.
#[derive(Clone)]
pub(crate) struct NewtonWorkspace {
    pub(super) solver: Box<dyn Solver>,
    choice: Choice,
    pins: Pins,
    pub(super) gradient: Vec<[f64; 3]>,
    pub(super) direction: Vec<[f64; 3]>,
    pub(super) trial: Vec<[f64; 3]>,
}

impl NewtonWorkspace {
    /// Allocates the memory for a body with these pins.
    pub(crate) fn new(body: &Body, pins: &Pins, choice: Choice) -> Result<Self, LinearError> {
        let nodes = body.rest().len();
        Ok(Self {
            solver: choice.set_up(body, pins, &[])?,
            choice,
            pins: pins.clone(),
            gradient: vec![[0.0; 3]; nodes],
            direction: vec![[0.0; 3]; nodes],
            trial: vec![[0.0; 3]; nodes],
        })
    }

    /// Whether the linear solver is a caller's own.
    pub(crate) fn has_own_solver(&self) -> bool {
        matches!(self.choice, Choice::Own(_))
    }

    /// Replaces the pins, with a solver that is set up anew where the old one cannot serve.
    pub(crate) fn set_pins(&mut self, body: &Body, pins: &Pins) -> Result<(), LinearError> {
        if !self.solver.set_pins(pins) {
            self.solver = self.choice.set_up(body, pins, &[])?;
        }
        self.pins = pins.clone();
        Ok(())
    }

    /// Sets the solver up anew if the terms' blocks join nodes that its matrix does not.
    pub(super) fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let is_free = |node: &usize| self.pins.nodes().binary_search(node).is_err();
        let is_missing = |[a, b]: &[usize; 2]| is_free(a) && is_free(b) && !self.solver.joins(*a, *b);
        if blocks.pairs().any(|pair| is_missing(&pair)) {
            let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
            self.solver = self.choice.set_up(body, &self.pins, &pairs)?;
        }
        Ok(())
    }

    /// Norm of the gradient over the free nodes.
    pub(super) fn free_norm(&self) -> f64 {
        let square = |g: [f64; 3]| g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        self.solver.free_nodes().iter().map(|&node| square(self.gradient[node])).sum::<f64>().sqrt()
    }
}
