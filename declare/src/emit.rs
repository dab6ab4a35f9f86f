//! Energies as source text of other languages: stress, tangent and projection of a point, in one file without
//! a dependency.
//!
//! The functions of [`piola::point`] run once, on a real number that records its operations, with the
//! programs of the energy inside; the record is printed. There is no second copy of the mathematics, and the
//! arithmetic is that of portable lanes, to the last bit.

#![expect(non_snake_case, reason = "F as in the literature")]

mod language;
mod printer;
mod signature;
mod steps;

use std::str::FromStr;

use piola::__private::record::{
    Recorded, RecordedFunction, RecordedMask, define, evaluate_tetrahedron, evaluate_vertex, record,
};
use piola::interpreter::Interpreted;
use piola::lanes::{Mask, Real, Truth};
use piola::material::{Blocks, Form, MaterialError, Text};
use piola::point::{Filter, evaluate_dense, evaluate_energy, evaluate_stress, svd};
use piola::{Inversion, Material, Status};

use crate::energy::Energy;
use signature::{Signature, Signatures, contradiction};

/// Languages of emitted source text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Target {
    /// C99, which is C++17 as well.
    C,
    /// CUDA, HIP and the native functions of Warp: C with the qualifiers of a device.
    Cuda,
    /// OpenCL C 1.2.
    OpenCl,
    /// WGSL, which has 32 bits alone.
    Wgsl,
}

impl FromStr for Target {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<Self, UnknownWord> {
        let all = [("c", Self::C), ("cuda", Self::Cuda), ("opencl", Self::OpenCl), ("wgsl", Self::Wgsl)];
        let known = "c, which C++ reads as well; cuda, also for HIP and Warp; opencl; wgsl";
        choice("target", word, &all, known)
    }
}

/// The number format of a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32 bits.
    F32,
    /// 64 bits.
    #[default]
    F64,
}

impl FromStr for Precision {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<Self, UnknownWord> {
        choice("precision", word, &[("f32", Self::F32), ("f64", Self::F64)], "f32, f64")
    }
}

/// A function of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PointFunction {
    /// ψ from F.
    Energy,
    /// P from F.
    Stress,
    /// P and the 81 entries of dP/dF from F.
    Tangent,
    /// P and dP/dF with its negative eigenvalues clamped to zero.
    Projected,
    /// P and dP/dF with the absolute values of its eigenvalues.
    Absolute,
    /// The gradient of a tetrahedron's energy and its stiffness, from nodes, Dm⁻¹ and volume.
    Tetrahedron,
    /// Gradient and stiffness of a tetrahedron, from dP/dF with its negative eigenvalues clamped to zero.
    ProjectedTetrahedron,
    /// The gradient of a tetrahedron's energy in the position of one node, and the node's block of the
    /// stiffness, from F and the node's row of Dm⁻¹.
    Vertex,
    /// The same, from dP/dF with its negative eigenvalues clamped to zero.
    ProjectedVertex,
    /// ψi, ψij, flips and twists from the signed stretches.
    Blocks,
    /// U, the signed stretches and V from F.
    Svd,
}

impl PointFunction {
    const TABLE: [(&str, Self); 11] = [
        ("energy", Self::Energy),
        ("stress", Self::Stress),
        ("tangent", Self::Tangent),
        ("projected", Self::Projected),
        ("absolute", Self::Absolute),
        ("tetrahedron", Self::Tetrahedron),
        ("projected_tetrahedron", Self::ProjectedTetrahedron),
        ("vertex", Self::Vertex),
        ("projected_vertex", Self::ProjectedVertex),
        ("blocks", Self::Blocks),
        ("svd", Self::Svd),
    ];

    /// All functions, in the order in which they are printed.
    pub const ALL: [Self; Self::TABLE.len()] = {
        let mut all = [Self::Energy; Self::TABLE.len()];
        let mut k = 0;
        while k < all.len() {
            all[k] = Self::TABLE[k].1;
            k += 1;
        }
        all
    };

    /// Word for the function, the last part of its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::TABLE[self as usize].0
    }
}

impl FromStr for PointFunction {
    type Err = UnknownWord;

    fn from_str(word: &str) -> Result<Self, UnknownWord> {
        choice("function", word, &Self::TABLE, &Self::ALL.map(Self::name).join(", "))
    }
}

/// Error of an unknown word for a choice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnknownWord(String);

