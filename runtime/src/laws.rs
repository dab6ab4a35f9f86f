//! Energies for tests, declared as users declare theirs: neither `piola` nor `piola-bodies` depends on a
//! crate of materials.

use piola::{Inversion, material};

/// μ ΣE² + λ/2 (ΣE)², E = (λ² − 1)/2: even in every pair, so that its twist is smooth everywhere.
#[material]
pub(crate) fn SaintVenantKirchhoff(
    [l1, l2, l3]: [f64; 3],
    /** Shear modulus μ, Pa. */
    mu: f64,
    /** First Lamé parameter λ, Pa. */
    lambda: f64,
) -> f64 {
    let e1 = (l1 * l1 - 1.0) / 2.0;
    let e2 = (l2 * l2 - 1.0) / 2.0;
    let e3 = (l3 * l3 - 1.0) / 2.0;
    mu * (e1 * e1 + e2 * e2 + e3 * e3) + lambda / 2.0 * (e1 + e2 + e3).powi(2)
}

/// μ/2 (Σλ² − 3) − μ ln J + λ/2 (ln J)² in stretches: without derivatives by invariants.
#[material(domain(J > 0.0), extend)]
pub(crate) fn NeoHookean(
    [l1, l2, l3]: [f64; 3],
    /** Shear modulus μ, Pa. */
    mu: f64,
    /** First Lamé parameter λ, Pa. */
    lambda: f64,
) -> f64 {
    let log = l1.ln() + l2.ln() + l3.ln();
    mu / 2.0 * (l1 * l1 + l2 * l2 + l3 * l3 - 3.0) - mu * log + lambda / 2.0 * log * log
}

/// [`NeoHookean`] as μ/2 (I1 − 3) − μ ln J + λ/2 (ln J)².
#[material(domain(J > 0.0))]
pub(crate) fn NeoHookeanByInvariants(
    [l1, l2, l3]: [f64; 3],
    /** Shear modulus μ, Pa. */
    mu: f64,
    /** First Lamé parameter λ, Pa. */
    lambda: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// μ Σ(λ − 1)² + λ/2 (Σλ − 3)²: not even, with a pole of the twist where two stretches are opposite.
#[material]
pub(crate) fn RotatedLinear(
    [l1, l2, l3]: [f64; 3],
    /** Shear modulus μ, Pa. */
    mu: f64,
    /** First Lamé parameter λ, Pa. */
    lambda: f64,
) -> f64 {
    let squares = (l1 - 1.0).powi(2) + (l2 - 1.0).powi(2) + (l3 - 1.0).powi(2);
    mu * squares + lambda / 2.0 * (l1 + l2 + l3 - 3.0).powi(2)
}

/// The parameters of the functions below, Pa.
const PARAMETERS: (f64, f64) = (1.0, 1.5);

pub(crate) fn saint_venant_kirchhoff() -> SaintVenantKirchhoff {
    SaintVenantKirchhoff::new(PARAMETERS.0, PARAMETERS.1).expect("finite parameters")
}

pub(crate) fn neo_hookean() -> NeoHookean {
    NeoHookean::new(PARAMETERS.0, PARAMETERS.1).expect("finite parameters")
}

/// ln is continued below ε as its quadratic Taylor polynomial: it admits every point, is C² across ε, and has
/// a pole where two stretches are opposite.
pub(crate) fn extended_neo_hookean(epsilon: f64) -> NeoHookean {
    neo_hookean().with_inversion(Inversion::Extend { epsilon }).expect("a threshold")
}

pub(crate) fn neo_hookean_by_invariants() -> NeoHookeanByInvariants {
    NeoHookeanByInvariants::new(PARAMETERS.0, PARAMETERS.1).expect("finite parameters")
}

pub(crate) fn rotated_linear() -> RotatedLinear {
    RotatedLinear::new(PARAMETERS.0, PARAMETERS.1).expect("finite parameters")
}
