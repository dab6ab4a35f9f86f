//! Energy, stress and tangent of many points.

#![expect(non_snake_case, reason = "F and P as in the literature")]

use numpy::{Element, PyArrayDyn, PyReadonlyArrayDyn, PyReadwriteArrayDyn, PyUntypedArrayMethods, dtype};
use piola::batch::{Kernels, TileMaterial};
use piola::point::Filter;
use piola::point::measures::Measure;
use piola::{StatusCell, Survey};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::arrays::{Axes, Numbers, deformations, kind, output};
use crate::columns::Columns;
use crate::errors::{DomainError, type_error, value_error};
use crate::material::Material;
use crate::quantity::{Materials, Quantity};
use crate::shape;
use crate::threads::on_threads;

/// Points from which on the threads of the pool share a call, unless the caller decides.
const MANY: usize = 2048;

/// Options of a call for points: keywords that all methods share.
struct Call<'a, 'py> {
    filter: Filter,
    /// True if the points are on the last axes of F.
    trailing: Option<bool>,
    /// Array for the result, or a tuple of arrays for several results.
    out: Option<&'a Bound<'py, PyAny>>,
    status: Option<&'a Bound<'py, PyAny>>,
    threads: Option<bool>,
}

impl<'py> Call<'_, 'py> {
    /// Computes a quantity of each F, and returns its result, or a tuple of several results.
    fn run(
        &self,
        material: &Material,
        F: &Bound<'py, PyAny>,
        quantity: Quantity,
    ) -> PyResult<Bound<'py, PyAny>> {
        let out = match (self.out, quantity.components().len()) {
            (Some(out), 1) => vec![Some(out.clone())],
            (Some(out), count) => several(out, count)?,
            (None, _) => Vec::new(),
        };
        let mut results = match Numbers::new("F", F)? {
            Numbers::Double(F) => self.run_in(material, &*material.double, &F, quantity, out)?,
            Numbers::Single(F) => self.run_in(material, &material.each[0], &F, quantity, out)?,
        };
        match results.len() {
            1 => Ok(results.remove(0)),
            _ => Ok(PyTuple::new(F.py(), results)?.into_any()),
        }
    }

    /// Computes in the precision of F, with `uniform` if the material is the same at all points.
    fn run_in<E: Kernels + Element>(
        &self,
        material: &Material,
        uniform: &dyn TileMaterial<E>,
        F: &Bound<'py, PyArrayDyn<E>>,
        quantity: Quantity,
        mut out: Vec<Option<Bound<'py, PyAny>>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let axes = Axes::of(F.py(), self.trailing, F.shape())?;
        let (F, points) = deformations(F, axes, &material.shape)?;
        let (py, count) = (F.py(), points.iter().product::<usize>());
        let mut outputs = Vec::with_capacity(3);
        out.resize(quantity.components().len(), None);
        for (components, given) in quantity.components().iter().zip(out) {
            let shape = axes.shape(&points, components);
            let new = || PyArrayDyn::<E>::zeros(py, shape.clone(), false).into_any();
            let given = given.unwrap_or_else(new);
            let wanted = dtype::<E>(py);
            outputs.push(output::<E>(
                "out",
                &given,
                &shape,
                format_args!("{wanted}, the type of the result"),
            )?);
        }
        let mut status =
            self.status.map(|given| output::<u8>("status", given, &points, "numpy.uint8")).transpose()?;
        let cells: Vec<_> = status.iter().flat_map(|_| (0..count).map(|_| StatusCell::default())).collect();
        let results = outputs.iter_mut().map(PyReadwriteArrayDyn::as_slice_mut);
        let results = results.collect::<Result<Vec<_>, _>>()?;
        let materials = Materials { uniform, each: material.at(&points), filter: self.filter };
        let survey = self.compute(axes, &materials, &F, quantity, results, &cells)?;
        for (output, components) in outputs.iter_mut().zip(quantity.numbers()) {
            let at = |point: usize, component: usize| match axes {
                Axes::Leading => components * point + component,
                Axes::Trailing => count * component + point,
            };
            let entries = output.as_slice_mut()?;
            let from_first = cells.iter().enumerate().skip(survey.first.unwrap_or(count));
            for (point, _) in from_first.filter(|(_, cell)| !cell.get().is_clean()) {
                for component in 0..components {
                    entries[at(point, component)] = E::splat(f64::NAN);
                }
            }
        }
        match (&mut status, survey.first) {
            (Some(status), _) => {
                for (status, cell) in status.as_slice_mut()?.iter_mut().zip(&cells) {
                    *status = flags(cell);
                }
            }
            (None, Some(first)) => return Err(outside(survey, first, &points)),
            (None, None) => {}
        }
        Ok(outputs.into_iter().map(|output| output.as_any().clone()).collect())
    }

    /// Computes a quantity, and the status of each point, if there are cells for it.
    fn compute<E: Kernels + Element>(
        &self,
        axes: Axes,
        materials: &Materials<'_, E>,
        F: &PyReadonlyArrayDyn<'py, E>,
        quantity: Quantity,
        mut results: Vec<&mut [E]>,
        cells: &[StatusCell],
    ) -> PyResult<Survey> {
        let (py, F) = (F.py(), F.as_slice()?);
        let count = F.len() / 9;
        let threads = self.threads.unwrap_or(count >= MANY);
        let compute = || match axes {
            Axes::Leading => materials.with_batch(0, count, |batch| {
                let batch = batch.with_threads(threads).with_statuses(cells);
                quantity.compute(&batch, F, &mut results)
            }),
            Axes::Trailing => Columns { materials, quantity, F, cells, count }.compute(results, threads),
        };
        let survey = match (threads, count) {
            (true, _) => py.detach(|| on_threads(compute))?,
            // Shorter than to let others have the interpreter.
            (false, ..=8) => compute(),
            (false, _) => py.detach(compute),
        };
        survey.map_err(value_error)
    }
}

