//! Errors of Rust as exceptions of the package, which `python/piola/errors.py` declares.

use std::fmt::Display;

use piola_declare::Mistakes;
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

/// A message with the keywords of Python instead of the names in Rust.
pub(crate) fn in_python(message: impl Display) -> String {
    message.to_string().replace("Inversion::Refuse", "extend=None").replace("`lambda`", "`lambda_`")
}

/// A material that does not exist, or that rejects its parameters.
pub(crate) fn of_material(error: impl Display) -> PyErr {
    MaterialError::new_err(in_python(error))
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

/// A step that fails, or a state without reactions.
pub(crate) fn of_step(error: impl Display) -> PyErr {
    StepError::new_err(error.to_string())
}

/// A mesh, pin or setting that is not valid for a body or a simulation.
pub(crate) fn of_body(error: impl Display) -> PyErr {
    BodyError::new_err(error.to_string())
}

/// Raises an exception that carries the name of what was given.
pub(crate) fn type_error(message: impl Display) -> PyErr {
    pyo3::exceptions::PyTypeError::new_err(message.to_string())
}

/// Raises an exception for a value out of range.
pub(crate) fn value_error<T: Display>(message: T) -> PyErr {
    pyo3::exceptions::PyValueError::new_err(message.to_string())
}

/// The type of an object, for messages.
pub(crate) fn type_name(object: &Bound<'_, PyAny>) -> String {
    object.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string())
}
