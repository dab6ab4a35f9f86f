//! Materials: an energy with its parameters, by its name in the catalogue or declared by a text.

use numpy::{IntoPyArray, PyArrayMethods, PyUntypedArrayMethods};
use piola::__private::message::printable;
use piola::Inversion;
use piola::batch::TileMaterial;
use piola::contract::Notation;
use piola::interpreter::Interpreted;
use piola::material::{self, Moduli, Parameter, PerPoint};
use piola_declare::emit::{Emission, UnknownWord};
use piola_declare::{Energy, FormulaOptions, Mistakes};
use piola_scenes::material::{MaterialInfo, MaterialSpec};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyTuple};

use crate::arrays::{Numbers, kind, read_only};
use crate::description::{Description, is_name, keyword, parameter_name, shown};
use crate::errors::{MaterialError, of_material, of_text, type_error, value_error};
use crate::shape;

/// An energy with its parameters.
///
///     Material(name, /, *, extend=None, **parameters)
///
/// name: the name in `catalogue()`; case, spaces, `_` and `-` do not matter.
/// extend: the stretch, between 0 and 1, below which the energy is continued, so that inverted elements are
///     ordinary ones; None to refuse points outside of its domain.
/// parameters: by the names of `describe(name)`, in its units: a number, or a sequence for a list. If they
///     differ from point to point they are arrays, which are broadcast with the shape of the points, by the
///     rules of numpy: of shape (...) for a number, (..., n) for a list of n. `lambda_` is the parameter
///     `lambda`, whose name is a keyword of Python. `matching` takes Young's modulus and Poisson's ratio
///     instead.
///
/// Raises MaterialError for an unknown name, and for parameters that are missing, unknown or out of range.
#[pyclass(frozen, module = "piola")]
pub(crate) struct Material {
    /// The energy by its name in the catalogue, or declared, with a value for each parameter.
    spec: MaterialSpec,
    /// With the first values of parameters that differ from point to point.
    pub(crate) double: Box<dyn TileMaterial<f64>>,
    /// Parameters that differ from point to point.
    varying: Vec<Varying>,
    /// The shape that these have together, that of a number if there are none.
    pub(crate) shape: Vec<usize>,
    /// The program of each point of this shape, in the order of C.
    pub(crate) each: Vec<Interpreted>,
}

/// A parameter that has a value of its own, or a list of them, at each point.
struct Varying {
    name: String,
    /// The shape as given, which that of the points begins.
    given: Vec<usize>,
    points: Vec<usize>,
    numbers: Vec<f64>,
}

/// A function and its arguments, which make a material again.
type Pickled<'py> = (Bound<'py, PyAny>, (String, Option<f64>));

impl Varying {
    fn at(&self, point: usize) -> &[f64] {
        let entries: usize = self.given[self.points.len()..].iter().product();
        &self.numbers[entries * point..][..entries]
    }
}

impl Material {
    /// The material of a specification, which has the first value of parameters that differ from point to
    /// point.
    fn new(spec: MaterialSpec, extend: Option<f64>, varying: Vec<Varying>) -> PyResult<Self> {
        let inversion = extend.map_or(Inversion::Refuse, |epsilon| Inversion::Extend { epsilon });
        let mut spec = spec.with_inversion(inversion).explicit().map_err(of_material)?;
        let MaterialInfo { name, elements: double, .. } = spec.build().map_err(of_material)?;
        spec.material = name.into_owned();
        let mut shape = Vec::new();
        for Varying { name, points, .. } in &varying {
            shape = shape::common(&shape, points).ok_or_else(|| {
                let (points, others) = (shape::text(points), shape::text(&shape));
                of_material(format!(
                    "`{name}` has values for points of the shape {points}, and the parameters before it for {others}: \
                     they cannot be broadcast together"
                ))
            })?;
        }
        let mut each = Vec::new();
        let count = shape.iter().try_fold(1, |count: usize, &length| count.checked_mul(length));
        let Some(count) = count.filter(|&count| each.try_reserve_exact(count).is_ok()) else {
            let shape = shape::text(&shape);
            return Err(MaterialError::new_err(format!(
                "there is no memory for parameters of the shape {shape}"
            )));
        };
        let entries: Vec<_> = varying.iter().map(|varying| shape::entries(&varying.points, &shape)).collect();
        for point in 0..count {
            let of_point = varying.iter().zip(&entries).fold(spec.clone(), |spec, (varying, entries)| {
                spec.with_parameter(&varying.name, varying.at(entries[point]))
            });
            let refused = |error| {
                let index = shape::text(&shape::index(point, &shape));
                of_material(format!("at index {index}: {error}"))
            };
            each.push(of_point.interpreted().map_err(refused)?);
        }
        Ok(Self { spec, double, varying, shape, each })
    }

