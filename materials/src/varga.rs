//! Varga solid.

use piola::material;

/// Varga solid: rubber at moderate strain, linear in the stretches.
///
/// ψ = 2μ (λ1 + λ2 + λ3 − 3) − 2μ ln J + κ/2 (J − 1)².
///
/// Varga, *Stress-Strain Behavior of Elastic Materials*, 1966, for the first term; the source is
/// incompressible, and the others free the rest state of stress and penalise changes of volume. Defined for J
/// > 0; continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if κ ≥ 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0),
    extend(kappa >= 0.0),
    typical("natural rubber fitted to Treloar 1944 up to twice the rest length", mu = 4.0e5, kappa = 2e7)
)]
pub fn Varga(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Volumetric modulus κ, Pa.
    kappa: f64,
) -> f64 {
    2.0 * mu * (l1 + l2 + l3 - 3.0) - 2.0 * mu * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}
