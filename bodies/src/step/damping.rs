//! Damping of a motion in addition to that of implicit Euler.
//!
//! It is a term of the function that a step minimises, with h the time step and xₙ the positions before it:
//!
//! ```text
//! mass         α/(2h) ‖x − xₙ‖²_M          force −α M v
//! ```

/// Damping: forces against velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(rename_all = "snake_case", deny_unknown_fields)
)]
#[non_exhaustive]
pub enum Damping {
    /// No damping except that of implicit Euler.
    #[default]
    None,
    /// Mass-proportional damping: the force −α m v on each node slows every motion alike, falling too.
    Mass {
        /// Rate α, 1/s.
        rate: f64,
    },
}

impl Damping {
    /// Rate α, 1/s: 0 for [`Damping::None`].
    #[must_use]
    pub fn rate(self) -> f64 {
        match self {
            Self::Mass { rate } => rate,
            Self::None => 0.0,
        }
    }

    /// The rule that these settings break, if any.
    pub(super) fn broken_rule(self) -> Option<&'static str> {
        let rate = self.rate();
        (!(rate >= 0.0 && rate.is_finite())).then_some("damping must be finite and not negative")
    }
}
