//! Settings from keywords, and reports as dictionaries, by serde.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::errors::{of_body, value_error};

/// Settings from keywords: strings, numbers, sequences, arrays and dictionaries of these.
pub(crate) fn from_keywords<T: DeserializeOwned>(
    py: Python<'_>,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<T> {
    let keywords = keywords.map_or_else(|| PyDict::new(py), Clone::clone);
    let text: String = py.import("piola.results")?.call_method1("to_json", (keywords,))?.extract()?;
    serde_json::from_str(&text).map_err(|error| {
        let message = error.to_string();
        let message = message.split(" at line ").next().unwrap_or(&message);
        of_body(format!("the settings are wrong: {message}"))
    })
}

/// A report as a dictionary.
pub(crate) fn to_dict<'py>(py: Python<'py>, report: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let text = serde_json::to_string(report).map_err(value_error)?;
    py.import("json")?.call_method1("loads", (text,))
}
