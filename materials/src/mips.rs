//! Most isometric parametrisation.

use piola::material;

/// Most isometric parametrisation in three dimensions: the distortion of angles and of volumes; for maps.
///
/// ψ = μ (α (I1 I2/J² − 1)/8 + (1 − α) (J + 1/J)/2).
///
/// Fu, Liu, Guo, *Computing locally injective mappings by advanced MIPS*, 2015, without its exponential:
/// Hormann, Greiner, *MIPS: an efficient global parametrization method*, 2000, in three dimensions, and a
/// term of volume. ψ is μ at rest. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, alpha > 0.0, alpha < 1.0),
    refuse("I1 I2/J² has no value at F = 0, from any side"),
    typical("equal shares, of the source; energies of maps have no unit", mu = 1.0, alpha = 0.5)
)]
pub fn Mips(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa.
    mu: f64,
    /// Share α of the angles, dimensionless.
    alpha: f64,
) -> f64 {
    mu * (alpha * (I1 * I2 / J.powi(2) - 1.0) / 8.0 + (1.0 - alpha) * (J + 1.0 / J) / 2.0)
}
