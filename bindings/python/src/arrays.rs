//! Arrays that are taken, and those that results go to.
//!
//! Points are along the leading axes of an array, F of shape (..., 3, 3), which is what `Batch` takes:
//! nothing is copied. Or they are along the trailing ones, (3, 3, ...): `columns` sees to these.

use numpy::{
    Element, IntoPyArray, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods,
};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::{type_error, type_name, value_error};

/// The axes along which the points of an array lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// (..., 3, 3).
    Leading,
    /// (3, 3, ...).
    Trailing,
}

impl Axes {
    pub(crate) fn new(trailing: bool) -> Self {
        if trailing { Self::Trailing } else { Self::Leading }
    }

    /// The shape of points whose F has the shape given; `None` if there is no F of that shape.
    fn points(self, shape: &[usize]) -> Option<&[usize]> {
        match self {
            Self::Leading => shape.strip_suffix(&[3, 3]),
            Self::Trailing => shape.strip_prefix(&[3, 3]),
        }
    }

    /// The shape of an array with these components for each point.
    fn shape(self, points: &[usize], components: &[usize]) -> Vec<usize> {
        match self {
            Self::Leading => [points, components].concat(),
            Self::Trailing => [components, points].concat(),
        }
    }
}

/// Deformation gradients, contiguous.
pub(crate) struct Input<'py, E: Element> {
    array: PyReadonlyArrayDyn<'py, E>,
    axes: Axes,
}

impl<'py, E: Element> Input<'py, E> {
    /// Reads the array where it is, or a contiguous copy of it.
    pub(crate) fn new(array: &Bound<'py, PyArrayDyn<E>>, axes: Axes) -> PyResult<Self> {
        if axes.points(array.shape()).is_none() {
            let wanted = if axes == Axes::Leading { "(..., 3, 3)" } else { "(3, 3, ...)" };
            let shape = shape_text(array.shape());
            return Err(value_error(format!("F has the shape {shape}; it must be {wanted}")));
        }
        let array = if array.is_c_contiguous() { array.clone() } else { copy(array)? };
        let refused = |error: numpy::BorrowError| value_error(format!("F cannot be read: {error}"));
        Ok(Self { array: array.try_readonly().map_err(refused)?, axes })
    }

    pub(crate) fn py(&self) -> Python<'py> {
        self.array.py()
    }

    pub(crate) fn slice(&self) -> PyResult<&[E]> {
        Ok(self.array.as_slice()?)
    }

    /// The shape of the points.
    pub(crate) fn points(&self) -> &[usize] {
        self.axes.points(self.array.shape()).unwrap_or(&[])
    }

    /// A result with these components for each point: in the array that the caller gives, or in a new one.
    pub(crate) fn output(
        &self,
        py: Python<'py>,
        components: &[usize],
        given: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Output<'py, E>> {
        let shape = self.axes.shape(self.points(), components);
        let array = match given {
            None => PyArrayDyn::zeros(py, shape, false),
            Some(given) => {
                let array = given.cast::<PyArrayDyn<E>>().map_err(|_| {
                    type_error(format!("out is {}; it must be an array of the numbers of F", kind(given)))
                })?;
                if array.shape() != shape {
                    let (shape, found) = (shape_text(&shape), shape_text(array.shape()));
                    return Err(value_error(format!("out has the shape {found}; it must be {shape}")));
                }
                array.clone()
            }
        };
        Output::new(array, "out")
    }
}

/// An array that a result is written to.
pub(crate) struct Output<'py, E: Element> {
    array: Bound<'py, PyArrayDyn<E>>,
    writable: PyReadwriteArrayDyn<'py, E>,
}

impl<'py, E: Element> Output<'py, E> {
    fn new(array: Bound<'py, PyArrayDyn<E>>, name: &str) -> PyResult<Self> {
        if !array.is_c_contiguous() {
            return Err(value_error(format!("{name} must be contiguous in the order of C")));
        }
        let refused = |error: numpy::BorrowError| value_error(format!("{name} cannot be written: {error}"));
        let writable = array.try_readwrite().map_err(refused)?;
        Ok(Self { array, writable })
    }

    pub(crate) fn slice(&mut self) -> PyResult<&mut [E]> {
        Ok(self.writable.as_slice_mut()?)
    }

    pub(crate) fn finish(self) -> Bound<'py, PyArrayDyn<E>> {
        self.array
    }
}

/// An array of bytes for the status of each point.
pub(crate) fn statuses<'py>(given: &Bound<'py, PyAny>, points: &[usize]) -> PyResult<Output<'py, u8>> {
    let array = given
        .cast::<PyArrayDyn<u8>>()
        .map_err(|_| type_error(format!("status is {}; it must be an array of numpy.uint8", kind(given))))?;
    if array.shape() != points {
        let (found, wanted) = (shape_text(array.shape()), shape_text(points));
        return Err(value_error(format!("status has the shape {found}; it must be {wanted}")));
    }
    Output::new(array.clone(), "status")
}

