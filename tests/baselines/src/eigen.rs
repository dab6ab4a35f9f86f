//! The semidefinite matrix nearest to a symmetric 9×9 one, by nalgebra's eigensolver.

use nalgebra::{RealField, SMatrix, SymmetricEigen};

/// The matrix with its negative eigenvalues set to zero; only its symmetric part counts.
///
/// `None` where the matrix is not finite or the iteration does not converge.
#[must_use]
pub fn clamp<T: RealField + Copy>(matrix: &[[T; 9]; 9]) -> Option<[[T; 9]; 9]> {
    const LONGEST_ITERATION: usize = 1000;
    let largest = matrix.iter().flatten().fold(T::zero(), |largest, x| largest.max(x.abs()));
    if !matrix.iter().flatten().all(|x| x.is_finite()) || largest == T::zero() {
        return matrix.iter().flatten().all(|x| x.is_finite()).then_some(*matrix);
    }
    // Brought to magnitude 1, so that squares neither overflow nor vanish.
    let half = T::from_subset(&0.5);
    let symmetric =
        SMatrix::<T, 9, 9>::from_fn(|i, j| half * (matrix[i][j] / largest + matrix[j][i] / largest));
    let mut eigen = SymmetricEigen::try_new(symmetric, T::default_epsilon(), LONGEST_ITERATION)?;
    eigen.eigenvalues.apply(|eigenvalue| *eigenvalue = eigenvalue.max(T::zero()));
    let clamped = eigen.recompose();
    Some(std::array::from_fn(|i| std::array::from_fn(|j| clamped[(i, j)] * largest)))
}
