//! Gent solid.

use piola::material;

/// Gent solid: rubber that locks where I1 − 3 reaches Jm.
///
/// ψ = −μ Jm/2 ln(1 − (I1 − 3)/Jm) − μ ln J + κ/2 (J − 1)².
///
/// Gent, *A New Constitutive Relation for Rubber*, 1996, eq. 2, for the first term; the source is
/// incompressible, and the others free the rest state of stress and penalise changes of volume. Defined for J
/// > 0 and I1 − 3 < Jm; the first of these bounds opens with [`Inversion::Extend`](piola::Inversion::Extend)
/// if κ ≥ 0, the second stays.
#[material(
    domain(J > 0.0, I1 - 3.0 < jm),
    admissible(mu > 0.0, jm > 0.0),
    extend(kappa >= 0.0),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.3e5, jm = 108.0, kappa = 2e7)
)]
pub fn Gent(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Locking value Jm of I1 − 3, dimensionless.
    jm: f64,
    /// Volumetric modulus κ, Pa.
    kappa: f64,
) -> f64 {
    -mu * jm / 2.0 * (1.0 - (I1 - 3.0) / jm).ln() - mu * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}
