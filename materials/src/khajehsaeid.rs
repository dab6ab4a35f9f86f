//! Khajehsaeid solid.

use piola::material;

/// Khajehsaeid exp–ln solid: rubber, soft at moderate strain and stiff near its limit, by one invariant.
///
/// ψ = A (exp(α (I1b − 3))/α + β (I1b − 2)(1 − ln(I1b − 2)) − 1/α − β) + κ/2 ((J² − 1)/2 − ln J).
///
/// Khajehsaeid, Arghavani, Naghdabadi, *A hyperelastic constitutive model for rubber-like materials*, 2013.
/// The source is incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2,
/// penalises changes of volume. Defined for J > 0. Far from rest the exponential leaves the range of the
/// numbers, and the status of the point is `nonfinite`.
#[material(
    domain(J > 0.0),
    admissible(a > 0.0, alpha > 0.0, kappa > 0.0),
    refuse("the continued I1b vanishes at F = 0, where ln(I1b − 2) has no value"),
    typical("natural rubber, fitted to Treloar 1944", a = 1.99e5, alpha = 0.0165, beta = 0.158, kappa = 2e7)
)]
pub fn Khajehsaeid(
    [l1, l2, l3]: [f64; 3],
    /// Modulus A, Pa: half the shear modulus.
    a: f64,
    /// Stiffening α, dimensionless.
    alpha: f64,
    /// Softening β, dimensionless.
    beta: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let x = I1b - 2.0;
    let shape = ((alpha * (I1b - 3.0)).exp() - 1.0) / alpha + beta * (x * (1.0 - x.ln()) - 1.0);
    a * shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
