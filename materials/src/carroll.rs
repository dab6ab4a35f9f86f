//! Carroll solid.

use piola::material;

/// Carroll solid: rubber up to its limit of stretch, with three moduli and no further parameter.
///
/// ψ = a (I1b − 3) + b (I1b⁴ − 81) + c (√I2b − √3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Carroll, *A Strain Energy Function for Vulcanized Rubbers*, 2011. The source is incompressible; the last
/// term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for
/// J > 0.
#[material(
    domain(J > 0.0),
    admissible(a >= 0.0, b >= 0.0, c >= 0.0, kappa > 0.0),
    refuse("√I2 has a kink where two stretches vanish"),
    typical("natural rubber, fitted to Treloar 1944", a = 1.46e5, b = 0.31, c = 1.25e5, kappa = 2e7)
)]
pub fn Carroll(
    [l1, l2, l3]: [f64; 3],
    /// Modulus a of I1b, Pa.
    a: f64,
    /// Modulus b of I1b⁴, Pa.
    b: f64,
    /// Modulus c of √I2b, Pa.
    c: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = a * (I1b - 3.0) + b * (I1b.powi(4) - 81.0) + c * (I2b.sqrt() - 3.0.sqrt());
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
