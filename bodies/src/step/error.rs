//! Errors of setting up and stepping a simulation.

use std::fmt;

use piola::__private::message::number;
use piola::NoSuchNode;

use crate::step::newton::NewtonError;
use crate::system::LinearError;

/// Reason why a simulation cannot be set up.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// A pin or spring uses a node that does not exist.
    NoSuchNode(NoSuchNode),
    /// A motion is prescribed for a node that is not pinned.
    NotPinned {
        /// The node, from 0.
        node: usize,
    },
    /// Wrong length: an array does not have one entry for each node.
    Length {
        /// Number of nodes.
        expected: usize,
        /// Number of entries given.
        found: usize,
    },
    /// A vector of a node, such as its position, is infinite or NaN.
    NotFinite {
        /// The node, from 0.
        node: usize,
    },
    /// A spring has a negative or infinite stiffness, or an entry that is not finite.
    Spring {
        /// Index of the spring.
        index: usize,
    },
    /// A setting is out of range.
    Setting {
        /// The rule that it breaks.
        rule: &'static str,
    },
    /// The linear solver cannot be set up.
    Linear(LinearError),
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchNode(error) => error.fmt(f),
            Self::NotPinned { node } => {
                write!(f, "node {node} (from 0) is not pinned, so its motion cannot be prescribed")
            }
            Self::Length { expected, found } => {
                write!(f, "expected one entry for each of {expected} nodes, found {found}")
            }
            Self::NotFinite { node } => write!(f, "the entry of node {node} (from 0) is not finite"),
            Self::Spring { index } => {
                write!(f, "spring {index} (from 0) has a negative stiffness or an entry that is not finite")
            }
            Self::Setting { rule } => write!(f, "{rule}"),
            Self::Linear(error) => error.fmt(f),
        }
    }
}

crate::chained::wraps!(SetupError { NoSuchNode(NoSuchNode), Linear(LinearError) });

/// Reason why a step failed. The state before the step is untouched.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// The time step is not positive and finite, or so short that inertia, mass over its square, overflows.
    TimeStep {
        /// The time step, s.
        dt: f64,
    },
    /// The tolerance of adaptive steps is not positive and finite.
    Tolerance {
        /// The tolerance, m/s.
        tolerance: f64,
    },
    /// The minimisation failed.
    Newton(NewtonError),
}

impl fmt::Display for StepError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TimeStep { dt } if *dt > 0.0 && dt.is_finite() => write!(
                f,
                "the time step is {dt:e} s, so short that mass over its square overflows; take a longer one"
            ),
            Self::TimeStep { dt } => {
                write!(f, "the time step is {} s; it must be positive and finite", number(*dt))
            }
            Self::Tolerance { tolerance } => {
                write!(
                    f,
                    "the tolerance of steps is {} m/s; it must be positive and finite",
                    number(*tolerance)
                )
            }
            Self::Newton(error) => error.fmt(f),
        }
    }
}

crate::chained::wraps!(StepError { Newton(NewtonError) });
