//! Biderman's energy of rubber.

/// Rubber that stiffens [Biderman 1958], made compressible.
#[piola::material(domain(J > 0.0), extend)]
pub fn Biderman(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient of I1 − 3, Pa.
    c10: f64,
    /// Coefficient of I2 − 3, Pa.
    c01: f64,
    /// Coefficient of (I1 − 3)², Pa.
    c20: f64,
    /// Coefficient of (I1 − 3)³, Pa.
    c30: f64,
    /// Resistance to changes of volume, Pa.
    kappa: f64,
) -> f64 {
    let shape = c10 * (I1 - 3.0) + c01 * (I2 - 3.0) + c20 * (I1 - 3.0).powi(2) + c30 * (I1 - 3.0).powi(3);
    shape - (2.0 * c10 + 4.0 * c01) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
}
