//! Errors of a run.

use std::fmt::Display;

use piola_bodies::step::{NewtonError, StepError};
use piola_bodies::system::LinearError;
use piola_scenes::error::{Error as SceneError, explained};

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
    /// Invalid options, or a scene, a body, a setting or a file that cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A matrix does not fit into memory, perhaps on this rank alone.
    #[error(transparent)]
    Linear(#[from] LinearError),
    /// A step fails, on all ranks.
    #[error("{}{}", explained(.0), remedy(.0))]
    Step(#[from] StepError),
}

impl Error {
    /// Error of options or of the files that they name, with this message.
    #[must_use]
    pub fn usage(message: impl Display) -> Self {
        SceneError::Usage(message.to_string()).into()
    }

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
