//! Errors of a run.

use std::cell::RefCell;
use std::io;
use std::path::PathBuf;
use std::rc::Rc;

use piola_bodies::step::{NewtonError, SetupError, StepError};
use piola_bodies::system::{BodyError, LinearError};
use piola_scenes::error::explained;

use crate::petsc::PetscError;

/// Reason why a run cannot begin or continue.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// Failure of a rank, reported on all ranks.
    #[error("{message}")]
    OnRank {
        /// Number of the first rank that failed, from 0.
        rank: usize,
        /// Error message of that rank.
        message: String,
    },
    /// Failure of PETSc, possibly on this rank alone.
    #[error(transparent)]
    Petsc(#[from] PetscError),
    /// Options that no part of PETSc has used.
    #[error(
        "PETSc does not use {}: the name is misspelt, or belongs to a solver that is not in use",
        names.iter().map(|name| format!("-{name}")).collect::<Vec<_>>().join(", ")
    )]
    UnusedOptions {
        /// Names without their dash.
        names: Vec<String>,
    },
    /// Fewer elements than ranks.
    #[error(
        "{ranks} ranks cannot share {elements} elements: use at most as many ranks as there are elements"
    )]
    TooManyRanks {
        /// Number of ranks.
        ranks: usize,
        /// Number of elements.
        elements: usize,
    },
    /// The scene, its body or its material cannot be simulated.
    #[error(transparent)]
    Scene(#[from] piola_scenes::error::Error),
    /// The part of the mesh on a rank is not a body.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// A setting is out of range.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A matrix does not fit into memory, perhaps on this rank alone.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// Invalid options, files or combinations of options.
    #[error("{0}")]
    Options(String),
    /// A step fails, on all ranks.
    #[error("{}{}", explained(.0), remedy(.0))]
    Step(#[from] StepError),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// Checkpoint from which a run cannot continue.
    #[error("cannot continue from {}: {reason}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

impl Error {
    /// True if all ranks have this error, so that each can end normally.
    #[must_use]
    pub fn is_common(&self) -> bool {
        !matches!(self, Self::Petsc(_) | Self::Linear(_))
    }
}

/// Option that avoids an error, for a message.
fn remedy(error: &StepError) -> &'static str {
    match error {
        StepError::Newton(NewtonError::Inadmissible { .. }) => {
            " (`--inversion` continues energies beyond J > 0)"
        }
        _ => "",
    }
}

/// First error, since the last call of [`Failure::take`], of functions that cannot return it.
#[derive(Clone, Debug, Default)]
pub struct Failure(Rc<RefCell<Option<Error>>>);

impl Failure {
    /// Value of a result; an error is kept, unless an earlier one is.
    pub fn note<T, E: Into<Error>>(&self, result: Result<T, E>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                self.0.borrow_mut().get_or_insert_with(|| error.into());
                None
            }
        }
    }

    /// True if an error is kept.
    #[must_use]
    pub fn is_noted(&self) -> bool {
        self.0.borrow().is_some()
    }

    /// Removes the error, and returns it.
    ///
    /// # Errors
    /// The first [`Error`] that was noted.
    pub fn take(&self) -> Result<(), Error> {
        self.0.borrow_mut().take().map_or(Ok(()), Err)
    }
}
