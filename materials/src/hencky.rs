//! Hencky solid.

use piola::material;

/// Hencky solid: linear in the logarithmic strain, for metals and moderate volume changes.
///
/// ψ = μ Σ (ln λi)² + λ/2 (ln J)².
///
/// Hencky, *Über die Form des Elastizitätsgesetzes bei ideal elastischen Stoffen*, 1928; Xiao, Chen,
/// *Hencky's elasticity model and linear stress-strain relations in isotropic finite hyperelasticity*, 2002.
/// Defined for J > 0; continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend).
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend,
    typical(
        "sand, E = 354 kPa and ν = 0.3 of Klár et al., *Drucker–Prager elastoplasticity for sand \
         animation*, 2016",
        mu = 1.36e5, lambda = 2.04e5
    )
)]
pub fn Hencky(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    mu * (l1.ln().powi(2) + l2.ln().powi(2) + l3.ln().powi(2)) + lambda / 2.0 * J.ln().powi(2)
}
