//! Neo-Hookean solid, isochoric form.

use piola::material;

/// Neo-Hookean solid in the isochoric invariant: nearly incompressible rubber at moderate strain.
///
/// ψ = μ/2 (I1b − 3) + κ/2 ((J² − 1)/2 − ln J).
///
/// Simo, Hughes, *Computational Inelasticity*, 1998, §9.2. Defined for J > 0; continued below a threshold
/// stretch with [`Inversion::Extend`](piola::Inversion::Extend), since −ln J pushes even a collapsed point
/// open.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, kappa > 0.0),
    extend,
    typical("natural rubber, fitted to Treloar 1944", mu = 3.8e5, kappa = 2e7)
)]
pub fn IsochoricNeoHookean(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    mu / 2.0 * (I1b - 3.0) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
