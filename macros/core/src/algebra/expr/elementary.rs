//! The names of elementary functions besides ln, exp and powers.

/// An elementary function with a kernel of its own, and one for its divided difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each is named like the method of `f64`")]
pub enum Elementary {
    Asinh,
    Atan,
    Cos,
    Cosh,
    Erf,
    ExpM1,
    Ln1p,
    /// σ(x) = 1/(1 + e⁻ˣ).
    Sigmoid,
    Sin,
    Sinh,
    /// ln(1 + eˣ).
    Softplus,
    Tanh,
}

impl Elementary {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Asinh,
        Self::Atan,
        Self::Cos,
        Self::Cosh,
        Self::Erf,
        Self::ExpM1,
        Self::Ln1p,
        Self::Sigmoid,
        Self::Sin,
        Self::Sinh,
        Self::Softplus,
        Self::Tanh,
    ];

    /// Its name as a method, in declarations and of `Real`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Asinh => "asinh",
            Self::Atan => "atan",
            Self::Cos => "cos",
            Self::Cosh => "cosh",
            Self::Erf => "erf",
            Self::ExpM1 => "exp_m1",
            Self::Ln1p => "ln_1p",
            Self::Sigmoid => "sigmoid",
            Self::Sin => "sin",
            Self::Sinh => "sinh",
            Self::Softplus => "softplus",
            Self::Tanh => "tanh",
        }
    }

    /// The function of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|function| function.name() == name)
    }

    /// Its value at zero if that is a whole number.
    pub(crate) fn at_zero(self) -> Option<i64> {
        match self {
            Self::Cos | Self::Cosh => Some(1),
            Self::Sigmoid | Self::Softplus => None,
            _ => Some(0),
        }
    }

    /// True if its values are positive.
    pub(crate) fn is_positive(self) -> bool {
        matches!(self, Self::Cosh | Self::Sigmoid | Self::Softplus)
    }
}
