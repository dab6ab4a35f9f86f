//! Attard–Hunt solid.

use piola::material;

/// Attard–Hunt solid: rubber by whole powers of C and of its inverse.
///
/// ψ = Σₙ Aₙ/(2n) (tr Cⁿ − 3) + B1/2 (tr C⁻¹ − 3) − (A1 + A2 + A3 − B1) ln J + λ/2 (ln J)² for n = 1, 2, 3.
///
/// Attard, Hunt, *Hyperelastic constitutive modeling under finite strain*, 2004, of whose sums the first
/// terms are taken; of more, Treloar's rubber determines no one. Defined for J > 0; continued below a
/// threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend) if no modulus is negative.
#[material(
    domain(J > 0.0),
    extend(a1 >= 0.0, a2 >= 0.0, a3 >= 0.0, b1 >= 0.0, lambda >= 0.0),
    typical(
        "natural rubber, fitted to Treloar 1944 with A2 = 0",
        a1 = 3.3e5, a2 = 0.0, a3 = 102.0, b1 = 8.69e3, lambda = 2e7
    )
)]
pub fn AttardHunt(
    [l1, l2, l3]: [f64; 3],
    /// Modulus A1 of tr C, Pa.
    a1: f64,
    /// Modulus A2 of tr C², Pa.
    a2: f64,
    /// Modulus A3 of tr C³, Pa.
    a3: f64,
    /// Modulus B1 of tr C⁻¹, Pa.
    b1: f64,
    /// Volumetric modulus λ, Pa.
    lambda: f64,
) -> f64 {
    let first = a1 / 2.0 * (I1 - 3.0);
    let second = a2 / 4.0 * (l1.powi(4) + l2.powi(4) + l3.powi(4) - 3.0);
    let third = a3 / 6.0 * (l1.powi(6) + l2.powi(6) + l3.powi(6) - 3.0);
    let inverse = b1 / 2.0 * (l1.powi(-2) + l2.powi(-2) + l3.powi(-2) - 3.0);
    first + second + third + inverse - (a1 + a2 + a3 - b1) * J.ln() + lambda / 2.0 * J.ln().powi(2)
}