/// The bits of a status: those of `piola.Status`.
fn flags(cell: &StatusCell) -> u8 {
    let status = cell.get();
    [status.refused, status.bounded, status.nonfinite, status.filtered]
        .into_iter()
        .enumerate()
        .fold(0, |bits, (k, flag)| bits | u8::from(flag) << k)
}

/// The exception for points with invalid results.
fn outside(survey: Survey, first: usize, points: &[usize]) -> PyErr {
    let index = shape::index(first, points);
    let Survey { refused, nonfinite, .. } = survey;
    let count = points.iter().product::<usize>();
    let reasons: Vec<String> = [
        (refused, "are outside the domain of the energy"),
        (nonfinite, "have an F or a result that is not finite"),
    ]
    .into_iter()
    .filter(|(number, _)| *number > 0)
    .map(|(number, reason)| format!("{number} of {count} points {reason}"))
    .collect();
    let message = format!(
        "{}; the first has the index {}. `extend=` of the material continues an energy beyond J > 0; `status=` \
         returns flags instead of this error",
        reasons.join(", "),
        shape::text(&index)
    );
    DomainError::new_err((message, index, refused, nonfinite))
}

pub(crate) fn filter(name: Option<&str>) -> PyResult<Filter> {
    let filters = [("clamp", Filter::Clamp), ("absolute", Filter::Absolute)];
    name.map_or(Ok(Filter::None), |name| choice("filter", name, &filters, r#""clamp", "absolute" or None"#))
}

fn measure(name: &str) -> PyResult<Measure> {
    let measures = [
        ("second_piola", Measure::SecondPiola),
        ("kirchhoff", Measure::Kirchhoff),
        ("cauchy", Measure::Cauchy),
        ("jaumann", Measure::Jaumann),
        ("green_naghdi", Measure::GreenNaghdi),
    ];
    let known = r#""second_piola", "kirchhoff", "cauchy", "jaumann" or "green_naghdi""#;
    choice("measure", name, &measures, known)
}

/// The meaning of the word that an argument is, one of these.
fn choice<T: Copy>(argument: &str, word: &str, all: &[(&str, T)], known: &str) -> PyResult<T> {
    let found = all.iter().find(|(name, _)| *name == word).map(|&(_, meaning)| meaning);
    found.ok_or_else(|| value_error(format!("{argument} is {word:?}; it must be {known}")))
}

/// The arrays that a caller gives for several results.
fn several<'py>(out: &Bound<'py, PyAny>, count: usize) -> PyResult<Vec<Option<Bound<'py, PyAny>>>> {
    let tuple = out.cast::<PyTuple>();
    let tuple =
        tuple.map_err(|_| type_error(format!("out is {}; it must be a tuple of arrays", kind(out))))?;
    let arrays: Vec<Option<Bound<'py, PyAny>>> = tuple.extract()?;
    match arrays.len() == count {
        true => Ok(arrays),
        false => Err(value_error(format!("out has {} arrays; it must have {count}", arrays.len()))),
    }
}

