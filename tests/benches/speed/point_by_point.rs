//! P and dP/dF by the method of the paper, one point after the other: what batches are compared with.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::hint::black_box;

use piola::Material;
use piola::lanes::{Backend, Kernel, Lanes};
use piola::point::{Matrix3, stress, svd};
use piola_speed::IN_CACHE;
use piola_tests::baselines::decompositions;
use piola_tests::baselines::svd_gradients::{self, Regularization};

use super::measure::matrices;

/// [`IN_CACHE`] deformation gradients with room for P and the 81 entries of dP/dF.
///
/// [`svd_gradients`], a scalar at a time: what a good engineer makes of \[SZLSB11\] without lanes.
#[derive(Debug)]
pub(crate) struct PointByPoint {
    F: Vec<Matrix3<f64>>,
    results: Vec<(Matrix3<f64>, [[f64; 9]; 9])>,
}

impl PointByPoint {
    /// The points of [`Arrays`](piola_speed::Arrays).
    pub(crate) fn new() -> Self {
        Self { F: matrices(IN_CACHE), results: vec![Default::default(); IN_CACHE] }
    }

    /// Computes all after the decomposition of this library, compiled for the instructions of a back end: the
    /// compiler may use them as it likes.
    pub(crate) fn run(&mut self, material: &impl Material, backend: Backend) {
        backend.run(Compute::<_, false> { material, points: self });
        black_box(&self.results);
    }

    /// The same after the decomposition that a library has ready, nalgebra's. A point where it fails keeps
    /// its numbers.
    pub(crate) fn run_with_library(&mut self, material: &impl Material, backend: Backend) {
        backend.run(Compute::<_, true> { material, points: self });
        black_box(&self.results);
    }
}

struct Compute<'a, M, const BY_LIBRARY: bool> {
    material: &'a M,
    points: &'a mut PointByPoint,
}

impl<M: Material, const BY_LIBRARY: bool> Kernel<f64> for Compute<'_, M, BY_LIBRARY> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = f64>>(self) {
        let PointByPoint { F, results } = self.points;
        for (F, result) in F.iter().zip(results) {
            let svd = if BY_LIBRARY { decompositions::nalgebra(F) } else { Some(svd(F)) };
            let Some(svd) = svd else { continue };
            let P = stress(&svd, self.material.gradient(svd.stretches));
            *result = (P, svd_gradients::tangent(self.material, &svd, Regularization::default()));
        }
    }
}
