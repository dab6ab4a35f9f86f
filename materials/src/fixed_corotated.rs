//! Fixed corotated solid.

use piola::material;

/// Fixed corotated solid: the rotated linear solid with a volumetric part in J.
///
/// ψ = μ Σ (λi − 1)² + λ/2 (J − 1)².
///
/// Stomakhin, Howes, Schroeder, Teran, *Energetically consistent invertible elasticity*, 2012, eq. 7. Defined
/// for every deformation; the stress jumps where λ2 + λ3 = 0, and the twist quotient has a pole there.
#[material(
    admissible(mu > 0.0),
    typical(
        "snow, E = 140 kPa and ν = 0.2 of Stomakhin, Schroeder, Chai, Teran, Selle, *A material \
         point method for snow simulation*, 2013",
        mu = 5.8e4, lambda = 3.9e4
    )
)]
pub fn FixedCorotated(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    let squares = (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2);
    mu * squares + lambda / 2.0 * (J - 1.0).powi(2)
}
