//! Valanis–Landel solid.

use piola::material;

/// Valanis–Landel solid: rubber up to about twice its length, by one function of each stretch.
///
/// ψ = 2μ Σ (λi ln λi − λi + 1) + λ/2 (ln J)².
///
/// Valanis, Landel, *The Strain-Energy Function of a Hyperelastic Material in Terms of the Extension Ratios*,
/// 1967: ψ is a sum of w(λi), for rubber with w′ = 2μ ln λ. The source is incompressible; the last term
/// penalises changes of volume. Defined for J > 0; continued below a threshold stretch with
/// [`Inversion::Extend`](piola::Inversion::Extend) if λ ≥ 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend(lambda >= 0.0),
    typical("natural rubber fitted to Treloar 1944 up to twice the rest length", mu = 3.9e5, lambda = 2e7)
)]
pub fn ValanisLandel(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
) -> f64 {
    let separable = l1 * l1.ln() - l1 + l2 * l2.ln() - l2 + l3 * l3.ln() - l3 + 3.0;
    2.0 * mu * separable + lambda / 2.0 * J.ln().powi(2)
}
