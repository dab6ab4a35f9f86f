//! A material on the bench: curves, fits to measurements, stability, and the contract of a declaration.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::fmt::Display;

use numpy::{IntoPyArray, PyArrayMethods};
use piola::contract::{Notation, Settings, check};
use piola::point::{stress, svd};
use piola_declare::Energy;
use piola_laboratory::curve::{Mode, Volume, sweep};
use piola_laboratory::data::{Measured, Measurements, ReadOptions, TRELOAR_1944};
use piola_laboratory::fit::{Fit, FitSettings, fit_parameters};
use piola_laboratory::stability::criteria::Criterion;
use piola_laboratory::stability::{Report, SurveySettings, Walk, survey};
use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};

use crate::arrays::{Axes, Numbers, deformations, from_rows, numbers, rows};
use crate::description::{keyword, parameter_name};
use crate::errors::{
    ContractError, DomainError, FitError, MaterialError, in_python, of_material, value_error,
};
use crate::material::Material;
use crate::shape;

#[pymethods]
impl Material {
    /// A test curve: the stress of a homogeneous specimen in a testing machine.
    ///
    ///     curve(mode, controls, /, *, incompressible=False)
    ///
    /// mode: "uniaxial", "equibiaxial", "pure_shear", "simple_shear" or "volumetric".
    /// controls: values that the machine prescribes, of shape (n,): stretch, shear, or ratio of volumes J.
    /// incompressible: True to keep the volume; otherwise free sides carry no stress.
    ///
    /// Returns a `Curve`: control and stress, Pa, of shape (n,), and principal stretches, of shape (n, 3).
    /// Stress and stretches are NaN where the curve has no point; `reasons` has the reason.
    #[pyo3(signature = (mode, controls, /, *, incompressible = false))]
    fn curve<'py>(
        &self,
        py: Python<'py>,
        mode: &str,
        controls: &Bound<'py, PyAny>,
        incompressible: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (mode, controls) = (self::mode(mode)?, numbers("controls", controls)?);
        let specimen = self.program()?;
        let points = py.detach(|| sweep(specimen, mode, volume(incompressible), &controls));
        let (mut stress, mut stretches, mut reasons) = (Vec::new(), Vec::new(), Vec::new());
        for point in points {
            let (at, of, reason) = match point {
                Ok(point) => (point.stress, point.stretches, None),
                Err(reason) => (f64::NAN, [f64::NAN; 3], Some(reason.to_string())),
            };
            stress.push(at);
            stretches.push(of);
            reasons.push(reason);
        }
        let (controls, stress) = (controls.into_pyarray(py), stress.into_pyarray(py));
        let arguments = (mode.name(), controls, stress, from_rows(py, &stretches)?, reasons);
        py.import("piola.results")?.call_method1("Curve", arguments)
    }

    /// Fits the parameters to measurements, starting from the current ones; returns the material with the
    /// best parameters.
    ///
    ///     fit(data, /, *, incompressible=True, relative=True, floor=0.0, cycle=None, held=(), restarts=20,
    ///         seed=1)
    ///
    /// data: a dictionary from modes, as in `curve`, to arrays of shape (n, 2): control and stress, Pa; or to
    ///     DataFrames with columns such as "stretch" or "strain [%]", and "stress", Pa, or "stress [MPa]".
    /// incompressible: True to keep the volume of the specimens.
    /// relative: True for differences relative to each stress, False for those relative to the greatest, as
    ///     by floor=1.
    /// floor: least divisor of a difference, as a share of the greatest stress: 0.05 limits the weight of
    ///     noise near zero stress.
    /// cycle: number from 1 of the cycle, or specimen, whose loading is used as it is.
    /// held: keywords of parameters that keep their values, such as "kappa" or "lambda_", and entries of
    ///     lists, such as "alpha_1".
    /// restarts: number of further starts, at random about the first.
    /// seed: equal seeds give equal fits.
    ///
    /// Returns a `Fit`; its warnings are UserWarnings, too. Raises FitError if nothing can be fitted,
    /// ValueError for columns that are not clear and for points that are not one curve of one solid,
    /// MaterialError if parameters differ from point to point.
    #[pyo3(signature = (
        data, /, *, incompressible = true, relative = true, floor = 0.0, cycle = None, held = Vec::new(),
        restarts = 20, seed = 1
    ))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn fit<'py>(
        &self,
        py: Python<'py>,
        data: &Bound<'py, PyDict>,
        incompressible: bool,
        relative: bool,
        floor: f64,
        cycle: Option<usize>,
        held: Vec<String>,
        restarts: usize,
        seed: u64,
    ) -> PyResult<Bound<'py, PyAny>> {
        let data = from_dictionary(data, cycle)?;
        let candidate = self.uniform()?.candidate().map_err(of_material)?;
        let parameters = &candidate.energy.description().parameters;
        let is_known = |name: &str| parameters.iter().any(|known| known.name == name);
        let held = held.iter().map(|name| parameter_name(name, is_known).to_owned()).collect();
        let volume = volume(incompressible);
        if !relative && floor != 0.0 {
            return Err(value_error("`relative=False` has no `floor`: leave one of them out"));
        }
        let floor = if relative { floor } else { 1.0 };
        let settings = FitSettings { volume, floor, held, restarts, seed };
        let fit = py.detach(|| fit_parameters(&candidate, &data, &settings));
        let Fit { values, numbers, agreement, difference, condition, ended, warnings, .. } =
            fit.map_err(|error| FitError::new_err(in_python(error)))?;
        let errors = numbers.iter().map(|number| (keyword(&number.name), number.error)).into_py_dict(py)?;
        let modes = agreement.modes.iter().map(|&(mode, value)| (mode.name(), value));
        let determination = modes.chain([("all", agreement.total)]).into_py_dict(py)?;
        let warnings: Vec<_> = warnings.iter().map(in_python).collect();
        let material = Py::new(py, self.with_fitted(&values)?)?;
        let arguments = (material, errors, determination, difference, condition, ended.to_string(), warnings);
        py.import("piola.results")?.call_method1("fitted", arguments)
    }

    /// Range of stretches in which the material keeps the inequalities of a stable solid.
    ///
    ///     stability(*, smallest=0.3, largest=3.0, resolution=41)
    ///
    /// smallest, largest: the range of the principal stretches, which contains 1.
    /// resolution: number of stretches along each axis of the box.
    ///
    /// Returns a `Stability`. Raises ValueError for an empty range, or a material without shear modulus.
    #[pyo3(signature = (*, smallest = 0.3, largest = 3.0, resolution = 41))]
    fn stability<'py>(
        &self,
        py: Python<'py>,
        smallest: f64,
        largest: f64,
        resolution: usize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let specimen = self.program()?;
        let settings = SurveySettings { from: smallest, to: largest, resolution };
        let report = py.detach(|| survey(specimen, &settings)).map_err(value_error)?;
        let text = report.to_string();
        let Report { points, admitted, findings, walks, .. } = report;
        let kept = findings.iter().map(|finding| (key(finding.criterion), finding.kept)).into_py_dict(py)?;
        let results = py.import("piola.results")?;
        let walk = |walk: &Walk| {
            let lost = Criterion::ALL.into_iter().map(key).zip(walk.lost).into_py_dict(py)?;
            results.call_method1("Walk", (key(walk.path), walk.to, walk.reached, lost))
        };
        let walks: Vec<_> = walks.iter().map(walk).collect::<PyResult<_>>()?;
        results.call_method1("Stability", (points, admitted, kept, walks, text))
    }

    /// Checks the rules that every material must keep: derivatives, isotropy, accuracy where stretches are
    /// equal, and more.
    ///
    /// Returns a list of (rule, number of comparisons, worst difference as a share of its tolerance). Raises
    /// ContractError with the broken rules.
    fn contract(&self, py: Python<'_>) -> PyResult<Vec<(String, usize, f64)>> {
        let notation = self.uniform()?.energy.as_ref().map_or_else(Notation::default, Energy::notation);
        let settings = Settings { notation, ..Settings::default() };
        let material = self.program()?;
        let report = py.detach(|| check(material, &settings));
        let report = report.map_err(|violations| ContractError::new_err(violations.to_string()))?;
        let finding = |finding: &piola::contract::Finding| {
            (finding.rule.to_string(), finding.comparisons, finding.worst)
        };
        Ok(report.findings.iter().map(finding).collect())
    }

    /// Derivatives of the first Piola stress by the parameters, Pa for a unit of the parameter.
    ///
    ///     stress_by_parameters(F, /)
    ///
    /// F: any array_like, of shape (..., 3, 3), inside the domain, with J > 0; its points are broadcast with
    ///     the parameters of the material.
    ///
    /// Returns a dictionary from the keywords of the parameters to arrays of the shape of stresses, float32
    /// if F is; for a list, to an array with one more axis in front, and so for a curve: the derivatives by
    /// the ordinates of its control points, except for one at x = 1. Raises DomainError for an F outside of
    /// the domain, MaterialError for curves of which only some have a control point at x = 1.
    #[pyo3(signature = (F, /))]
    fn stress_by_parameters<'py>(
        &self,
        py: Python<'py>,
        F: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let F = Numbers::new("F", F)?;
        let dtype = if let Numbers::Single(_) = F { "float32" } else { "float64" };
        let (F, shape) = deformations(&F.doubles()?, Axes::Leading, &self.shape)?;
        let (energy, material_of) = (self.declaration()?, shape::entries(&self.shape, &shape));
        let lists = energy.values(&self.each[0]);
        let lengths = |lists: &[Vec<f64>]| lists.iter().map(Vec::len).collect::<Vec<_>>();
        if self.each.iter().any(|material| lengths(&energy.values(material)) != lengths(&lists)) {
            let message = "curves have a control point at x = 1 for some points and none for others: their derivatives are \
                           not one array";
            return Err(MaterialError::new_err(message));
        }
        let count = lists.iter().map(Vec::len).sum::<usize>();
        let points: &[[[f64; 3]; 3]] = F.as_slice()?.as_chunks().0.as_chunks().0;
        let mut derivatives = vec![vec![[[0.0; 3]; 3]; points.len()]; count];
        let outside = py.detach(|| {
            (0..points.len()).find(|&point| {
                let material = &self.each[material_of[point]];
                let frames = svd(&points[point]);
                let by_parameters =
                    match frames.stretches[2] > 0.0 && piola::Material::admits(material, frames.stretches) {
                        true => energy.gradient_by_parameters(material, frames.stretches),
                        false => return true,
                    };
                for (derivatives, gradient) in derivatives.iter_mut().zip(by_parameters) {
                    derivatives[point] = stress(&frames, gradient);
                }
                false
            })
        });
        if let Some(point) = outside {
            let index = shape::index(point, &shape);
            let message = format!(
                "a point is outside the domain of the energy, or not finite; it has the index {}",
                shape::text(&index)
            );
            return Err(DomainError::new_err((message, index, 1, 0)));
        }
        let result = PyDict::new(py);
        let mut derivatives = derivatives.into_iter();
        for (parameter, list) in energy.description().parameters.iter().zip(&lists) {
            let part = derivatives.by_ref().take(list.len()).flatten().flatten().flatten();
            let part = part.collect::<Vec<f64>>().into_pyarray(py);
            let entries = [list.len()];
            let in_front = &entries[..usize::from(parameter.is_list())];
            let part = part.reshape([in_front, &shape, &[3, 3]].concat())?;
            result.set_item(keyword(&parameter.name), part.call_method1("astype", (dtype,))?)?;
        }
        Ok(result)
    }
}

