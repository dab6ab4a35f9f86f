//! Hoss–Marczak solid.

use piola::material;

/// Hoss–Marczak solid: rubber by a saturating exponential, a power and a logarithm, for small and large
/// strain.
///
/// ψ = α/β (1 − exp(−β (I1b − 3))) + μ/(2b) ((1 + b/n (I1b − 3))ⁿ − 1) + C2 ln(I2b/3) + κ/2 ((J² − 1)/2 − ln
/// J).
///
/// Hoss, Marczak, *A new constitutive model for rubber-like materials*, 2010: the model for high strain. The
/// source is incompressible; the last term, of Simo, Hughes, *Computational Inelasticity*, 1998, §9.2,
/// penalises changes of volume. Defined for J > 0.
#[material(
    domain(J > 0.0),
    admissible(beta > 0.0, b > 0.0, n > 0.0, mu > 0.0, kappa > 0.0),
    refuse("ln I2 is singular where two stretches vanish"),
    typical(
        "natural rubber, fitted to Treloar 1944 with β = 1/2 and n = 2",
        alpha = 1.5e4, beta = 0.5, mu = 2.0e5, b = 0.0804, n = 2.0, c2 = 2.51e5, kappa = 2e7
    )
)]
pub fn HossMarczak(
    [l1, l2, l3]: [f64; 3],
    /// Modulus α of the exponential, Pa.
    alpha: f64,
    /// Rate β of the exponential, dimensionless.
    beta: f64,
    /// Modulus μ of the power, Pa.
    mu: f64,
    /// Nonlinearity b of the power, dimensionless.
    b: f64,
    /// Exponent n, dimensionless.
    n: f64,
    /// Modulus C2 of ln I2b, Pa.
    c2: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    let x = I1b - 3.0;
    let moderate = alpha / beta * (1.0 - (-beta * x).exp());
    let large = mu / (2.0 * b) * ((1.0 + b / n * x).powf(n) - 1.0);
    moderate + large + c2 * (I2b / 3.0).ln() + kappa / 2.0 * ((J * J - 1.0) / 2.0 - J.ln())
}
