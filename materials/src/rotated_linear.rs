//! Rotated linear solid.

use piola::material;

/// Rotated linear solid: linear elasticity in the frame of the polar decomposition, also called corotated.
///
/// ψ = μ Σ (λi − 1)² + λ/2 (λ1 + λ2 + λ3 − 3)².
///
/// Müller, Gross, *Interactive Virtual Materials*, 2004; in principal stretches Irving, Teran, Fedkiw,
/// *Invertible finite elements for robust simulation of large deformation*, 2004, §5. Defined for every
/// deformation; the stress jumps where λ2 + λ3 = 0, and the twist quotient has a pole there.
#[material(
    admissible(mu > 0.0),
    typical("the order of soft rubber, E = 1 MPa and ν = 0.45", mu = 3.4e5, lambda = 3.1e6)
)]
pub fn RotatedLinear(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    let squares = (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2);
    mu * squares + lambda / 2.0 * (l1 + l2 + l3 - 3.0).powi(2)
}
