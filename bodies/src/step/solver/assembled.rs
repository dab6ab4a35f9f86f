//! Second derivatives as a sparse matrix, for a factorisation or a user-defined solver.

use crate::step::error::NewtonError;
use crate::system::linear::LinearError;
use crate::system::{LowerTriangle, NodalStiffness, Pins};

use super::interface::{Solution, System};
use super::user_defined::AnySolver;

/// The largest tolerance that a solver receives.
const TOLERANCE: f64 = 1e-3;

/// [`LinearSolver::Cholesky`](super::LinearSolver::Cholesky), or a user-defined solver.
///
/// A filtered stiffness plus inertia is positive definite up to rounding. Without a filter, or if inertia is
/// lost in the stiffness, it may not be. Mass is then added tenfold more each time, as if the time step were
/// shorter.
#[derive(Clone)]
pub(super) struct Assembled {
    pub(super) matrix: LowerTriangle,
    /// For each free node of the matrix, true if it has been pinned since the matrix was made; empty if no
    /// node has.
    held: Vec<bool>,
    right: Vec<f64>,
    /// The right side, then the solution.
    unknowns: Vec<f64>,
    /// Product of the matrix with the solution.
    product: Vec<f64>,
    solver: Box<dyn AnySolver>,
}

impl Assembled {
    pub(super) fn new(
        stiffness: &NodalStiffness,
        pins: &Pins,
        mut solver: Box<dyn AnySolver>,
    ) -> Result<Self, LinearError> {
        let matrix = LowerTriangle::new(stiffness, pins)?;
        solver.analyse_any(&matrix)?;
        let right = vec![0.0; 3 * matrix.free_nodes().len()];
        Ok(Self { solver, held: Vec::new(), unknowns: right.clone(), product: right.clone(), right, matrix })
    }

    /// Replaces the pins of a body of `nodes` nodes. Returns the free nodes in the order of the unknowns, or
    /// `None` if they need a new matrix.
    pub(super) fn set_pins(&mut self, pins: &Pins, nodes: usize) -> Option<Vec<usize>> {
        let of_matrix = self.matrix.free_nodes();
        let is_pinned = |node: &usize| pins.nodes().binary_search(node).is_ok();
        let free: Vec<usize> = of_matrix.iter().copied().filter(|node| !is_pinned(node)).collect();
        // The matrix leaves out nodes that were pinned when it was made: a new one is needed to let them go.
        if free.len() != nodes - pins.nodes().len() {
            return None;
        }
        let has_held = free.len() < of_matrix.len();
        self.held = if has_held { of_matrix.iter().map(is_pinned).collect() } else { Vec::new() };
        Some(free)
    }

    /// Solves as [`Machine::solve`](super::Machine::solve), with the stiffness of the elements.
    pub(super) fn solve(
        &mut self,
        stiffness: &NodalStiffness,
        system: System<'_>,
        direction: &mut [[f64; 3]],
    ) -> Result<Option<Solution>, NewtonError> {
        let Self { matrix, held, right, unknowns, product, solver } = self;
        let System { objective, gradient, tolerance, must_be_definite, .. } = system;
        for (free, &node) in matrix.free_nodes().iter().enumerate() {
            let is_held = held.get(free) == Some(&true);
            let force = if is_held { [0.0; 3] } else { gradient[node].map(|g| -g) };
            right[3 * free..3 * free + 3].copy_from_slice(&force);
        }
        let mut shift = 0.0;
        let iterations = loop {
            let diagonal = |node: usize| objective.inertia(node) + shift * objective.regularisation(node);
            matrix.fill(stiffness, diagonal)?;
            objective.blocks.add_to_triangle(matrix);
            matrix.hold(held);
            unknowns.copy_from_slice(right);
            let error = match solver.solve_any(matrix, unknowns, tolerance.min(TOLERANCE)) {
                Ok(_) if unknowns.iter().any(|x| !x.is_finite()) => return Err(NewtonError::NotFinite),
                Ok(iterations) => match unsolved(matrix, right, unknowns, product)? {
                    None => break iterations,
                    // It may have overlooked that the matrix is not definite, or not to working precision.
                    Some(residual) => NewtonError::NotSolved { residual },
                },
                Err(LinearError::NotPositive { column }) => {
                    // A user-defined solver may name any column.
                    let node = matrix.free_nodes().get(column / 3).copied().unwrap_or(0);
                    NewtonError::NotPositive { node, shift }
                }
                Err(error) => return Err(error.into()),
            };
            if must_be_definite {
                return Ok(None);
            }
            if shift >= 1e12 {
                return Err(error);
            }
            shift = if shift == 0.0 { 1.0 } else { 10.0 * shift };
        };
        for (unknown, &node) in unknowns.chunks_exact(3).zip(matrix.free_nodes()) {
            direction[node] = [unknown[0], unknown[1], unknown[2]];
        }
        Ok(Some(Solution { shift, iterations, ..Solution::default() }))
    }
}

/// ‖b − A x‖/‖b‖, if x is no closer to the solution of A x = b than x = 0 in the norm of A.
fn unsolved(
    matrix: &LowerTriangle,
    b: &[f64],
    x: &[f64],
    product: &mut [f64],
) -> Result<Option<f64>, LinearError> {
    matrix.multiply(x, product)?;
    let [mut residual, mut size, mut energy] = [0.0_f64; 3];
    for ((&b, &x), &product) in b.iter().zip(x).zip(&*product) {
        residual += (b - product).powi(2);
        size += b * b;
        energy += x * (0.5 * product - b);
    }
    // ½ xᵀA x − bᵀx < 0 for an x that is closer than 0, as are all iterates of conjugate gradients: a limit
    // of iterations is no mistake.
    Ok((energy >= 0.0 && size.is_normal()).then(|| (residual / size).sqrt()))
}
