//! Derivatives with respect to the parameters, for fits to measurements.

use super::{Declared, Inversion, MaterialError, Text};

/// Material with derivatives of its stress by its parameters: one declared with the word `fit`.
///
/// The derivatives come from the same expressions as all others; without the word nothing is generated.
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
    message = "`{Self}` has no derivatives of its stress by its parameters",
    label = "not declared with `fit`",
    note = "add `fit` to its `#[material(…)]`"
)]
pub trait Fittable: Declared {
    /// Values of the parameters, one list for each parameter of the description in its order, in the form of
    /// [`with_values`](Fittable::with_values): numbers and lists as in [`Declared::from_values`], functions
    /// as in `Univariate::values`.
    fn values(&self) -> Vec<Vec<f64>>;

    /// Builds the material with other values, as [`values`](Fittable::values) lists them, without extension.
    ///
    /// A function without values stays what it is.
    ///
    /// # Errors
    /// [`MaterialError::Shape`] if the lengths do not match; other errors are those of the constructor of the
    /// type and of `Univariate::with_values`.
    fn with_values(&self, values: &[&[f64]]) -> Result<Self, MaterialError> {
        Self::from_values(values, Inversion::Refuse)
    }

    /// Derivatives ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each number p among the parameters, in the order of
    /// [`values`](Fittable::values), lists entry by entry. Pa for each unit of p. Whole exponents do not
    /// change, and have zeros. Those by the values of a function are central differences of sixth order, with
    /// steps of about 1/128 of each value; NaN if the function refuses such values.
    ///
    /// For stretches inside the domain: an extension is not used, and outside the domain the numbers are
    /// meaningless and may be NaN.
    fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]>;

    /// Conditions that the constructor checks, except for finite values and `!=`: the comparisons of
    /// `admissible(…)`, one for each entry if they are on entries, and positive moduli at rest unless the
    /// material is `prestressed`.
    ///
    /// ```
    /// use piola::material;
    /// use piola::material::{Fittable, Limit};
    ///
    /// /// Compressible neo-Hookean solid.
    /// #[material(domain(J > 0.0), admissible(lambda <= 1e7), fit)]
    /// fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    /// }
    ///
    /// # fn main() -> Result<(), piola::material::MaterialError> {
    /// let [upper, shear, bulk] = <[_; 3]>::try_from(Rubber::new(6e5, 1e6)?.constraints()).expect("three");
    /// assert_eq!((upper.limit, upper.value), (Limit::Admissible("lambda <= 1e7".into()), 9e6));
    /// assert_eq!((shear.limit, shear.value), (Limit::ShearModulus, 6e5));
    /// // K = λ + 2/3 μ
    /// assert_eq!((bulk.limit, bulk.gradient), (Limit::BulkModulus, vec![2.0 / 3.0, 1.0]));
    /// # Ok(())
    /// # }
    /// ```
    fn constraints(&self) -> Vec<Constraint>;

    /// Conditions of the domain at stretches λ1 ≥ λ2 ≥ λ3 > 0, except for those on J alone: at stretches that
    /// are kept, these are conditions on the parameters too.
    fn domain_constraints(&self, stretches: [f64; 3]) -> Vec<Constraint> {
        let _ = stretches;
        Vec::new()
    }
}

/// A condition on parameters, as a function of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// The condition.
    pub limit: Limit,
    /// A measure of the distance to the limit, positive inside: for `a > b` the difference a − b.
    pub value: f64,
    /// The derivative of the value with respect to each number among the parameters, in the order of
    /// [`Fittable::values`], lists entry by entry.
    pub gradient: Vec<f64>,
}

/// A limit on the parameters of a material.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// A comparison of `admissible(…)`, as declared.
    Admissible(Text),
    /// The shear modulus at rest is positive.
    ShearModulus,
    /// The bulk modulus at rest is not negative.
    BulkModulus,
    /// A comparison of `domain(…)`, as declared.
    Domain(Text),
}

impl Constraint {
    /// Constraints that expansions have computed together, with an array of derivatives for each number.
    #[doc(hidden)]
    #[must_use]
    pub fn all<const N: usize>(limits: [Limit; N], values: [f64; N], slopes: Vec<[f64; N]>) -> Vec<Self> {
        let gradient = |k: usize| slopes.iter().map(|slopes| slopes[k]).collect();
        let all = limits.into_iter().zip(values).enumerate();
        all.map(|(k, (limit, value))| Self { limit, value, gradient: gradient(k) }).collect()
    }

    /// Constraint that depends on a few numbers only, each given by parameter, place in its list, and
    /// derivative; `values` are those of the material.
    #[doc(hidden)]
    #[must_use]
    pub fn of_entry(limit: Limit, value: f64, values: Vec<Vec<f64>>, slopes: &[(usize, usize, f64)]) -> Self {
        let mut gradient: Vec<_> = values.iter().map(|list| vec![0.0; list.len()]).collect();
        for &(parameter, place, slope) in slopes {
            gradient[parameter][place] = slope;
        }
        Self { limit, value, gradient: gradient.concat() }
    }
}
