//! Neo-Hookean solid.

use piola::material;

/// Compressible neo-Hookean solid with a logarithmic volumetric part: rubber at moderate strain.
///
/// ψ = μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
///
/// Bonet, Wood, *Nonlinear Continuum Mechanics for Finite Element Analysis*, 2nd ed. 2008, eq. 6.27. Defined
/// for J > 0; continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if λ ≥
/// 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend(lambda >= 0.0),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.8e5, lambda = 2e7)
)]
pub fn NeoHookean(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}