    /// The material with parameters by keywords.
    fn from_keywords(
        mut spec: MaterialSpec,
        extend: Option<f64>,
        keywords: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let parameters = spec.description().map_err(of_material)?.parameters.clone();
        let mut all_varying = Vec::new();
        for (keyword, value) in keywords.into_iter().flatten() {
            let keyword: String = keyword.extract()?;
            let name = parameter_name(&keyword, |name| parameters.iter().any(|known| known.name == name));
            let (given, numbers) = shape_and_numbers(&keyword, &value)?;
            let parameter = parameters.iter().find(|known| known.name == name);
            let mut points = given.clone();
            if parameter.is_some_and(Parameter::is_list) {
                points.pop();
            }
            if parameter.is_none() || points.is_empty() {
                spec = spec.with_parameter(name, numbers);
                continue;
            }
            if points.contains(&0) {
                let given = shape::text(&given);
                return Err(of_material(format!("`{name}` has the shape {given}: it has no values")));
            }
            let varying = Varying { name: name.to_owned(), given, points, numbers };
            spec = spec.with_parameter(name, varying.at(0));
            all_varying.push(varying);
        }
        Self::new(spec, extend, all_varying)
    }

    /// The specification, if it is the same at all points.
    pub(crate) fn uniform(&self) -> PyResult<&MaterialSpec> {
        if self.varying.is_empty() {
            return Ok(&self.spec);
        }
        Err(MaterialError::new_err(format!(
            "{} has parameters of the shape {}; this needs one material for all points",
            self.name(),
            shape::text(&self.shape)
        )))
    }

    /// Materials for the elements of a body, as many as there are.
    pub(crate) fn elements(&self, count: usize) -> PyResult<Box<dyn TileMaterial<f64>>> {
        if self.varying.is_empty() {
            return Ok(self.spec.build().map_err(of_material)?.elements);
        }
        if shape::common(&self.shape, &[count]).is_none_or(|common| common != [count]) {
            return Err(MaterialError::new_err(format!(
                "{} has parameters of the shape {}, and there are {count} tetrahedra",
                self.name(),
                shape::text(&self.shape)
            )));
        }
        let materials: Vec<_> = self.at(&[count]).into_iter().cloned().collect();
        Ok(Box::new(PerPoint::new(materials).map_err(of_material)?))
    }

    /// The material of each of these points, to whose shape the parameters can be broadcast; none if they are
    /// the same at all points.
    pub(crate) fn at(&self, points: &[usize]) -> Vec<&Interpreted> {
        match self.varying[..] {
            [] => Vec::new(),
            _ => shape::entries(&self.shape, points).into_iter().map(|entry| &self.each[entry]).collect(),
        }
    }

    /// The material as a program, if it is the same at all points.
    pub(crate) fn program(&self) -> PyResult<&Interpreted> {
        self.uniform().map(|_| &self.each[0])
    }

    /// The declared energy, without values for its parameters.
    pub(crate) fn declaration(&self) -> PyResult<Energy> {
        Ok(self.spec.candidate().map_err(of_material)?.energy)
    }

