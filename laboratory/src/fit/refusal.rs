//! Why there is no fit at some parameters.

use std::fmt;
use std::mem::discriminant;

use piola::material::Inadmissible;

use crate::data::Unanswered;

/// Why parameters have no curves to compare with the data.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// The constructor of the energy refuses them.
    Inadmissible(
        /// Why.
        Inadmissible,
    ),
    /// A measured point has no stress.
    Unanswered(
        /// Which, and why.
        Unanswered,
    ),
}

impl Refusal {
    /// Whether the reason is the same but for the numbers in it.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        use Inadmissible::Violated;
        match (self, other) {
            (
                Self::Inadmissible(Violated { condition: one, .. }),
                Self::Inadmissible(Violated { condition: other, .. }),
            ) => one == other,
            (Self::Inadmissible(one), Self::Inadmissible(other)) => discriminant(one) == discriminant(other),
            (Self::Unanswered(one), Self::Unanswered(other)) => {
                discriminant(&one.reason) == discriminant(&other.reason)
            }
            _ => false,
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Inadmissible(reason) => reason.fmt(f),
            Self::Unanswered(unanswered) => unanswered.fmt(f),
        }
    }
}
