//! A material of a user's own crate, next to one of the catalogue.

use piola::DynMaterial;
use piola::material::MaterialError;
use piola_materials::NeoHookean;

/// Rubber that stiffens: the first two terms of Yeoh's energy.
#[piola::material(domain(J > 0.0), serde)]
pub fn Stiffening(
    [l1, l2, l3]: [f64; 3],
    /// Coefficient of Ī1 − 3, Pa.
    c10: f64,
    /// Coefficient of (Ī1 − 3)², Pa.
    c20: f64,
    /// Bulk modulus, Pa.
    kappa: f64,
) -> f64 {
    c10 * (I1b - 3.0) + c20 * (I1b - 3.0).powi(2) + kappa / 2.0 * (J - 1.0).powi(2)
}

/// The declared energy with parameters of a soft rubber.
///
/// # Errors
/// `MaterialError` if a parameter is.
pub fn stiffening() -> Result<Stiffening, MaterialError> {
    Stiffening::new(1e5, 1e4, 2e6)
}

/// A neo-Hookean solid of the catalogue.
///
/// # Errors
/// `MaterialError` if a parameter is.
pub fn matrix() -> Result<NeoHookean, MaterialError> {
    NeoHookean::new(3.8e5, 2e7)
}

/// Materials that are told apart at run time only.
///
/// # Errors
/// `MaterialError` if a parameter is.
pub fn boxed() -> Result<[Box<dyn DynMaterial<f64>>; 2], MaterialError> {
    Ok([Box::new(stiffening()?), Box::new(matrix()?)])
}
