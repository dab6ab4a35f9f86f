//! Ogden solid, isochoric form.

use piola::material;

/// Ogden solid with N terms in isochoric stretches: nearly incompressible rubber at large strain.
///
/// ψ = Σₚ μₚ/αₚ (J^(−αₚ/3) (λ1^αₚ + λ2^αₚ + λ3^αₚ) − 3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
/// incompressible rubberlike solids*, 1972, eq. 12, in the stretches J^(−1/3) λi that leave the volume alone:
/// Simo, Taylor, *Quasi-incompressible finite elasticity in principal stretches*, 1991. The volumetric part
/// is that of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2. Defined for J > 0; continued below a
/// threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if every μₚ > 0 and αₚ ≥ 2: below 2
/// the polynomial that continues λ^αₚ has negative values, which the other factors amplify without bound, and
/// ψ has minima where the body is collapsed.
#[material(
    domain(J > 0.0),
    admissible(alpha[p] != 0.0, kappa > 0.0),
    extend(mu[p] > 0.0, alpha[p] >= 2.0),
    typical(
        "natural rubber, fitted to Treloar 1944 with these exponents",
        mu = [3.5e5, 96.0], alpha = [2.0, 6.0], kappa = 2e7
    )
)]
pub fn IsochoricOgden<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli μₚ, Pa.
    mu: [f64; N],
    /// Exponents αₚ, dimensionless.
    alpha: [f64; N],
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = sum(|p| {
        let powers = l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]);
        mu[p] / alpha[p] * (J.powf(-alpha[p] / 3.0) * powers - 3.0)
    });
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
