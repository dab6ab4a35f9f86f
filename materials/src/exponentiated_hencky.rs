//! Exponentiated Hencky solid.

use piola::material;

/// Exponentiated Hencky solid: linear in the logarithmic strain at rest, and elliptic far from it.
///
/// ψ = μ/k (exp(k ‖dev ln V‖²) − 1) + κ/(2k̂) (exp(k̂ (ln J)²) − 1) with ‖dev ln V‖² = Σ (ln λi − ln J/3)².
///
/// Neff, Ghiba, Lankeit, *The exponentiated Hencky-logarithmic strain energy. Part I: Constitutive issues and
/// rank-one convexity*, 2015; the constants are taken off, so that ψ vanishes at rest. Defined for J > 0. Far
/// from rest the exponentials leave the range of the numbers, and the status of the point is `nonfinite`.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, k > 0.0, kappa > 0.0, k_hat > 0.0),
    refuse("the exponential of an extended logarithm leaves the range of the numbers just below the threshold"),
    typical(
        "natural rubber fitted to Treloar 1944 up to twice the rest length, with the smallest k \
         and k̂ for which the source proves plane deformations elliptic",
        mu = 3.9e5, k = 0.25, kappa = 2e7, k_hat = 0.125
    )
)]
pub fn ExponentiatedHencky(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Exponent k of the shape, dimensionless.
    k: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
    /// Exponent k̂ of the volume, dimensionless.
    k_hat: f64,
) -> f64 {
    let mean = J.ln() / 3.0;
    let shape = (l1.ln() - mean).powi(2) + (l2.ln() - mean).powi(2) + (l3.ln() - mean).powi(2);
    mu / k * ((k * shape).exp() - 1.0) + kappa / (2.0 * k_hat) * ((k_hat * J.ln().powi(2)).exp() - 1.0)
}
