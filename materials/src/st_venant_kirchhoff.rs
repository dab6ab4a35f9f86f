//! Saint Venant–Kirchhoff solid.

use piola::material;

/// Saint Venant–Kirchhoff solid: linear in the Green strain E, for large rotations with small strains.
///
/// ψ = μ Σ Ei² + λ/2 (Σ Ei)² with Ei = (λi² − 1)/2.
///
/// Ciarlet, *Mathematical Elasticity I*, 1988, §3.9. Defined for every deformation and even in the stretches,
/// so it resists inversion no more than compression: P vanishes at F = 0, and an inside-out body is at rest.
#[material(
    admissible(mu > 0.0),
    typical("steel, E = 210 GPa and ν = 0.3 of EN 1993-1-1, §3.2.6", mu = 8.1e10, lambda = 1.2e11)
)]
pub fn StVenantKirchhoff(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    let squares = (l1 * l1 - 1.0).powi(2) + (l2 * l2 - 1.0).powi(2) + (l3 * l3 - 1.0).powi(2);
    mu / 4.0 * squares + lambda / 8.0 * (I1 - 3.0).powi(2)
}
