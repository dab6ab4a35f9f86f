//! Murnaghan solid.

use piola::material;

/// Murnaghan solid: glasses, metals and rocks at strains of some per cent, to the third order.
///
/// ψ = (λ + 2μ)/2 J1² − 2μ J2 + (l + 2m)/3 J1³ − 2m J1 J2 + n J3, with J1 = tr E, J2 = E1 E2 + E2 E3 + E3 E1,
/// J3 = det E of the Green strain E.
///
/// Murnaghan, *Finite Deformations of an Elastic Solid*, 1937, in terms of the strain at rest. Defined
/// everywhere, but meant for small strain: with negative l, m, n, as most solids have, ψ has no lower bound.
#[material(
    admissible(mu > 0.0),
    typical(
        "polystyrene, of Hughes, Kelly, *Second-order elastic deformation of solids*, 1953",
        lambda = 2.889e9, mu = 1.381e9, l = -1.89e10, m = -1.33e10, n = -1.0e10
    )
)]
pub fn Murnaghan(
    [l1, l2, l3]: [f64; 3],
    /// First Lamé parameter λ, Pa.
    lambda: f64,
    /// Shear modulus μ, Pa.
    mu: f64,
    /// Third-order modulus l, Pa.
    l: f64,
    /// Third-order modulus m, Pa.
    m: f64,
    /// Third-order modulus n, Pa.
    n: f64,
) -> f64 {
    let e1 = (l1.powi(2) - 1.0) / 2.0;
    let e2 = (l2.powi(2) - 1.0) / 2.0;
    let e3 = (l3.powi(2) - 1.0) / 2.0;
    let j1 = e1 + e2 + e3;
    let j2 = e1 * e2 + e2 * e3 + e3 * e1;
    let j3 = e1 * e2 * e3;
    (lambda + 2.0 * mu) / 2.0 * j1.powi(2) - 2.0 * mu * j2 + (l + 2.0 * m) / 3.0 * j1.powi(3)
        - 2.0 * m * j1 * j2
        + n * j3
}
