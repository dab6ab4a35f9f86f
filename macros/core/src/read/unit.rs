//! Units of parameters, which their documentation states: `Shear modulus μ, Pa.`

/// The unit of a parameter, a whole power of Pa, with its exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Pa, which is J/m³.
    Pascal = 1,
    /// 1/Pa.
    PerPascal = -1,
    /// 1: an exponent, a stretch, a fraction.
    Dimensionless = 0,
}

/// Other units of stress. Values of parameters are not converted from them.
const OTHERS: [&str; 18] = [
    "kPa", "MPa", "GPa", "hPa", "psi", "ksi", "bar", "atm", "N/mm²", "N/mm^2", "N/mm2", "kN/m²", "kN/m^2",
    "kN/mm²", "kN/mm^2", "kgf/cm²", "kgf/cm^2", "dyn/cm²",
];

impl Unit {
    /// All units.
    pub const ALL: [Self; 3] = [Self::Pascal, Self::PerPascal, Self::Dimensionless];

    /// The unit that ends a sentence, or the part of one before `:` or `;`; the first such end counts.
    ///
    /// The text is that of [`documentation`](crate::read::parse::documentation).
    ///
    /// # Errors
    /// The word at this place if it is another unit of stress, or one divided by it.
    pub fn read(documentation: &str) -> Result<Option<Self>, String> {
        let parts = documentation.lines().flat_map(|line| line.split_inclusive(['.', ':', ';']));
        let mut sentence = String::new();
        let found = parts.chain(["."]).find_map(|part| {
            // The point in `0.5` ends nothing.
            let is_end = part.ends_with(['.', ':', ';']);
            sentence.push_str(part);
            if !is_end {
                return None;
            }
            let found = Self::at_end(sentence.trim_end_matches(['.', ':', ';', ' ']));
            sentence.clear();
            found
        });
        found.transpose()
    }

    fn at_end(sentence: &str) -> Option<Result<Self, String>> {
        let (before, word) = sentence.rsplit_once(' ')?;
        let bracketed = word.strip_prefix(['[', '(']).and_then(|word| word.strip_suffix([']', ')']));
        let is_set_apart = bracketed.is_some() || before.ends_with(',');
        let word = bracketed.unwrap_or(word);
        let stress = ["⁻¹", "^-1"].iter().find_map(|power| word.strip_suffix(power));
        let stress = stress.or_else(|| word.strip_prefix("1/")).unwrap_or(word);
        match word {
            "dimensionless" => Some(Ok(Self::Dimensionless)),
            "Pa" | "J/m³" | "J/m^3" | "N/m²" | "N/m^2" => Some(Ok(Self::Pascal)),
            "1/Pa" | "Pa⁻¹" | "Pa^-1" => Some(Ok(Self::PerPascal)),
            "1" | "-" | "–" if is_set_apart => Some(Ok(Self::Dimensionless)),
            // Not the unit of a value, as in `about 0.4 MPa`.
            _ if OTHERS.contains(&stress) && (is_set_apart || before.ends_with(" in")) => {
                Some(Err(word.to_owned()))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[test]
    fn the_end_of_a_sentence_is_the_unit() {
        let [pascal, per_pascal, dimensionless] = Unit::ALL.map(Some);
        for (documentation, expected) in [
            ("Shear modulus μ, Pa.", pascal),
            ("Shear modulus [Pa]", pascal),
            ("Modulus μ, Pa: the shear modulus for n → ∞.", pascal),
            ("Compressibility D1 = 2/κ (1/Pa).", per_pascal),
            ("Exponents αₚ, dimensionless.", dimensionless),
            ("Release β of the tubes, 1.", dimensionless),
            ("Modulus. At most 0.5 of the other, Pa.", pascal),
            ("Modulus.\nIts unit is Pa", pascal),
            ("", None),
            ("Pa", None),
            ("Exponent.", None),
            ("Release β of the tubes, 1 for none.", None),
            ("Of soft rubber about 0.4 MPa.", None),
            ("Modulus of a bar.", None),
            ("At most 1.", None),
        ] {
            assert_eq!(Unit::read(documentation), Ok(expected), "{documentation}");
        }
    }
}
