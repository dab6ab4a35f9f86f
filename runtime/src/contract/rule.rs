//! The rules by name, and what each of them asks for.

use std::fmt;

/// A rule of the contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Rule {
    /// See [`rest`](super::rest).
    Rest,
    /// See [`domain`](super::domain).
    Domain,
    /// See [`objectivity`](super::objectivity).
    Objectivity,
    /// See [`isotropy`](super::isotropy).
    Isotropy,
    /// See [`symmetric_tangent`](super::symmetric_tangent).
    SymmetricTangent,
    /// See [`stress_slope`](super::stress_slope).
    StressSlope,
    /// See [`tangent_slope`](super::tangent_slope).
    TangentSlope,
    /// See [`dual_numbers`](super::dual_numbers).
    DualNumbers,
    /// See [`quotients`](super::quotients).
    Quotients,
    /// See [`strains`](super::strains).
    Strains,
    /// See [`invariants`](super::invariants).
    Invariants,
    /// See [`extension`](super::extension).
    Extension,
    /// See [`moduli`](super::moduli).
    Moduli,
    /// See [`single_precision`](super::single_precision).
    SinglePrecision,
    /// See [`lanes`](super::lanes).
    Lanes,
}

impl Rule {
    /// All of them, in the order of the table at the head of the module.
    pub const ALL: [Self; 15] = [
        Self::Rest,
        Self::Domain,
        Self::Objectivity,
        Self::Isotropy,
        Self::SymmetricTangent,
        Self::StressSlope,
        Self::TangentSlope,
        Self::DualNumbers,
        Self::Quotients,
        Self::Strains,
        Self::Invariants,
        Self::Extension,
        Self::Moduli,
        Self::SinglePrecision,
        Self::Lanes,
    ];

    /// The promise of a material that keeps the rule, in one line.
    #[must_use]
    pub const fn promise(self) -> &'static str {
        match self {
            Self::Rest => "F = I is free of stress, and shear is resisted there",
            Self::Domain => "where the energy is defined, it and its derivatives are finite numbers",
            Self::Objectivity => "rotating space rotates the stress and leaves the energy",
            Self::Isotropy => "rotating the rest shape rotates the stress, and no stretch is preferred",
            Self::SymmetricTangent => "A : (dP/dF) B = B : (dP/dF) A",
            Self::StressSlope => "P is the derivative of the energy",
            Self::TangentSlope => "dP/dF is the derivative of P",
            Self::DualNumbers => {
                "gradient and Hessian are the derivatives of `energy` and `gradient`, to rounding"
            }
            Self::Quotients => {
                "flips and twists keep their digits at every gap between stretches, zero included"
            }
            Self::Strains => "`gradient_at_strains` is the gradient at the stretches 1 + s",
            Self::Invariants => "energy and gradient by I1, I2 and J are those by stretches",
            Self::Extension => "beyond its domain the energy goes on smoothly and restores",
            Self::Moduli => "the stated moduli are those of the Hessian at rest",
            Self::SinglePrecision => "in `f32` all numbers are those of `f64`, to the rounding of `f32`",
            Self::Lanes => "on lanes every number is what it is by itself",
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rest => "rest",
            Self::Domain => "domain",
            Self::Objectivity => "objectivity",
            Self::Isotropy => "isotropy",
            Self::SymmetricTangent => "symmetric tangent",
            Self::StressSlope => "slope of the energy",
            Self::TangentSlope => "slope of the stress",
            Self::DualNumbers => "dual numbers",
            Self::Quotients => "quotients",
            Self::Strains => "strains",
            Self::Invariants => "invariants",
            Self::Extension => "extension",
            Self::Moduli => "moduli",
            Self::SinglePrecision => "f32 against f64",
            Self::Lanes => "lanes against scalar",
        })
    }
}
