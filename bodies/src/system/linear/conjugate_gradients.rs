//! Preconditioned conjugate gradients [HS52] for A x = b, with the termination criteria of a minimisation
//! [NW06 §7.1].
//!
//! The iteration begins at x = 0. If A is positive definite, each iterate x minimises ½ xᵀA x − bᵀx over more
//! directions than the previous iterate, and bᵀx > 0. Every iterate is therefore a direction of descent for a
//! gradient −b. If pᵀA p ≤ 0 for a search direction p, A is not positive definite, and the iteration ends
//! with the current iterate. In the first iteration it ends with p, the preconditioned direction of steepest
//! descent.
//!
//! The residual b − A x is updated instead of recomputed. It differs from the true residual by about
//! u ‖A‖ ‖x‖, as much as the residual of a factorisation. Sums are computed in chunks of fixed size, so that
//! they have the same bits for any number of threads. This module does not depend on nodes.
//!
//! \[HS52\] Hestenes, Stiefel, *Methods of Conjugate Gradients for Solving Linear Systems*, 1952.
//! \[NW06\] Nocedal, Wright, *Numerical Optimization*, 2nd edition, 2006: "line search Newton–CG".

#![expect(non_snake_case, reason = "A as in the literature")]

use crate::system::parts::for_each_part;

/// Number of entries in a chunk.
const CHUNK: usize = 4096;

/// Memory of the iteration.
#[derive(Clone)]
pub(crate) struct ConjugateGradients {
    /// r = b − A x.
    residual: Vec<f64>,
    /// z = M⁻¹ r.
    preconditioned: Vec<f64>,
    /// p.
    search: Vec<f64>,
    /// A p.
    product: Vec<f64>,
    /// Sums of chunks.
    sums: Vec<f64>,
}

/// Outcome of conjugate gradients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Iteration {
    /// Number of products with the matrix A.
    pub iterations: usize,
    /// Reason why the iteration ended.
    pub end: End,
}

/// Reason why conjugate gradients for A x = b ended; the residual is r = b − A x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Convergence: ‖r‖ ≤ tolerance ‖b‖.
    Converged,
    /// Maximum number of iterations reached.
    Limit,
    /// Negative curvature: A is not positive definite.
    NegativeCurvature,
    /// Infinite or NaN entry, or a preconditioner that is not positive definite; x is meaningless.
    NotFinite,
}

impl ConjugateGradients {
    pub(crate) fn new(unknowns: usize) -> Self {
        let zeros = || vec![0.0; unknowns];
        Self {
            residual: zeros(),
            preconditioned: zeros(),
            search: zeros(),
            product: zeros(),
            sums: vec![0.0; unknowns.div_ceil(CHUNK)],
        }
    }

    /// Replaces b by x with ‖b − A x‖ ≤ tolerance ‖b‖ in Euclidean norms, or by the last iterate if the
    /// iteration ends earlier. `apply` replaces its second argument by A times the first one, and
    /// `precondition` by a positive definite approximation of A⁻¹ times the first one.
    pub(crate) fn solve(
        &mut self,
        mut apply: impl FnMut(&[f64], &mut [f64]),
        mut precondition: impl FnMut(&[f64], &mut [f64]),
        b: &mut [f64],
        tolerance: f64,
        max_iterations: usize,
    ) -> Iteration {
        let Self { residual: r, preconditioned: z, search: p, product: Ap, sums } = self;
        r.copy_from_slice(b);
        let x = b;
        x.fill(0.0);
        p.fill(0.0);
        let mut norm = dot(r, r, sums).sqrt();
        let goal = tolerance * norm;
        let mut rz_before = f64::INFINITY;
        let mut iterations = 0;
        let end = loop {
            if !norm.is_finite() {
                break End::NotFinite;
            }
            if norm <= goal {
                break End::Converged;
            }
            if iterations == max_iterations {
                break End::Limit;
            }
            precondition(r, z);
            let rz = dot(r, z, sums);
            let beta = rz / rz_before;
            combine(p, |p, z| z + beta * p, z);
            apply(p, Ap);
            iterations += 1;
            let curvature = dot(p, Ap, sums);
            if !(rz > 0.0 && curvature.is_finite()) {
                break End::NotFinite;
            }
            if curvature <= 0.0 {
                if iterations == 1 {
                    x.copy_from_slice(p);
                }
                break End::NegativeCurvature;
            }
            let step = rz / curvature;
            combine(x, |x, p| x + step * p, p);
            combine(r, |r, Ap| r - step * Ap, Ap);
            norm = dot(r, r, sums).sqrt();
            rz_before = rz;
        };
        Iteration { iterations, end }
    }
}

/// Scalar product Σ a·b, summed in the same order for any number of threads.
fn dot(a: &[f64], b: &[f64], sums: &mut [f64]) -> f64 {
    for_each_part(sums, 1, |chunk, sums| {
        let first = chunk * CHUNK;
        let chunk = first..a.len().min(first + CHUNK);
        let products = a[chunk.clone()].iter().zip(&b[chunk]).map(|(a, b)| a * b);
        sums[0] = products.sum();
    });
    sums.iter().sum()
}

