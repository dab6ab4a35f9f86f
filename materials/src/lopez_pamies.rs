//! Lopez-Pamies solid.

use piola::material;

/// Lopez-Pamies solid with N terms: rubber, from small strain to its limit, by powers of one invariant.
///
/// ψ = Σₚ 3 μₚ/(2 αₚ) ((I1b/3)^αₚ − 1) + κ/2 ((J² − 1)/2 − ln J).
///
/// Lopez-Pamies, *A new I1-based hyperelastic model for rubber elastic materials*, 2010, written there as
/// 3^(1−αₚ)/(2αₚ) μₚ (I1^αₚ − 3^αₚ). The source is incompressible; the last term, of Simo, Hughes,
/// *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Σ μₚ is the shear modulus. Defined
/// for J > 0; continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if
/// every μₚ > 0 and αₚ ≥ 1: the continued I1b vanishes at F = 0, where a lesser power has no second
/// derivative. For αₚ < 2 the tangent at F = 0 itself cannot be computed, and the status of that point is not
/// finite.
#[material(
    domain(J > 0.0),
    admissible(alpha[p] != 0.0, kappa > 0.0),
    extend(mu[p] > 0.0, alpha[p] >= 1.0),
    typical("natural rubber, fitted to Treloar 1944", mu = [3.53e5, 15.9], alpha = [1.0, 4.45], kappa = 2e7)
)]
pub fn LopezPamies<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli μₚ, Pa.
    mu: [f64; N],
    /// Exponents αₚ, dimensionless.
    alpha: [f64; N],
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = sum(|p| 3.0 * mu[p] / (2.0 * alpha[p]) * ((I1b / 3.0).powf(alpha[p]) - 1.0));
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
