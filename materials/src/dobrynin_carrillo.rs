//! Dobrynin–Carrillo solid.

use piola::material;

/// Dobrynin–Carrillo solid: networks and gels of flexible or stiff chains that lock, with two parameters.
///
/// ψ = G/6 I1b + G/β (1 − β I1b/3)⁻¹ + κ/2 ((J² − 1)/2 − ln J).
///
/// Dobrynin, Carrillo, *Universality in nonlinear elasticity of biological and polymeric networks and gels*,
/// 2011, whose stress in tension, G/3 (λ² − 1/λ)(1 + 2 (1 − β I1/3)⁻²), this is the energy of; here the
/// constant is taken off, so that ψ vanishes at rest. The source is incompressible; the last term, of Simo,
/// Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0 and β I1b
/// < 3.
#[material(
    domain(J > 0.0, beta * I1b < 3.0),
    admissible(g > 0.0, beta > 0.0, beta < 1.0, kappa > 0.0),
    refuse("the chains lock at β I1b = 3, which a flattened element exceeds before it inverts"),
    typical("natural rubber, fitted to Treloar 1944", g = 3.23e5, beta = 0.0196, kappa = 2e7)
)]
pub fn DobryninCarrillo(
    [l1, l2, l3]: [f64; 3],
    /// Modulus G, Pa: the shear modulus for β → 0.
    g: f64,
    /// Square β of the ratio of a chain at rest to its full length, dimensionless.
    beta: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let chains = 1.0 / (1.0 - beta * I1b / 3.0) - 1.0 / (1.0 - beta);
    g / 6.0 * (I1b - 3.0) + g / beta * chains + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
