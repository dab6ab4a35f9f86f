//! Conjugate gradients on the assembled matrix.

use crate::step::error::NewtonError;
use crate::system::linear::conjugate_gradients::{ConjugateGradients, End};
use crate::system::linear::multigrid::Undivided;
use crate::system::{NodalStiffness, Pins};

use super::interface::{Solution, System};
use super::preconditioner::Preconditioner;

/// [`LinearSolver::ConjugateGradients`](super::LinearSolver::ConjugateGradients).
///
/// Unknowns are the coordinates of all nodes, pinned ones too: right sides and products are set to zero
/// there.
#[derive(Clone)]
pub(super) struct Conjugate {
    pinned: Vec<usize>,
    is_free: Vec<bool>,
    preconditioner: Preconditioner<Undivided>,
    conjugate_gradients: ConjugateGradients,
    tolerance: f64,
    max_iterations: usize,
}

impl Conjugate {
    /// Memory for a body of `nodes` nodes, none of them pinned.
    pub(super) fn new(nodes: usize, tolerance: f64, max_iterations: usize) -> Self {
        Self {
            pinned: Vec::new(),
            is_free: vec![true; nodes],
            preconditioner: Preconditioner::new(nodes, Undivided),
            conjugate_gradients: ConjugateGradients::new(3 * nodes),
            tolerance,
            max_iterations,
        }
    }

    /// Replaces the pins; returns the free nodes.
    pub(super) fn set_pins(&mut self, pins: &Pins) -> Vec<usize> {
        self.pinned = pins.nodes().to_vec();
        self.is_free.fill(true);
        pins.nodes().iter().for_each(|&node| self.is_free[node] = false);
        (0..self.is_free.len()).filter(|&node| self.is_free[node]).collect()
    }

    /// Discards information from earlier systems.
    pub(super) fn begin(&mut self) {
        self.preconditioner.forget();
    }

    /// Solves as [`Machine::solve`](super::Machine::solve), with the stiffness of the elements.
    pub(super) fn solve(
        &mut self,
        stiffness: &mut NodalStiffness,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, NewtonError> {
        let Self { pinned, is_free, preconditioner, conjugate_gradients, .. } = self;
        let System { objective, x, gradient, must_be_definite, .. } = system;
        objective.add_second_derivatives(stiffness);
        let tolerance = system.tolerance.min(self.tolerance);
        let mut given_up = 0;
        loop {
            preconditioner.take(stiffness, is_free, x, |node| objective.inertia(node))?;
            for (direction, gradient) in direction.iter_mut().zip(gradient) {
                *direction = gradient.map(|g| -g);
            }
            pinned.iter().for_each(|&node| direction[node] = [0.0; 3]);
            let limit = preconditioner.patience(tolerance).min(self.max_iterations - given_up);
            // The second derivatives, as an operator on displacements that are zero at pinned nodes.
            let apply = |x: &[f64], product: &mut [f64]| {
                let product = product.as_chunks_mut().0;
                stiffness.matrix_mut().multiply(x.as_chunks().0, product);
                pinned.iter().for_each(|&node| product[node] = [0.0; 3]);
            };
            let precondition =
                |r: &[f64], z: &mut [f64]| preconditioner.apply(r.as_chunks().0, z.as_chunks_mut().0);
            let unknowns = direction.as_flattened_mut();
            let mut iteration = conjugate_gradients.solve(apply, precondition, unknowns, tolerance, limit);
            let again = preconditioner.judge(iteration, tolerance);
            iteration.iterations += given_up;
            if again && iteration.iterations < self.max_iterations {
                given_up = iteration.iterations;
                continue;
            }
            let truncated = match iteration.end {
                End::NegativeCurvature if must_be_definite => return Ok(None),
                End::Converged => false,
                End::Limit | End::NegativeCurvature => true,
                End::NotFinite => return Err(NewtonError::NotFinite),
            };
            if unknowns.iter().any(|x| !x.is_finite()) {
                return Err(NewtonError::NotFinite);
            }
            return Ok(Some(Solution { shift: 0.0, iterations: iteration.iterations, truncated }));
        }
    }
}
