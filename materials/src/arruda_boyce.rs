//! Arruda–Boyce solid.

use piola::material;

/// Arruda–Boyce solid: rubber as eight chains in a cube, to the fifth order of the inverse Langevin function.
///
/// ψ = μ Σₖ Cₖ/λm^(2k−2) (I1b^k − 3^k) + κ/2 ((J² − 1)/2 − ln J) with C = 1/2, 1/20, 11/1050, 19/7000,
/// 519/673750.
///
/// Arruda, Boyce, *A three-dimensional constitutive model for the large stretch behavior of rubber elastic
/// materials*, 1993, eq. 16; the volumetric part is that of Abaqus. Defined for J > 0; continued below a
/// threshold stretch with [`Inversion::Extend`](piola::Inversion::Extend).
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, lambda_m > 0.0, kappa > 0.0),
    extend,
    typical("natural rubber, fitted to Treloar 1944", mu = 3.3e5, lambda_m = 5.2, kappa = 2e7)
)]
pub fn ArrudaBoyce(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ of the source, Pa.
    mu: f64,
    /// Locking stretch λm, dimensionless.
    lambda_m: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let n = lambda_m.powi(-2);
    let chains = 1.0 / 2.0 * (I1b - 3.0)
        + 1.0 / 20.0 * n * (I1b.powi(2) - 9.0)
        + 11.0 / 1050.0 * n.powi(2) * (I1b.powi(3) - 27.0)
        + 19.0 / 7000.0 * n.powi(3) * (I1b.powi(4) - 81.0)
        + 519.0 / 673750.0 * n.powi(4) * (I1b.powi(5) - 243.0);
    mu * chains + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
