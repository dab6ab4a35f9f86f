//! Symmetric as-rigid-as-possible energy.

use piola::material;

/// Symmetric as-rigid-as-possible energy: stretching costs what its inverse costs; for maps rather than for
/// solids.
///
/// ψ = μ/2 Σ ((λi − 1)² + (1/λi − 1)²).
///
/// Smith, de Goes, Kim, *Analytic eigensystems for isotropic distortion energies*, 2019. Defined for J > 0;
/// continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend).
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend,
    typical("any value: energies of maps have no unit", mu = 1.0)
)]
pub fn SymmetricArap(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: half the small-strain shear modulus.
    mu: f64,
) -> f64 {
    let stretched = (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2);
    let compressed = (1.0 / l1 - 1.0).powi(2) + (1.0 / l2 - 1.0).powi(2) + (1.0 / l3 - 1.0).powi(2);
    mu / 2.0 * (stretched + compressed)
}
