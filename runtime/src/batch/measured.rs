//! Other measures of stress at many points: S, τ and σ with their tangents.
//!
//! The stages of a tile are those for P and dP/dF: decomposition, energy, outputs; the last one makes a
//! [`Measure`] in lanes. Symmetric tensors have six components and tangents 36, in the order of
//! [`voigt`](crate::point::measures::voigt).

#![expect(non_snake_case, reason = "F as in the literature")]

use super::tile::{Call, Job, Tile};
use super::{Batch, LengthError};
use crate::kernels::Kernels;
use crate::kernels::measure::{MeasuredStress, MeasuredTangent};
use crate::kernels::workspace::Scratch;
use crate::point::Filter;
use crate::point::measures::Measure;
use crate::status::Survey;

impl<E: Kernels> Batch<'_, E> {
    /// Stresses in another measure, Pa: six components of each F, in the order of
    /// [`voigt`](crate::point::measures::voigt).
    ///
    /// A point is `nonfinite` if its stress is, such as σ for a singular F. The
    /// [front page](crate#points-in-batches) of the crate has a program.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn measured_stresses(
        &self,
        measure: Measure,
        F: &[E],
        stresses: &mut [E],
    ) -> Result<Survey, LengthError> {
        self.run([("F", F, 9)], [("stresses", stresses, 6)], |job, [F], [stresses]| {
            let mut tile = job.points(F);
            tile.decompose(0);
            let refused = tile.gradients();
            let Tile { call, count, svd: points, scratch: Scratch { gradients, line, .. }, .. } = tile;
            let to = call.sink(stresses, 0);
            let kernel = MeasuredStress { measure, points, gradients: &gradients.0, count, line, to };
            refused | E::measured_stress(call.backend, kernel)
        })
    }

    /// Stresses in another measure, six components of each F, and their tangents, 36, row by row, Pa.
    ///
    /// Tangents are not filtered, regardless of the filter of the batch, because a filtered tangent would not
    /// be a derivative; see [`measures`](crate::point::measures). Otherwise like
    /// [`Batch::measured_stresses`].
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not match.
    pub fn measured_tangents(
        &self,
        measure: Measure,
        F: &[E],
        stresses: &mut [E],
        tangents: &mut [E],
    ) -> Result<Survey, LengthError> {
        let outputs = [("stresses", stresses, 6), ("tangents", tangents, 36)];
        self.run([("F", F, 9)], outputs, |job, [F], [stresses, tangents]| {
            let call = Call { filter: Filter::None, ..job.call };
            let mut tile = Job { call, ..job }.points(F);
            tile.decompose(0);
            let judged = tile.blocks();
            let Tile { count, svd: points, scratch: Scratch { blocks, line, .. }, .. } = tile;
            let (points, to) = (&*points, call.sink(stresses, 0));
            let kernel = MeasuredStress { measure, points, gradients: &blocks.0, count, line, to };
            let stressed = E::measured_stress(call.backend, kernel);
            let to = call.sink(tangents, 0);
            let kernel = MeasuredTangent { measure, points, blocks, count, line, to };
            E::measured_tangent(call.backend, kernel) | stressed | judged
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_written::{ExtendedNeoHookean, SaintVenantKirchhoff};
    use crate::lanes::Backend;
    use crate::material::Material;
    use crate::point::evaluate;
    use crate::random::Random;

    const COUNT: usize = 64 * 10 + 16;

    /// Moderate deformations, as nine numbers each.
    fn sample() -> Vec<[f64; 9]> {
        let mut random = Random::new(121);
        let one = |k: usize| if k.is_multiple_of(4) { 1.0 } else { 0.0 };
        (0..COUNT).map(|_| std::array::from_fn(|k| one(k) + 0.2 * random.uniform(-1.0, 1.0))).collect()
    }

    fn check_against_points(material: &impl Material) {
        let sample = sample();
        for backend in Backend::available() {
            for measure in Measure::ALL {
                let batch = Batch::new(material).with_filter(Filter::Clamp).with_backend(backend);
                let (mut alone, mut stresses) = (vec![0.0; 6 * COUNT], vec![0.0; 6 * COUNT]);
                let mut tangents = vec![0.0; 36 * COUNT];
                let F = sample.as_flattened();
                assert!(batch.measured_stresses(measure, F, &mut alone).expect("lengths").is_clean());
                let survey = batch.measured_tangents(measure, F, &mut stresses, &mut tangents);
                assert!(survey.expect("lengths").is_clean());
                for (p, F) in sample.iter().enumerate() {
                    let F = std::array::from_fn(|i| std::array::from_fn(|j| F[3 * i + j]));
                    let point = evaluate(material, &F, Filter::None);
                    let (svd, blocks) = (point.decomposition(), &point.tangent.blocks);
                    let stress = measure.stress(&svd, blocks.gradient);
                    let tangent = measure.tangent(&svd, blocks);
                    // Twice the 20 u of a decomposition, times moduli of some 10 and what division by
                    // stretches of at least ½ makes of them.
                    let close = |found: &[f64], expected: &[f64]| {
                        let mut pairs = found.iter().zip(expected);
                        pairs.all(|(found, expected)| (found - expected).abs() <= 1e4 * f64::EPSILON)
                    };
                    let is_stress = close(&alone[6 * p..], &stress) && close(&stresses[6 * p..], &stress);
                    let is_tangent = close(&tangents[36 * p..], tangent.as_flattened());
                    assert!(is_stress && is_tangent, "{backend}, {measure:?} at {F:?}");
                }
            }
        }
    }

    #[test]
    fn every_measure_is_that_of_the_points() {
        check_against_points(&SaintVenantKirchhoff);
        check_against_points(&ExtendedNeoHookean { epsilon: 0.3 });
    }

    #[test]
    fn a_singular_deformation_has_a_Kirchhoff_stress_only() {
        let F = [0.0; 9];
        for measure in Measure::ALL {
            let (mut stress, mut tangent) = ([0.0; 6], [0.0; 36]);
            let batch = Batch::new(&SaintVenantKirchhoff);
            let survey = batch.measured_tangents(measure, &F, &mut stress, &mut tangent).expect("lengths");
            assert_eq!(survey.is_clean(), measure == Measure::Kirchhoff, "{measure:?}: {tangent:?}");
        }
    }
}