    /// The material with the values of a fit.
    pub(crate) fn with_fitted(&self, values: &[Vec<f64>]) -> PyResult<Self> {
        Self::new(self.spec.with_fitted(values).map_err(of_material)?, self.extend(), Vec::new())
    }

    /// Description of the declaration.
    fn declared(&self) -> PyResult<&material::Description> {
        self.spec.description().map_err(of_material)
    }
}

/// The shape and the numbers of a value that a parameter is given.
fn shape_and_numbers(name: &str, value: &Bound<'_, PyAny>) -> PyResult<(Vec<usize>, Vec<f64>)> {
    if value.is_instance_of::<PyFloat>() {
        return Ok((Vec::new(), vec![value.extract()?]));
    }
    if value.is_instance_of::<PyBool>() {
        return Err(type_error(format!("`{name}` is {}; it must be a number", kind(value))));
    }
    let array = Numbers::new(&format!("`{name}`"), value)?.doubles()?;
    Ok((array.shape().to_vec(), array.to_vec()?))
}

#[pymethods]
impl Material {
    #[new]
    #[pyo3(signature = (name, /, *, extend = None, **parameters))]
    fn by_name(name: &str, extend: Option<f64>, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::from_keywords(MaterialSpec::new(name), extend, parameters)
    }

    /// The material of a name with its typical parameters, mostly those of a rubber.
    #[staticmethod]
    #[pyo3(signature = (name, /, *, extend = None))]
    fn typical(name: &str, extend: Option<f64>) -> PyResult<Self> {
        Self::new(MaterialSpec::typical(name).map_err(of_material)?, extend, Vec::new())
    }

    /// The material of a name with Young's modulus, Pa, and Poisson's ratio at small strain.
    ///
    /// One of its typical parameters is changed for Poisson's ratio, then those in Pa for Young's modulus.
    ///
    /// Raises MaterialError with the values that Poisson's ratio can have, if the wanted one is none of them.
    #[staticmethod]
    #[pyo3(signature = (name, /, *, young, poisson, extend = None))]
    fn matching(name: &str, young: f64, poisson: f64, extend: Option<f64>) -> PyResult<Self> {
        let moduli = Moduli::from_young_poisson(young, poisson).map_err(of_material)?;
        Self::new(MaterialSpec::matching(name, moduli), extend, Vec::new())
    }

    /// The material with other values of the parameters that are named.
    ///
    ///     changed(**parameters)
    ///
    /// Raises MaterialError like Material.
    #[pyo3(signature = (**parameters))]
    fn changed(&self, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::from_keywords(self.uniform()?.clone(), self.extend(), parameters)
    }

    /// The energy as source text, for kernels that link no library.
    ///
    ///     emit(target, *, precision=None, name=None, functions=None)
    ///
    /// target: "c" (C99 and C++17 alike), "cuda" (HIP and Warp, too), "opencl" or "wgsl".
    /// precision: "f64" or "f32"; None for "f64", in WGSL for "f32".
    /// name: the first part of all names; None for the name of the energy.
    /// functions: a sequence of "energy", "stress", "tangent", "projected", "absolute", "tetrahedron",
    ///     "projected_tetrahedron", "vertex", "projected_vertex", "blocks" and "svd"; None for all.
    ///
    /// Raises ValueError for an unknown word, and MaterialError for an energy that cannot be printed.
    #[pyo3(signature = (target, *, precision = None, name = None, functions = None))]
    fn emit(
        &self,
        target: &str,
        precision: Option<&str>,
        name: Option<String>,
        functions: Option<Vec<String>>,
    ) -> PyResult<String> {
        let unknown = value_error::<UnknownWord>;
        let mut emission = Emission::new(target.parse().map_err(unknown)?);
        if let Some(precision) = precision {
            emission.precision = precision.parse().map_err(unknown)?;
        }
        emission.prefix = name;
        if let Some(functions) = functions {
            let functions: Result<Vec<_>, _> = functions.iter().map(|word| word.parse()).collect();
            emission.functions = functions.map_err(unknown)?;
        }
        self.uniform()?.emit(&emission).map_err(of_material)
    }

