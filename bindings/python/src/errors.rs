//! Errors of Rust as exceptions of the package, which `python/piola/errors.py` declares.

use piola::material::MaterialError as Refused;
use piola_declare::Mistakes;
use piola_scenes::error::Error;
use pyo3::PyErr;
use pyo3::import_exception;
use pyo3::prelude::*;

import_exception!(piola.errors, BodyError);
import_exception!(piola.errors, ContractError);
import_exception!(piola.errors, DeclarationError);
import_exception!(piola.errors, DomainError);
import_exception!(piola.errors, FitError);
import_exception!(piola.errors, MaterialError);
import_exception!(piola.errors, StepError);

/// A material that does not exist, or that rejects its parameters.
pub(crate) fn of_material(error: Error) -> PyErr {
    MaterialError::new_err(in_python(&error.to_string()))
}

/// Parameters that a material refuses.
pub(crate) fn of_parameters(error: Refused) -> PyErr {
    MaterialError::new_err(in_python(&error.to_string()))
}

/// A material of a point that refuses its parameters.
pub(crate) fn of_point(index: &str, error: &Error) -> PyErr {
    MaterialError::new_err(in_python(&format!("at index {index}: {error}")))
}

/// A message with the keywords of Python instead of the names in Rust.
fn in_python(message: &str) -> String {
    message.replace("Inversion::Refuse", "extend=None").replace("`lambda`", "`lambda_`")
}

/// A text that does not declare an energy: its mistakes, and for each its line, its column and its length.
pub(crate) fn of_text(mistakes: Mistakes) -> PyErr {
    let place = |mistake: &piola_declare::Mistake| {
        let place = mistake.place.map(|place| (place.line, place.column, place.length));
        (mistake.message.clone(), place)
    };
    let places: Vec<_> = mistakes.list.iter().map(place).collect();
    DeclarationError::new_err((mistakes.to_string(), places))
}

/// A mesh, pin or setting that is not valid for a body or a simulation.
pub(crate) fn of_body(error: impl std::error::Error) -> PyErr {
    BodyError::new_err(error.to_string())
}

/// Raises an exception that carries the name of what was given.
pub(crate) fn type_error(message: String) -> PyErr {
    pyo3::exceptions::PyTypeError::new_err(message)
}

/// Raises an exception for a value out of range.
pub(crate) fn value_error(message: String) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(message)
}

/// The type of an object, for messages.
pub(crate) fn type_name(object: &Bound<'_, PyAny>) -> String {
    object.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string())
}
