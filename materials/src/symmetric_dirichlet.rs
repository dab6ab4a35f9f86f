//! Symmetric Dirichlet energy.

use piola::material;

/// Symmetric Dirichlet energy: stretching costs what its inverse costs; for maps rather than for solids.
///
/// ψ = μ/2 Σ (λi² + λi⁻² − 2).
///
/// Smith, Schaefer, *Bijective parameterization with free boundaries*, 2015, §3, in three dimensions. Even in
/// each stretch, and defined wherever none is zero: it separates inverted elements from others by an infinite
/// barrier, which [`Inversion::Extend`](piola::Inversion::Extend) opens.
#[material(
    domain(J != 0.0),
    admissible(mu > 0.0),
    extend,
    typical("any value: energies of maps have no unit", mu = 1.0)
)]
pub fn SymmetricDirichlet(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: half the small-strain shear modulus.
    mu: f64,
) -> f64 {
    mu / 2.0 * (I1 + l1.powi(-2) + l2.powi(-2) + l3.powi(-2) - 6.0)
}
