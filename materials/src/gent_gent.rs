//! Gent–Gent solid.

use piola::material;

/// Gent–Gent solid: rubber that locks where I1b − 3 reaches Jm, with a second term for moderate strain.
///
/// ψ = −μ Jm/2 ln(1 − (I1b − 3)/Jm) + c2 ln(I2b/3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Pucci, Saccomandi, *A note on the Gent model for rubber-like materials*, 2002, named and fitted by Ogden,
/// Saccomandi, Sgura, *Fitting hyperelastic models to experimental data*, 2004. The source is incompressible;
/// the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume.
/// Defined for J > 0 and I1b − 3 < Jm.
#[material(
    domain(J > 0.0, I1b - 3.0 < jm),
    admissible(mu > 0.0, jm > 0.0, c2 >= 0.0, kappa > 0.0),
    refuse("ln I2 is singular where two stretches vanish"),
    typical("natural rubber, fitted to Treloar 1944", mu = 2.6e5, jm = 81.0, c2 = 2.0e5, kappa = 2e7)
)]
pub fn GentGent(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: the shear modulus without 2/3 c2.
    mu: f64,
    /// Locking value Jm of I1b − 3, dimensionless.
    jm: f64,
    /// Modulus c2 of ln I2b, Pa.
    c2: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let shape = -mu * jm / 2.0 * (1.0 - (I1b - 3.0) / jm).ln() + c2 * (I2b / 3.0).ln();
    shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