fn volume(incompressible: bool) -> Volume {
    if incompressible { Volume::Kept } else { Volume::Free }
}

fn mode(name: &str) -> PyResult<Mode> {
    name.parse().map_err(value_error::<String>)
}

/// Measurements from arrays, or from tables whose columns have names.
fn from_dictionary(data: &Bound<'_, PyDict>, cycle: Option<usize>) -> PyResult<Measurements> {
    let mut points = Vec::new();
    for (name, readings) in data {
        let name: String = name.extract()?;
        let mode = mode(&name)?;
        let readings =
            data.py().import("piola.results")?.call_method1("readings", (mode.name(), readings))?;
        let readings: Vec<[f64; 2]> = rows(&name, &readings)?;
        points.extend(readings.into_iter().map(|[control, stress]| Measured { mode, control, stress }));
    }
    let data = Measurements { points };
    let chosen = match cycle {
        Some(cycle) => data.cycle(cycle),
        None => data.check_curves().map(|()| data),
    };
    let in_python = |text: String| text.replace("`--cycle first`, `Measurements::cycle`", "`cycle=1`");
    chosen.map_err(|mistake| value_error(in_python(mistake)))
}

/// A name of a report as a key of a dictionary, such as "strong_ellipticity".
fn key(name: impl Display) -> String {
    name.to_string().to_lowercase().replace([' ', '–'], "_")
}

