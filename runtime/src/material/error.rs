//! Errors of constructors of materials.

use std::fmt;

use super::{Moduli, Text};
use crate::message::number;

/// Reason why a material cannot be built from given parameters.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum MaterialError {
    /// A condition of the declaration does not hold.
    Violated {
        /// The condition as declared.
        condition: Text,
        /// The parameters that it names, as given.
        given: Vec<Argument>,
    },
    /// The shear modulus at rest is not positive, or the bulk modulus negative, or one is not finite.
    UnstableRest {
        /// The moduli that follow from the parameters.
        moduli: Moduli,
    },
    /// The rest state is outside the domain, whose boundary depends on parameters.
    RestOutside {
        /// The condition of the domain as declared.
        condition: Text,
        /// The numbers among the parameters that it names, as given.
        given: Vec<Argument>,
    },
    /// The material has no extension.
    NoExtension {
        /// Name of the material.
        material: Text,
        /// Reason that its declaration states.
        reason: Option<Text>,
    },
    /// The extension would not restore an inverted point.
    DoesNotRestore {
        /// The condition that would make it restore.
        condition: Text,
        /// The parameters that it names, as given.
        given: Vec<Argument>,
    },
    /// Lists of different lengths, a scalar given as a list, or too few or too many parameters.
    Shape {
        /// The expected shape in words.
        expected: String,
    },
    /// Another reason, in words: a number that is out of range, or functions that do not suit the rest state.
    Other(String),
}

impl fmt::Display for MaterialError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Violated { condition, given } => {
                write!(f, "`{condition}` must hold, but {}", listed(given))
            }
            Self::UnstableRest { moduli } if !(moduli.mu + moduli.bulk()).is_finite() => write!(
                f,
                "the small-strain moduli are not finite, shear modulus {} Pa and bulk modulus {} Pa: \
                 these parameters divide by zero or overflow somewhere in the energy, as a compressibility of 0 does; \
                 give other values, or leave out the term of a volume that is kept",
                number(moduli.mu),
                number(moduli.bulk())
            ),
            Self::UnstableRest { moduli } if moduli.mu > 0.0 => write!(
                f,
                "the rest state would be unstable: the small-strain bulk modulus is {} Pa and must not be negative; increase the \
                 resistance to changes of volume",
                number(moduli.bulk())
            ),
            Self::UnstableRest { moduli } => write!(
                f,
                "the rest state would be unstable: the small-strain shear modulus is {} Pa and must be positive",
                number(moduli.mu)
            ),
            Self::RestOutside { condition, given } => {
                write!(
                    f,
                    "the rest state, where all stretches are 1, would be outside of the domain: `{condition}` must hold \
                     there too"
                )?;
                if given.is_empty() {
                    f.write_str("; change the parameters that it depends on")
                } else {
                    write!(f, ", but {}; change these parameters", listed(given))
                }
            }
            Self::NoExtension { material, reason } => {
                write!(f, "{material} has no extension beyond its domain")?;
                reason.as_ref().map_or(Ok(()), |reason| write!(f, ": {reason}"))?;
                write!(f, "; use `Inversion::Refuse`")
            }
            Self::DoesNotRestore { condition, given } => write!(
                f,
                "the extended energy would attract collapse instead of restoring: `{condition}` must hold, but {}; \
                 use `Inversion::Refuse` or other parameters",
                listed(given)
            ),
            Self::Shape { expected: message } | Self::Other(message) => f.write_str(message),
        }
    }
}

impl std::error::Error for MaterialError {}

/// Parameter of a constructor, as given: printed as `mu = -1` or, for an entry of a list, as `alpha[2] = 0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Argument {
    /// Name of the parameter.
    pub parameter: Text,
    /// Place in the list, counted from 0, if the parameter is one.
    pub index: Option<usize>,
    /// Its value.
    pub value: f64,
}

impl Argument {
    /// Name of the parameter, such as `mu`, with its index if it is an entry, such as `alpha[2]`.
    #[must_use]
    pub fn name(&self) -> String {
        let Self { parameter, index, .. } = self;
        index.map_or_else(|| parameter.to_string(), |index| format!("{parameter}[{index}]"))
    }
}

impl fmt::Display for Argument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.name(), number(self.value))
    }
}

fn listed(given: &[Argument]) -> String {
    given.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::constructor::stressed_rest;

    #[test]
    fn a_rest_state_is_refused_with_its_cause_and_a_remedy() {
        let outside = MaterialError::RestOutside { condition: "I1b < 2.0".into(), given: Vec::new() };
        let unstable = |mu, lambda| MaterialError::UnstableRest { moduli: Moduli { mu, lambda } };
        for (error, expected) in [
            (outside, "change the parameters that it depends on"),
            (unstable(-1.0, 1.0), "shear modulus is -1 Pa and must be positive"),
            (unstable(1.5, -2.0), "bulk modulus is -1 Pa and must not be negative"),
            // ν = 1/2, and 0/0.
            (unstable(1.0, f64::INFINITY), "divide by zero or overflow"),
            (unstable(f64::NAN, 1.0), "divide by zero or overflow"),
            (stressed_rest(1.0), "`I1b`, `I2b` for `I1`, `I2`, or add `- p * J.ln()`"),
        ] {
            let text = error.to_string();
            assert!(text.contains(expected), "{text}");
        }
    }
}
