//! Horgan–Saccomandi solid.

use piola::material;

/// Horgan–Saccomandi solid: rubber whose greatest stretch has a limit, with two parameters.
///
/// ψ = −μ/2 Jm ln((Jm³ − Jm² I1b + Jm I2b − 1)/(Jm − 1)³) + κ/2 ((J² − 1)/2 − ln J).
///
/// Horgan, Saccomandi, *Constitutive modelling of rubber-like and biological materials with limiting chain
/// extensibility*, 2002. The argument of the logarithm is Π (Jm − λ̄i²)/(Jm − 1) with λ̄i = J^(−1/3) λi, and
/// is formed so, as the sum would cancel where a chain locks. The source is incompressible; the last term, of
/// Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0 and
/// λ̄1² < Jm.
#[material(
    domain(J > 0.0, (l1 / J.cbrt()).powi(2) < jm),
    admissible(mu > 0.0, jm > 1.0, kappa > 0.0),
    refuse("the chains lock at a stretch which a flattened element exceeds before it inverts"),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.33e5, jm = 117.0, kappa = 2e7)
)]
pub fn HorganSaccomandi(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: the shear modulus except for the factor (Jm/(Jm − 1))².
    mu: f64,
    /// Square Jm of the greatest isochoric stretch, dimensionless.
    jm: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let b1 = l1 / J.cbrt();
    let b2 = l2 / J.cbrt();
    let b3 = l3 / J.cbrt();
    let rest = (jm - b1.powi(2)) * (jm - b2.powi(2)) * (jm - b3.powi(2)) / (jm - 1.0).powi(3);
    -mu / 2.0 * jm * rest.ln() + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
