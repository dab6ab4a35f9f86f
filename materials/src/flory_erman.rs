//! Flory–Erman solid.

use piola::material;

/// Flory–Erman solid: rubber whose junctions are held back by the chains around them.
///
/// ψ = Cp/2 (I1b − 3) + Cc/2 Σ (Bi + Di − ln(1 + Bi) − ln(1 + Di)) + κ/2 ((J² − 1)/2 − ln J) with Bi = κc²
/// (λ̄i² − 1)/(λ̄i² + κc)², Di = λ̄i² Bi/κc, λ̄i = J^(−1/3) λi.
///
/// Flory, Erman, *Theory of elasticity of polymer networks. 3*, 1982, for ζ = 0, with Cp = ξkT, Cc = μkT, and
/// κc for its κ. As λ̄i → 0, Bi → −1, and the digits of 1 + Bi would be lost. But with s = λ̄² and Q = Π (si
/// + κc) the sum of Bi + Di is κc Σ (si − 1)/(si + κc), 1 + Bi = si (si + 2κc + κc²)/(si + κc)², and 1 + Di =
/// ((1 + κc) si² + κc si + κc²)/(si + κc)², whose products are polynomials of I1b and I2b, as s1 s2 s3 = 1;
/// I2b is written Σ 1/si, since J^(−4/3) and I2 leave the range of f32 where their product does not. The
/// differences in them lose no digits: I1b² ≥ 3 I2b, I2b² ≥ 3 I1b, I1b I2b ≥ 9. The source is incompressible;
/// the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume.
/// Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(cp >= 0.0, cc >= 0.0, kappa_c > 0.0, kappa > 0.0),
    refuse("ln λ of an extended stretch that vanishes is singular"),
    typical(
        "natural rubber fitted to Treloar 1944 up to three times the rest length",
        cp = 2.45e5, cc = 4.48e5, kappa_c = 2.59, kappa = 2e7
    )
)]
pub fn FloryErman(
    [l1, l2, l3]: [f64; 3],
    /// Modulus Cp of the phantom network, Pa.
    cp: f64,
    /// Modulus Cc of the constraints, Pa.
    cc: f64,
    /// Strength κc of the constraints, dimensionless.
    kappa_c: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let s1 = (l1 / J.cbrt()).powi(2);
    let s2 = (l2 / J.cbrt()).powi(2);
    let s3 = (l3 / J.cbrt()).powi(2);
    let e1 = s1 + s2 + s3;
    let e2 = 1.0 / s1 + 1.0 / s2 + 1.0 / s3;
    let k = kappa_c;
    let a = 1.0 + k;
    let c = 2.0 * k + k.powi(2);
    let q = 1.0 + k * e2 + k.powi(2) * e1 + k.powi(3);
    let b = 1.0 + c * e2 + c.powi(2) * e1 + c.powi(3);
    let d = a.powi(3)
        + a.powi(2) * k * (e2 + k * (e2.powi(2) - 2.0 * e1))
        + a * k.powi(2) * (e1 + k * (e1 * e2 - 3.0) + k.powi(2) * (e1.powi(2) - 2.0 * e2))
        + k.powi(3) * (1.0 + k * e2 + k.powi(2) * e1 + k.powi(3));
    let sum_of_b_and_d = 3.0 * k - k * a * (e2 + 2.0 * k * e1 + 3.0 * k.powi(2)) / q;
    let constraints = sum_of_b_and_d - b.ln() - d.ln() + 4.0 * q.ln();
    cp / 2.0 * (e1 - 3.0) + cc / 2.0 * constraints + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