/// A contiguous copy.
fn copy<'py, E: Element>(array: &Bound<'py, PyArrayDyn<E>>) -> PyResult<Bound<'py, PyArrayDyn<E>>> {
    let copied = array.call_method1("copy", ("C",))?;
    copied.cast_into().map_err(|_| type_error("F cannot be copied".to_owned()))
}

/// Rows of N numbers, as of positions: any sequence of sequences, or an array.
pub(crate) fn rows<const N: usize>(
    py: Python<'_>,
    name: &str,
    given: &Bound<'_, PyAny>,
) -> PyResult<Vec<[f64; N]>> {
    let numbers = as_array(py, name, given, "float64")?;
    let numbers = numbers.cast_into::<PyArrayDyn<f64>>().map_err(|_| no_numbers(name, given))?;
    if numbers.ndim() != 2 || numbers.shape()[1] != N {
        let found = shape_text(numbers.shape());
        return Err(value_error(format!("{name} has the shape {found}; it must be (n, {N})")));
    }
    let numbers = numbers.to_vec().map_err(|error| value_error(error.to_string()))?;
    Ok(numbers.as_chunks().0.to_vec())
}

/// Numbers in a row: any sequence, an array, or a single one.
pub(crate) fn numbers(py: Python<'_>, name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = as_array(py, name, given, "float64")?;
    let array = array.cast_into::<PyArrayDyn<f64>>().map_err(|_| no_numbers(name, given))?;
    if array.ndim() > 1 {
        let found = shape_text(array.shape());
        return Err(value_error(format!(
            "{name} has the shape {found}; it must be a number or a row of numbers"
        )));
    }
    array.to_vec().map_err(|error| value_error(error.to_string()))
}

/// Indices in rows of N, or in one row for N = 1, none below zero.
pub(crate) fn indices<const N: usize>(
    py: Python<'_>,
    name: &str,
    given: &Bound<'_, PyAny>,
) -> PyResult<Vec<[usize; N]>> {
    let kind = as_array(py, name, given, "")?;
    let is_empty = kind.cast::<PyUntypedArray>().is_ok_and(|array| array.len() == 0);
    let is_whole =
        kind.cast::<PyUntypedArray>().is_ok_and(|array| matches!(array.dtype().kind(), b'i' | b'u'));
    if !is_whole && !is_empty {
        return Err(type_error(format!(
            "{name} is {}; it must be an array of whole numbers",
            self::kind(&kind)
        )));
    }
    let array = as_array(py, name, given, "int64")?;
    let array = array.cast_into::<PyArrayDyn<i64>>().map_err(|_| no_numbers(name, given))?;
    let fits = if N == 1 { array.ndim() == 1 } else { array.ndim() == 2 && array.shape()[1] == N };
    if !fits {
        let wanted = if N == 1 { "(n,)".to_owned() } else { format!("(n, {N})") };
        let found = shape_text(array.shape());
        return Err(value_error(format!("{name} has the shape {found}; it must be {wanted}")));
    }
    let whole = array.to_vec().map_err(|error| value_error(error.to_string()))?;
    let index = |&number: &i64| {
        usize::try_from(number)
            .map_err(|_| value_error(format!("{name} has the entry {number}; it must not be negative")))
    };
    let whole: Vec<_> = whole.iter().map(index).collect::<PyResult<_>>()?;
    Ok(whole.as_chunks().0.to_vec())
}

/// Rows as an array of shape (n, N).
pub(crate) fn from_rows<'py, const N: usize, E: Element + Copy>(
    py: Python<'py>,
    rows: &[[E; N]],
) -> PyResult<Bound<'py, PyAny>> {
    let flat = rows.as_flattened().to_vec().into_pyarray(py);
    Ok(flat.reshape([rows.len(), N])?.into_any())
}

fn as_array<'py>(
    py: Python<'py>,
    name: &str,
    given: &Bound<'py, PyAny>,
    dtype: &str,
) -> PyResult<Bound<'py, PyAny>> {
    let numpy = py.import("numpy")?;
    let arguments =
        if dtype.is_empty() { PyTuple::new(py, [given])? } else { (given, dtype).into_pyobject(py)? };
    numpy.call_method1("ascontiguousarray", arguments).map_err(|_| no_numbers(name, given))
}

fn no_numbers(name: &str, given: &Bound<'_, PyAny>) -> PyErr {
    type_error(format!("{name} is {}; it must be numbers", kind(given)))
}

/// The kind of an object, in words.
pub(crate) fn kind(object: &Bound<'_, PyAny>) -> String {
    match object.cast::<PyUntypedArray>() {
        Ok(array) => format!("an array of {}", array.dtype()),
        Err(_) => format!("of type {}", type_name(object)),
    }
}

/// A shape as Python writes it.
pub(crate) fn shape_text(shape: &[usize]) -> String {
    match shape {
        [one] => format!("({one},)"),
        _ => format!("({})", shape.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")),
    }
}
