//! P and dP/dF by the method of the paper, one point after the other: what batches are compared with.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*, 2011.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::hint::black_box;

use piola::Material;
use piola::lanes::{Backend, Kernel, Lanes};
use piola::point::{Matrix3, stress, svd};

use super::IN_CACHE;
use super::task::Input;
use crate::baselines::decompositions;
use crate::baselines::svd_gradients::{self, Regularization};
use piola::random::Random;

/// [`IN_CACHE`] deformation gradients with room for P and the 81 entries of dP/dF.
///
/// [`svd_gradients`], a scalar at a time: what a good engineer makes of \[SZLSB11\] without lanes.
#[derive(Debug)]
pub struct PointByPoint {
    F: Vec<Matrix3<f64>>,
    results: Vec<(Matrix3<f64>, [[f64; 9]; 9])>,
}

impl PointByPoint {
    /// The points of [`Arrays`](super::Arrays).
    #[must_use]
    pub fn new() -> Self {
        let mut random = Random::new(1);
        let mut F = vec![[[0.0; 3]; 3]; IN_CACHE];
        for F in &mut F {
            F.as_flattened_mut().copy_from_slice(&Input::Deformation.draw(&mut random));
        }
        Self { F, results: vec![Default::default(); IN_CACHE] }
    }

    /// Computes all after the decomposition of this library, compiled for the instructions of a back end: the compiler may use
    /// them as it likes.
    pub fn run(&mut self, material: &impl Material, backend: Backend) {
        backend.run(Compute::<_, false> { material, points: self });
        black_box(&self.results);
    }

    /// The same after the decomposition that a library has ready, nalgebra's. A point where it fails keeps its numbers.
    pub fn run_with_library(&mut self, material: &impl Material, backend: Backend) {
        backend.run(Compute::<_, true> { material, points: self });
        black_box(&self.results);
    }
}

impl Default for PointByPoint {
    fn default() -> Self {
        Self::new()
    }
}

struct Compute<'a, M, const BY_LIBRARY: bool> {
    material: &'a M,
    points: &'a mut PointByPoint,
}

impl<M: Material, const BY_LIBRARY: bool> Kernel<f64> for Compute<'_, M, BY_LIBRARY> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Element = f64>>(self) {
        let PointByPoint { F, results } = self.points;
        for (F, result) in F.iter().zip(results) {
            let svd = if BY_LIBRARY { decompositions::nalgebra(F) } else { Some(svd(F)) };
            let Some(svd) = svd else { continue };
            let P = stress(&svd, self.material.gradient(svd.stretches));
            *result = (P, svd_gradients::tangent(self.material, &svd, Regularization::default()));
        }
    }
}
