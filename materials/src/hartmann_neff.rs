//! Hartmann–Neff solid.

use piola::material;

/// Hartmann–Neff solid: polyconvex, for nearly incompressible rubber.
///
/// ψ = α (I1b³ − 27) + c10 (I1b − 3) + c01 (I2b^(3/2) − 3√3) + κ/50 (J⁵ + J⁻⁵ − 2).
///
/// Hartmann, Neff, *Polyconvexity of generalized polynomial-type hyperelastic strain energy functions for
/// near-incompressibility*, 2003. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(alpha >= 0.0, c10 >= 0.0, c01 >= 0.0, kappa > 0.0),
    refuse("(J⁵ + J⁻⁵) of extended stretches leaves the range of f32 just below the threshold"),
    typical("natural rubber, fitted to Treloar 1944", alpha = 16.1, c10 = 1.7e5, c01 = 57.4, kappa = 2e7)
)]
pub fn HartmannNeff(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient α of I1b³, Pa.
    alpha: f64,
    /// Coefficient c10 of I1b, Pa.
    c10: f64,
    /// Coefficient c01 of I2b^(3/2), Pa.
    c01: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = alpha * (I1b.powi(3) - 27.0) + c10 * (I1b - 3.0) + c01 * (I2b.powf(3 / 2) - 3.0 * 3.0.sqrt());
    shape + kappa / 50.0 * (J.powi(5) + J.powi(-5) - 2.0)
}
