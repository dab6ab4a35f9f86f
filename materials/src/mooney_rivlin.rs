//! Mooney–Rivlin solid, isochoric form.

use piola::material;

/// Mooney–Rivlin solid in isochoric invariants: nearly incompressible rubber at moderate strain.
///
/// ψ = C10 (I1b − 3) + C01 (I2b − 3) + κ/2 (J − 1)².
///
/// Rivlin, *Large elastic deformations of isotropic materials IV*, 1948; the split into isochoric and
/// volumetric parts is that of Flory, *Thermodynamic relations for high elastic materials*, 1961. Defined for
/// J > 0.
#[material(
    domain(J > 0.0),
    admissible(c10 >= 0.0, c01 >= 0.0, kappa > 0.0),
    refuse("isochoric terms with (J − 1)² alone do not push a collapsed point open"),
    typical("natural rubber, fitted to Treloar 1944", c10 = 1.8e5, c01 = 3.4e3, kappa = 2e7)
)]
pub fn MooneyRivlin(
    [l1, l2, l3]: [f64; 3],
    /// Modulus C10, Pa.
    c10: f64,
    /// Modulus C01, Pa.
    c01: f64,
    /// Bulk modulus κ, Pa.
    kappa: f64,
) -> f64 {
    c10 * (I1b - 3.0) + c01 * (I2b - 3.0) + kappa / 2.0 * (J - 1.0).powi(2)
}
