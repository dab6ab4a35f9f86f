//! Materials: an energy with its parameters, by its name in the catalogue or declared by a text.

use std::sync::{Arc, OnceLock};

use numpy::{PyArrayDescrMethods, PyUntypedArray, PyUntypedArrayMethods};
use piola::Inversion;
use piola::batch::TileMaterial;
use piola::interpreter::Interpreted;
use piola::material::{Moduli, Parameter, PerPoint};
use piola_declare::{Energy, FormulaOptions};
use piola_scenes::material::{MaterialInfo, MaterialSpec};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{kind, numbers};
use crate::description::Description;
use crate::errors::{MaterialError, of_material, of_parameters, of_text, type_error};

/// An energy with its parameters, whatever it is called by.
///
///     Material(name, /, *, extend=None, **parameters)
///
/// name: the name in `catalogue()`; case, spaces, `_` and `-` do not matter.
/// extend: the stretch, between 0 and 1, below which the energy is continued, so that inverted elements are
///     ordinary ones; None to refuse what is outside of its domain.
/// parameters: by the names of `describe(name)`, in its units: a number, or a sequence for a list. A number
///     may be given as an array with a value for each point. `lambda_` is the parameter `lambda`, whose name
///     Python keeps for itself.
///
/// Raises MaterialError for an unknown name, and for parameters that are missing, unknown or out of range.
#[pyclass(frozen, module = "piola")]
pub(crate) struct Material {
    spec: MaterialSpec,
    name: String,
    inversion: Inversion,
    /// Values in the order of the declaration.
    values: Vec<(String, Vec<f64>)>,
    moduli: Moduli,
    pub(crate) double: Box<dyn TileMaterial<f64>>,
    /// Its program for single precision, made when it is wanted first.
    single: OnceLock<Interpreted>,
    /// A material for each point, if they differ.
    each: Option<PerPoint<Interpreted, Arc<[Interpreted]>>>,
}

/// A number that has a value of its own at each point.
struct Varying {
    parameter: usize,
    values: Vec<f64>,
}

impl Material {
    pub(crate) fn new(spec: MaterialSpec, extend: Option<f64>) -> PyResult<Self> {
        let inversion = extend.map_or(Inversion::Refuse, |epsilon| Inversion::Extend { epsilon });
        let spec = spec.with_inversion(inversion).explicit().map_err(of_material)?;
        let MaterialInfo { name, elements, moduli, .. } = spec.build().map_err(of_material)?;
        let description = spec.description().map_err(of_material)?;
        let value =
            |parameter: &Parameter| (parameter.name.to_string(), spec.values_of(&parameter.name).to_vec());
        let values = description.parameters.iter().map(value).collect();
        let (name, single) = (name.to_string(), OnceLock::new());
        Ok(Self { spec, name, inversion, values, moduli, double: elements, single, each: None })
    }

    /// The material with parameters by keywords.
    fn from_keywords(
        py: Python<'_>,
        spec: MaterialSpec,
        extend: Option<f64>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let (spec, varying) = with_keywords(py, spec, keywords)?;
        let material = Self::new(spec, extend)?;
        if varying.is_empty() { Ok(material) } else { material.varied(&varying) }
    }

    /// A material for each point.
    fn varied(self, varying: &[Varying]) -> PyResult<Self> {
        let points = varying[0].values.len();
        if let Some(other) = varying.iter().find(|other| other.values.len() != points) {
            let (first, name) = (&self.values[varying[0].parameter].0, &self.values[other.parameter].0);
            return Err(MaterialError::new_err(format!(
                "`{first}` has values for {points} points, and `{name}` for {}",
                other.values.len()
            )));
        }
        let material = |point: usize| {
            let at_point = |spec: MaterialSpec, Varying { parameter, values }: &Varying| {
                spec.with_parameter(&self.values[*parameter].0, [values[point]])
            };
            let spec = varying.iter().fold(self.spec.clone(), at_point);
            let refused = |error| MaterialError::new_err(format!("point {point} (from 0): {error}"));
            spec.interpreted().map_err(refused)
        };
        let materials: Arc<[_]> = (0..points).map(material).collect::<PyResult<_>>()?;
        let each = PerPoint::new(materials).map_err(|error| MaterialError::new_err(error.to_string()))?;
        Ok(Self { each: Some(each), ..self })
    }

    /// The specification, if it is the same at all points.
    pub(crate) fn uniform(&self) -> PyResult<&MaterialSpec> {
        match self.each() {
            None => Ok(&self.spec),
            Some(each) => Err(MaterialError::new_err(format!(
                "{} has parameters for each of {} points; this needs one material for all",
                self.name,
                each.len()
            ))),
        }
    }

