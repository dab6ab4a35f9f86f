//! A factorisation in f32 whose solutions are refined.

use crate::system::linear::LinearError;
use crate::system::linear::refined::RefinedCholesky;

use super::assembled::{Factorisation, Matrix};
use super::interface::{Definiteness, Solution, SolveError};

/// [`LinearSolver::RefinedCholesky`](super::LinearSolver::RefinedCholesky).
#[derive(Clone)]
pub(super) struct Refined {
    pub(super) factor: RefinedCholesky,
    pub(super) tolerance: f64,
}

/// An indefinite matrix is left as it is: the iteration finds the negative curvature and stops there.
impl Factorisation for Refined {
    fn solve(
        &mut self,
        matrix: &mut Matrix,
        fill: impl Fn(f64, &mut Matrix),
        b: &mut [f64],
        tolerance: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError> {
        fill(0.0, matrix);
        match self.factor.factor(matrix.entries()) {
            Ok(()) => {
                let tolerance = tolerance.min(self.tolerance);
                Solution::of(self.factor.solve(matrix.entries(), b, tolerance), definiteness)
            }
            Err(LinearError::NotPositive { column }) => Err(matrix.not_positive(column, 0.0)),
            Err(error) => Err(error.into()),
        }
    }
}
