//! Storåkers solid.

use piola::material;

/// Storåkers solid with N terms, also called Ogden–Hill foam: highly compressible foams.
///
/// ψ = Σₚ 2μₚ/αₚ² (λ1^αₚ + λ2^αₚ + λ3^αₚ − 3 + (J^(−αₚβₚ) − 1)/βₚ).
///
/// Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
/// compressible rubberlike solids*, 1972; in this form Storåkers, *On material representation and
/// constitutive branching in finite compressible elasticity*, 1986. Σ μₚ is the shear modulus; with one term,
/// β/(1 + 2β) is Poisson's ratio. For βₚ = 0 the term in J is its limit −αₚ ln J, that of a foam without
/// lateral strain. Defined for J > 0; continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend) if every μₚ > 0, αₚ ≥ 2 and βₚ > 0: a positive power of a
/// negative J would let ψ fall without bound.
#[material(
    domain(J > 0.0),
    admissible(alpha[p] != 0.0),
    extend(mu[p] > 0.0, alpha[p] >= 2.0, beta[p] > 0.0),
    typical(
        "foamed polyurethane rubber, μ = 32 psi and ν = 1/4 of Blatz, Ko, *Application of finite \
         elastic theory to the deformation of rubbery materials*, 1962, who prefer α = −2",
        mu = [2.2e5], alpha = [2.0], beta = [0.5]
    )
)]
pub fn Storakers<const N: usize>(
    [l1, l2, l3]: [f64; 3],
    /// Moduli μₚ, Pa.
    mu: [f64; N],
    /// Exponents αₚ of the stretches, dimensionless.
    alpha: [f64; N],
    /// Resistance βₚ to changes of volume, dimensionless.
    beta: [f64; N],
) -> f64 {
    sum(|p| {
        let powers = l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p]) - 3.0;
        let volume = (J.powf(-alpha[p] * beta[p]) - 1.0) / beta[p];
        2.0 * mu[p] / (alpha[p] * alpha[p]) * (powers + volume)
    })
}
