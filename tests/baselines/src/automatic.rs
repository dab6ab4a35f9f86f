//! Derivatives by second-order dual numbers: an energy is written once, and its gradient and Hessian come
//! from its evaluation on numbers that carry 1 + N + N² derivatives along (the crate `num-dual`).
//!
//! [`through_stretches`] takes three variables: ψi and ψij are exact to rounding, flips and twists remain to
//! be made of them, as plain quotients. [`through_decomposition`] takes all of F and needs no theory at all,
//! for it sends the numbers through an eigenvalue iteration on FᵀF. That costs 91 numbers for each one, and
//! is wrong where eigenvalues meet: the iteration ends when the *values* off the diagonal are zero,
//! regardless of their derivatives, and at rest it never begins. Close to that point derivatives of the
//! eigenvectors, gap⁻¹ and gap⁻² in size, cancel in the result.

#![expect(non_snake_case, reason = "F, P, C, I1, J as in the literature")]

use nalgebra::SVector;
use num_dual::linalg::jacobi_eigenvalue;
use num_dual::{Dual2SVec, DualNum, DualNumFloat, hessian};
use piola::material::Blocks;
use piola::point::{Matrix3, Svd};
use piola_materials::{Hencky, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff};

use crate::LibraryNumber;
use crate::quotients::{Change, Plain};

/// An energy density that can be evaluated on dual numbers.
pub trait Potential {
    /// ψ, J/m³ of rest volume, from signed stretches.
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, stretches: [D; 3]) -> D;
}

/// μ/4 Σ (λi² − 1)² + λ/8 (I1 − 3)².
impl Potential for StVenantKirchhoff {
    #[inline(always)]
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, stretches: [D; 3]) -> D {
        quadratic(stretches.map(|l| l * l - real::<T>(1.0)), self.mu() / 4.0, self.lambda() / 8.0)
    }
}

/// μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
impl Potential for NeoHookean {
    #[inline(always)]
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, [l1, l2, l3]: [D; 3]) -> D {
        let I1 = l1 * l1 + l2 * l2 + l3 * l3;
        let log = (l1 * l2 * l3).ln();
        (I1 - real::<T>(3.0)) * real::<T>(self.mu() / 2.0) - log * real::<T>(self.mu())
            + log * log * real::<T>(self.lambda() / 2.0)
    }
}

/// Σₚ μₚ/αₚ (λ1^αₚ + λ2^αₚ + λ3^αₚ − 3) − (Σₚ μₚ) ln J + κ/2 (J − 1)².
impl<const N: usize> Potential for Ogden<N> {
    #[inline(always)]
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, [l1, l2, l3]: [D; 3]) -> D {
        let J = l1 * l2 * l3;
        let volume = J - real::<T>(1.0);
        let total: f64 = self.mu().iter().sum();
        let mut energy = volume * volume * real::<T>(self.kappa() / 2.0) - J.ln() * real::<T>(total);
        for (mu, alpha) in self.mu().into_iter().zip(self.alpha()) {
            let exponent = real::<T>(alpha);
            let powers = l1.powf(exponent) + l2.powf(exponent) + l3.powf(exponent);
            energy += (powers - real::<T>(3.0)) * real::<T>(mu / alpha);
        }
        energy
    }
}

/// μ Σ (λi − 1)² + λ/2 (λ1 + λ2 + λ3 − 3)².
impl Potential for RotatedLinear {
    #[inline(always)]
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, stretches: [D; 3]) -> D {
        quadratic(stretches.map(|l| l - real::<T>(1.0)), self.mu(), self.lambda() / 2.0)
    }
}

/// μ Σ (ln λi)² + λ/2 (ln J)².
impl Potential for Hencky {
    #[inline(always)]
    fn energy<T: DualNumFloat, D: DualNum<T> + Copy>(&self, stretches: [D; 3]) -> D {
        quadratic(stretches.map(|l| l.ln()), self.mu(), self.lambda() / 2.0)
    }
}

/// a Σ ei² + b (e1 + e2 + e3)².
#[inline(always)]
fn quadratic<T: DualNumFloat, D: DualNum<T> + Copy>([e1, e2, e3]: [D; 3], a: f64, b: f64) -> D {
    let trace = e1 + e2 + e3;
    (e1 * e1 + e2 * e2 + e3 * e3) * real::<T>(a) + trace * trace * real::<T>(b)
}

/// The number nearest to `value`.
#[inline(always)]
fn real<T: DualNumFloat>(value: f64) -> T {
    // Every format has one.
    T::from_f64(value).unwrap_or_else(T::nan)
}

/// ψi and ψij by automatic differentiation, flips and twists as (ψi ∓ ψj)/(λi ∓ λj), NaN where stretches are
/// equal.
#[must_use]
pub fn through_stretches<T: LibraryNumber>(potential: &impl Potential, svd: &Svd<T>) -> Blocks<T> {
    let energy = |l: SVector<Dual2SVec<T, T, 3>, 3>| potential.energy([l[0], l[1], l[2]]);
    let (_, gradient, h) = hessian(energy, &SVector::from(svd.stretches));
    let hessian = [h[(0, 0)], h[(1, 1)], h[(2, 2)], h[(0, 1)], h[(0, 2)], h[(1, 2)]];
    let none = [<T as piola::Real>::splat(0.0); 3];
    Plain.blocks(svd.stretches, Blocks { gradient: gradient.into(), hessian, flip: none, twist: none })
}