/// Replaces each entry of `to` by a function of this entry and the corresponding entry of `from`.
fn combine(to: &mut [f64], with: impl Fn(f64, f64) -> f64 + Sync, from: &[f64]) {
    for_each_part(to, CHUNK, |first, to| {
        for (to, from) in to.iter_mut().zip(&from[first..]) {
            *to = with(*to, *from);
        }
    });
}

#[cfg(test)]
mod tests {
    use piola::__private::random::Random;

    use super::*;

    /// Diagonal matrix between dense reflections I − 2wwᵀ, without a preconditioner.
    struct Reflected {
        diagonal: Vec<f64>,
        w: Vec<f64>,
    }

    impl Reflected {
        fn new(diagonal: Vec<f64>) -> Self {
            let mut random = Random::new(1);
            let w: Vec<f64> = diagonal.iter().map(|_| random.uniform(-1.0, 1.0)).collect();
            let norm = w.iter().map(|w| w * w).sum::<f64>().sqrt();
            Self { w: w.into_iter().map(|w| w / norm).collect(), diagonal }
        }

        fn reflect(&self, x: &mut [f64]) {
            let along: f64 = x.iter().zip(&self.w).map(|(x, w)| x * w).sum();
            x.iter_mut().zip(&self.w).for_each(|(x, w)| *x -= 2.0 * along * w);
        }

        fn apply(&self, x: &[f64], product: &mut [f64]) {
            product.copy_from_slice(x);
            self.reflect(product);
            product.iter_mut().zip(&self.diagonal).for_each(|(x, d)| *x *= d);
            self.reflect(product);
        }

        fn solve(&self, b: &mut [f64], tolerance: f64, limit: usize) -> Iteration {
            let mut memory = ConjugateGradients::new(b.len());
            let apply = |x: &[f64], product: &mut [f64]| self.apply(x, product);
            memory.solve(apply, |r, z| z.copy_from_slice(r), b, tolerance, limit)
        }
    }

    /// Right side, solution, and outcome of the iteration.
    fn solve(diagonal: Vec<f64>, tolerance: f64, limit: usize) -> (Vec<f64>, Vec<f64>, Iteration) {
        let mut random = Random::new(2);
        let b: Vec<f64> = diagonal.iter().map(|_| random.uniform(-1.0, 1.0)).collect();
        let mut x = b.clone();
        let iteration = Reflected::new(diagonal).solve(&mut x, tolerance, limit);
        (b, x, iteration)
    }

    fn norm(x: &[f64]) -> f64 {
        x.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    #[test]
    fn few_eigenvalues_take_few_iterations() {
        // Enough entries for three chunks.
        let diagonal: Vec<f64> = (0..10_000).map(|i| [1.0, 3.0, 10.0, 40.0][i % 4]).collect();
        let (b, x, iteration) = solve(diagonal.clone(), 1e-12, 100);
        assert_eq!(iteration, Iteration { iterations: 4, end: End::Converged });
        let mut residual = vec![0.0; b.len()];
        Reflected::new(diagonal).apply(&x, &mut residual);
        residual.iter_mut().zip(&b).for_each(|(r, b)| *r -= b);
        // The true residual is the updated one up to u ‖A‖ ‖x‖ ≤ 40 u ‖b‖ for each of the four steps.
        assert!(norm(&residual) <= (1e-12 + 160.0 * f64::EPSILON) * norm(&b), "{}", norm(&residual));
    }

    #[test]
    fn whatever_stops_it_the_direction_descends() {
        let spread: Vec<f64> = (0..500).map(|i| 1.0 + f64::from(i)).collect();
        let indefinite: Vec<f64> = (0..500).map(|i| 1.0 - f64::from(i) / 300.0).collect();
        let negative = vec![-2.0; 500];
        for (diagonal, limit, iterations, expected) in [
            (spread, 5, 5..=5, End::Limit),
            (negative.clone(), 100, 1..=1, End::NegativeCurvature),
            // Directions precede the one of negative curvature.
            (indefinite, 500, 2..=500, End::NegativeCurvature),
        ] {
            let (b, x, found) = solve(diagonal, 1e-10, limit);
            assert!(found.end == expected && iterations.contains(&found.iterations), "{found:?}");
            assert!(b.iter().zip(&x).map(|(b, x)| b * x).sum::<f64>() > 0.0);
        }
        let (b, x, _) = solve(negative, 1e-10, 100);
        assert_eq!(b, x, "steepest descent");
    }

    #[test]
    fn nothing_to_solve_takes_no_iteration_and_nonsense_is_said() {
        let mut system = Reflected::new(vec![1.0; 3]);
        let mut b = [0.0; 3];
        let iteration = system.solve(&mut b, 1e-3, 10);
        assert_eq!((iteration, b), (Iteration { iterations: 0, end: End::Converged }, [0.0; 3]));
        for wrong in [f64::NAN, f64::INFINITY, 1e200] {
            assert_eq!(system.solve(&mut [1.0, wrong, 0.0], 1e-3, 10).end, End::NotFinite);
        }
        system.diagonal[1] = f64::NAN;
        assert_eq!(system.solve(&mut [1.0; 3], 1e-3, 10).end, End::NotFinite);
    }
}
