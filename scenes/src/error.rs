//! Why a scene cannot start or go on.

use std::io;
use std::path::PathBuf;

use piola::material::MaterialError;
use piola::mesh::ReadError;
use piola::step::{NewtonError, SetupError, StepError};
use piola::system::{BodyError, PinError};

use crate::region::RegionError;

/// Why a scene cannot start or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// No scene has that name.
    #[error("there is no scene `{name}`; choose one of {}", list(known))]
    UnknownScene {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// No body has that name.
    #[error("there is no body `{name}`; choose one of {}", list(known))]
    UnknownBody {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// No material has that name.
    #[error("there is no material `{name}`; choose one of {}", list(known))]
    UnknownMaterial {
        /// The name as given.
        name: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// The material has no parameter of that name.
    #[error("{material} has no parameter `{parameter}`; it has {}", list(known))]
    UnknownParameter {
        /// Name of the material.
        material: &'static str,
        /// The name as given.
        parameter: String,
        /// The names that exist.
        known: Vec<&'static str>,
    },
    /// A parameter was given no value, and none is right for everybody.
    #[error("{material} needs a value for {}", list(missing))]
    MissingParameters {
        /// Name of the material.
        material: &'static str,
        /// The names without a value.
        missing: Vec<&'static str>,
    },
    /// The material refuses its parameters.
    #[error("{material}: {source}")]
    Inadmissible {
        /// Name of the material.
        material: &'static str,
        /// Reason.
        source: MaterialError,
    },
    /// A value of the settings is out of range.
    #[error("{quantity} is {value}; it must be {requirement}")]
    OutOfRange {
        /// Name of the quantity, such as "the time step".
        quantity: &'static str,
        /// The value as given.
        value: f64,
        /// Requirement that the value breaks.
        requirement: &'static str,
    },
    /// A pin is neither a group of the mesh nor a box.
    #[error("`{pin}` is neither a group of the mesh (it has {}) nor a box; {source}", list(groups))]
    UnknownPin {
        /// The text as given.
        pin: String,
        /// The groups of the mesh.
        groups: Vec<String>,
        /// Reason why it is not a box.
        source: RegionError,
    },
    /// A pin holds no node.
    #[error("the pin {pin} holds nothing: {source}")]
    Pin {
        /// Which one.
        pin: String,
        /// Why.
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
    /// Mesh and material make no body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The solver refuses a setting, a position or a velocity.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// Files cannot be written to the folder.
    #[error("cannot write to the folder {}: {source}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
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
        /// The body that it was to go on with, or the file of its mesh.
        body: String,
    },
    /// No steps lead to such a moment.
    #[error("the state cannot be resumed: {0}")]
    Unsound(
        /// Reason.
        &'static str,
    ),
    /// A time step failed.
    #[error("the step to frame {frame} failed: {source}")]
    Step {
        /// The frame it would have led to.
        frame: usize,
        /// Error of the solver.
        source: StepError,
    },
}

/// Names in backquotes with commas, or "none".
fn list(names: &[impl AsRef<str>]) -> String {
    match names {
        [] => "none".into(),
        names => names.iter().map(|name| format!("`{}`", name.as_ref())).collect::<Vec<_>>().join(", "),
    }
}
