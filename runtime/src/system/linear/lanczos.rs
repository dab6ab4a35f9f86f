//! Largest eigenvalue of a symmetric operator, by Lanczos' method \[Par98, chapter 13\].
//!
//! All vectors are kept, at most a hundred. Each new vector is orthogonalised twice against all previous
//! ones, which suffices \[Par98, §6.9\]: no eigenvalue is found twice, and deflated vectors are excluded.
//! This module does not depend on a form of matrix.
//!
//! \[Par98\] Parlett, *The Symmetric Eigenvalue Problem*, 1998.

use super::LinearError;
use super::dense::eigen;
use crate::random::Random;

/// Maximum number of products.
const MAX_STEPS: usize = 100;

/// Number of products between two tests of convergence.
const STRIDE: usize = 5;

/// Tolerance of the residual, relative to the eigenvalue; the eigenvalue has twice as many accurate digits.
const TOLERANCE: f64 = 1e-9;

/// Eigenvector of the largest eigenvalue of an operator, from at most a hundred products; `None` if the
/// deflated vectors span the whole space.
///
/// The operator is symmetric in the inner product Σ mᵢ xᵢ yᵢ of the positive `masses`, in which the vector
/// has the norm 1. The span of the `deflated` vectors, which are orthonormal in this product, is left
/// out. `apply` replaces its second argument by the product with its first.
///
/// # Errors
/// [`LinearError::NoEigenvalues`].
pub(crate) fn largest(
    masses: &[f64],
    deflated: &[Vec<f64>],
    mut apply: impl FnMut(&[f64], &mut [f64]),
) -> Result<Option<Vec<f64>>, LinearError> {
    let mut random = Random::new(1);
    let mut next: Vec<f64> = masses.iter().map(|_| random.uniform(-1.0, 1.0)).collect();
    let mut vectors: Vec<Vec<f64>> = Vec::new();
    let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
    let scale = norm(masses, &next);
    let mut length = orthogonalize(masses, deflated, &vectors, &mut next);
    if length <= 1e-12 * scale {
        return Ok(None);
    }
    loop {
        next.iter_mut().for_each(|x| *x /= length);
        let mut product = vec![0.0; masses.len()];
        apply(&next, &mut product);
        diagonal.push(dot(masses, &next, &product));
        vectors.push(next);
        let before = norm(masses, &product);
        length = orthogonalize(masses, deflated, &vectors, &mut product);
        next = product;
        // The vectors span the remaining space: the rest is rounding error.
        let exhausted = length <= 1e-12 * before || vectors.len() == MAX_STEPS;
        if exhausted || vectors.len().is_multiple_of(STRIDE) {
            let (value, weights) = largest_of_tridiagonal(&diagonal, &beside)?;
            let residual = length * weights.last().map_or(0.0, |weight: &f64| weight.abs());
            if exhausted || residual <= TOLERANCE * value.abs() {
                let mut vector = vec![0.0; masses.len()];
                for (weight, part) in weights.iter().zip(&vectors) {
                    add(*weight, part, &mut vector);
                }
                return Ok(Some(vector));
            }
        }
        beside.push(length);
    }
}

/// Largest eigenvalue of a symmetric tridiagonal matrix, and its eigenvector.
fn largest_of_tridiagonal(diagonal: &[f64], beside: &[f64]) -> Result<(f64, Vec<f64>), LinearError> {
    let (mut values, mut vectors) = eigen(diagonal.len(), |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    })?;
    values.pop().zip(vectors.pop()).ok_or(LinearError::NoEigenvalues)
}

/// Removes the components along orthonormal vectors, twice, and returns the norm of the remainder.
fn orthogonalize(masses: &[f64], deflated: &[Vec<f64>], vectors: &[Vec<f64>], x: &mut [f64]) -> f64 {
    for vector in deflated.iter().chain(vectors).chain(deflated).chain(vectors) {
        add(-dot(masses, vector, x), vector, x);
    }
    norm(masses, x)
}

pub(crate) fn dot(masses: &[f64], x: &[f64], y: &[f64]) -> f64 {
    masses.iter().zip(x.iter().zip(y)).map(|(m, (x, y))| m * x * y).sum()
}

pub(crate) fn norm(masses: &[f64], x: &[f64]) -> f64 {
    dot(masses, x, x).sqrt()
}

pub(crate) fn add(factor: f64, x: &[f64], total: &mut [f64]) {
    total.iter_mut().zip(x).for_each(|(total, x)| *total += factor * x);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Eigenvector of a diagonal operator, whose eigenvalues are its entries.
    fn found(values: &[f64], deflated: &[Vec<f64>]) -> Option<Vec<f64>> {
        let masses = vec![4.0; values.len()];
        largest(&masses, deflated, |x, y| {
            y.iter_mut().zip(x.iter().zip(values)).for_each(|(y, (x, value))| *y = value * x);
        })
        .expect("finite")
    }

    fn unit(length: usize, index: usize) -> Vec<f64> {
        let mut vector = vec![0.0; length];
        // The norm is 1 for masses of 4.
        vector[index] = 0.5;
        vector
    }

    #[test]
    fn the_largest_is_found_among_many() {
        let values: Vec<f64> = (0..500).map(|k| 1.0 / (1.0 + f64::from(k))).collect();
        let vector = found(&values, &[]).expect("500 directions");
        assert!((vector[0].abs() - 0.5).abs() < 1e-8 && vector[1..].iter().all(|x| x.abs() < 1e-8));
        let vector = found(&values, &[unit(500, 0)]).expect("499 directions");
        assert!(vector[0] == 0.0 && (vector[1].abs() - 0.5).abs() < 1e-8);
    }

    #[test]
    fn few_directions_are_exhausted() {
        let vector = found(&[3.0, -5.0], &[]).expect("two directions");
        assert!((vector[0].abs() - 0.5).abs() < 1e-14, "{vector:?}");
        assert_eq!(found(&[3.0], &[unit(1, 0)]), None);
        assert_eq!(found(&[], &[]), None);
    }
}