/// Treloar's measurements of vulcanised rubber, 1944, in the form that `Material.fit` takes: control and
/// stress, Pa.
#[pyfunction]
pub(crate) fn treloar(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
    by_mode(py, &Measurements::read(TRELOAR_1944).map_err(value_error)?)
}

/// Measurements from the text of a table, in the form that `Material.fit` takes.
///
///     measurements(text, /, *, strain=None, stress=None, mode=None, unit=None)
///
/// text: the content of a file: a header, then numbers separated by tabs, semicolons, commas or spaces.
/// strain, stress: columns by name or number, and what they hold if the header does not say it, as in
///     "Dehnung", "1=stretch", "2=true stress [MPa]"; not needed if the header has plain names and units.
/// mode: the test, if no column names it, as in `curve`.
/// unit: the unit of stresses whose header names none, such as "MPa".
///
/// Returns a dictionary from modes to arrays of shape (n, 2): control and stress, Pa. Raises ValueError if
/// the table is ambiguous.
#[pyfunction]
#[pyo3(signature = (text, /, *, strain = None, stress = None, mode = None, unit = None))]
pub(crate) fn measurements<'py>(
    py: Python<'py>,
    text: &str,
    strain: Option<&str>,
    stress: Option<&str>,
    mode: Option<&str>,
    unit: Option<&str>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = ReadOptions {
        test: mode.map(str::parse).transpose().map_err(value_error::<String>)?,
        unit: unit.map(str::parse).transpose().map_err(value_error::<String>)?,
        strain: strain.map(Into::into),
        stress: stress.map(Into::into),
    };
    let reading = Measurements::read_with(text, &options).map_err(value_error)?;
    by_mode(py, &reading.measurements)
}

/// Measurements as a dictionary of Python.
fn by_mode<'py>(py: Python<'py>, data: &Measurements) -> PyResult<Bound<'py, PyDict>> {
    let result = PyDict::new(py);
    for mode in data.modes() {
        let readings: Vec<[f64; 2]> = data.of(mode).map(|point| [point.control, point.stress]).collect();
        result.set_item(mode.name(), from_rows(py, &readings)?)?;
    }
    Ok(result)
}
