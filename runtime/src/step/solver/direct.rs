//! Systems solved with the matrix as it is, by a factorisation or by a solver of a caller's own.

use crate::step::newton::{Definiteness, Solution};
use crate::system::LowerTriangle;
use crate::system::linear::LinearError;

use super::assembled::{Factorisation, Matrix};
use super::interface::SolveError;
use super::own::SparseSolver;

/// The largest tolerance that a solver is asked for.
const TOLERANCE: f64 = 1e-3;

/// [`LinearSolver::Cholesky`](super::LinearSolver::Cholesky), or a solver of a caller's own.
#[derive(Clone)]
pub(super) struct Direct<S> {
    pub(super) solver: S,
}

/// A filtered stiffness plus inertia is positive definite up to rounding. Without a filter, or where inertia
/// is lost beside the stiffness, it may not be. Mass is then added tenfold more each time, as if the time
/// step were shorter.
impl<S: SparseSolver> Factorisation for Direct<S> {
    fn solve(
        &mut self,
        matrix: &mut Matrix,
        fill: impl Fn(f64, &mut Matrix),
        b: &mut [f64],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError> {
        let tolerance = tolerance.min(TOLERANCE);
        let mut shift = 0.0;
        loop {
            fill(shift, matrix);
            match self.solver.solve(LowerTriangle(matrix.entries()), b, tolerance) {
                Ok(iterations) => return Ok(Some(Solution { shift, iterations, ..Solution::default() })),
                Err(LinearError::NotPositive { .. }) if definiteness == Definiteness::Required => {
                    return Ok(None);
                }
                Err(LinearError::NotPositive { .. }) if shift < 1e12 => {
                    shift = if shift == 0.0 { 1.0 } else { 10.0 * shift }
                }
                Err(LinearError::NotPositive { column }) => return Err(matrix.not_positive(column, shift)),
                Err(error) => return Err(error.into()),
            }
        }
    }
}