/// The meaning of a word, one of these.
fn choice<T: Copy>(kind: &str, word: &str, all: &[(&str, T)], known: &str) -> Result<T, UnknownWord> {
    let found = all.iter().find(|(name, _)| *name == word);
    let unknown = || UnknownWord(format!("unknown {kind} `{word}`; known are: {known}"));
    found.map(|&(_, meaning)| meaning).ok_or_else(unknown)
}

/// Contents of a file, and its names.
///
/// ```
/// use piola::Inversion;
/// use piola_declare::Energy;
/// use piola_declare::emit::{Emission, PointFunction, Target};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let energy = Energy::from_formula("mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2")?;
/// let (prefix, functions) = (Some("rubber".into()), vec![PointFunction::Stress]);
/// let emission = Emission { prefix, functions, ..Emission::new(Target::C) };
/// let file = energy.emit(&[&[1e6], &[5e6]], Inversion::Refuse, &emission)?;
/// assert!(file.contains("unsigned rubber_stress(const rubber_parameters *p, const double F[9], double P[9])"));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Emission {
    /// The language.
    pub target: Target,
    /// The number format.
    pub precision: Precision,
    /// The first part of all names; `None` for the name of the energy in lower case.
    pub prefix: Option<String>,
    /// The functions of the file.
    pub functions: Vec<PointFunction>,
}

impl Emission {
    /// A file with all functions in `f64`, in WGSL in `f32`.
    #[must_use]
    pub fn new(target: Target) -> Self {
        let precision = if target == Target::Wgsl { Precision::F32 } else { Precision::F64 };
        Self { target, precision, prefix: None, functions: PointFunction::ALL.to_vec() }
    }
}

/// Reason why an energy cannot be printed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EmitError {
    /// The parameters are not admissible.
    #[error(transparent)]
    Parameters(#[from] MaterialError),
    /// A parameter is a function.
    #[error("the parameter `{0}` is a function, which cannot be printed: write its formula into the energy")]
    Function(Text),
    /// A prefix is not a name.
    #[error(
        "`{0}` is not a name: letters of ASCII, digits and `_` make one, a letter in front and no `_` at the end or next to another; choose another prefix"
    )]
    Prefix(String),
    /// The language has no numbers of that precision.
    #[error("WGSL has no numbers of 64 bits: choose the precision f32, or another target")]
    Precision,
    /// No function is requested.
    #[error("no function is requested; there are: {}", PointFunction::ALL.map(PointFunction::name).join(", "))]
    Nothing,
    /// A parameter selects the program, which cannot be recorded.
    #[error("a parameter of the energy decides on its program: write its value into the energy")]
    Unrecorded,
    /// A function of the file is not the one that its description says, which is a mistake of this library.
    #[error(
        "the function `{0}` has no single program with its arguments and results; please report this energy"
    )]
    Contradiction(&'static str),
}

/// Input of a printer: an energy with its programs and parameters.
struct File<'a> {
    energy: &'a Energy,
    target: Target,
    prefix: String,
    precision: Precision,
    /// Values of the parameters when the file was printed.
    values: &'a [&'a [f64]],
    inversion: Inversion,
    wanted: Vec<PointFunction>,
    /// The wanted functions, what they call, and `at_rest`.
    functions: Vec<RecordedFunction>,
    signatures: Signatures,
}

impl Energy {
    /// The energy as source text: a structure of its parameters, a check of them, and functions. The check
    /// also tests the arithmetic, and returns 1 if options of the compiler change it.
    ///
    /// The values are those of [`Energy::material`]. They fix lengths of lists, whole exponents and the
    /// threshold of an extension. All other parameters are read from the structure, and the values are there
    /// as an example.
    ///
    /// # Errors
    /// [`EmitError`].
    pub fn emit(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
        emission: &Emission,
    ) -> Result<String, EmitError> {
        let mut parameters = self.description().parameters.iter();
        if let Some(function) = parameters.find(|one| matches!(one.form, Form::Function | Form::Points)) {
            return Err(EmitError::Function(function.name.clone()));
        }
        let prefix = emission.prefix.clone().unwrap_or_else(|| snake_case(&self.description().name));
        if !printer::is_identifier(&prefix) {
            return Err(EmitError::Prefix(prefix));
        }
        if emission.functions.is_empty() {
            return Err(EmitError::Nothing);
        }
        if (emission.target, emission.precision) == (Target::Wgsl, Precision::F64) {
            return Err(EmitError::Precision);
        }
        // In `f32` a file has the numbers that are nearest, for which the conditions must hold as well.
        let is_single = emission.precision == Precision::F32;
        let nearest = |&x: &f64| if is_single { f64::from(x as f32) } else { x };
        let nearest = |list: &&[f64]| list.iter().map(nearest).collect();
        let rounded: Vec<Vec<f64>> = values.iter().map(nearest).collect();
        let values: Vec<&[f64]> = rounded.iter().map(Vec::as_slice).collect();
        let material = self.with_marked_parameters(&self.material(&values, inversion)?);
        let Emission { target, precision, .. } = *emission;
        let mut wanted = emission.functions.clone();
        wanted.sort_unstable();
        wanted.dedup();
        let functions = record(is_single, || {
            at_rest(&self.without_extension(&material));
            wanted.iter().for_each(|&function| define_function(function, &material));
        });
        let (functions, signatures) = (functions.ok_or(EmitError::Unrecorded)?, Signature::all());
        if let Some(name) = contradiction(&signatures, &functions) {
            return Err(EmitError::Contradiction(name));
        }
        let (energy, values) = (self, &values[..]);
        let file =
            File { energy, target, prefix, precision, values, inversion, wanted, functions, signatures };
        Ok(printer::print(&file))
    }
}

