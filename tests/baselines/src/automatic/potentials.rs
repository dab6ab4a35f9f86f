//! Energies of the catalogue as formulas in the stretches, for numbers of any kind.

#![expect(non_snake_case, reason = "I1, J as in the literature")]

use num_dual::{DualNum, DualNumFloat};
use piola_materials::{Hencky, NeoHookean, Ogden, RotatedLinear, StVenantKirchhoff};

use super::Potential;

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
