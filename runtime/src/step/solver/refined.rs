//! A factorisation in f32 whose solutions are refined.

use crate::system::linear::LinearError;
use crate::system::linear::refined::RefinedCholesky;

use super::super::newton::NewtonError;
use super::assembled::{Factorisation, Matrix};
use super::{Demand, Solution};

/// [`LinearSolver::RefinedCholesky`](super::LinearSolver::RefinedCholesky).
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
        demand: Demand,
    ) -> Result<Option<Solution>, NewtonError> {
        fill(0.0, matrix);
        match self.factor.factor(matrix.entries()) {
            Ok(()) => {
                let tolerance = self.tolerance.min(demand.tolerance);
                Solution::of(self.factor.solve(matrix.entries(), b, tolerance), demand)
            }
            Err(LinearError::NotPositive { column }) => Err(matrix.not_positive(column, 0.0)),
            Err(error) => Err(NewtonError::Linear(error)),
        }
    }
}
