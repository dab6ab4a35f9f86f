//! Three-chain solid with Cohen's inverse Langevin function.

use piola::material;

/// Three-chain solid with Cohen's inverse Langevin function: rubber whose chains lie along the principal
/// axes.
///
/// ψ = μ N/3 Σ (xi²/2 − ln(1 − xi²)) + κ/2 ((J² − 1)/2 − ln J) with xi² = λ̄i²/N, λ̄i = J^(−1/3) λi.
///
/// Wang, Guth, *Statistical theory of networks of non-Gaussian flexible chains*, 1952, with the approximation
/// x (3 − x²)/(1 − x²) of Cohen, *A Padé approximant to the inverse Langevin function*, 1991, whose integral
/// it is; the constant is taken off, so that ψ vanishes at rest. The source is incompressible; the last term,
/// of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined for J > 0
/// and λ̄1² < N.
#[material(
    domain(J > 0.0, (l1 / J.cbrt()).powi(2) < n),
    admissible(mu > 0.0, n > 1.0, kappa > 0.0),
    refuse("the chains lock at λ̄1² = N, which a flattened element exceeds before it inverts"),
    typical("natural rubber, fitted to Treloar 1944", mu = 3.35e5, n = 93.1, kappa = 2e7)
)]
pub fn ThreeChain(
    [l1, l2, l3]: [f64; 3],
    /// Modulus μ, Pa: the shear modulus for N → ∞.
    mu: f64,
    /// Number N of links of a chain, dimensionless.
    n: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let s1 = (l1 / J.cbrt()).powi(2);
    let s2 = (l2 / J.cbrt()).powi(2);
    let s3 = (l3 / J.cbrt()).powi(2);
    let rest = (n - s1) * (n - s2) * (n - s3) / (n - 1.0).powi(3);
    mu * n / 3.0 * ((I1b - 3.0) / (2.0 * n) - rest.ln()) + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
