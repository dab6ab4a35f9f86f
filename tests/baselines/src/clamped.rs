//! Stress and tangent at stretches that are not allowed to become small, nor negative \[ITF04\].
//!
//! Every stretch below a limit is replaced by the limit, and the energy sees nothing else: P = U P̂(max(λ,
//! limit)) Vᵀ, and dP/dF is assembled from the derivatives at the same clamped stretches. So a material with
//! a domain J > 0 gets along with inverted elements, without being asked what it would do there.
//!
//! Where the clamp acts, this tangent is not the derivative of this P: along the clamped direction P does not
//! change at all, while the tangent has the whole stiffness that the material has at the limit, and quotients
//! take the clamped stretches for the true ones. Newton's method then takes another step than Newton's.
//!
//! \[ITF04\] Irving, Teran, Fedkiw, *Invertible finite elements for robust simulation of large deformation*,
//! 2004.

use piola::Real;

use crate::quotients::Change;

/// Stretches that are limited from below.
#[derive(Clone, Copy, Debug)]
pub struct Clamp {
    /// The smallest stretch that the material is shown.
    pub limit: f64,
}

impl Change for Clamp {
    /// NaN where a stretch is.
    #[inline(always)]
    fn shown<R: Real>(&self, [l1, l2, l3]: [R; 3]) -> [R; 3] {
        // In this order `max` gives a stretch that is NaN, not the limit.
        let limit = R::splat(self.limit);
        [limit.max(l1), limit.max(l2), limit.max(l3)]
    }
}

#[cfg(test)]
#[expect(non_snake_case, reason = "P as in the literature")]
mod tests {
    use piola::point::{Filter, Matrix3, evaluate};
    use piola_materials::NeoHookean;

    use super::*;
    use crate::quotients::Changed;
    use crate::testing::{SHEARED, exact};

    fn clamped() -> Changed<NeoHookean, Clamp> {
        let material = NeoHookean::new(1.0, 2.0).expect("admissible parameters");
        Changed(material, Clamp { limit: 0.3 })
    }

    #[test]
    fn above_the_limit_it_is_the_energy_itself() {
        assert_eq!(exact(&clamped(), &SHEARED), exact(&clamped().0, &SHEARED));
    }

    #[test]
    fn below_the_limit_the_tangent_is_not_the_slope_of_the_stress() {
        let stretched = |l3: f64| -> (Matrix3<f64>, [[f64; 9]; 9]) {
            let point =
                evaluate(&clamped(), &[[1.2, 0.0, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, l3]], Filter::None);
            (point.stress, point.tangent.to_matrix())
        };
        let ((P, tangent), (P_further, _)) = (stretched(-0.5), stretched(-0.6));
        assert_eq!(P, P_further);
        // ψ33 = μ + (λ + μ − λ ln J)/λ3² at the limit, J being about a third.
        assert!(tangent[8][8] > 3.0 / (0.3 * 0.3));
        assert!(stretched(f64::NAN).0[2][2].is_nan());
    }
}
