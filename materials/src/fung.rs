//! Fung solid.

use piola::material;

/// Fung solid: soft tissue, stiffening exponentially.
///
/// ψ = c/2 (e^Q − 1) with Q = a1 (Σ Ei)² + a2 Σ Ei² and Ei = (λi² − 1)/2.
///
/// Fung, *Biomechanics: Mechanical Properties of Living Tissues*, 2nd ed. 1993, §7.10, in its isotropic form.
/// Defined for every deformation; the exponential leaves the range of the numbers at moderate strain, and the
/// status of the point is `nonfinite`.
#[material(
    admissible(c > 0.0),
    typical(
        "artery; c and a1 + a2 are those of rabbit carotid in its circumferential direction by \
         Chuong, Fung, *Three-dimensional stress distribution in arteries*, 1983",
        c = 2.7e4, a1 = 0.5, a2 = 0.5
    )
)]
pub fn Fung(
    [l1, l2, l3]: [f64; 3],
    /// Stress c, Pa.
    c: f64,
    /// Coefficient a1 of (tr E)², dimensionless.
    a1: f64,
    /// Coefficient a2 of tr E², dimensionless.
    a2: f64,
) -> f64 {
    let e1 = (l1 * l1 - 1.0) / 2.0;
    let e2 = (l2 * l2 - 1.0) / 2.0;
    let e3 = (l3 * l3 - 1.0) / 2.0;
    let q = a1 * (e1 + e2 + e3).powi(2) + a2 * (e1.powi(2) + e2.powi(2) + e3.powi(2));
    c / 2.0 * (q.exp() - 1.0)
}
