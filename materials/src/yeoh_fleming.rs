//! Yeoh–Fleming solid.

use piola::material;

/// Yeoh–Fleming solid: rubber that locks where I1b reaches Im, softer at moderate strain than at rest.
///
/// ψ = A/B (Im − 3)(1 − exp(−B R)) − C10 (Im − 3) ln(1 − R) + κ/2 ((J² − 1)/2 − ln J) with R = (I1b − 3)/(Im
/// − 3).
///
/// Yeoh, Fleming, *A new attempt to reconcile the statistical and phenomenological theories of rubber
/// elasticity*, 1997. The source is incompressible; the last term, of Simo, Hughes, *Computational
/// Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0 and I1b < Im.
#[material(
    domain(J > 0.0, I1b < im),
    admissible(b > 0.0, c10 > 0.0, im > 3.0, kappa > 0.0),
    refuse("the chains lock at I1b = Im, which a flattened element exceeds before it inverts"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        a = 5.74e4, b = 28.2, c10 = 1.39e5, im = 88.7, kappa = 2e7
    )
)]
pub fn YeohFleming(
    [l1, l2, l3]: [f64; 3],
    /// Modulus A, Pa.
    a: f64,
    /// Rate B of its decay, dimensionless.
    b: f64,
    /// Modulus C10, Pa: half the shear modulus without A.
    c10: f64,
    /// Locking value Im of I1b, dimensionless.
    im: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let r = (I1b - 3.0) / (im - 3.0);
    let shape = a / b * (im - 3.0) * (1.0 - (-b * r).exp()) - c10 * (im - 3.0) * (1.0 - r).ln();
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
