//! Errors of scenes.

use std::io;
use std::ops::RangeInclusive;
use std::path::PathBuf;

use piola::__private::message::{number, quoted};
use piola::material::{MaterialError, Text};
use piola_bodies::mesh::ReadError;
use piola_bodies::step::{NewtonError, SetupError, StepError};
use piola_bodies::system::BodyError;
use piola_declare::Mistakes;
use piola_declare::emit::EmitError;

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
    /// The program cannot do what it is told, for this reason and with this remedy.
    #[error("{0}")]
    Usage(
        /// Reason and remedy.
        String,
    ),
    /// An energy has mistakes.
    #[error("{0}")]
    Declaration(Mistakes),
    /// An energy cannot be printed in another language.
    #[error(transparent)]
    Emit(#[from] EmitError),
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
    /// The file of a mesh or a surface cannot be read or is malformed.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Mesh and material are not a valid body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// The solver refuses a setting, a position or a velocity.
    #[error(transparent)]
    Setup(#[from] SetupError),
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
    /// A time step failed.
    #[error("the step to frame {frame} failed: {}", explained(source))]
    Step {
        /// The frame it would have led to.
        frame: usize,
        /// Error of the solver.
        source: StepError,
    },
}

/// Checks that a value is in its range; NaN is in none.
pub(crate) fn in_range(
    quantity: &'static str,
    value: f64,
    range: RangeInclusive<f64>,
    requirement: &'static str,
) -> Result<(), Error> {
    match range.contains(&value) {
        true => Ok(()),
        false => Err(Error::OutOfRange { quantity, value, requirement }),
    }
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

/// Names in backquotes with commas, or "none".
pub(crate) fn list(names: &[impl AsRef<str>]) -> String {
    match names {
        [] => "none".into(),
        names => {
            names.iter().map(|name| format!("`{}`", quoted(name.as_ref()))).collect::<Vec<_>>().join(", ")
        }
    }
}
