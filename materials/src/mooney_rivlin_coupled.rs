//! Mooney–Rivlin solid, coupled form.

use piola::material;

/// Mooney–Rivlin solid in the plain invariants: compressible rubber at moderate strain.
///
/// ψ = C10 (I1 − 3) + C01 (I2 − 3) − 2 (C10 + 2 C01) ln J + κ/2 (J − 1)².
///
/// Ciarlet, Geymonat, *Sur les lois de comportement en élasticité non linéaire compressible*, 1982, for the
/// form; the volumetric part here is κ/2 (J − 1)². Defined for J > 0; continued below a threshold stretch
/// with [`Inversion::Extend`](piola::Inversion::Extend) if κ ≥ 0.
#[material(
    domain(J > 0.0),
    admissible(c10 >= 0.0, c01 >= 0.0),
    extend(kappa >= 0.0),
    typical("natural rubber, fitted to Treloar 1944", c10 = 1.8e5, c01 = 3.4e3, kappa = 2e7)
)]
pub fn MooneyRivlinCoupled(
    [l1, l2, l3]: [f64; 3],
    /// Modulus C10, Pa.
    c10: f64,
    /// Modulus C01, Pa.
    c01: f64,
    /// Volumetric modulus κ, Pa.
    kappa: f64,
) -> f64 {
    c10 * (I1 - 3.0) + c01 * (I2 - 3.0) - 2.0 * (c10 + 2.0 * c01) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}
