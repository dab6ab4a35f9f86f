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

    /// The entries of lists that a constructor speaks of, each with its name among the numbers, which count from 1:
    /// `beta[0]` and `beta_1`.
    pub(super) fn entries(&self) -> Vec<(&str, String)> {
        let Self::Inadmissible(Inadmissible::Violated { given, .. }) = self else { return Vec::new() };
        let entry = |given| {
            let (entry, _value) = str::split_once(given, " = ")?;
            let (list, index) = entry.strip_suffix(']')?.split_once('[')?;
            Some((entry, format!("{list}_{}", index.parse::<usize>().ok()? + 1)))
        };
        given.split(", ").filter_map(entry).collect()
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
        let given = |given: &str| {
            Refusal::Inadmissible(Inadmissible::Violated { condition: "", given: given.into() })
        };
        let names = [("mu[0]", "mu_1".to_owned()), ("alpha[11]", "alpha_12".to_owned())];
        assert_eq!(given("mu[0] = -1, kappa = 2, alpha[11] = 0.5").entries(), names);
        assert_eq!(given("kappa = 2").entries(), []);
    }
}
