//! Mansouri–Darijani solid.

use piola::material;

/// Mansouri–Darijani solid: rubber by an exponential of each invariant.
///
/// ψ = A1 (exp(m1 (I1b − 3)) − 1) + B1 (exp(n1 (I2b − 3)) − 1) + κ/2 ((J² − 1)/2 − ln J).
///
/// Mansouri, Darijani, *Constitutive modeling of isotropic hyperelastic materials in an exponential framework
/// using a self-contained approach*, 2014. The source is incompressible; the last term, of Simo, Hughes,
/// *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0. Far from rest
/// the exponentials leave the range of the numbers, and the status of the point is `nonfinite`.
#[material(
    domain(J > 0.0),
    admissible(kappa > 0.0),
    refuse("the exponential of an extended I2b leaves the range of the numbers just below the threshold"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        a1 = 6.38e6, m1 = 0.0193, b1 = -3.92e5, n1 = -0.171, kappa = 2e7
    )
)]
pub fn MansouriDarijani(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient A1 of the exponential of I1b, Pa.
    a1: f64,
    /// Exponent m1, dimensionless.
    m1: f64,
    /// Coefficient B1 of the exponential of I2b, Pa.
    b1: f64,
    /// Exponent n1, dimensionless.
    n1: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = a1 * ((m1 * (I1b - 3.0)).exp() - 1.0) + b1 * ((n1 * (I2b - 3.0)).exp() - 1.0);
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
