//! Bažant solid.

use piola::material;

/// Bažant solid: linear in a strain close to Hencky's, of which tension and compression are alike.
///
/// ψ = μ Σ hi² + λ/2 (Σ hi)² with hi = (λi − 1/λi)/2.
///
/// Bažant, *Easy-to-compute tensors with symmetric inverse approximating Hencky finite strain and its rate*,
/// 1998: the strain of its family with m = 1, in the energy of Hooke. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    refuse("continued, its reciprocal stretches leave the range of f64 at the ends of what F can be"),
    typical("the order of soft rubber, E = 1 MPa and ν = 0.45", mu = 3.4e5, lambda = 3.1e6)
)]
pub fn Bazant(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    let h1 = (l1 - 1.0 / l1) / 2.0;
    let h2 = (l2 - 1.0 / l2) / 2.0;
    let h3 = (l3 - 1.0 / l3) / 2.0;
    mu * (h1.powi(2) + h2.powi(2) + h3.powi(2)) + lambda / 2.0 * (h1 + h2 + h3).powi(2)
}
