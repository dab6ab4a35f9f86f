//! Veronda–Westmann solid.

use piola::material;

/// Veronda–Westmann solid: skin, by an exponential of the first invariant.
///
/// ψ = C1 (exp(α (I1b − 3)) − 1) − C1 α/2 (I2b − 3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Veronda, Westmann, *Mechanical characterization of skin—finite deformations*, 1970. The source is
/// incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises
/// changes of volume. Defined for J > 0. Far from rest the exponential leaves the range of the numbers, and
/// the status of the point is `nonfinite`.
#[material(
    domain(J > 0.0),
    admissible(c1 > 0.0, alpha > 0.0, kappa > 0.0),
    refuse("the exponential of an extended I1b leaves the range of the numbers, and −I2b attracts collapse"),
    typical("skin of a cat, C1 and α of the source", c1 = 3.94e3, alpha = 5.03, kappa = 1e6)
)]
pub fn VerondaWestmann(
    [l1, l2, l3]: [f64; 3],
    /// Modulus C1, Pa.
    c1: f64,
    /// Stiffening α, dimensionless: C1 α is the shear modulus.
    alpha: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = c1 * ((alpha * (I1b - 3.0)).exp() - 1.0) - c1 * alpha / 2.0 * (I2b - 3.0);
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
