//! Choice of the filter in each iteration of Newton's method.
//!
//! Without a filter Newton's method converges fastest, but its matrix is positive definite only near a
//! minimum. Clamped eigenvalues are safe everywhere; absolute ones are safer for an energy that curves
//! downwards, and slower otherwise. So the choice may depend on the matrix.

use piola::point::Filter;

/// Choice of the filter in each iteration of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Filtering {
    /// One filter in all iterations.
    Always(Filter),
    /// No filter if the matrix is positive definite without one, and clamped eigenvalues if it is not, which
    /// costs a second linearisation and factorisation. Compared with clamping always, it takes half the
    /// iterations or fewer if steps are solved to their end (`cargo speed-report --only steps`).
    OnDemand,
}

impl Filtering {
    /// The filter of the first linearisation of an iteration.
    pub(super) fn choice(self) -> Filter {
        match self {
            Self::Always(filter) => filter,
            Self::OnDemand => Filter::None,
        }
    }
}

#[cfg(test)]
mod tests;
