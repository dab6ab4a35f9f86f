//! Second derivatives as a sparse matrix, for a factorisation or a user-defined solver.

use crate::step::error::NewtonError;
use crate::step::objective::Objective;
use crate::system::linear::LinearError;
use crate::system::{Body, LowerTriangle, NodalStiffness, Pins};

use super::interface::{Definiteness, OwnSolver, Solution, Solver};
use super::user_defined::SparseSolver;

/// The largest tolerance that a solver receives.
const TOLERANCE: f64 = 1e-3;

/// [`LinearSolver::Cholesky`](super::LinearSolver::Cholesky), or a user-defined solver.
///
/// A filtered stiffness plus inertia is positive definite up to rounding. Without a filter, or if inertia is
/// lost in the stiffness, it may not be. Mass is then added tenfold more each time, as if the time step were
/// shorter.
#[derive(Clone)]
pub(super) struct Assembled<S> {
    stiffness: NodalStiffness,
    matrix: LowerTriangle,
    /// Free nodes: nodes of the matrix without those in `held`.
    free: Vec<usize>,
    /// For each free node of the matrix, true if it has been pinned since the matrix was made; empty if no
    /// node has.
    held: Vec<bool>,
    /// The right side, then the solution.
    unknowns: Vec<f64>,
    solver: S,
}

impl<S: SparseSolver> Assembled<S> {
    pub(super) fn new(
        body: &Body,
        pins: &Pins,
        pairs: &[[usize; 2]],
        mut solver: S,
    ) -> Result<Self, LinearError> {
        let stiffness = NodalStiffness::with_elements(body, pairs)?;
        let matrix = LowerTriangle::new(&stiffness, pins)?;
        solver.analyse(matrix.column_starts(), matrix.row_indices())?;
        Ok(Self {
            solver,
            stiffness,
            free: matrix.free_nodes().to_vec(),
            held: Vec::new(),
            unknowns: vec![0.0; 3 * matrix.free_nodes().len()],
            matrix,
        })
    }
}

impl<S: SparseSolver> OwnSolver for Assembled<S> {
    fn set_pins(&mut self, pins: &Pins) -> bool {
        let nodes = self.matrix.free_nodes();
        let is_pinned = |node: &usize| pins.nodes().binary_search(node).is_ok();
        let held: Vec<bool> = nodes.iter().map(is_pinned).collect();
        let count = held.iter().filter(|is_held| **is_held).count();
        // The matrix leaves out nodes that were pinned when it was made: a new one is needed to let them go.
        if nodes.len() - count != self.stiffness.matrix().pattern().rows() - pins.nodes().len() {
            return false;
        }
        self.free =
            nodes.iter().zip(&held).filter(|(_, is_held)| !**is_held).map(|(&node, _)| node).collect();
        self.held = if count == 0 { Vec::new() } else { held };
        true
    }

    fn boxed_clone(&self) -> Box<dyn OwnSolver> {
        Box::new(self.clone())
    }
}

impl<S: SparseSolver> Solver for Assembled<S> {
    fn free_nodes(&self) -> &[usize] {
        &self.free
    }

    fn with_stiffness(&mut self, work: &mut dyn FnMut(&mut NodalStiffness)) {
        work(&mut self.stiffness);
    }

    fn add_product(&mut self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        self.stiffness.add_product_of_elements(body, displacement, total);
    }

    fn solve(
        &mut self,
        objective: &Objective<'_>,
        _: &[[f64; 3]],
        gradient: &[[f64; 3]],
        direction: &mut [[f64; 3]],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, NewtonError> {
        let Self { stiffness, matrix, held, unknowns, solver, .. } = self;
        for (free, &node) in matrix.free_nodes().iter().enumerate() {
            let is_held = held.get(free) == Some(&true);
            let right = if is_held { [0.0; 3] } else { gradient[node].map(|g| -g) };
            unknowns[3 * free..3 * free + 3].copy_from_slice(&right);
        }
        let mut shift = 0.0;
        let iterations = loop {
            let diagonal = |node: usize| objective.inertia(node) + shift * objective.regularisation(node);
            matrix.fill(stiffness, diagonal)?;
            objective.blocks.add_to_triangle(matrix);
            matrix.hold(held);
            match solver.solve(matrix, unknowns, tolerance.min(TOLERANCE)) {
                Ok(iterations) => break iterations,
                Err(LinearError::NotPositive { .. }) if definiteness == Definiteness::Required => {
                    return Ok(None);
                }
                Err(LinearError::NotPositive { .. }) if shift < 1e12 => {
                    shift = if shift == 0.0 { 1.0 } else { 10.0 * shift }
                }
                Err(LinearError::NotPositive { column }) => {
                    // A user-defined solver may name any column.
                    let node = matrix.free_nodes().get(column / 3).copied().unwrap_or(0);
                    return Err(NewtonError::NotPositive { node, shift });
                }
                Err(error) => return Err(error.into()),
            }
        };
        if unknowns.iter().any(|x| !x.is_finite()) {
            return Err(NewtonError::NotFinite);
        }
        for (unknown, &node) in unknowns.chunks_exact(3).zip(matrix.free_nodes()) {
            direction[node] = [unknown[0], unknown[1], unknown[2]];
        }
        Ok(Some(Solution { shift, iterations, ..Solution::default() }))
    }
}
