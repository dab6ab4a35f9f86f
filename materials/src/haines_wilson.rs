//! Haines–Wilson solid.

use piola::material;

/// Haines–Wilson solid: rubber by six terms of a polynomial in both invariants.
///
/// ψ = C10 (I1b − 3) + C01 (I2b − 3) + C11 (I1b − 3)(I2b − 3) + C02 (I2b − 3)² + C20 (I1b − 3)² + C30 (I1b −
/// 3)³ + κ/2 ((J² − 1)/2 − ln J).
///
/// Haines, Wilson, *Strain-energy density function for rubberlike materials*, 1979. The source is
/// incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises
/// changes of volume. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(kappa > 0.0),
    refuse("terms of the wrong sign, as the fit to rubber has, would attract collapse"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        c10 = 1.711e5, c01 = 1.482e4, c11 = -499.6, c02 = 19.76, c20 = -1427.0, c30 = 42.24, kappa = 2e7
    )
)]
pub fn HainesWilson(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient C10 of I1b − 3, Pa.
    c10: f64,
    /// Coefficient C01 of I2b − 3, Pa.
    c01: f64,
    /// Coefficient C11 of (I1b − 3)(I2b − 3), Pa.
    c11: f64,
    /// Coefficient C02 of (I2b − 3)², Pa.
    c02: f64,
    /// Coefficient C20 of (I1b − 3)², Pa.
    c20: f64,
    /// Coefficient C30 of (I1b − 3)³, Pa.
    c30: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let x = I1b - 3.0;
    let y = I2b - 3.0;
    let shape = c10 * x + c01 * y + c11 * x * y + c02 * y.powi(2) + c20 * x.powi(2) + c30 * x.powi(3);
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
