//! Many points in the plane: slices of 2×2 deformation gradients in, slices of stresses and tangents out.
//!
//! As [`plane_strain`], [`plane_stress`] and [`uniaxial_stress`] do for one point.
//!
//! ```
//! use piola::batch::PointBatch;
//! use piola::point::Filter;
//!
//! /// Rubber.
//! #[piola::material(domain(J > 0.0))]
//! fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ bulk: f64) -> f64 {
//!     mu / 2.0 * (I1b - 3.0) + bulk / 2.0 * (J - 1.0).powi(2)
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let rubber = Rubber::new(1.0, 1e4)?;
//! let membrane = PointBatch::new(&rubber).with_filter(Filter::Clamp);
//! // Four numbers for each of a hundred points, row by row.
//! let F = [2.0, 0.0, 0.0, 1.0].repeat(100);
//! let (mut thickness, mut P, mut dP_dF) = (vec![0.0f64; 100], vec![0.0f64; 400], vec![0.0; 1600]);
//! let survey = membrane.plane_stresses(&F, &mut thickness, &mut P, &mut dP_dF)?;
//! assert!(survey.is_clean());
//! assert!((thickness[99] - 0.5).abs() < 1e-3 && (P[4 * 99] - 1.875).abs() < 1e-3);
//! # Ok(())
//! # }
//! ```

#![expect(non_snake_case, reason = "F, P, dP_dF as in the literature")]

use super::PointBatch;
use crate::batch::{LengthError, Stages};
use crate::lanes::Real;
use crate::material::Response;
use crate::point::plane::{Matrix2, PlanePoint, plane_strain, plane_stress, uniaxial_stress};
use crate::status::{Status, Survey};

impl<M: ?Sized> PointBatch<'_, M> {
    /// Plane strain: stresses P in the plane, four components of each F, and dP/dF, 16, Pa.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn plane_strains<E: Stages + Real<Mask = bool>>(
        &self,
        F: &[E],
        P: &mut [E],
        dP_dF: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        self.run([("F", F, 4)], [("P", P, 4), ("dP_dF", dP_dF, 16)], |[F], [P, dP_dF]| {
            put(&plane_strain(self.material, &matrix(F), self.filter), P, dP_dF)
        })
    }

    /// Plane stress: the stretch out of the plane of each F, stresses P in the plane, four components, and
    /// the condensed dP/dF, 16, Pa.
    ///
    /// Where no stretch frees a point, it is `refused`, and its results are NaN.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn plane_stresses<E: Stages + Real<Mask = bool>>(
        &self,
        F: &[E],
        stretches: &mut [E],
        P: &mut [E],
        dP_dF: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        let outputs = [("stretches", stretches, 1), ("P", P, 4), ("dP_dF", dP_dF, 16)];
        self.run([("F", F, 4)], outputs, |[F], [stretch, P, dP_dF]| {
            let point = plane_stress(self.material, &matrix(F), self.filter);
            stretch.fill(point.out_of_plane_stretch);
            put(&point, P, dP_dF)
        })
    }

    /// Uniaxial stress: of each axial stretch the lateral one, the nominal stress P, Pa, and dP/dλ, Pa.
    ///
    /// Where no lateral stretch frees the sides, the point is `refused`, and its results are NaN.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn uniaxial_stresses<E: Stages + Real<Mask = bool>>(
        &self,
        stretches: &[E],
        lateral: &mut [E],
        P: &mut [E],
        tangents: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        let outputs = [("lateral", lateral, 1), ("P", P, 1), ("tangents", tangents, 1)];
        self.run([("stretches", stretches, 1)], outputs, |[stretch], [lateral, P, tangent]| {
            let Some(&stretch) = stretch.first() else { return Status::default() };
            let point = uniaxial_stress(self.material, stretch);
            lateral.fill(point.lateral_stretch);
            P.fill(point.stress);
            tangent.fill(point.tangent);
            point.status
        })
    }
}

/// Four numbers, row by row.
fn matrix<E: Copy>(numbers: &[E]) -> Matrix2<E> {
    std::array::from_fn(|i| std::array::from_fn(|j| numbers[2 * i + j]))
}

fn put<E: Real<Mask = bool>>(point: &PlanePoint<E>, P: &mut [E], dP_dF: &mut [E]) -> Status {
    P.copy_from_slice(point.stress.as_flattened());
    dP_dF.copy_from_slice(point.tangent.to_matrix().as_flattened());
    point.status
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StatusCell;
    use crate::hand_written::{ExtendedNeoHookean, NeoHookean, SaintVenantKirchhoff};
    use crate::point::Filter;
    use crate::random::Random;

    #[test]
    fn every_point_has_the_bits_that_it_has_alone() {
        const COUNT: usize = 64 * 20 + 5;
        let mut random = Random::new(131);
        let F: Vec<f64> = (0..4 * COUNT)
            .map(|k| random.uniform(-0.5, 0.5) + f64::from(u8::from(matches!(k % 4, 0 | 3))))
            .collect();
        let material = ExtendedNeoHookean { epsilon: 0.3 };
        let two_threads = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads");
        for threads in [false, true] {
            let statuses: Vec<StatusCell> = (0..COUNT).map(|_| StatusCell::default()).collect();
            let batch = PointBatch::new(&material).with_filter(Filter::Clamp).with_threads(threads);
            let batch = batch.with_statuses(&statuses);
            let (mut t, mut P, mut dP) = (vec![0.0; COUNT], vec![0.0; 4 * COUNT], vec![0.0; 16 * COUNT]);
            let survey = two_threads.install(|| batch.plane_stresses(&F, &mut t, &mut P, &mut dP));
            let mut filtered = 0;
            for p in 0..COUNT {
                let point = plane_stress(&material, &matrix(&F[4 * p..]), Filter::Clamp);
                assert_eq!(statuses[p].get(), point.status);
                assert_eq!(t[p].to_bits(), point.out_of_plane_stretch.to_bits());
                assert_eq!(P[4 * p + 1].to_bits(), point.stress[0][1].to_bits());
                assert_eq!(dP[16 * p + 6].to_bits(), point.tangent.to_matrix()[1][2].to_bits());
                filtered += usize::from(point.status.filtered);
            }
            assert_eq!(survey.expect("lengths").filtered, filtered);
        }
    }

    #[test]
    fn a_survey_counts_what_has_no_equilibrium_and_names_the_first() {
        let F = [[1.0, 0.0, 0.0, 1.0], [3.0, 0.0, 0.0, 3.0]].concat();
        let batch = PointBatch::new(&SaintVenantKirchhoff);
        let (mut t, mut P, mut dP) = ([0.0f64; 2], [0.0; 8], [0.0; 32]);
        let survey = batch.plane_stresses(&F, &mut t, &mut P, &mut dP).expect("lengths");
        assert_eq!((survey.refused, survey.first), (1, Some(1)));
        assert_eq!((t[0], t[1].is_nan()), (1.0, true));
        assert!(batch.plane_strains(&F, &mut P, &mut dP).expect("lengths").is_clean());
        let bars = PointBatch::new(&NeoHookean);
        let (mut lateral, mut P, mut dP) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        let survey = bars.uniaxial_stresses(&[1.0, f64::NAN], &mut lateral, &mut P, &mut dP);
        assert_eq!(survey.expect("lengths").nonfinite, 1);
        let error = bars.uniaxial_stresses(&[1.0], &mut lateral, &mut P, &mut dP).unwrap_err();
        assert_eq!((error.slice, error.found), ("lateral", 2));
    }
}
