//! Errors of an energy with trial parameters.

use piola::material::{Argument, MaterialError};

use crate::data::PointError;

/// Reason why an energy with trial parameters has no curves to compare with the data.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(transparent)]
pub enum TrialError {
    /// The constructor of the energy refuses the parameters.
    Inadmissible(
        /// Its reason.
        #[from]
        MaterialError,
    ),
    /// A measured point has no stress.
    Point(
        /// The point and the reason.
        #[from]
        PointError,
    ),
}

impl TrialError {
    /// The entries of lists that a constructor names, each with its name among the numbers, which count from
    /// 1: `beta[0]` and `beta_1`.
    pub(super) fn entries(&self) -> Vec<(String, String)> {
        let Self::Inadmissible(MaterialError::Violated { given, .. }) = self else { return Vec::new() };
        let names =
            |given: &Argument| Some((given.name(), format!("{}_{}", given.parameter, given.index? + 1)));
        given.iter().filter_map(names).collect()
    }
}
