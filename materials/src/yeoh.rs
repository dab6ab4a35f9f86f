//! Yeoh solid.

use piola::material;

/// Yeoh solid: carbon-black filled rubber, a cubic in the first isochoric invariant.
///
/// ψ = Σₖ Cₖ (I1b − 3)ᵏ + κ/2 (J − 1)², k = 1, 2, 3.
///
/// Yeoh, *Some Forms of the Strain Energy Function for Rubber*, 1993, eq. 5, in isochoric form. Defined for J
/// > 0.
#[material(
    domain(J > 0.0),
    admissible(c1 > 0.0, kappa > 0.0),
    refuse("isochoric terms with (J − 1)² alone do not push a collapsed point open"),
    typical("natural rubber, fitted to Treloar 1944", c1 = 1.85e5, c2 = -1.46e3, c3 = 40.4, kappa = 2e7)
)]
pub fn Yeoh(
    [l1, l2, l3]: [f64; 3],
    /// Modulus C1, Pa.
    c1: f64,
    /// Modulus C2, Pa.
    c2: f64,
    /// Modulus C3, Pa.
    c3: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let i = I1b - 3.0;
    c1 * i + c2 * i.powi(2) + c3 * i.powi(3) + kappa / 2.0 * (J - 1.0).powi(2)
}
