//! Ciarlet–Geymonat solid.

use piola::material;

/// Ciarlet–Geymonat solid: compressible rubber at moderate strain, polyconvex.
///
/// ψ = c1 (I1 − 3) + c2 (I2 − 3) + a (J² − 1) − (2 c1 + 4 c2 + 2 a) ln J.
///
/// Ciarlet, Geymonat, *Sur les lois de comportement en élasticité non linéaire compressible*, 1982. Defined
/// for J > 0; continued below a threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend).
#[material(
    domain(J > 0.0),
    admissible(c1 >= 0.0, c2 >= 0.0, a >= 0.0),
    extend,
    typical("natural rubber, fitted to Treloar 1944", c1 = 1.8e5, c2 = 3.4e3, a = 5e6)
)]
pub fn CiarletGeymonat(
    [l1, l2, l3]: [f64; 3],
    /// Modulus of I1, Pa.
    c1: f64,
    /// Modulus of I2, Pa.
    c2: f64,
    /// Modulus of J², Pa: with c2 a quarter of the first Lamé parameter.
    a: f64,
) -> f64 {
    c1 * (I1 - 3.0) + c2 * (I2 - 3.0) + a * (J * J - 1.0) - (2.0 * c1 + 4.0 * c2 + 2.0 * a) * J.ln()
}
