//! Knowles solid.

use piola::material;

/// Knowles solid: generalised neo-Hookean, hardening in shear for n > 1 and softening for n < 1.
///
/// ψ = μ/(2b) ((1 + b/n (I1b − 3))ⁿ − 1) + κ/2 ((J² − 1)/2 − ln J).
///
/// Knowles, *The finite anti-plane shear field near the tip of a crack for a class of incompressible elastic
/// solids*, 1977. The source is incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*,
/// 1998, §9.2, penalises changes of volume. Defined for J > 0; continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend) if 3b < n: the continued I1b vanishes at F = 0, and the
/// base of the power must stay positive.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, b > 0.0, n > 0.0, kappa > 0.0),
    extend(3.0 * b < n),
    typical(
        "natural rubber, fitted to Treloar 1944 with n = 2",
        mu = 3.3e5, b = 0.024, n = 2.0, kappa = 2e7
    )
)]
pub fn Knowles(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Nonlinearity b, dimensionless.
    b: f64,
    /// Hardening exponent n, dimensionless.
    n: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = mu / (2.0 * b) * ((1.0 + b / n * (I1b - 3.0)).powf(n) - 1.0);
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
