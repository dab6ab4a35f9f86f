//! Swanson solid.

use piola::material;

/// Swanson solid with N pairs of terms: rubber at high elongation, by powers of both invariants.
///
/// ψ = Σₚ 3/2 Aₚ/(1 + αₚ) (I1b/3)^(1+αₚ) + Σₚ 3/2 Bₚ/(1 + βₚ) (I2b/3)^(1+βₚ) + κ/2 ((J² − 1)/2 − ln J).
///
/// Swanson, *A constitutive model for high elongation elastic materials*, 1985; here the constant is taken
/// off, so that ψ vanishes at rest. The source is incompressible; the last term, of Simo, Hughes,
/// *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(alpha[p] != -1.0, beta[p] != -1.0, kappa > 0.0),
    refuse("real powers of I2 are singular where two stretches vanish"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        a = [1.3e5], alpha = [0.514], b = [2.61e5], beta = [-1.09], kappa = 2e7
    )
)]
pub fn Swanson<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli Aₚ, Pa.
    a: [f64; N],
    /// Exponents αₚ of I1b, dimensionless.
    alpha: [f64; N],
    /// Moduli Bₚ, Pa.
    b: [f64; N],
    /// Exponents βₚ of I2b, dimensionless.
    beta: [f64; N],
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = sum(|p| {
        3 / 2 * a[p] / (1.0 + alpha[p]) * ((I1b / 3.0).powf(1.0 + alpha[p]) - 1.0)
            + 3 / 2 * b[p] / (1.0 + beta[p]) * ((I2b / 3.0).powf(1.0 + beta[p]) - 1.0)
    });
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
