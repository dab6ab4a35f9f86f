//! Why there is no fit at some parameters.

use std::fmt;
use std::mem::discriminant;

use piola::material::{Given, Inadmissible};

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

    /// The entries of lists that a constructor speaks of, each with its name among the numbers, which count from 1:
    /// `beta[0]` and `beta_1`.
    pub(super) fn entries(&self) -> Vec<(String, String)> {
        let Self::Inadmissible(Inadmissible::Violated { given, .. }) = self else { return Vec::new() };
        let names = |given: &Given| Some((given.name(), format!("{}_{}", given.parameter, given.index? + 1)));
        given.iter().filter_map(names).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_lists_go_by_the_names_of_numbers() {
        let given =
            vec![Given::entry("mu", 0, -1.0), Given::scalar("kappa", 2.0), Given::entry("alpha", 11, 0.5)];
        let violated = Refusal::Inadmissible(Inadmissible::Violated { condition: "", given });
        let names = [("mu[0]", "mu_1"), ("alpha[11]", "alpha_12")];
        assert_eq!(violated.entries(), names.map(|(entry, number)| (entry.to_owned(), number.to_owned())));
    }
}
