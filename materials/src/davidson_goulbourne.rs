//! Davidson–Goulbourne solid.

use piola::material;

/// Davidson–Goulbourne solid: rubber as a network of chains that lock, and of entanglements.
///
/// ψ = Gc/6 I1b − Gc λm² ln(3λm² − I1b) + Ge Σ (λ̄i + 1/λ̄i) + κ/2 ((J² − 1)/2 − ln J) with λ̄i = J^(−1/3)
/// λi.
///
/// Davidson, Goulbourne, *A nonaffine network model for elastomers undergoing finite deformations*, 2013;
/// here the constant is taken off, so that ψ vanishes at rest. The source is incompressible; the last term,
/// of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0
/// and I1b < 3λm².
#[material(
    domain(J > 0.0, I1b < 3.0 * lambda_m.powi(2)),
    admissible(gc >= 0.0, lambda_m > 1.0, ge >= 0.0, kappa > 0.0),
    refuse("the chains lock at I1b = 3λm², which a flattened element exceeds before it inverts"),
    typical("natural rubber, fitted to Treloar 1944", gc = 2.29e5, lambda_m = 4.93, ge = 1.3e5, kappa = 2e7)
)]
pub fn DavidsonGoulbourne(
    [l1, l2, l3]: [f64; 3],
    /// Modulus Gc of the cross-links, Pa.
    gc: f64,
    /// Locking stretch λm, dimensionless.
    lambda_m: f64,
    /// Modulus Ge of the entanglements, Pa.
    ge: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let m = lambda_m.powi(2);
    let chains = gc / 6.0 * (I1b - 3.0) - gc * m * ((3.0 * m - I1b) / (3.0 * m - 3.0)).ln();
    let sum_of_stretches = (l1 + l2 + l3) / J.cbrt();
    let sum_of_inverses = J.cbrt() * (1.0 / l1 + 1.0 / l2 + 1.0 / l3);
    chains + ge * (sum_of_stretches + sum_of_inverses - 6.0) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
