//! Input arrays, and output arrays for results.
//!
//! Accepts anything that `numpy.asarray` turns into an array of numbers; float32 stays as it is, all else
//! becomes float64, and masked entries NaN. Points are along the leading axes of an array, F of shape (...,
//! 3, 3), which is what `Batch` takes: nothing is copied. Or they are along the trailing ones, (3, 3, ...):
//! `columns` sees to these.

use std::fmt::Display;

use numpy::{
    BorrowError, Element, IntoPyArray, PyArrayDescrMethods, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn,
    PyReadwriteArrayDyn, PyUntypedArray, PyUntypedArrayMethods, dtype,
};
use pyo3::prelude::*;

use crate::errors::{type_error, type_name, value_error};
use crate::shape;

/// The axes along which the points of an array lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axes {
    /// (..., 3, 3).
    Leading,
    /// (3, 3, ...).
    Trailing,
}

impl Axes {
    /// The axes that the caller chooses, or the leading ones; Python warns of a shape that could mean both,
    /// and refuses one that means the others.
    pub(crate) fn of(py: Python<'_>, trailing: Option<bool>, shape: &[usize]) -> PyResult<Self> {
        let (axes, others) = match trailing {
            Some(true) => (Self::Trailing, Self::Leading),
            _ => (Self::Leading, Self::Trailing),
        };
        let is_meant = trailing.is_some() && axes.points(shape).is_some();
        if shape.len() > 2 && !is_meant && others.points(shape).is_some() {
            py.import("piola.results")?.call_method1("question_axes", (shape.to_vec(), trailing))?;
        }
        Ok(axes)
    }

    /// The shape of points whose F has the shape given; `None` if there is no F of that shape.
    fn points(self, shape: &[usize]) -> Option<&[usize]> {
        match self {
            Self::Leading => shape.strip_suffix(&[3, 3]),
            Self::Trailing => shape.strip_prefix(&[3, 3]),
        }
    }

    /// The shape of an array with these components for each point.
    pub(crate) fn shape(self, points: &[usize], components: &[usize]) -> Vec<usize> {
        match self {
            Self::Leading => [points, components].concat(),
            Self::Trailing => [components, points].concat(),
        }
    }
}

/// Numbers that a caller gives, in the precision that they have.
pub(crate) enum Numbers<'py> {
    Double(Bound<'py, PyArrayDyn<f64>>),
    Single(Bound<'py, PyArrayDyn<f32>>),
}

impl<'py> Numbers<'py> {
    /// Reads an array of float64 or float32 where it is, and makes one of everything else.
    pub(crate) fn new(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        if let Ok(array) = given.cast_exact() {
            return Ok(Self::Double(array.clone()));
        }
        if let Ok(array) = given.cast_exact() {
            return Ok(Self::Single(array.clone()));
        }
        let array = as_array(name, given)?;
        let dtype = array.dtype();
        match (dtype.kind(), dtype.itemsize()) {
            (b'f', 4) => Ok(Self::Single(converted(&array)?)),
            (b'f' | b'i' | b'u' | b'b', _) => Ok(Self::Double(converted(&array)?)),
            _ => Err(no_numbers(name, given, None)),
        }
    }

    /// The numbers in double precision, in the order of C.
    pub(crate) fn doubles(self) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        match self {
            Self::Double(array) if array.is_c_contiguous() => Ok(array),
            Self::Double(array) => converted(array.as_untyped()),
            Self::Single(array) => converted(array.as_untyped()),
        }
    }
}

/// Contiguous deformation gradients, and the shape of their points: the array where it is, or a copy of it,
/// broadcast to the shape that its points have together with the parameters of a material.
pub(crate) fn deformations<'py, E: Element>(
    array: &Bound<'py, PyArrayDyn<E>>,
    axes: Axes,
    parameters: &[usize],
) -> PyResult<(PyReadonlyArrayDyn<'py, E>, Vec<usize>)> {
    let Some(points) = axes.points(array.shape()) else {
        let wanted = if axes == Axes::Leading { "(..., 3, 3)" } else { "(3, 3, ...)" };
        return Err(wrong_shape("F", array, wanted));
    };
    let Some(common) = shape::common(points, parameters) else {
        let (points, parameters) = (shape::text(points), shape::text(parameters));
        return Err(value_error(format!(
            "F has points of the shape {points}, and the material has parameters of the shape {parameters}: \
             they cannot be broadcast together"
        )));
    };
    let array = match common == points && array.is_c_contiguous() {
        true => array.clone(),
        false => {
            let results = array.py().import("piola.results")?;
            let arguments = (array, common.clone(), axes == Axes::Trailing);
            results.call_method1("broadcast", arguments)?.cast_into()?
        }
    };
    let refused = |_| value_error("F cannot be read: another thread writes results to its memory");
    Ok((array.try_readonly().map_err(refused)?, common))
}

