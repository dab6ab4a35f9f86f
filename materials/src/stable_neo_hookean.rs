//! Stable neo-Hookean solid.

use piola::material;

/// Stable neo-Hookean solid: flesh at high Poisson's ratio, defined for every deformation.
///
/// ψ = μ/2 (I1 − 3) + λ/2 (J − a)² − μ/2 ln(I1 + 1) with a = 1 + μ/λ − μ/(4λ).
///
/// Smith, de Goes, Kim, *Stable Neo-Hookean Flesh Simulation*, 2018, eq. 14, with the paper's raw μ and λ: at
/// small strain the Lamé parameters are 3μ/4 and λ − 5μ/8. The energy of the rest state is not zero.
#[material(
    admissible(mu > 0.0, lambda > 0.0),
    typical(
        "flesh, with a Young's modulus of 10 kPa at the Poisson's ratio 0.488 of the source",
        mu = 4.5e3, lambda = 1.4e5
    )
)]
pub fn StableNeoHookean(
    [l1, l2, l3]: [f64; 3],
    /// μ of the source, Pa.
    mu: f64,
    /// λ of the source, Pa.
    lambda: f64,
) -> f64 {
    let a = 1.0 + mu / lambda - mu / (4.0 * lambda);
    mu / 2.0 * (I1 - 3.0) + lambda / 2.0 * (J - a).powi(2) - mu / 2.0 * (I1 + 1.0).ln()
}
