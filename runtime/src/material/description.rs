//! Descriptions of declared materials, for programs that choose one at run time.

use std::borrow::Cow;

/// Text of a declaration: part of the program, or owned if the energy was declared at run time.
pub type Text = Cow<'static, str>;

/// Texts and data of a declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The type's name.
    pub name: Text,
    /// First paragraph of the documentation.
    pub summary: Text,
    /// ψ as a formula in one line.
    pub formula: Text,
    /// The parameters in the order of the constructor.
    pub parameters: Cow<'static, [Parameter]>,
    /// The domain of ψ, such as `J > 0`.
    pub domain: Text,
    /// True if the material can be built with [`Inversion::Extend`](super::Inversion::Extend).
    pub extends: bool,
    /// The reason why it does not extend, if the declaration states one.
    pub refusal: Option<Text>,
    /// Conditions on the parameters, which must also be finite.
    pub admissible: Cow<'static, [Text]>,
    /// Small-strain shear modulus and first Lamé parameter as formulas in the parameters.
    pub moduli: [Text; 2],
    /// Parameters of some real material, if the declaration has them: `typical(…)`.
    pub typical: Option<Typical>,
}

/// A parameter of a declared energy.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name in the declaration.
    pub name: Text,
    /// Its documentation, units included.
    pub doc: Text,
    /// Unit in the documentation, as in `Shear modulus μ, Pa.`; for a function, the unit of its values.
    pub unit: Option<Unit>,
    /// Form of its values at run time.
    pub form: Form,
}

impl Parameter {
    /// True if it is a list of values: one for each term of a sum, or those that define a function.
    #[must_use]
    pub fn is_list(&self) -> bool {
        !matches!(self.form, Form::Number | Form::Exponent)
    }

    /// True if its values are whole numbers, exponents from 0 to 64, by which nothing is differentiated.
    #[doc(hidden)] // for fits
    #[must_use]
    pub fn is_whole(&self) -> bool {
        matches!(self.form, Form::Exponent | Form::Exponents)
    }

    /// Multiplies those values of this parameter that are in powers of Pa by powers of a factor, so that an
    /// energy whose parameters are all rescaled is multiplied by the factor. That is not known of a parameter
    /// without a unit, and of a function that is not given by points: they stay.
    #[doc(hidden)] // for energies that are matched to others
    pub fn rescale(&self, values: &mut [f64], factor: f64) {
        let factor = match self.unit {
            Some(Unit::Pascal) => factor,
            Some(Unit::PerPascal) => factor.recip(),
            Some(Unit::Dimensionless) | None => return,
        };
        let (first, step) = match self.form {
            Form::Number | Form::List | Form::Exponent | Form::Exponents => (0, 1),
            Form::Points => (1, 2),
            Form::Function => return,
        };
        values.iter_mut().skip(first).step_by(step).for_each(|value| *value *= factor);
    }
}

/// Units that the documentation of a parameter can end with.
///
/// `#[piola::material]` checks that ψ is in Pa, if its parameters have units. A parameter without a unit is
/// not checked, and nothing can be derived from its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// `Pa`, which is `J/m³` and `N/m²`.
    Pascal,
    /// `1/Pa`.
    PerPascal,
    /// `dimensionless`: exponents, stretches, fractions.
    Dimensionless,
}

/// The form of a parameter as values at run time.
///
/// ```
/// use piola::material::{Declared, Form};
/// use piola::{Inversion, material};
///
/// /// Rivlin's series.
/// #[material(domain(J > 0.0))]
/// fn Rivlin(
///     [l1, l2, l3]: [f64; 3],
///     /// Coefficients, Pa.
///     c: Vec<f64>,
///     /// Exponents of I1b − 3.
///     i: Vec<u32>,
///     /// Exponents of I2b − 3.
///     j: Vec<u32>,
///     /// Bulk modulus, Pa.
///     K: f64,
/// ) -> f64 {
///     sum(|p| c[p] * (I1b - 3.0).powi(i[p]) * (I2b - 3.0).powi(j[p])) + K / 2.0 * (J - 1.0).powi(2)
/// }
///
/// # fn main() -> Result<(), piola::material::MaterialError> {
/// let description = Rivlin::DESCRIPTION;
/// let forms = description.parameters.iter().map(|parameter| parameter.form);
/// assert!(forms.eq([Form::List, Form::Exponents, Form::Exponents, Form::Number]));
/// // C10, C01 and C20.
/// let terms: [&[f64]; 4] = [&[1.6e5, 2e4, 1e3], &[1.0, 0.0, 2.0], &[0.0, 1.0, 0.0], &[1e7]];
/// let rubber = Rivlin::from_values(&terms, Inversion::Refuse)?;
/// assert_eq!(rubber.i(), [1, 0, 2]);
/// // The shear modulus is 2 (C10 + C01).
/// assert!((rubber.moduli().mu / 3.6e5 - 1.0).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One number.
    Number,
    /// One number for each term of a sum.
    List,
    /// One whole number, an exponent.
    Exponent,
    /// One whole number for each term of a sum, its exponent.
    Exponents,
    /// Points of a function or of one of its derivatives: x1, y1, x2, y2, ….
    Points,
    /// Numbers from which a function is built by its own constructor, if it can be built from numbers.
    Function,
}

/// Parameters of some real material, as declared by `typical("natural rubber", mu = 4e5)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Typical {
    /// One slice for each parameter of the description, in its order, as
    /// [`Declared::from_values`](super::Declared::from_values) takes them.
    pub values: Cow<'static, [Cow<'static, [f64]>]>,
    /// Name of the material and source of the values.
    pub source: Text,
}