/// The array of this shape that a caller gives for results of a type, which is `wanted` in words.
pub(crate) fn output<'py, E: Element>(
    name: &str,
    given: &Bound<'py, PyAny>,
    shape: &[usize],
    wanted: impl Display,
) -> PyResult<PyReadwriteArrayDyn<'py, E>> {
    let array = given
        .cast::<PyArrayDyn<E>>()
        .map_err(|_| type_error(format!("{name} is {}; it must be an array of {wanted}", kind(given))))?;
    if array.shape() != shape {
        return Err(wrong_shape(name, array, &shape::text(shape)));
    }
    if !array.is_c_contiguous() {
        return Err(value_error(format!("{name} must be contiguous in the order of C")));
    }
    let refused = |error| {
        let reason = match error {
            BorrowError::NotWriteable => "it is read-only",
            _ => "it shares memory with F, another result or an array of another thread; pass one of its own",
        };
        value_error(format!("{name} cannot be written: {reason}"))
    };
    array.try_readwrite().map_err(refused)
}

/// Rows of N numbers, as of positions: any sequence of sequences, or an array.
pub(crate) fn rows<const N: usize>(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<[f64; N]>> {
    let numbers = Numbers::new(name, given)?.doubles()?;
    if numbers.ndim() != 2 || numbers.shape()[1] != N {
        return Err(wrong_shape(name, &numbers, &format!("(n, {N})")));
    }
    Ok(numbers.to_vec()?.as_chunks().0.to_vec())
}

/// Numbers in a row: any sequence, an array, or a single one.
pub(crate) fn numbers(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let array = Numbers::new(name, given)?.doubles()?;
    if array.ndim() > 1 {
        return Err(wrong_shape(name, &array, "a number or a row of numbers"));
    }
    Ok(array.to_vec()?)
}

/// Indices in rows of N, or in one row for N = 1, none below zero.
pub(crate) fn indices<const N: usize>(name: &str, given: &Bound<'_, PyAny>) -> PyResult<Vec<[usize; N]>> {
    let array = as_array(name, given)?;
    let is_whole = matches!(array.dtype().kind(), b'i' | b'u');
    if !is_whole && array.len() > 0 {
        let (found, is_mask) = (kind(&array), array.dtype().kind() == b'b');
        let advice = if is_mask { ", such as numpy.flatnonzero returns for a mask" } else { "" };
        return Err(type_error(format!("{name} is {found}; it must be an array of whole numbers{advice}")));
    }
    let array: Bound<'_, PyArrayDyn<i64>> = converted(&array)?;
    let fits = if N == 1 { array.ndim() == 1 } else { array.ndim() == 2 && array.shape()[1] == N };
    if !fits {
        let wanted = if N == 1 { "(n,)".to_owned() } else { format!("(n, {N})") };
        return Err(wrong_shape(name, &array, &wanted));
    }
    let index = |&number: &i64| {
        usize::try_from(number)
            .map_err(|_| value_error(format!("{name} has the entry {number}; it must not be negative")))
    };
    let whole: Vec<_> = array.to_vec()?.iter().map(index).collect::<PyResult<_>>()?;
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

/// An array that the caller can read only, since it is a copy: what is written to it would be lost.
pub(crate) fn read_only<T>(array: Bound<'_, T>) -> PyResult<Bound<'_, T>> {
    array.as_any().call_method1("setflags", (false,))?;
    Ok(array)
}

/// Result of `numpy.asarray` for an object, with NaN for masked entries and numbers for objects.
fn as_array<'py>(name: &str, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyUntypedArray>> {
    let array = given.py().import("piola.results")?.call_method1("as_array", (given,));
    Ok(array.map_err(|cause| no_numbers(name, given, Some(cause)))?.cast_into()?)
}

/// An array with numbers of this type, in the order of C; a copy if it is not one already.
fn converted<'py, E: Element>(array: &Bound<'py, PyUntypedArray>) -> PyResult<Bound<'py, PyArrayDyn<E>>> {
    let (casting, is_subclass, is_copy) = ("unsafe", false, false);
    let arguments = (dtype::<E>(array.py()), "C", casting, is_subclass, is_copy);
    Ok(array.call_method1("astype", arguments)?.cast_into()?)
}

fn no_numbers(name: &str, given: &Bound<'_, PyAny>, cause: Option<PyErr>) -> PyErr {
    let error =
        type_error(format!("{name} is {}; it must be real numbers, or an array of them", kind(given)));
    error.set_cause(given.py(), cause);
    error
}

fn wrong_shape<E>(name: &str, array: &Bound<'_, PyArrayDyn<E>>, wanted: &str) -> PyErr {
    value_error(format!("{name} has the shape {}; it must be {wanted}", shape::text(array.shape())))
}

/// The kind of an object, in words.
pub(crate) fn kind(object: &Bound<'_, PyAny>) -> String {
    match object.cast::<PyUntypedArray>() {
        Ok(array) => format!("an array of {}", array.dtype()),
        Err(_) => format!("of type {}", type_name(object)),
    }
}
