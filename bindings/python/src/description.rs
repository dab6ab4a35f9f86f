//! Descriptions of declarations.

use piola::material::{self, Unit};
use piola_materials::DECLARATIONS;
use pyo3::prelude::*;

/// A parameter of an energy.
#[pyclass(frozen, get_all, module = "piola")]
#[derive(Clone)]
pub(crate) struct Parameter {
    /// Its name, the keyword of `Material` and `declare`.
    name: String,
    /// Its documentation.
    doc: String,
    /// Its unit: "Pa", "1/Pa", "1" for a number without unit, or None if the declaration states none.
    unit: Option<&'static str>,
    /// True if it takes a sequence of numbers.
    is_list: bool,
    /// Its value in some real material, if the declaration has one.
    typical: Option<Vec<f64>>,
}

#[pymethods]
impl Parameter {
    fn __repr__(&self) -> String {
        format!("Parameter({:?}: {})", self.name, self.doc)
    }
}

/// Description of an energy.
#[pyclass(frozen, get_all, module = "piola")]
pub(crate) struct Description {
    /// The name.
    name: String,
    /// The first sentence of its documentation.
    summary: String,
    /// The energy density as a formula.
    formula: String,
    /// The parameters in the order of the declaration.
    parameters: Vec<Parameter>,
    /// Domain of the energy, such as "J > 0".
    domain: String,
    /// Conditions on the parameters.
    admissible: Vec<String>,
    /// True if it can be continued beyond its domain, by `extend=`.
    extends: bool,
    /// Formulas of the shear modulus and of Lamé's first parameter at small strain.
    moduli: [String; 2],
}

impl Description {
    pub(crate) fn new(name: &str, description: &material::Description) -> Self {
        let typical = description.typical.as_ref();
        let parameter = |(k, parameter): (usize, &material::Parameter)| Parameter {
            name: keyword(&parameter.name).to_owned(),
            doc: parameter.doc.to_string(),
            unit: parameter.unit.and_then(|unit| match unit {
                Unit::Pascal => Some("Pa"),
                Unit::PerPascal => Some("1/Pa"),
                Unit::Dimensionless => Some("1"),
                _ => None,
            }),
            is_list: parameter.is_list(),
            typical: typical.and_then(|typical| typical.values.get(k)).map(|values| values.to_vec()),
        };
        Self {
            name: name.to_owned(),
            summary: description.summary.to_string(),
            formula: description.formula.to_string(),
            parameters: description.parameters.iter().enumerate().map(parameter).collect(),
            domain: description.domain.to_string(),
            admissible: description.admissible.iter().map(ToString::to_string).collect(),
            extends: description.extends,
            moduli: description.moduli.each_ref().map(ToString::to_string),
        }
    }
}

#[pymethods]
impl Description {
    fn __repr__(&self) -> String {
        let names: Vec<_> = self.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        format!("{}({}): {}", shown(&self.name), names.join(", "), self.formula)
    }
}

/// The keyword of a parameter: `lambda_` for `lambda`, which is one of Python's own.
pub(crate) fn keyword(name: &str) -> &str {
    if name == "lambda" { "lambda_" } else { name }
}

/// The parameter that a keyword names: `lambda_` is `lambda`, unless there is a `lambda_`.
pub(crate) fn parameter_name(keyword: &str, is_known: impl Fn(&str) -> bool) -> &str {
    match keyword.strip_suffix('_') {
        Some(bare) if !is_known(keyword) => bare,
        _ => keyword,
    }
}

/// A name before the parentheses of its parameters: in quotes if it is a formula, or has other signs in it.
pub(crate) fn shown(name: &str) -> String {
    match is_name(name) {
        true => name.to_owned(),
        false => format!("'{name}'"),
    }
}

/// True if a text can be a name of the catalogue: a formula has other signs in it.
pub(crate) fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_alphanumeric() || "_- ".contains(c))
}

/// The names of all energies of the catalogue.
#[pyfunction]
pub(crate) fn catalogue() -> Vec<&'static str> {
    DECLARATIONS.iter().map(|declaration| declaration.name).collect()
}
