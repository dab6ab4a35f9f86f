//! Errors of setting up and stepping a simulation.

use piola::__private::message::number;
use piola::NoSuchNode;
use thiserror::Error;

use crate::step::newton::NewtonError;
use crate::system::LinearError;

/// Reason why a simulation cannot be set up.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// A pin or spring uses a node that does not exist.
    #[error("{0}")]
    NoSuchNode(#[from] NoSuchNode),
    /// A motion is prescribed for a node that is not pinned.
    #[error("node {node} (from 0) is not pinned, so its motion cannot be prescribed")]
    NotPinned {
        /// The node, from 0.
        node: usize,
    },
    /// Wrong length: an array does not have one entry for each node.
    #[error("expected one entry for each of {expected} nodes, found {found}")]
    Length {
        /// Number of nodes.
        expected: usize,
        /// Number of entries given.
        found: usize,
    },
    /// A vector of a node, such as its position, is infinite or NaN.
    #[error("the entry of node {node} (from 0) is not finite")]
    NotFinite {
        /// The node, from 0.
        node: usize,
    },
    /// A spring has a negative or infinite stiffness, or an entry that is not finite.
    #[error("spring {index} (from 0) has a negative stiffness or an entry that is not finite")]
    Spring {
        /// Index of the spring.
        index: usize,
    },
    /// A setting is out of range.
    #[error("{rule}")]
    Setting {
        /// The rule that it breaks.
        rule: &'static str,
    },
    /// The linear solver cannot be set up.
    #[error("{0}")]
    Linear(#[from] LinearError),
}

/// Reason why a step failed. The state before the step is untouched.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum StepError {
    /// The time step is not positive and finite, or so short that inertia, mass over its square, overflows.
    #[error("the time step is {}", wrong(*dt))]
    TimeStep {
        /// The time step, s.
        dt: f64,
    },
    /// The tolerance of adaptive steps is not positive and finite.
    #[error("the tolerance of steps is {} m/s; it must be positive and finite", number(*tolerance))]
    Tolerance {
        /// The tolerance, m/s.
        tolerance: f64,
    },
    /// The minimisation failed.
    #[error("{0}")]
    Newton(#[from] NewtonError),
}

/// A time step with the reason why it is refused.
fn wrong(dt: f64) -> String {
    if dt > 0.0 && dt.is_finite() {
        format!("{dt:e} s, so short that mass over its square overflows; take a longer one")
    } else {
        format!("{} s; it must be positive and finite", number(dt))
    }
}
