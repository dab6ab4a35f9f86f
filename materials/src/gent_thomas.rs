//! Gent–Thomas solid.

use piola::material;

/// Gent–Thomas solid: rubber at moderate strain, whose second term fades as strain grows.
///
/// ψ = c1 (I1b − 3) + c2 ln(I2b/3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Gent, Thomas, *Forms for the stored (strain) energy function for vulcanized rubber*, 1958. The source is
/// incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises
/// changes of volume. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(c1 >= 0.0, c2 >= 0.0, kappa > 0.0),
    refuse("ln I2 is singular where two stretches vanish"),
    typical(
        "natural rubber fitted to Treloar 1944 up to three times the rest length",
        c1 = 1.4e5, c2 = 1.7e5, kappa = 2e7
    )
)]
pub fn GentThomas(
    [l1, l2, l3]: [f64; 3],
    /// Modulus c1 of I1b, Pa.
    c1: f64,
    /// Modulus c2 of ln I2b, Pa.
    c2: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    c1 * (I1b - 3.0) + c2 * (I2b / 3.0).ln() + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