    /// The name in the catalogue, or of the declaration.
    #[getter]
    fn name(&self) -> &str {
        &self.spec.material
    }

    /// Description of the energy.
    #[getter]
    fn description(&self) -> PyResult<Description> {
        Ok(Description::new(self.name(), self.declared()?))
    }

    /// The parameters by their keywords: a number each, or a list of numbers; arrays of those that differ
    /// from point to point.
    #[getter]
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parameters = PyDict::new(py);
        for parameter in self.declared()?.parameters.iter() {
            let (name, values) = (keyword(&parameter.name), self.spec.values_of(&parameter.name));
            match parameter.is_list() {
                true => parameters.set_item(name, values)?,
                false => parameters.set_item(name, values[0])?,
            }
        }
        for Varying { name, given, numbers, .. } in &self.varying {
            let name = keyword(name);
            parameters.set_item(name, read_only(numbers.clone().into_pyarray(py).reshape(&given[..])?)?)?;
        }
        Ok(parameters)
    }

    /// The stretch below which the energy is continued, or None.
    #[getter]
    fn extend(&self) -> Option<f64> {
        match self.spec.inversion {
            Some(Inversion::Extend { epsilon }) => Some(epsilon),
            _ => None,
        }
    }

    /// The shape of parameters that differ from point to point, with which points are broadcast; () for one
    /// material at all points.
    #[getter(shape)]
    fn shape_of_parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        PyTuple::new(py, &self.shape)
    }

    /// Moduli at small strain, Pa, and Poisson's ratio: those of the first point, if parameters differ.
    #[getter]
    fn moduli<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let moduli = Moduli::of(&self.each[0]);
        let (bulk, young, poisson) = (moduli.bulk(), moduli.young(), moduli.poisson());
        let Moduli { mu, lambda } = moduli;
        py.import("piola.results")?.call_method1("Moduli", (mu, lambda, bulk, young, poisson))
    }

    fn __repr__(&self) -> PyResult<String> {
        let argument = |parameter: &Parameter| {
            let (name, keyword) = (&*parameter.name, keyword(&parameter.name));
            let varying = self.varying.iter().find(|varying| varying.name == name);
            match (varying, self.spec.values_of(name)) {
                (Some(varying), _) => format!("{keyword}=<array of shape {}>", shape::text(&varying.given)),
                (None, [value]) => format!("{keyword}={value:?}"),
                (None, values) => format!("{keyword}={values:?}"),
            }
        };
        let parameters = self.declared()?.parameters.iter().map(argument);
        let extend = self.extend().map(|epsilon| format!("extend={epsilon:?}"));
        let arguments: Vec<_> = parameters.chain(extend).collect();
        Ok(format!("<piola.Material {}({})>", shown(self.name()), arguments.join(", ")))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Pickled<'py>> {
        let text = serde_json::to_string(slf.get().uniform()?).map_err(type_error)?;
        Ok((slf.get_type().getattr("_from_text")?, (text, slf.get().extend())))
    }

    /// The material that `__reduce__` has written.
    #[staticmethod]
    fn _from_text(text: &str, extend: Option<f64>) -> PyResult<Self> {
        let spec = serde_json::from_str(text).map_err(of_material)?;
        Self::new(spec, extend, Vec::new())
    }
}

