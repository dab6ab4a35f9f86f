//! Isihara solid.

use piola::material;

/// Isihara solid: rubber by a statistical theory of chains that are not Gaussian.
///
/// ψ = C10 (I1b − 3) + C20 (I1b − 3)² + C01 (I2b − 3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Isihara, Hashitsume, Tatibana, *Statistical Theory of Rubber-Like Elasticity. IV. (Two-Dimensional
/// Stretching)*, 1951. The source is incompressible; the last term, of Simo, Hughes, *Computational
/// Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(kappa > 0.0),
    refuse("a term of the wrong sign, as the fit to rubber has, would attract collapse"),
    typical("natural rubber, fitted to Treloar 1944", c10 = 1.65e5, c20 = 953.0, c01 = 1.67e3, kappa = 2e7)
)]
pub fn Isihara(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient C10 of I1b − 3, Pa.
    c10: f64,
    /// Coefficient C20 of (I1b − 3)², Pa.
    c20: f64,
    /// Coefficient C01 of I2b − 3, Pa.
    c01: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = c10 * (I1b - 3.0) + c20 * (I1b - 3.0).powi(2) + c01 * (I2b - 3.0);
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
