//! Errors of setting up and stepping a simulation, and of the minimisations in a step.

use piola::__private::message::number;
use piola::NoSuchNode;
use thiserror::Error;

use crate::system::LinearError;

/// Reason why a simulation cannot be set up or changed, in words.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{0}")]
pub struct SetupError(pub(super) String);

impl From<NoSuchNode> for SetupError {
    fn from(error: NoSuchNode) -> Self {
        Self(error.to_string())
    }
}

impl From<LinearError> for SetupError {
    fn from(error: LinearError) -> Self {
        Self(error.to_string())
    }
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
    /// Nothing holds a body that shall come to equilibrium, and the loads on it do not balance.
    #[error(
        "no pin, spring or term holds the body, and gravity and given forces add up to {} N, so that it has no \
         equilibrium; pin some of its nodes, or take time steps",
        number(*force)
    )]
    Unheld {
        /// Norm of the sum of gravity and given forces, N.
        force: f64,
    },
    /// The minimisation failed.
    #[error("{0}")]
    Newton(#[from] NewtonError),
}

/// Reason why Newton's method failed.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum NewtonError {
    /// An element is outside the domain of its material at the start.
    #[error(
        "element {element} is outside the domain of its material before the step: its stretches are {} \
         (`Inversion::Extend` continues an energy beyond J > 0 only: other conditions of its domain must hold)",
        stretches.map(number).join(", ")
    )]
    Inadmissible {
        /// Tag of the element.
        element: usize,
        /// Its principal stretches; NaN if unknown.
        stretches: [f64; 3],
    },
    /// The energy, a force or the stiffness of an element is infinite or NaN at the start, although its
    /// material admits its deformation.
    #[error(
        "the energy or a force of element {element} is not finite before the step: the deformation, the moduli of \
         the material or the reciprocal of its `epsilon` exceed the range of f64"
    )]
    ElementNotFinite {
        /// Tag of the element.
        element: usize,
    },
    /// The motion of the pins alone takes an element out of the domain of its material.
    #[error(
        "the motion of the pins takes element {element} out of the domain of its material; take shorter time steps"
    )]
    PinsMoveTooFar {
        /// Tag of the element.
        element: usize,
    },
    /// A term has no energy before the step, or after the pins have moved.
    #[error(
        "term {term} (from 0) has no finite energy before the step or where the pins move; set positions that it \
         admits, or take shorter time steps"
    )]
    TermRefuses {
        /// Index of the term, from 0.
        term: usize,
    },
    /// A term uses a node that does not exist.
    #[error("second derivatives of a term: {0}")]
    NoSuchNode(#[from] NoSuchNode),
    /// The matrix is not positive definite with any multiple of inertia added.
    #[error(
        "the matrix is not positive definite at node {node} (from 0), even with {shift:e} times the inertia added; \
         where elements are so flat that the energy's derivatives differ by more orders of magnitude than f64 has \
         digits, extend it from a greater `epsilon`, or begin less flat"
    )]
    NotPositive {
        /// The node in whose unknowns a pivot fails.
        node: usize,
        /// The largest multiple of inertia that was tried.
        shift: f64,
    },
    /// A gradient, a direction or a slope is infinite or NaN.
    #[error("a force or the Newton direction is not finite; the motion exceeds the range of f64")]
    NotFinite,
    /// No step along a direction of descent decreases the objective.
    #[error(
        "no step down to {step:e} of the Newton direction decreases the energy (residual {residual:e} N, {refused} \
         trials outside the domain of a material{})",
        if *step > 0.0 { "" } else { "; the `longest_step` of a term is not above 0" }
    )]
    LineSearch {
        /// The smallest step tried.
        step: f64,
        /// Number of trials that left the domain of a material.
        refused: usize,
        /// Norm of the gradient, N.
        residual: f64,
    },
    /// The energy of a term or of the materials does not change along the Newton direction as its gradient
    /// predicts, so that no step decreases the sum.
    #[error(
        "the gradient of {} does not fit its energy: look for a wrong sign or factor, or rounding errors beyond those \
         of `Term::change` (`check_term` of piola-bodies finds it, or the contract of the material)",
        term.map_or("a material".into(), |term| format!("term {term} (from 0)"))
    )]
    WrongGradient {
        /// Index of the term, from 0; `None` for the materials.
        term: Option<usize>,
    },
    /// The answer of a user-defined linear solver is no closer to the solution of A x = b than x = 0, in the
    /// norm of A, also with inertia added to A.
    #[error(
        "the linear solver does not solve A x = b, not even with inertia added: ‖b − A x‖ is {} times ‖b‖; \
         `LowerTriangle::multiply` computes A x",
        number(*residual)
    )]
    NotSolved {
        /// ‖b − A x‖/‖b‖.
        residual: f64,
    },
    /// The linear solver failed for another reason.
    #[error("{0}")]
    Linear(#[from] LinearError),
}

/// A time step with the reason why it is refused.
fn wrong(dt: f64) -> String {
    if dt > 0.0 && dt.is_finite() {
        format!("{dt:e} s, so short that mass over its square overflows; take a longer one")
    } else {
        format!("{} s; it must be positive and finite", number(dt))
    }
}
