//! Extended tube solid.

use piola::material;

/// Extended tube solid: rubber as chains of finite length, cross-linked and confined to tubes by each other.
///
/// ψ = Gc/2 ((1 − δ²) D/(1 − δ² D) + ln(1 − δ² D)) + 2 Ge/β² Σ (λ̄i^(−β) − 1) + κ/2 ((J² − 1)/2 − ln J)
/// with D = I1b − 3 and λ̄i = J^(−1/3) λi.
///
/// Kaliske, Heinrich, *An extended tube-model for rubber elasticity: statistical-mechanical theory and finite
/// element implementation*, 1999. The source leaves the volumetric part open; this one is that of Simo,
/// Hughes, *Computational Inelasticity*, 1998, §9.2. Defined for J > 0 and δ² D < 1.
#[material(
    domain(J > 0.0, delta * delta * (I1b - 3.0) < 1.0),
    admissible(gc >= 0.0, ge >= 0.0, beta > 0.0, kappa > 0.0),
    refuse("the chains lock at δ² (I1b − 3) = 1, which a flattened element exceeds before it inverts"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        gc = 2.05e5, delta = 0.094, ge = 1.8e5, beta = 0.2, kappa = 2e7
    )
)]
pub fn ExtendedTube(
    [l1, l2, l3]: [f64; 3],
    /// Modulus Gc of the cross-links, Pa.
    gc: f64,
    /// Inextensibility δ of the chains, dimensionless.
    delta: f64,
    /// Modulus Ge of the tubes, Pa.
    ge: f64,
    /// Release β of the tubes, dimensionless: 1 for none.
    beta: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let d = I1b - 3.0;
    let stretch = delta * delta * d;
    let chains = gc / 2.0 * ((1.0 - delta * delta) * d / (1.0 - stretch) + (1.0 - stretch).ln());
    let powers = J.powf(beta / 3.0) * (l1.powf(-beta) + l2.powf(-beta) + l3.powf(-beta));
    let tubes = 2.0 * ge / (beta * beta) * (powers - 3.0);
    chains + tubes + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
