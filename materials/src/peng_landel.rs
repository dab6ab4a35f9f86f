//! Peng–Landel solid.

use piola::material;

/// Peng–Landel solid: rubber up to about three times its length, with a single modulus.
///
/// ψ = E Σ (λ̄i − 1 − ln λ̄i − (ln λ̄i)²/6 + (ln λ̄i)³/18 − (ln λ̄i)⁴/216) + κ/2 ((J² − 1)/2 − ln J) with λ̄i
/// = J^(−1/3) λi.
///
/// Peng, Landel, *Stored energy function of rubberlike materials derived from simple tensile data*, 1972. The
/// source is incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2,
/// penalises changes of volume. Σ ln λ̄i = 0. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(e > 0.0, kappa > 0.0),
    refuse("−(ln λ̄)⁴ attracts collapse"),
    typical(
        "natural rubber fitted to Treloar 1944 up to three times the rest length",
        e = 1.23e6, kappa = 2e7
    )
)]
pub fn PengLandel(
    [l1, l2, l3]: [f64; 3],
    /// Young's modulus E, Pa.
    e: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let mean = J.ln() / 3.0;
    let h1 = l1.ln() - mean;
    let h2 = l2.ln() - mean;
    let h3 = l3.ln() - mean;
    let second = h1.powi(2) + h2.powi(2) + h3.powi(2);
    let third = h1.powi(3) + h2.powi(3) + h3.powi(3);
    let fourth = h1.powi(4) + h2.powi(4) + h3.powi(4);
    let shape = (l1 + l2 + l3) / J.cbrt() - 3.0 - second / 6.0 + third / 18.0 - fourth / 216.0;
    e * shape + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
