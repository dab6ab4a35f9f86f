//! A factorisation in f64.

use crate::system::linear::{Cholesky, LinearError};
use crate::system::pattern::Pattern;

use super::assembled::{Factorisation, Matrix};
use super::interface::{Definiteness, Solution, SolveError};

/// [`LinearSolver::Cholesky`](super::LinearSolver::Cholesky).
#[derive(Clone)]
pub(super) struct Exact {
    cholesky: Cholesky,
}

impl Exact {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, LinearError> {
        Ok(Self { cholesky: Cholesky::of_pattern(pattern.shared_entries())? })
    }
}

/// A filtered stiffness plus inertia is positive definite up to rounding. Without a filter, or where inertia
/// is lost beside the stiffness, it may not be. Mass is then added tenfold more each time, as if the time
/// step were shorter.
impl Factorisation for Exact {
    fn solve(
        &mut self,
        matrix: &mut Matrix,
        fill: impl Fn(f64, &mut Matrix),
        b: &mut [f64],
        _: f64,
        definiteness: Definiteness,
    ) -> Result<Option<Solution>, SolveError> {
        let mut shift = 0.0;
        loop {
            fill(shift, matrix);
            match self.cholesky.factor(matrix.values()) {
                Ok(()) => break,
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
        self.cholesky.solve(b)?;
        Ok(Some(Solution { shift, ..Solution::default() }))
    }
}
