//! Units of parameters, which their documentation states: `Shear modulus μ, Pa.`

use crate::read::parse::{Declaration, Parameter};

/// The unit of a parameter, a whole power of Pa.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Pa, which is J/m³.
    Pascal,
    /// 1/Pa.
    PerPascal,
    /// 1: an exponent, a stretch, a fraction.
    Dimensionless,
}

impl Unit {
    /// The unit that ends a sentence, or the part of one before `:` or `;`; the first such end counts.
    ///
    /// The text is that of [`documentation`](crate::read::parse::documentation).
    #[must_use]
    pub fn read(documentation: &str) -> Option<Self> {
        let parts = documentation.lines().flat_map(|line| line.split_inclusive(['.', ':', ';']));
        let mut sentence = String::new();
        parts.chain(["."]).find_map(|part| {
            // The point in `0.5` ends nothing.
            let is_end = part.ends_with(['.', ':', ';']);
            sentence.push_str(part);
            if !is_end {
                return None;
            }
            let found = Self::at_end(sentence.trim_end_matches(['.', ':', ';', ' ']));
            sentence.clear();
            found
        })
    }

    fn at_end(sentence: &str) -> Option<Self> {
        let (before, word) = sentence.rsplit_once(' ')?;
        let bracketed = word.strip_prefix(['[', '(']).and_then(|word| word.strip_suffix([']', ')']));
        let is_set_apart = bracketed.is_some() || before.ends_with(',');
        match bracketed.unwrap_or(word) {
            "dimensionless" => Some(Self::Dimensionless),
            "Pa" | "J/m³" | "J/m^3" | "N/m²" | "N/m^2" => Some(Self::Pascal),
            "1/Pa" | "Pa⁻¹" | "Pa^-1" => Some(Self::PerPascal),
            "1" | "-" | "–" if is_set_apart => Some(Self::Dimensionless),
            _ => None,
        }
    }

    /// The exponent of Pa.
    #[must_use]
    pub fn pascals(self) -> i64 {
        match self {
            Self::Pascal => 1,
            Self::PerPascal => -1,
            Self::Dimensionless => 0,
        }
    }
}

impl Parameter {
    /// The unit that its documentation states: of a function that of its values.
    #[must_use]
    pub fn unit(&self) -> Option<Unit> {
        Unit::read(&self.doc)
    }
}

impl Declaration {
    /// The exponent of Pa in the unit of each parameter; `None` without one.
    pub(crate) fn pascals(&self) -> Vec<Option<i64>> {
        self.parameters.iter().map(|parameter| parameter.unit().map(Unit::pascals)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[track_caller]
    fn check(documentation: &str, expected: Option<Unit>) {
        assert_eq!(Unit::read(documentation), expected, "{documentation}");
    }

    #[test]
    fn the_end_of_a_sentence_is_the_unit() {
        check("Shear modulus μ, Pa.", Some(Unit::Pascal));
        check("Shear modulus [Pa]", Some(Unit::Pascal));
        check("Modulus μ, Pa: the shear modulus for n → ∞.", Some(Unit::Pascal));
        check("Compressibility D1 = 2/κ (1/Pa).", Some(Unit::PerPascal));
        check("Exponents αₚ, dimensionless.", Some(Unit::Dimensionless));
        check("Release β of the tubes, 1.", Some(Unit::Dimensionless));
        check("Modulus. At most 0.5 of the other, Pa.", Some(Unit::Pascal));
        check("Modulus.\nIts unit is Pa", Some(Unit::Pascal));
    }

    #[test]
    fn other_words_are_no_unit() {
        for text in [
            "",
            "Pa",
            "Exponent.",
            "Release β of the tubes, 1 for none.",
            "Shear modulus, MPa.",
            "At most 1.",
        ] {
            check(text, None);
        }
    }
}