/// A material of an energy that a text declares.
///
///     declare(text, /, *, name=None, extend=None, free_rest=False, **parameters)
///
/// text: a formula in the notation of papers, such as "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2", in the
///     stretches l1, l2, l3 or the invariants I1, I2, J, I1b, I2b, with conditions behind `where`; or the
///     function in Rust that piola's attribute `material` takes, which has documentation, domain and more.
/// name: name of the material, in messages too; None for the formula, or the name of the function.
/// free_rest: True to add a term in ln J that makes the rest state of a formula free of stress.
/// extend, parameters: as for Material. Names of a formula that are given here are parameters, regardless of
///     any other meaning: b, C and E for example.
///
/// Raises DeclarationError with all mistakes of the text, each at its place, and MaterialError like Material.
#[pyfunction]
#[pyo3(signature = (text, /, *, name = None, extend = None, free_rest = false, **parameters))]
pub(crate) fn declare(
    py: Python<'_>,
    text: &str,
    name: Option<&str>,
    extend: Option<f64>,
    free_rest: bool,
    parameters: Option<&Bound<'_, PyDict>>,
) -> PyResult<Material> {
    if name.is_some_and(|name| name.trim().is_empty()) {
        return Err(value_error("the name is empty; leave it out to call the material by its formula"));
    }
    Material::from_keywords(declared(py, text, name, free_rest, parameters)?, extend, parameters)
}

/// Description of an energy.
///
///     describe(energy, /, *, free_rest=False)
///
/// energy: a name in `catalogue()`, a `Material`, or a formula or function in Rust as for `declare`.
/// free_rest: as for `declare`, if a formula is given.
///
/// Raises MaterialError for an unknown name, and DeclarationError for a text with mistakes.
#[pyfunction]
#[pyo3(signature = (energy, /, *, free_rest = false))]
pub(crate) fn describe(py: Python<'_>, energy: &Bound<'_, PyAny>, free_rest: bool) -> PyResult<Description> {
    if let Ok(material) = energy.cast::<Material>() {
        return material.get().description();
    }
    let text: String = energy.extract().map_err(|_| {
        type_error(format!("energy is {}; it must be a name, a Material or a formula", kind(energy)))
    })?;
    let of_catalogue = MaterialSpec::new(&text);
    let spec = match of_catalogue.description() {
        Err(unknown) if is_name(&text) => return Err(of_material(unknown)),
        Err(_) => declared(py, &text, None, free_rest, None)?,
        Ok(_) => of_catalogue,
    };
    Ok(Description::new(&spec.material, spec.description().map_err(of_material)?))
}

/// The specification of an energy that a text declares; keywords only tell which names of a formula are
/// parameters.
fn declared(
    py: Python<'_>,
    text: &str,
    name: Option<&str>,
    free_rest: bool,
    keywords: Option<&Bound<'_, PyDict>>,
) -> PyResult<MaterialSpec> {
    let letters: String = py.import("piola.results")?.call_method1("as_identifiers", (text,))?.extract()?;
    let is_used =
        |name: &str| letters.split(|c: char| !c.is_alphanumeric() && c != '_').any(|word| word == name);
    let mut known = Vec::new();
    for (keyword, _) in keywords.into_iter().flatten() {
        let keyword: String = keyword.extract()?;
        known.push((parameter_name(&keyword, is_used).to_owned(), String::new()));
    }
    let (value, free_rest_option) = (Some("NAME=VALUE"), Some("free_rest=True"));
    let any = FormulaOptions { free_rest, value, free_rest_option, ..FormulaOptions::default() };
    let with_known = FormulaOptions { parameters: (!known.is_empty()).then_some(known), ..any.clone() };
    let energy = py.detach(|| match Energy::from_text_with(&letters, &with_known) {
        // Where keywords are missing or wrong the material says which parameters there are.
        Err(mistakes) if with_known != any => Energy::from_text_with(&letters, &any).map_err(|_| mistakes),
        energy => energy,
    });
    // Ctrl-C during the compilation ends here.
    py.check_signals()?;
    let energy = energy.map_err(|mistakes| match name {
        Some(name) => of_text(Mistakes { name: label(name), ..mistakes }),
        None => of_text(mistakes),
    })?;
    let formula = (energy.notation() == Notation::Formula).then_some(text);
    let mut spec = MaterialSpec::declared(energy);
    if let Some(name) = name.or(formula) {
        spec.material = label(name);
    }
    Ok(spec)
}

/// The name of a material in one line, not longer than a line.
fn label(name: &str) -> String {
    const LONGEST: usize = 100;
    let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", printable(&name[..end])),
        None => printable(&name),
    }
}