/// Runs a function of a point once.
fn define_function(function: PointFunction, material: &Interpreted) {
    let (name, zero) = (function.name(), Recorded::splat(0.0));
    let F = [[zero; 3]; 3];
    let failed = |refused, nonfinite| {
        let no = RecordedMask::splat(false);
        Status { refused, bounded: no, nonfinite, filtered: no }
    };
    let dense = |filter| {
        define(name, F, |F| {
            let point = evaluate_dense(material, &F, filter);
            (point.stress, point.tangent, point.status)
        });
    };
    let tetrahedron = |filter| {
        let inputs = ([[zero; 3]; 4], [zero; 10]);
        define(name, inputs, |(nodes, rest)| evaluate_tetrahedron(material, nodes, rest, filter));
    };
    let vertex = |filter| {
        define(name, (F, [zero; 4]), |(F, rest)| evaluate_vertex(material, &F, rest, filter));
    };
    match function {
        PointFunction::Energy => {
            define(name, F, |F| {
                let point = evaluate_energy(material, &F);
                (point.energy, point.status)
            });
        }
        PointFunction::Stress => {
            define(name, F, |F| {
                let point = evaluate_stress(material, &F);
                (point.stress, point.status)
            });
        }
        PointFunction::Tangent => dense(Filter::None),
        PointFunction::Projected => dense(Filter::Clamp),
        PointFunction::Absolute => dense(Filter::Absolute),
        PointFunction::Tetrahedron => tetrahedron(Filter::None),
        PointFunction::ProjectedTetrahedron => tetrahedron(Filter::Clamp),
        PointFunction::Vertex => vertex(Filter::None),
        PointFunction::ProjectedVertex => vertex(Filter::Clamp),
        PointFunction::Blocks => {
            define(name, [zero; 3], |stretches| {
                let Blocks { gradient, hessian, flip, twist } = material.blocks(stretches);
                let numbers = [&gradient[..], &hessian, &flip, &twist].concat();
                let status = failed(!material.admits(stretches), !all_finite(&numbers));
                ((gradient, hessian, flip, twist), status)
            });
        }
        PointFunction::Svd => {
            define(name, F, |F| {
                let svd = svd(&F);
                (svd, failed(RecordedMask::splat(false), !all_finite(&svd.stretches)))
            });
        }
    }
}

/// Twice the shear modulus and three times the bulk modulus at rest, and true if rest is inside the domain.
fn at_rest(material: &Interpreted) {
    define("at_rest", [] as [Recorded; 0], |_| {
        let one = Recorded::splat(1.0);
        let blocks = material.blocks([one; 3]);
        let [h11, _, _, h12, ..] = blocks.hessian;
        (blocks.flip[0], h11 + h12 + h12, Truth(material.admits([one; 3])))
    });
}

fn all_finite<R: Real>(numbers: &[R]) -> R::Mask {
    numbers.iter().fold(R::Mask::splat(true), |all, number| all & number.is_finite())
}

/// A name in lower case, with `_` before what were capitals within it.
fn snake_case(name: &str) -> String {
    let mut text = String::new();
    let mut was_small = false;
    for c in name.chars() {
        if c.is_uppercase() && was_small {
            text.push('_');
        }
        was_small = !c.is_uppercase();
        text.extend(c.to_lowercase());
    }
    text
}
