//! Neo-Hookean solid with Ciarlet's volumetric part.

use piola::material;

/// Compressible neo-Hookean solid whose volumetric part is convex: rubber and soft solids at moderate strain.
///
/// ψ = μ/2 (I1 − 3) + λ/4 (J² − 1) − (λ/2 + μ) ln J.
///
/// Ciarlet, *Mathematical Elasticity I*, 1988, ch. 4, for the volumetric part a J² − b ln J, which makes ψ
/// polyconvex. Defined for J > 0; continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend) if λ ≥ 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend(lambda >= 0.0),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.8e5, lambda = 2e7)
)]
pub fn CiarletNeoHookean(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) + lambda / 4.0 * (J * J - 1.0) - (lambda / 2.0 + mu) * J.ln()
}