#[pymethods]
impl Material {
    /// Energy densities of deformation gradients, Pa.
    ///
    ///     energy(F, /, *, trailing=None, out=None, status=None, threads=None)
    ///
    /// F: any array_like, of shape (..., 3, 3), or (3, 3, ...) if trailing; its points are broadcast with the
    ///     parameters of the material. Results are float32 if F is, else float64.
    /// trailing: True for points on the last axes; None for False, with a warning if the shape could mean
    ///     both, as (3, 3, 3).
    /// out: an array for the result, of shape (...), contiguous and of its type.
    /// status: an array of uint8, of shape (...), for the flags of each point: see `Status`.
    /// threads: True to share the points among threads; None for True from 2048 points on.
    ///
    /// Raises DomainError if a point is outside the domain or not finite, unless `status` is given: then the
    /// results of such points are NaN. Raises ValueError for a wrong shape, TypeError for a wrong type.
    #[pyo3(signature = (F, /, *, trailing = None, out = None, status = None, threads = None))]
    fn energy<'py>(
        &self,
        F: &Bound<'py, PyAny>,
        trailing: Option<bool>,
        out: Option<&Bound<'py, PyAny>>,
        status: Option<&Bound<'py, PyAny>>,
        threads: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = Call { filter: Filter::None, trailing, out, status, threads };
        call.run(self, F, Quantity::Energy)
    }

    /// First Piola stresses P = dψ/dF of deformation gradients, Pa, in the shape of F.
    ///
    ///     stress(F, /, *, trailing=None, out=None, status=None, threads=None)
    ///
    /// Arguments and errors as for `energy`.
    #[pyo3(signature = (F, /, *, trailing = None, out = None, status = None, threads = None))]
    fn stress<'py>(
        &self,
        F: &Bound<'py, PyAny>,
        trailing: Option<bool>,
        out: Option<&Bound<'py, PyAny>>,
        status: Option<&Bound<'py, PyAny>>,
        threads: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = Call { filter: Filter::None, trailing, out, status, threads };
        call.run(self, F, Quantity::Stress)
    }

    /// First Piola stresses P and tangents dP/dF, Pa: entry (i, j, k, l) is dP_ij/dF_kl.
    ///
    ///     tangent(F, /, *, filter=None, trailing=None, out=None, status=None, threads=None)
    ///
    /// filter: treatment of negative eigenvalues of dP/dF: None leaves them, "clamp" sets them to zero,
    ///     "absolute" changes their sign.
    /// out: a pair of arrays, or of None.
    ///
    /// Returns (P, dP_dF), of shapes (..., 3, 3) and (..., 3, 3, 3, 3), or (3, 3, ...) and (3, 3, 3, 3, ...).
    /// Other arguments and errors as for `energy`.
    #[pyo3(signature = (F, /, *, filter = None, trailing = None, out = None, status = None, threads = None))]
    fn tangent<'py>(
        &self,
        F: &Bound<'py, PyAny>,
        filter: Option<&str>,
        trailing: Option<bool>,
        out: Option<&Bound<'py, PyAny>>,
        status: Option<&Bound<'py, PyAny>>,
        threads: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = Call { filter: self::filter(filter)?, trailing, out, status, threads };
        call.run(self, F, Quantity::Tangent)
    }

    /// Energy, stress and tangent of one decomposition: (energy, P, dP_dF), as from `energy` and `tangent`.
    ///
    ///     evaluate(F, /, *, filter=None, trailing=None, out=None, status=None, threads=None)
    #[pyo3(signature = (F, /, *, filter = None, trailing = None, out = None, status = None, threads = None))]
    fn evaluate<'py>(
        &self,
        F: &Bound<'py, PyAny>,
        filter: Option<&str>,
        trailing: Option<bool>,
        out: Option<&Bound<'py, PyAny>>,
        status: Option<&Bound<'py, PyAny>>,
        threads: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let call = Call { filter: self::filter(filter)?, trailing, out, status, threads };
        call.run(self, F, Quantity::All)
    }

    /// Stresses in another measure with their tangents, Pa.
    ///
    ///     measured(F, measure, /, *, tangent=True, trailing=None, out=None, status=None, threads=None)
    ///
    /// measure: "second_piola" (S and dS/dE), "kirchhoff" (τ and J c), "cauchy" (σ and the spatial tangent
    ///     c), "jaumann" (σ and DDSDDE of Abaqus, except for the order) or "green_naghdi" (σ and c★).
    /// tangent: False for the stress only.
    ///
    /// Returns (stress, tangent) of shapes (..., 6) and (..., 6, 6), with the components 11, 22, 33, 23, 13,
    /// 12; [0, 1, 2, 5, 4, 3] are their places in the order of Abaqus/Standard.
    /// Other arguments and errors as for `energy`.
    #[pyo3(signature = (
        F, measure, /, *, tangent = true, trailing = None, out = None, status = None, threads = None
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn measured<'py>(
        &self,
        F: &Bound<'py, PyAny>,
        measure: &str,
        tangent: bool,
        trailing: Option<bool>,
        out: Option<&Bound<'py, PyAny>>,
        status: Option<&Bound<'py, PyAny>>,
        threads: Option<bool>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let measure = self::measure(measure)?;
        let call = Call { filter: Filter::None, trailing, out, status, threads };
        match tangent {
            true => call.run(self, F, Quantity::MeasuredTangent(measure)),
            false => call.run(self, F, Quantity::MeasuredStress(measure)),
        }
    }
}
