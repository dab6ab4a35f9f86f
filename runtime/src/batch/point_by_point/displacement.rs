//! Many points of bodies that hardly deform: slices of displacement gradients H = F − I in, slices of
//! energies, stresses and tangents out.
//!
//! As [`evaluate_energy_from_displacement`], [`evaluate_stress_from_displacement`] and
//! [`evaluate_from_displacement`] do for one point.

#![expect(non_snake_case, reason = "H, P, dP_dF as in the literature")]

use super::PointBatch;
use crate::batch::{LengthError, Stages};
use crate::lanes::Real;
use crate::material::Response;
use crate::point::{
    Matrix3, evaluate_energy_from_displacement, evaluate_from_displacement, evaluate_stress_from_displacement,
};
use crate::status::Survey;

impl<M: ?Sized> PointBatch<'_, M> {
    /// Energy densities above that of rest, Pa, of displacement gradients, nine components each.
    ///
    /// ```
    /// use piola::batch::PointBatch;
    ///
    /// /// Rubber.
    /// #[piola::material(domain(J > 0.0))]
    /// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln()
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let rubber = Rubber::new(1e6)?;
    /// // A strain of 10⁻⁸: ψ is μ times its square, of which nothing is left in F.
    /// let H = [1e-8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0].repeat(100);
    /// let mut energies = vec![0.0_f64; 100];
    /// PointBatch::new(&rubber).energies_from_displacements(&H, &mut energies)?;
    /// assert!((energies[99] - 1e6 * 1e-16).abs() < 1e-7 * 1e6 * 1e-16);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn energies_from_displacements<E: Stages + Real<Mask = bool>>(
        &self,
        H: &[E],
        energies: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        self.run([("H", H, 9)], [("energies", energies, 1)], |[H], [energy]| {
            let (value, status) = evaluate_energy_from_displacement(self.material, &matrix(H));
            energy.fill(value);
            status
        })
    }

    /// Stresses P, Pa, of displacement gradients, nine components each.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn stresses_from_displacements<E: Stages + Real<Mask = bool>>(
        &self,
        H: &[E],
        P: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        self.run([("H", H, 9)], [("P", P, 9)], |[H], [P]| {
            let (stress, status) = evaluate_stress_from_displacement(self.material, &matrix(H));
            P.copy_from_slice(stress.as_flattened());
            status
        })
    }

    /// Stresses P, nine components, and the filtered dP/dF, 81, Pa, of displacement gradients.
    ///
    /// # Errors
    /// [`LengthError`] if the lengths of the slices do not fit together.
    pub fn tangents_from_displacements<E: Stages + Real<Mask = bool>>(
        &self,
        H: &[E],
        P: &mut [E],
        dP_dF: &mut [E],
    ) -> Result<Survey, LengthError>
    where
        M: Response<E>,
    {
        self.run([("H", H, 9)], [("P", P, 9), ("dP_dF", dP_dF, 81)], |[H], [P, dP_dF]| {
            let point = evaluate_from_displacement(self.material, &matrix(H), self.filter);
            P.copy_from_slice(point.stress.as_flattened());
            dP_dF.copy_from_slice(point.tangent.to_matrix().as_flattened());
            point.status
        })
    }
}

/// Nine components, row by row.
fn matrix<E: Copy>(components: &[E]) -> Matrix3<E> {
    std::array::from_fn(|i| std::array::from_fn(|j| components[3 * i + j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_written::NeoHookean;
    use crate::point::Filter;
    use crate::random::Random;

    #[test]
    fn every_point_has_the_bits_that_it_has_alone() {
        const COUNT: usize = 70;
        let mut random = Random::new(7);
        let H: Vec<f64> = (0..9 * COUNT).map(|_| random.uniform(-1e-6, 1e-6)).collect();
        let batch = PointBatch::new(&NeoHookean).with_filter(Filter::Clamp);
        let (mut energies, mut P, mut dP) = (vec![0.0; COUNT], vec![0.0; 9 * COUNT], vec![0.0; 81 * COUNT]);
        assert!(batch.energies_from_displacements(&H, &mut energies).expect("lengths").is_clean());
        batch.tangents_from_displacements(&H, &mut P, &mut dP).expect("lengths");
        let mut alone = vec![0.0; 9 * COUNT];
        batch.stresses_from_displacements(&H, &mut alone).expect("lengths");
        assert_eq!(P, alone);
        for p in 0..COUNT {
            let at = matrix(&H[9 * p..]);
            assert_eq!(energies[p], evaluate_energy_from_displacement(&NeoHookean, &at).0);
            let point = evaluate_from_displacement(&NeoHookean, &at, Filter::Clamp);
            assert_eq!(dP[81 * p..][..81], *point.tangent.to_matrix().as_flattened());
        }
    }
}