/// P and dP/dF, Pa, as derivatives of ψ by the nine entries of F; wrong where two stretches are equal.
#[must_use]
pub fn through_decomposition<T: LibraryNumber>(
    potential: &impl Potential,
    F: &Matrix3<T>,
) -> (Matrix3<T>, [[T; 9]; 9]) {
    let energy = |F: SVector<Dual2SVec<T, T, 9>, 9>| potential.energy(signed_stretches(&F));
    let (_, P, dP_dF) = hessian(energy, &SVector::from_row_slice(F.as_flattened()));
    (
        std::array::from_fn(|i| std::array::from_fn(|j| P[3 * i + j])),
        std::array::from_fn(|row| std::array::from_fn(|column| dP_dF[(row, column)])),
    )
}

/// The square roots of the eigenvalues of FᵀF, the smallest one with the sign of det F.
fn signed_stretches<T: DualNumFloat, D: DualNum<T> + Copy>(F: &SVector<D, 9>) -> [D; 3] {
    const LONGEST_ITERATION: usize = 200;
    let F = nalgebra::Matrix3::from_fn(|i, j| F[3 * i + j]);
    let C = nalgebra::Matrix3::from_fn(|i, j| {
        F[(0, i)] * F[(0, j)] + F[(1, i)] * F[(1, j)] + F[(2, i)] * F[(2, j)]
    });
    // In ascending order.
    let (squares, _) = jacobi_eigenvalue(C, LONGEST_ITERATION);
    let [l3, l2, l1] = [squares[0].sqrt(), squares[1].sqrt(), squares[2].sqrt()];
    let minor = |j: usize, k: usize| F[(1, j)] * F[(2, k)] - F[(1, k)] * F[(2, j)];
    let determinant = F[(0, 0)] * minor(1, 2) + F[(0, 1)] * minor(2, 0) + F[(0, 2)] * minor(0, 1);
    [l1, l2, if determinant.is_negative() { -l3 } else { l3 }]
}

#[cfg(test)]
mod tests {
    use piola::Material;
    use piola::point::{Tangent, svd};

    use super::*;
    use crate::testing::{IDENTITY, SHEARED, convert, error, exact};

    const FITS: &str = "admissible parameters";

    /// The errors of both ways to dP/dF, in units of u.
    #[track_caller]
    fn errors<T: LibraryNumber + Into<f64>>(
        material: &(impl Material + Potential),
        F: &Matrix3<f64>,
    ) -> [f64; 2] {
        let F = convert::<T>(F);
        let (exact_P, exact_K) = exact(material, &F);
        let svd = svd(&F);
        let blocks = through_stretches(material, &svd);
        let (P, K) = through_decomposition(material, &F);
        assert!(error(&P, &exact_P) <= 1000.0 * T::UNIT_ROUNDOFF || F == convert::<T>(&IDENTITY));
        [Tangent { U: svd.U, V: svd.V, blocks }.to_matrix(), K]
            .map(|found| error(&found, &exact_K) / T::UNIT_ROUNDOFF)
    }

    #[track_caller]
    fn compare(material: &(impl Material + Potential)) {
        // Gaps of a sixth, which quotients divide by once and derivatives of eigenvectors twice.
        for [stretches, decomposition] in
            [errors::<f64>(material, &SHEARED), errors::<f32>(material, &SHEARED)]
        {
            assert!(stretches <= 100.0 && decomposition <= 1000.0, "{stretches} {decomposition}");
        }
        // The quotients are 0/0, and the shear stiffness is missing from what ends before it begins.
        let [stretches, decomposition] = errors::<f64>(material, &IDENTITY);
        assert!(stretches.is_nan() && decomposition >= 1e14, "{stretches} {decomposition:e}");
    }

    #[test]
    fn the_energies_are_those_of_the_catalogue() {
        compare(&StVenantKirchhoff::new(1.0, 1.5).expect(FITS));
        compare(&NeoHookean::new(1.0, 1.5).expect(FITS));
        compare(&RotatedLinear::new(1.0, 1.5).expect(FITS));
        compare(&Hencky::new(1.0, 1.5).expect(FITS));
        compare(&Ogden::new([0.6, 0.1, -0.2], [1.3, 5.0, -2.0], 3.0).expect(FITS));
    }

    /// An inside-out point, where the smallest stretch is negative.
    #[test]
    fn the_determinant_gives_its_sign() {
        let material = RotatedLinear::new(1.0, 1.5).expect(FITS);
        let inverted = SHEARED.map(|[x, y, z]| [x, y, -z]);
        let [_, decomposition] = errors::<f64>(&material, &inverted);
        assert!(decomposition <= 1000.0, "{decomposition}");
    }
}
