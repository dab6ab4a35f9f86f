//! Conjugate gradients on the assembled matrix.

use crate::step::error::NewtonError;
use crate::step::objective::Objective;
use crate::system::linear::LinearError;
use crate::system::linear::conjugate_gradients::{ConjugateGradients, End};
use crate::system::linear::multigrid::Undivided;
use crate::system::nodal_stiffness::NodalStiffness;
use crate::system::{Body, Pins};

use super::interface::{Definiteness, OwnSolver, Solution, Solver};
use super::preconditioner::Preconditioner;

/// [`LinearSolver::ConjugateGradients`](super::LinearSolver::ConjugateGradients).
///
/// Unknowns are the coordinates of all nodes, pinned ones too: right sides and products are set to zero
/// there.
#[derive(Clone)]
pub(super) struct Conjugate {
    stiffness: NodalStiffness,
    pinned: Vec<usize>,
    free: Vec<usize>,
    is_free: Vec<bool>,
    preconditioner: Preconditioner<Undivided>,
    conjugate_gradients: ConjugateGradients,
    tolerance: f64,
    max_iterations: usize,
}

impl Conjugate {
    pub(super) fn new(
        body: &Body,
        pins: &Pins,
        pairs: &[[usize; 2]],
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<Self, LinearError> {
        let nodes = body.rest().len();
        let mut solver = Self {
            stiffness: NodalStiffness::new(body, pairs)?,
            pinned: Vec::new(),
            free: Vec::new(),
            is_free: vec![true; nodes],
            preconditioner: Preconditioner::new(nodes, Undivided),
            conjugate_gradients: ConjugateGradients::new(3 * nodes),
            tolerance,
            max_iterations,
        };
        solver.set_pins(pins);
        Ok(solver)
    }
}

impl OwnSolver for Conjugate {
    fn set_pins(&mut self, pins: &Pins) -> bool {
        self.pinned = pins.nodes().to_vec();
        self.is_free.fill(true);
        pins.nodes().iter().for_each(|&node| self.is_free[node] = false);
        self.free = (0..self.is_free.len()).filter(|&node| self.is_free[node]).collect();
        true
    }

    fn boxed_clone(&self) -> Box<dyn OwnSolver> {
        Box::new(self.clone())
    }
}

impl Solver for Conjugate {
    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn begin(&mut self) {
        self.preconditioner.forget();
    }

    fn with_stiffness(&mut self, work: &mut dyn FnMut(&mut NodalStiffness)) {
        work(&mut self.stiffness);
    }

    fn solve(
        &mut self,
        objective: &Objective<'_>,
        x: &[[f64; 3]],
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, NewtonError> {
        let Self { stiffness, pinned, is_free, preconditioner, conjugate_gradients, .. } = self;
        objective.add_second_derivatives(stiffness);
        let tolerance = tolerance.min(self.tolerance);
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
                End::NegativeCurvature if definiteness == Definiteness::Required => return Ok(None),
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
