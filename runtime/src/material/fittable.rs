//! Derivatives of the stress by the parameters, as those need who fit parameters to measurements.

use super::Declared;

/// A material that knows how its stress changes with its parameters: one declared with the word `fit`.
///
/// The derivatives come from the expressions that all others come from; without the word nothing is generated.
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