    /// Materials for the elements of a body.
    pub(crate) fn elements(&self) -> PyResult<Box<dyn TileMaterial<f64>>> {
        match &self.each {
            Some(each) => Ok(Box::new(each.clone())),
            None => Ok(self.spec.build().map_err(of_material)?.elements),
        }
    }

    /// The materials of the points, if they differ.
    pub(crate) fn each(&self) -> Option<&[Interpreted]> {
        self.each.as_ref().map(|each| each.materials())
    }

    pub(crate) fn single(&self) -> PyResult<&dyn TileMaterial<f32>> {
        if let Some(single) = self.single.get() {
            return Ok(single);
        }
        let single = self.interpreted()?;
        Ok(self.single.get_or_init(|| single))
    }

    /// The material as a program.
    pub(crate) fn interpreted(&self) -> PyResult<Interpreted> {
        self.spec.interpreted().map_err(of_material)
    }

    /// The material with other values, in the order of the declaration.
    pub(crate) fn with_values(&self, values: &[Vec<f64>]) -> PyResult<Self> {
        let named = self.values.iter().zip(values);
        let spec = named
            .fold(self.spec.clone(), |spec, ((name, _), values)| spec.with_parameter(name, values.clone()));
        Self::new(spec, self.extend())
    }
}

/// A specification with the values of keywords, and the numbers that differ from point to point.
fn with_keywords(
    py: Python<'_>,
    mut spec: MaterialSpec,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<(MaterialSpec, Vec<Varying>)> {
    let parameters = spec.description().map_err(of_material)?.parameters.clone();
    let mut varying = Vec::new();
    for (keyword, value) in keywords.into_iter().flatten() {
        let keyword: String = keyword.extract()?;
        let find = |name: &str| parameters.iter().position(|parameter| parameter.name == name);
        let bare = keyword.strip_suffix('_').unwrap_or(&keyword);
        let (name, parameter) = match find(&keyword) {
            Some(parameter) => (keyword.as_str(), Some(parameter)),
            None => (bare, find(bare)),
        };
        let is_row = value.cast::<PyUntypedArray>().is_ok_and(|array| array.ndim() > 0);
        let values = if is_row || !value.is_instance_of::<pyo3::types::PyFloat>() {
            no_strings(name, &value)?;
            numbers(py, name, &value)?
        } else {
            vec![value.extract()?]
        };
        match parameter {
            Some(parameter) if is_row && !parameters[parameter].is_list() => {
                let first = values.first().copied();
                let first = first.ok_or_else(|| MaterialError::new_err(format!("`{name}` has no values")))?;
                spec = spec.with_parameter(name, [first]);
                varying.push(Varying { parameter, values });
            }
            _ => spec = spec.with_parameter(name, values),
        }
    }
    Ok((spec, varying))
}

/// Refuses what numpy would read as numbers and a person would not.
fn no_strings(name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let is_text =
        value.is_instance_of::<pyo3::types::PyString>() || value.is_instance_of::<pyo3::types::PyBool>();
    let is_complex = value.cast::<PyUntypedArray>().is_ok_and(|array| array.dtype().kind() == b'c');
    if is_text || is_complex || value.is_none() {
        return Err(type_error(format!(
            "`{name}` is {}; it must be a number, or numbers in a row",
            kind(value)
        )));
    }
    Ok(())
}

#[pymethods]
impl Material {
    #[new]
    #[pyo3(signature = (name, /, *, extend = None, **parameters))]
    fn by_name(
        py: Python<'_>,
        name: &str,
        extend: Option<f64>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        Self::from_keywords(py, MaterialSpec::new(name), extend, parameters)
    }

    /// The material of a name with its typical parameters, mostly those of a rubber.
    #[staticmethod]
    #[pyo3(signature = (name, /, *, extend = None))]
    fn typical(name: &str, extend: Option<f64>) -> PyResult<Self> {
        Self::new(MaterialSpec::typical(name).map_err(of_material)?, extend)
    }

    /// The material of a name with Young's modulus, Pa, and Poisson's ratio at small strain.
    ///
    /// Its typical parameters are scaled to them, as far as they can be: `moduli` tells what came of it.
    #[staticmethod]
    #[pyo3(signature = (name, /, *, young, poisson, extend = None))]
    fn matching(name: &str, young: f64, poisson: f64, extend: Option<f64>) -> PyResult<Self> {
        let moduli = Moduli::from_young_poisson(young, poisson).map_err(of_parameters)?;
        Self::new(MaterialSpec::matching(name, moduli), extend)
    }

    /// The material with other values of the parameters that are named.
    ///
    ///     changed(**parameters)
    ///
    /// Raises MaterialError as Material.
    #[pyo3(signature = (**parameters))]
    fn changed(&self, py: Python<'_>, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::from_keywords(py, self.uniform()?.clone(), self.extend(), parameters)
    }

    /// The name in the catalogue, or of the declaration.
    #[getter]
    fn name(&self) -> &str {
        &self.name
    }

    /// The energy in words.
    #[getter]
    fn description(&self) -> PyResult<Description> {
        Ok(Description::new(&self.name, self.spec.description().map_err(of_material)?))
    }

    /// The parameters by name: a number each, or a list of numbers. Those that differ from point to point
    /// have the value of the first.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = PyDict::new(py);
        let description = self.spec.description().map_err(of_material)?;
        for (parameter, (name, values)) in description.parameters.iter().zip(&self.values) {
            match parameter.is_list() {
                true => parameters.set_item(name, values)?,
                false => parameters.set_item(name, values[0])?,
            }
        }
        Ok(parameters)
    }

    /// The stretch below which the energy is continued, or None.
    #[getter]
    fn extend(&self) -> Option<f64> {
        match self.inversion {
            Inversion::Refuse => None,
            Inversion::Extend { epsilon } => Some(epsilon),
        }
    }

    /// Number of points whose parameters are given one by one, or None for one material at all points.
    #[getter]
    fn points(&self) -> Option<usize> {
        self.each().map(<[_]>::len)
    }

    /// Moduli at small strain, Pa, and Poisson's ratio: those of the first point, where parameters differ.
    #[getter]
    fn moduli<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let Moduli { mu, lambda } = self.moduli;
        let (bulk, young, poisson) = (self.moduli.bulk(), self.moduli.young(), self.moduli.poisson());
        py.import("piola.results")?.call_method1("Moduli", (mu, lambda, bulk, young, poisson))
    }

    fn __repr__(&self) -> String {
        let shown = |(name, values): &(String, Vec<f64>)| match values.as_slice() {
            [value] => format!("{name}={value:?}"),
            values => format!("{name}={values:?}"),
        };
        let parameters = self.values.iter().map(shown);
        let extend = self.extend().map(|epsilon| format!("extend={epsilon:?}"));
        let arguments: Vec<_> = parameters.chain(extend).collect();
        format!("<piola.Material {}({})>", self.name, arguments.join(", "))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
        let text =
            serde_json::to_string(slf.get().uniform()?).map_err(|error| type_error(error.to_string()))?;
        Ok((slf.get_type().getattr("_from_text")?, (text,)))
    }

    /// The material that `__reduce__` has written.
    #[staticmethod]
    fn _from_text(text: &str) -> PyResult<Self> {
        let spec: MaterialSpec =
            serde_json::from_str(text).map_err(|error| MaterialError::new_err(error.to_string()))?;
        let extend = spec_extension(&spec)?;
        Self::new(spec, extend)
    }
}

