//! Errors of scenes.

use std::io;
use std::path::PathBuf;

use piola::__private::message::{number, quoted};
use piola::material::{MaterialError, Text, Unit};
use piola_bodies::mesh::ReadError;
use piola_bodies::step::{NewtonError, SetupError, StepError};
use piola_bodies::system::{BodyError, PinError};
use piola_declare::emit::EmitError;
use piola_declare::{Mistakes, nearest};

use crate::region::RegionError;

/// Error that prevents a scene from starting or continuing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No scene, body or material has that name.
    #[error("there is no {kind} `{}`; choose one of {}", quoted(name), list(known))]
    Unknown {
        /// `scene`, `body` or `material`.
        kind: &'static str,
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// An option for random starts is given for a scene with another start.
    #[error("the scene `{scene}` does not use {option}: only {} displace nodes at random", list(known))]
    NotScrambled {
        /// The option, such as `--seed`.
        option: &'static str,
        /// The scene.
        scene: &'static str,
        /// The scenes that start at random.
        known: Vec<&'static str>,
    },
    /// A file that is to declare an energy cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    UnreadableDeclaration {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// An energy has mistakes.
    #[error("{0}")]
    Declaration(Mistakes),
    /// A value of a parameter is given in a unit that the parameter does not have.
    #[error("the parameter `{}` is {}, but its value is given {}; write another unit after it, or none",
        quoted(parameter), in_words(*declared), in_words(*unit))]
    UnitOfParameter {
        /// The parameter.
        parameter: String,
        /// The kind of unit that is given.
        unit: Unit,
        /// The kind of unit that the parameter has.
        declared: Unit,
    },
    /// A value of a parameter of a formula has no unit, while the units of other values imply one.
    #[error("the parameter `{}` is {}, because other values have units, but its own value has none; write it with its unit, \
        such as `{given}{}MPa`, or `{given}{}Pa`",
        quoted(parameter), in_words(*unit), division(*unit), division(*unit))]
    WithoutUnit {
        /// The parameter.
        parameter: String,
        /// Its name and value as given, such as `mu=0.4`.
        given: String,
        /// The kind of unit that the formula implies.
        unit: Unit,
    },
    /// An energy cannot be printed in another language.
    #[error(transparent)]
    Emit(#[from] EmitError),
    /// The material has no parameter of that name.
    #[error(
        "{material} has no parameter `{}`; {} has {}",
        quoted(parameter),
        near_or_it(parameter, known),
        list(known)
    )]
    UnknownParameter {
        /// Name of the material.
        material: Text,
        /// The name as given.
        parameter: String,
        /// The names that exist.
        known: Vec<Text>,
    },
    /// A parameter has no value, and there is no default that suits everybody.
    #[error("{material} needs a value for {}", list(missing))]
    MissingParameters {
        /// Name of the material.
        material: Text,
        /// The names without a value.
        missing: Vec<Text>,
    },
    /// The material refuses its parameters.
    #[error("{material}: {source}")]
    Inadmissible {
        /// Name of the material.
        material: Text,
        /// Reason.
        source: MaterialError,
    },
    /// A value of the settings is out of range.
    #[error("{quantity} is {}; it must be {requirement}", number(*value))]
    OutOfRange {
        /// Name of the quantity, such as "the time step".
        quantity: &'static str,
        /// The value as given.
        value: f64,
        /// Requirement that the value breaks.
        requirement: &'static str,
    },
    /// The body starts outside of the domain of its material.
    #[error(
        "the scene `{scene}` starts where `{material}` is not defined: its domain is {domain}{}",
        refusal.as_ref().map(|reason| format!(", and it cannot be extended: {reason}")).unwrap_or_default()
    )]
    StartOutsideDomain {
        /// Name of the scene.
        scene: &'static str,
        /// Name of the material.
        material: Text,
        /// Domain of the material.
        domain: Text,
        /// Reason why the material cannot be extended beyond its domain; `None` for one that can be.
        refusal: Option<Text>,
        /// Names of the materials that can start there, with typical parameters.
        others: Vec<&'static str>,
    },
    /// A pin is neither a group of the mesh nor a box.
    #[error("`{}` is neither a group of the mesh (it has {}) nor a box; {source}", quoted(pin), list(groups))]
    UnknownPin {
        /// The text as given.
        pin: String,
        /// The groups of the mesh.
        groups: Vec<String>,
        /// Reason why it is not a box.
        source: RegionError,
    },
    /// A pin does not hold any node.
    #[error("the pin {pin} holds nothing: {source}")]
    Pin {
        /// The pin.
        pin: String,
        /// Reason.
        source: Box<PinError>,
    },
    /// The file of a mesh or a surface cannot be read or is malformed.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A mesh or a surface is unusable.
    #[error("{file}: {source}")]
    Geometry {
        /// The file, or the name of the body.
        file: String,
        /// Reason, without the name of the file.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// Mesh and material are not a valid body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The solver refuses a setting, a position or a velocity.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Files cannot be written to the folder; a new run is not begun in one that exists.
    #[error("cannot write to the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// Another run is writing to the folder.
    #[error("another run is writing to the folder {}; wait until it has ended", folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// No run to continue.
    #[error("the folder {} contains no run to continue", folder.display())]
    NothingToResume {
        /// The folder.
        folder: PathBuf,
    },
    /// The run in the folder cannot continue with these settings.
    #[error("the run in {} cannot continue: {reason}", folder.display())]
    Resume {
        /// The folder.
        folder: PathBuf,
        /// Reason.
        reason: String,
    },
    /// A signal has ended the run before its first step.
    #[error("the run was interrupted before its first step; nothing was written")]
    Interrupted,
    /// Threads cannot be started.
    #[error("cannot start threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// A file cannot be written although its folder could be.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// The equilibrium of a body that has not recovered cannot be examined.
    #[error("the equilibrium at the end cannot be examined: {0}")]
    Equilibrium(#[from] NewtonError),
    /// A moment belongs to another body.
    #[error("the state belongs to another body than {body}")]
    OtherBody {
        /// The body with which it should continue, or the file of its mesh.
        body: String,
    },
    /// No steps lead to such a moment.
    #[error("the state cannot be resumed: {0}")]
    Unsound(
        /// Reason.
        &'static str,
    ),
    /// A time step failed.
    #[error("the step to frame {frame} failed: {}", explained(source))]
    Step {
        /// The frame it would have led to.
        frame: usize,
        /// Error of the solver.
        source: StepError,
    },
}

/// A failed step in the words of scenes, which have options and no `Inversion`.
#[must_use]
pub fn explained(error: &StepError) -> String {
    match error {
        StepError::Newton(NewtonError::Inadmissible { element, stretches }) => {
            let [l1, l2, l3] = stretches.map(number);
            format!("element {element} is where its material is not defined: its stretches are {l1}, {l2}, {l3}")
        }
        StepError::Newton(NewtonError::NotPositive { .. }) => {
            "the matrix is not positive definite to working precision: elements are too flat for the stretch where the \
             extension begins, or the time step is too long"
                .into()
        }
        other => other.to_string(),
    }
}

/// A kind of unit in sentences.
fn in_words(unit: Unit) -> &'static str {
    match unit {
        Unit::Pascal => "in Pa",
        Unit::PerPascal => "in 1/Pa",
        _ => "without a unit",
    }
}

/// "it", after a question if a name is similar to a known one, with or without an index.
fn near_or_it(name: &str, known: &[Text]) -> String {
    let known = || known.iter().map(|known| &**known);
    let without_index = name.trim_end_matches(|c: char| c == '_' || c.is_ascii_digit());
    let near = nearest(name, known()).or_else(|| nearest(without_index, known()));
    near.map_or_else(|| "it".to_owned(), |near| format!("did you mean `{}`? It", quoted(near)))
}

/// The sign between a value and the stress that its unit is made of.
fn division(unit: Unit) -> &'static str {
    if unit == Unit::PerPascal { "/" } else { "" }
}

/// Names in backquotes with commas, or "none".
fn list(names: &[impl AsRef<str>]) -> String {
    match names {
        [] => "none".into(),
        names => {
            names.iter().map(|name| format!("`{}`", quoted(name.as_ref()))).collect::<Vec<_>>().join(", ")
        }
    }
}
