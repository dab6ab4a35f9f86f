//! Cholesky factor in f32, refined to solutions in f64.
//!
//! A Cholesky factor in f32 takes half the memory and half the traffic of one in f64, and is a nearly perfect
//! preconditioner for [conjugate gradients](super::conjugate_gradients) in f64 with the matrix itself. On a
//! well-conditioned matrix these gain a few digits in each iteration, like iterative refinement; on one whose
//! condition is beyond the 10⁷ that f32 resolves, where refinement diverges, they need an iteration for each
//! eigenvalue that the factor misses, and converge.
//! \[CH18\] do the same with GMRES for matrices that are not symmetric.
//!
//! *Range.* The matrix is scaled to a unit diagonal first, and right sides to a largest entry of one, so that
//! no unit of stiffness is beyond f32.
//!
//! *Failure.* A matrix that is not positive definite in f32, because of rounding or because it is indefinite,
//! is factored with a larger diagonal. The system to be solved stays the same; the factor is then a worse
//! preconditioner of it.
//!
//! \[CH18\] Carson, Higham, *Accelerating the Solution of Linear Systems by Iterative Refinement in Three
//! Precisions*, 2018.

use std::sync::Arc;

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};

use super::conjugate_gradients::{ConjugateGradients, Iteration, System};
use super::{Cholesky, LinearError, symmetric_product};

/// Number of iterations after which to stop; usually there are a few.
const MAX_ITERATIONS: usize = 100;

/// Growth of the diagonal, scaled to ones, where the factor fails: eight times as much each time, from a few
/// roundings of f32 up to a diagonal that outweighs any row.
const FIRST_GROWTH: f64 = 8.0 * f32::EPSILON as f64;
const LAST_GROWTH: f64 = 1e4;

/// A factorisation in f32, and memory for the next one and for solutions in f64.
#[derive(Clone)]
pub(crate) struct RefinedCholesky {
    cholesky: Cholesky<f32>,
    /// 1/√|a| for each entry a on the diagonal.
    scales: Vec<f64>,
    /// The scaled entries.
    values: Vec<f32>,
    /// A scaled right side.
    single: Vec<f32>,
    conjugate_gradients: ConjugateGradients,
}

impl RefinedCholesky {
    /// Analyses the lower triangle of a symmetric pattern, each column of which begins on the diagonal, and
    /// allocates all memory that later calls need.
    ///
    /// # Errors
    /// [`LinearError::OutOfMemory`].
    pub(crate) fn new(pattern: &Arc<SymbolicSparseColMat<usize>>) -> Result<Self, LinearError> {
        let unknowns = pattern.ncols();
        Ok(Self {
            cholesky: Cholesky::of_pattern(pattern)?,
            scales: vec![1.0; unknowns],
            values: vec![0.0; pattern.row_idx().len()],
            single: vec![0.0; unknowns],
            conjugate_gradients: ConjugateGradients::new(unknowns),
        })
    }

    /// Factors a matrix of the analysed pattern, with a larger diagonal if need be.
    ///
    /// # Errors
    /// [`LinearError::NotPositive`] if no diagonal makes it positive definite: an entry is not finite.
    pub(crate) fn factor(&mut self, matrix: SparseColMatRef<'_, usize, f64>) -> Result<(), LinearError> {
        let Self { cholesky, scales, values, .. } = self;
        for (column, scale) in scales.iter_mut().enumerate() {
            let diagonal = matrix.val_of_col(column)[0].abs();
            *scale = if diagonal > 0.0 { diagonal.sqrt().recip() } else { 1.0 };
        }
        for column in 0..scales.len() {
            for entry in matrix.col_range(column) {
                let row = matrix.row_idx()[entry];
                values[entry] = (scales[row] * matrix.val()[entry] * scales[column]) as f32;
            }
        }
        let mut growth = 0.0;
        loop {
            for column in 0..scales.len() {
                let unit = (scales[column] * scales[column]) * matrix.val_of_col(column)[0];
                values[matrix.col_range(column).start] = (unit + growth) as f32;
            }
            match cholesky.factor(values) {
                Err(LinearError::NotPositive { .. }) if growth < LAST_GROWTH => {
                    growth = if growth == 0.0 { FIRST_GROWTH } else { 8.0 * growth };
                }
                result => return result,
            }
        }
    }

    /// Replaces b by x with ‖b − A x‖ ≤ tolerance ‖b‖, with the matrix factored last.
    pub(crate) fn solve(
        &mut self,
        matrix: SparseColMatRef<'_, usize, f64>,
        b: &mut [f64],
        tolerance: f64,
    ) -> Iteration {
        let Self { cholesky, scales, single, conjugate_gradients, .. } = self;
        let mut system = Factored { matrix, cholesky, scales, single };
        conjugate_gradients.solve(&mut system, b, tolerance, MAX_ITERATIONS)
    }
}

/// A matrix and the factor of a scaled one.
struct Factored<'a> {
    matrix: SparseColMatRef<'a, usize, f64>,
    cholesky: &'a mut Cholesky<f32>,
    scales: &'a [f64],
    single: &'a mut [f32],
}

impl System for Factored<'_> {
    fn apply(&mut self, x: &[f64], product: &mut [f64]) {
        symmetric_product(self.matrix, x, product);
    }

    fn precondition(&mut self, r: &[f64], z: &mut [f64]) {
        let largest = r.iter().zip(self.scales).fold(0.0, |m: f64, (r, scale)| m.max((r * scale).abs()));
        for ((single, r), scale) in self.single.iter_mut().zip(r).zip(self.scales) {
            *single = (r * scale / largest) as f32;
        }
        self.cholesky.substitute(self.single);
        for ((z, single), scale) in z.iter_mut().zip(&*self.single).zip(self.scales) {
            *z = f64::from(*single) * largest * scale;
        }
    }
}

#[cfg(test)]
mod tests;
