//! Edwards–Vilgis solid.

use piola::material;

/// Edwards–Vilgis solid: rubber as chains of finite length, joined by cross-links and by links that slide.
///
/// ψ = Nc/2 (S Σ λ̄i² + L) + Ns/2 (Σ ((1 + η) S λ̄i²/(1 + η λ̄i²) + ln(1 + η λ̄i²)) + L) + κ/2 ((J² − 1)/2 −
/// ln J) with S = (1 − α²)/(1 − α² I1b), L = ln(1 − α² I1b), λ̄i = J^(−1/3) λi.
///
/// Edwards, Vilgis, *The effect of entanglements in rubber elasticity*, 1986, where Nc and Ns are numbers of
/// links times kT; ψ at rest is not zero there, and not here. As Π λ̄i = 1, the sums over stretches are
/// functions of I1b, I2b and Q = Π (1 + η λ̄i²) = 1 + η I1b + η² I2b + η³; I2b is written Σ λ̄i⁻², since
/// J^(−4/3) and I2 leave the range of f32 where their product does not. The source is incompressible; the
/// last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2, penalises changes of volume. Defined
/// for J > 0 and α² I1b < 1.
#[material(
    domain(J > 0.0, alpha * alpha * I1b < 1.0),
    admissible(nc >= 0.0, ns >= 0.0, eta >= 0.0, kappa > 0.0),
    refuse("the chains lock at α² I1b = 1, which a flattened element exceeds before it inverts"),
    typical(
        "natural rubber, fitted to Treloar 1944",
        nc = 2.19e5, ns = 4.96e5, alpha = 0.0888, eta = 0.78, kappa = 2e7
    )
)]
pub fn EdwardsVilgis(
    [l1, l2, l3]: [f64; 3],
    /// Modulus Nc of the cross-links, Pa.
    nc: f64,
    /// Modulus Ns of the sliding links, Pa.
    ns: f64,
    /// Inextensibility α of the chains, dimensionless.
    alpha: f64,
    /// Slipperiness η of the sliding links, dimensionless.
    eta: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let e1 = I1b;
    let e2 = J.cbrt().powi(2) * (l1.powi(-2) + l2.powi(-2) + l3.powi(-2));
    let room = 1.0 - alpha * alpha * e1;
    let s = (1.0 - alpha * alpha) / room;
    let q = 1.0 + eta * e1 + eta.powi(2) * e2 + eta.powi(3);
    let slides = (e1 + 2.0 * eta * e2 + 3.0 * eta.powi(2)) / q;
    let crosslinks = nc / 2.0 * (s * e1 + room.ln());
    let sliplinks = ns / 2.0 * ((1.0 + eta) * s * slides + q.ln() + room.ln());
    crosslinks + sliplinks + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
