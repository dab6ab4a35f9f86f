//! Notations of remedies: they quote what the author of an energy writes.

/// Notation in which an energy is declared, and in which the remedies of its violations are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Notation {
    /// Rust: the arguments of [`material`](macro@crate::material) and of [`contract!`](crate::contract!).
    #[default]
    Rust,
    /// A formula, as the command `piola` and the Python package read it: conditions follow `where`.
    Formula,
}

impl Notation {
    /// One of two texts: for declarations in Rust, and for formulas.
    pub(super) fn either(self, rust: &'static str, formula: &'static str) -> &'static str {
        match self {
            Self::Rust => rust,
            Self::Formula => formula,
        }
    }

    /// Advice to leave out large stretches.
    pub(super) fn narrower(self) -> &'static str {
        self.either(
            "narrow the stretches of the test, as in `range: (0.7, 1.4)`",
            "exclude large stretches by a condition after the formula, such as `where J > 0, I1 < 9`",
        )
    }
}
