//! Seth–Hill solid.

use piola::material;

/// Seth–Hill solid: linear in a strain of the family that has those of Green, Biot and Almansi as members.
///
/// ψ = μ Σ Ei² + λ/2 (Σ Ei)² with Ei = (λi^(2m) − 1)/(2m).
///
/// Seth, *Generalized strain measure with applications to physical problems*, 1964, and Hill, *On
/// constitutive inequalities for simple materials*, 1968, in the energy of Hooke: m = 1 is Saint
/// Venant–Kirchhoff, m = 1/2 the rotated linear solid, m → 0 that of Hencky. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(mu > 0.0, m != 0.0),
    refuse("a positive power does not push a collapsed point open"),
    typical(
        "the order of soft rubber, E = 1 MPa and ν = 0.45, with m close to that of Hencky",
        mu = 3.4e5, lambda = 3.1e6, m = 0.25
    ),
    fit
)]
pub fn SethHill(
    [l1, l2, l3]: [f64; 3],
    /// Shear modulus μ, Pa.
    mu: f64,
    /// First Lamé parameter λ, Pa.
    lambda: f64,
    /// Order m of the strain, dimensionless.
    m: f64,
) -> f64 {
    let e1 = (l1.powf(2.0 * m) - 1.0) / (2.0 * m);
    let e2 = (l2.powf(2.0 * m) - 1.0) / (2.0 * m);
    let e3 = (l3.powf(2.0 * m) - 1.0) / (2.0 * m);
    mu * (e1.powi(2) + e2.powi(2) + e3.powi(2)) + lambda / 2.0 * (e1 + e2 + e3).powi(2)
}
