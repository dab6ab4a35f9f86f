//! Levinson–Burgess solid.

use piola::material;

/// Levinson–Burgess solid: slightly compressible rubber, polynomial in the invariants and J.
///
/// ψ = μ/2 (f (I1 − 3) + (1 − f)(I2/J² − 3) + 2 (1 − 2f)(J − 1) + (2f + (4ν − 1)/(1 − 2ν))(J − 1)²).
///
/// Levinson, Burgess, *A comparison of some simple constitutive relations for slightly compressible
/// rubber-like materials*, 1971. ν is Poisson's ratio at small strain. Defined for J ≠ 0, and for J > 0 here,
/// as nothing else keeps a body from inverting.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, f >= 0.0, f <= 1.0, nu < 1 / 2),
    refuse("nothing but I2/J² resists collapse, and that not of all stretches at once"),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.74e5, f = 0.982, nu = 0.49)
)]
pub fn LevinsonBurgess(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Share f of I1, dimensionless.
    f: f64,
    /// Poisson's ratio ν, dimensionless.
    nu: f64,
) -> f64 {
    let volume = 2.0 * (1.0 - 2.0 * f) * (J - 1.0)
        + (2.0 * f + (4.0 * nu - 1.0) / (1.0 - 2.0 * nu)) * (J - 1.0).powi(2);
    mu / 2.0 * (f * (I1 - 3.0) + (1.0 - f) * (I2 / J.powi(2) - 3.0) + volume)
}
