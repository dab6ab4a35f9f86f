//! Ogden solid.

use piola::material;

/// Compressible Ogden solid with N terms: rubber at large strain.
///
/// ψ = Σₚ μₚ/αₚ (λ1^αₚ + λ2^αₚ + λ3^αₚ − 3) − (Σₚ μₚ) ln J + κ/2 (J − 1)².
///
/// Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
/// incompressible rubberlike solids*, Proc. R. Soc. Lond. A 326, 1972, eq. 12, for the shear part. The source
/// is incompressible; here −(Σₚ μₚ) ln J frees the rest state of stress and κ/2 (J − 1)² penalises changes of
/// volume. κ is the first Lamé parameter at small strain. Defined for J > 0; continued below a threshold
/// stretch with [`Inversion::Extend`](piola::Inversion::Extend) if every μₚ αₚ > 0 and κ ≥ 0: a term with μₚ
/// αₚ < 0 would attract collapse.
#[material(
    domain(J > 0.0),
    admissible(alpha[p] != 0.0),
    extend(mu[p] * alpha[p] > 0.0, kappa >= 0.0),
    typical(
        "natural rubber, the three terms of the source",
        mu = [6.3e5, 1.2e3, -1e4], alpha = [1.3, 5.0, -2.0], kappa = 2e7
    )
)]
pub fn Ogden<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli μₚ, Pa.
    mu: [f64; N],
    /// Exponents αₚ, dimensionless.
    alpha: [f64; N],
    /// Volumetric modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shear = sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0));
    shear - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}
