//! Anssari-Benam–Bucchi solid.

use piola::material;

/// Anssari-Benam–Bucchi solid: rubber and soft tissue that lock where I1b reaches 3n, from the statistics of
/// chains.
///
/// ψ = μ n ((I1b − 3)/(6n) − ln((I1b − 3n)/(3 − 3n))) + κ/2 ((J² − 1)/2 − ln J).
///
/// Anssari-Benam, Bucchi, *A generalised neo-Hookean strain energy function for application to the finite
/// deformation of elastomers*, 2021. The source is incompressible; the last term, of Simo, Hughes,
/// *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0 and I1b < 3n.
#[material(
    domain(J > 0.0, I1b < 3.0 * n),
    admissible(mu > 0.0, n > 1.0, kappa > 0.0),
    refuse("the chains lock at I1b = 3n, which a flattened element exceeds before it inverts"),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.3e5, n = 30.0, kappa = 2e7)
)]
pub fn AnssariBenamBucchi(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: the shear modulus for n → ∞.
    mu: f64,
    /// Number n of segments in a chain, dimensionless.
    n: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = mu * n * ((I1b - 3.0) / (6.0 * n) - ((3.0 * n - I1b) / (3.0 * n - 3.0)).ln());
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
