//! Why a run cannot begin or go on.

use std::io;
use std::path::PathBuf;

use piola::step::{NewtonError, SetupError};
use piola::system::{BodyError, LinearError};

use crate::petsc::PetscError;

/// Why a run cannot begin or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A rank has failed, and all others have learnt of it.
    #[error("{message}")]
    OnRank {
        /// The first rank that has failed, from 0.
        rank: usize,
        /// What failed there.
        message: String,
    },
    /// PETSc has failed, perhaps on this rank alone.
    #[error(transparent)]
    Petsc(#[from] PetscError),
    /// Options that no part of PETSc has asked for.
    #[error(
        "PETSc has no use for {}: the name is misspelt, or belongs to a solver that is not in use",
        names.iter().map(|name| format!("-{name}")).collect::<Vec<_>>().join(", ")
    )]
    UnusedOptions {
        /// Names without their dash.
        names: Vec<String>,
    },
    /// There is less than an element for each rank.
    #[error(
        "{ranks} ranks cannot share {elements} elements: take as many ranks at most as there are elements"
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
    /// A combination of options that makes no sense.
    #[error("{0}")]
    Options(String),
    /// An element cannot be deformed as the step begins.
    #[error(
        "element {element} is outside the domain of its material before the step, or its energy is not finite \
         (`--inversion` continues energies beyond J > 0)"
    )]
    Inadmissible {
        /// Tag of the element.
        element: usize,
    },
    /// The matrix is not positive definite with any multiple of inertia added.
    #[error("the matrix is not positive definite, even with {shift:e} times the inertia added")]
    NotPositive {
        /// The largest multiple of inertia that was tried.
        shift: f64,
    },
    /// Newton's method fails for another reason, on all ranks.
    #[error(transparent)]
    Newton(#[from] NewtonError),
    /// A file cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// A checkpoint cannot be gone on from.
    #[error("cannot go on from {}: {reason}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// The reason.
        reason: String,
    },
}

impl Error {
    /// Whether no shorter step can help against this error: it may be of one rank alone, or is about options.
    #[must_use]
    pub fn is_final(&self) -> bool {
        !self.is_common() || matches!(self, Self::UnusedOptions { .. })
    }

    /// Whether all ranks have it, so that each can end in its turn.
    #[must_use]
    pub fn is_common(&self) -> bool {
        !matches!(self, Self::Petsc(_) | Self::Linear(_))
    }
}
