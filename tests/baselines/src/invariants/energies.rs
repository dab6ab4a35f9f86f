//! Energies of the catalogue as functions of I = tr C, II = C:C and III = det C, with derivatives by hand.

#![expect(non_snake_case, reason = "I, II, III as in the paper")]

use piola::Real;
use piola_materials::{NeoHookean, StVenantKirchhoff};

use super::{Derivatives, InvariantEnergy};

/// ψ = μ/4 (II − 2 I + 3) + λ/8 (I − 3)².
impl InvariantEnergy for StVenantKirchhoff {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [I, _, _]: [R; 3]) -> Derivatives<R> {
        let zero = R::splat(0.0);
        let psi_I = (I - R::splat(3.0)).mul_add(R::splat(self.lambda() / 4.0), R::splat(-self.mu() / 2.0));
        Derivatives {
            gradient: [psi_I, R::splat(self.mu() / 4.0), zero],
            hessian: [[R::splat(self.lambda() / 4.0), zero, zero], [zero; 3], [zero; 3]],
        }
    }
}

/// ψ = μ/2 (I − 3) − μ/2 ln III + λ/8 (ln III)².
impl InvariantEnergy for NeoHookean {
    #[inline(always)]
    fn derivatives<R: Real>(&self, [_, _, III]: [R; 3]) -> Derivatives<R> {
        let zero = R::splat(0.0);
        let quarter = R::splat(self.lambda() / 4.0);
        let inverse = R::splat(1.0) / III;
        // III ψ_III.
        let slope = III.ln().mul_add(quarter, R::splat(-self.mu() / 2.0));
        let psi_III_III = (quarter - slope) * (inverse * inverse);
        Derivatives {
            gradient: [R::splat(self.mu() / 2.0), zero, slope * inverse],
            hessian: [[zero; 3], [zero; 3], [zero, zero, psi_III_III]],
        }
    }
}
