//! User-defined linear solvers, which factor or iterate on the assembled matrix.

use crate::system::LowerTriangle;
use crate::system::linear::LinearError;

/// User-defined solver of the linear systems A x = b of Newton's method: see
/// [`Simulation::set_linear_solver`](crate::step::Simulation::set_linear_solver).
///
/// A function of the form of [`SparseSolver::solve`] is such a solver. Three rows and columns of A belong to
/// each of [`LowerTriangle::free_nodes`]. A copy of the solver as it was given solves the systems of each
/// pattern, which changes if terms of the energy join other nodes, or with the pins: it may analyse the
/// pattern in its first call, for a symbolic factorisation.
pub trait SparseSolver: Send + Sync + 'static {
    /// Replaces b by x with ‖b − A x‖ ≤ `tolerance` ‖b‖, or as close as possible. Returns the number of
    /// iterations, 0 for a direct solver.
    ///
    /// # Errors
    /// [`LinearError::NotPositive`], with b unchanged, if A is not positive definite: the solver is then
    /// called again, with eigenvalues clamped or with inertia added. Other errors end the step.
    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], tolerance: f64) -> Result<usize, LinearError>;

    /// Copies the solver.
    #[doc(hidden)]
    fn boxed_clone(&self) -> Box<dyn SparseSolver>;
}

impl<F> SparseSolver for F
where
    F: FnMut(&LowerTriangle, &mut [f64], f64) -> Result<usize, LinearError>,
    F: Clone + Send + Sync + 'static,
{
    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], tolerance: f64) -> Result<usize, LinearError> {
        self(matrix, b, tolerance)
    }

    fn boxed_clone(&self) -> Box<dyn SparseSolver> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn SparseSolver> {
    fn clone(&self) -> Self {
        self.as_ref().boxed_clone()
    }
}

#[cfg(feature = "faer")]
impl SparseSolver for crate::system::Cholesky {
    fn solve(&mut self, matrix: &LowerTriangle, b: &mut [f64], _: f64) -> Result<usize, LinearError> {
        self.factor(matrix.values())?;
        Self::solve(self, b);
        Ok(0)
    }

    fn boxed_clone(&self) -> Box<dyn SparseSolver> {
        Box::new(self.clone())
    }
}
