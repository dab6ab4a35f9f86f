//! As-rigid-as-possible solid.

use piola::material;

/// As-rigid-as-possible solid: distance from a rotation and nothing else; no resistance to change of volume
/// beyond that.
///
/// ψ = μ Σ (λi − 1)².
///
/// Sorkine, Alexa, *As-rigid-as-possible surface modeling*, 2007, as an energy of F in Smith, de Goes, Kim,
/// *Analytic Eigensystems for Isotropic Distortion Energies*, 2019, §4.2. Defined for every deformation; the
/// stress jumps where λ2 + λ3 = 0, and the twist quotient has a pole there.
#[material(
    admissible(mu > 0.0),
    typical("any value: energies of maps have no unit", mu = 1.0)
)]
pub fn Arap(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
) -> f64 {
    mu * ((l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2))
}