/// The threshold that a written specification holds.
fn spec_extension(spec: &MaterialSpec) -> PyResult<Option<f64>> {
    let value = serde_json::to_value(spec).map_err(|error| MaterialError::new_err(error.to_string()))?;
    Ok(value["inversion"]["extend"].as_f64())
}

/// A material of an energy that a text declares.
///
///     declare(text, /, *, extend=None, free_rest=False, **parameters)
///
/// text: a formula in the notation of papers, such as "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2", in the
///     stretches l1, l2, l3 or the invariants I1, I2, J, I1b, I2b, with conditions behind `where`; or the
///     function in Rust that piola's attribute `material` takes, which has documentation, domain and more.
/// free_rest: whether a formula gets a term in ln J that frees the rest state of stress.
/// extend, parameters: as of Material.
///
/// Raises DeclarationError with all mistakes of the text, each at its place, and MaterialError as Material.
#[pyfunction]
#[pyo3(signature = (text, /, *, extend = None, free_rest = false, **parameters))]
pub(crate) fn declare(
    py: Python<'_>,
    text: &str,
    extend: Option<f64>,
    free_rest: bool,
    parameters: Option<&Bound<'_, PyDict>>,
) -> PyResult<Material> {
    let energy = py.detach(|| match text.contains("#[") {
        true => Energy::from_rust(text),
        false => Energy::from_formula_with(text, &FormulaOptions::default().with_free_rest(free_rest)),
    });
    let spec = MaterialSpec::declared(energy.map_err(of_text)?);
    Material::from_keywords(py, spec, extend, parameters)
}
