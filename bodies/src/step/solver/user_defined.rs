//! User-defined linear solvers, which factor or iterate on the assembled matrix.

use crate::system::LowerTriangle;
use crate::system::linear::LinearError;

/// User-defined solver of the linear systems A x = b of Newton's method: see
/// [`Simulation::set_linear_solver`](crate::step::Simulation::set_linear_solver).
///
/// Three rows and columns of A belong to each of [`LowerTriangle::free_nodes`]. A function of the form of
/// [`SparseSolver::solve`] is such a solver.
pub trait SparseSolver: Clone + Send + Sync + 'static {
    /// Analyses the pattern of the matrices to come, for a symbolic factorisation: before the first one, and
    /// whenever terms of the energy join other nodes or pins change. Does nothing by default.
    ///
    /// # Errors
    /// Any [`LinearError`]; usually [`LinearError::OutOfMemory`].
    fn analyse(&mut self, column_starts: &[usize], row_indices: &[usize]) -> Result<(), LinearError> {
        let _ = (column_starts, row_indices);
        Ok(())
    }

    /// Replaces b by x with ‖b − A x‖ ≤ `tolerance` ‖b‖, or as close as possible. Returns the number of
    /// iterations, 0 for a direct solver.
    ///
    /// If A is not positive definite, or x is no closer to the solution than x = 0 in the norm of A, the
    /// solver is called again, with eigenvalues clamped or with inertia added. If that does not help, the
    /// step ends with [`NewtonError::NotSolved`](crate::step::NewtonError::NotSolved).
    ///
    /// # Errors
    /// [`LinearError::NotPositive`] if A is not positive definite. Other errors end the step.
    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], tolerance: f64) -> Result<usize, LinearError>;
}

impl<F> SparseSolver for F
where
    F: FnMut(&LowerTriangle, &mut [f64], f64) -> Result<usize, LinearError>,
    F: Clone + Send + Sync + 'static,
{
    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], tolerance: f64) -> Result<usize, LinearError> {
        self(matrix, b, tolerance)
    }
}

/// [`SparseSolver`] of any type.
pub(crate) trait AnySolver: Send + Sync {
    fn analyse_any(&mut self, matrix: &LowerTriangle) -> Result<(), LinearError>;

    fn solve_any(
        &mut self,
        matrix: &LowerTriangle,
        b: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, LinearError>;

    fn boxed_clone(&self) -> Box<dyn AnySolver>;
}

impl<S: SparseSolver> AnySolver for S {
    fn analyse_any(&mut self, matrix: &LowerTriangle) -> Result<(), LinearError> {
        self.analyse(matrix.column_starts(), matrix.row_indices())
    }

    fn solve_any(
        &mut self,
        matrix: &LowerTriangle,
        b: &mut [f64],
        tolerance: f64,
    ) -> Result<usize, LinearError> {
        self.solve(matrix, b, tolerance)
    }

    fn boxed_clone(&self) -> Box<dyn AnySolver> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn AnySolver> {
    fn clone(&self) -> Self {
        self.as_ref().boxed_clone()
    }
}

#[cfg(feature = "faer")]
impl SparseSolver for crate::system::Cholesky {
    fn analyse(&mut self, column_starts: &[usize], row_indices: &[usize]) -> Result<(), LinearError> {
        *self = Self::new(column_starts, row_indices)?;
        Ok(())
    }

    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], _: f64) -> Result<usize, LinearError> {
        self.factor(matrix.values())?;
        Self::solve(self, b);
        Ok(0)
    }
}
