//! Stress and tangent at stretches that are not allowed to become small, nor negative \[ITF04\].
//!
//! Every stretch below a limit is replaced by the limit, and the energy sees nothing else: P = U P̂(max(λ, limit))
//! Vᵀ, and dP/dF is assembled from the derivatives at the same clamped stretches. So a material with a domain J > 0
//! gets along with inverted elements, without being asked what it would do there.
//!
//! Where the clamp acts, this tangent is no derivative of this P: along the clamped direction P does not change at
//! all, while the tangent has the whole stiffness that the material has at the limit, and quotients take the clamped
//! stretches for the true ones. Newton's method then takes another step than Newton's.
//!
//! \[ITF04\] Irving, Teran, Fedkiw, *Invertible finite elements for robust simulation of large deformation*, 2004.

#![expect(non_snake_case, reason = "U, V, P as in the literature")]

use piola::point::{Matrix3, Svd, Tangent, stress};
use piola::{Material, Real};

/// P and dP/dF, Pa, at stretches of at least `limit`. NaN where a stretch is.
#[inline(always)]
#[must_use]
pub fn evaluate<R: Real>(material: &impl Material, svd: &Svd<R>, limit: f64) -> (Matrix3<R>, Tangent<R>) {
    let Svd { U, stretches: [l1, l2, l3], V } = *svd;
    // In this order `max` gives a stretch that is NaN, not the limit.
    let limit = R::splat(limit);
    let blocks = material.blocks([limit.max(l1), limit.max(l2), limit.max(l3)]);
    let P = stress(svd, blocks.gradient);
    (P, Tangent { U, V, blocks })
}

#[cfg(test)]
mod tests {
    use piola::point::svd;
    use piola_materials::NeoHookean;

    use super::*;
    use crate::baselines::testing::{SHEARED, exact};

    const LIMIT: f64 = 0.3;

    fn rubber() -> NeoHookean {
        NeoHookean::new(1.0, 2.0).expect("admissible parameters")
    }

    /// The same operations on the same numbers; only λ3 comes from the determinant there.
    #[test]
    fn above_the_limit_it_is_the_energy_itself() {
        let svd = piola::point::svd_signed_by_determinant(&SHEARED);
        let (P, tangent) = evaluate(&rubber(), &svd, LIMIT);
        assert_eq!((P, tangent.to_matrix()), exact(&rubber(), &SHEARED));
    }

    #[test]
    fn below_the_limit_the_tangent_is_not_the_slope_of_the_stress() {
        let stretched = |l3: f64| svd(&[[1.2, 0.0, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, l3]]);
        let (P, tangent) = evaluate(&rubber(), &stretched(-0.5), LIMIT);
        let (P_further, _) = evaluate(&rubber(), &stretched(-0.6), LIMIT);
        assert_eq!(P, P_further);
        // ψ33 = μ + (λ + μ − λ ln J)/λ3² at the limit, J being about a third.
        assert!(tangent.to_matrix()[8][8] > 3.0 / (LIMIT * LIMIT));
        assert!(evaluate(&rubber(), &stretched(f64::NAN), LIMIT).0[2][2].is_nan());
    }
}
