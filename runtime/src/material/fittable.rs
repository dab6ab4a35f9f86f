//! Derivatives of the stress by the parameters, as those need who fit parameters to measurements.

use super::Declared;

/// A material that knows how its stress changes with its parameters: one declared with the word `fit`.
///
/// The derivatives come from the expressions that all others come from; without the word nothing is generated.
///
/// ```
/// use piola::material;
/// use piola::material::Fittable;
///
/// /// Σₚ μₚ/αₚ Σ λ^αₚ − (Σₚ μₚ) ln J + κ/2 (J − 1)².
/// #[material(domain(J > 0.0), fit)]
/// fn Ogden<const N: usize>(
///     [l1, l2, l3]: [f64; 3],
///     /// Moduli μₚ, Pa.
///     mu: [f64; N],
///     /// Exponents αₚ.
///     alpha: [f64; N],
///     /// Volumetric modulus κ, Pa.
///     kappa: f64,
/// ) -> f64 {
///     let shear = sum(|p| mu[p] / alpha[p] * (l1.powf(alpha[p]) + l2.powf(alpha[p]) + l3.powf(alpha[p])));
///     shear - sum(|p| mu[p]) * J.ln() + kappa / 2.0 * (J - 1.0).powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let rubber = Ogden::new([6.3e5, -1e4], [1.3, -2.0], 2e7)?;
/// assert_eq!(rubber.values(), [&[6.3e5, -1e4][..], &[1.3, -2.0], &[2e7]]);
/// // ψ1 = Σₚ μₚ (λ1^αₚ − 1)/λ1 + κ (J − 1) J/λ1 changes by (λ1^α₂ − 1)/λ1 for each pascal of μ₂, the second of five numbers.
/// let derivatives = rubber.gradient_by_parameters([2.0, 1.0, 0.5]);
/// assert_eq!(derivatives.len(), 5);
/// assert!((derivatives[1][0] - (0.25 - 1.0) / 2.0).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not know the derivatives of its stress by its parameters",
    label = "not declared with `fit`",
    note = "add `fit` to its `#[material(…)]`"
)]
pub trait Fittable: Declared {
    /// The values of the parameters, one list for each parameter of the description in its order, as
    /// [`Declared::from_values`] takes them.
    fn values(&self) -> Vec<Vec<f64>>;

    /// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each number p among the parameters, in the order of [`values`](Fittable::values), lists
    /// entry by entry. Pa for each unit of p.
    ///
    /// Meant inside the domain: an extension is not in use, and outside the domain the numbers are meaningless and may be NaN.
    fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]>;
}
