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

/// Other units of stress, in small letters and without the exponents of lengths. Values of parameters are not
/// converted from them.
const OTHERS: [&str; 19] = [
    "kpa", "mpa", "gpa", "hpa", "n/mm", "n/cm", "kn/m", "kn/mm", "mn/m", "kgf/cm", "kgf/mm", "kp/cm",
    "dyn/cm", "lbf/in", "lb/in", "kj/m", "mj/m", "mj/mm", "mm/n",
];

/// Further ones, words that may have another meaning inside a sentence or at its end: `in psi` for ψ.
const AMBIGUOUS: [&str; 7] = ["pa", "psi", "ksi", "bar", "mbar", "atm", "mmhg"];

impl Unit {
    /// All units.
    pub const ALL: [Self; 3] = [Self::Pascal, Self::PerPascal, Self::Dimensionless];

    /// The first unit that ends a sentence, or the part of one before `:` or `;`, or that is set apart: by
    /// brackets, a comma or `in` before it.
    ///
    /// The text is that of [`documentation`](crate::read::parse::documentation).
    ///
    /// # Errors
    /// The word at this place if it is another unit of stress, or one divided by it.
    pub fn read(documentation: &str) -> Result<Option<Self>, String> {
        let (mut words, mut sentence) = (Vec::new(), 0);
        // Stars are at the beginning of the lines of a block. The point in `0.5` ends nothing.
        for word in documentation.split_whitespace().filter(|&word| word != "*").chain(["."]) {
            let bare = word.trim_end_matches(['.', ':', ';']);
            words.extend((!bare.is_empty()).then_some(bare));
            let is_end = bare != word;
            if let Some(found) = Self::last(&words, sentence, is_end) {
                return found.map(Some);
            }
            if is_end {
                sentence = words.len();
            }
        }
        Ok(None)
    }

    /// The unit that is the last of these words, whose sentence begins at a place and may end here.
    fn last(words: &[&str], sentence: usize, is_end: bool) -> Option<Result<Self, String>> {
        let (last, before) = words[sentence..].split_last()?;
        let word = last.trim_matches(['(', ')', '[', ']', '`', ',']);
        let before = before.last().map(|word| word.trim_start_matches(['(', '[']));
        let is_bracketed = last.starts_with(['(', '[']);
        let is_behind_comma = before.is_some_and(|before| before.ends_with(','));
        let is_set_apart =
            is_bracketed || is_behind_comma || before == Some("in") || before.is_none() && is_end;
        if !(is_end || is_set_apart) {
            return None;
        }
        // As in `about 0.4 MPa`, where it is not the unit of the parameter.
        let is_of_value = before.is_some_and(|before| {
            !before.starts_with(char::is_alphabetic) && before.contains(|c: char| c.is_ascii_digit())
        });
        let small = word.to_lowercase().replace(['²', '³', '^', '2', '3'], "");
        let stress = ["⁻¹", "-1"].iter().find_map(|power| small.strip_suffix(power));
        let stress = stress.or_else(|| small.strip_prefix("1/")).unwrap_or(&small);
        match word {
            "Pa" | "J/m³" | "J/m^3" | "J/m3" | "N/m²" | "N/m^2" | "N/m2" => Some(Ok(Self::Pascal)),
            "1/Pa" | "Pa⁻¹" | "Pa^-1" | "m²/N" | "m^2/N" | "m2/N" => Some(Ok(Self::PerPascal)),
            // In brackets, or behind `eq.`, it is the number of an equation or of a source.
            "1" if last.len() == 1 && (is_end && is_behind_comma || words.len() == 1) => {
                Some(Ok(Self::Dimensionless))
            }
            "-" | "–" | "−" if is_bracketed || is_end && is_set_apart => Some(Ok(Self::Dimensionless)),
            _ if matches!(&*small, "dimensionless" | "unitless") => Some(Ok(Self::Dimensionless)),
            _ if matches!(&*small, "pascal" | "pascals") => Some(Ok(Self::Pascal)),
            _ if OTHERS.contains(&stress) || stress.trim_end_matches('s').ends_with("pascal") => {
                (is_set_apart || !is_of_value).then(|| Err(word.to_owned()))
            }
            _ if AMBIGUOUS.contains(&stress) && is_set_apart && (is_end || is_bracketed) => {
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
            ("Pa", pascal),
            ("Dimensionless.", dimensionless),
            ("1.", dimensionless),
            ("Shear modulus μ,\tPa.", pascal),
            ("Shear modulus,\n   * Pa.", pascal),
            ("Compressibility, m²/N.", per_pascal),
            ("Share, 0.5 or less of the other. Unit: 1/Pa", per_pascal),
            ("Modulus (Pa), of the matrix.", pascal),
            ("Coefficient of J² in psi, pascals.", pascal),
            ("Coefficient of eq. (1) or, in short, of eq. 1.", None),
            ("Modulus of PA, in [0, 1].", None),
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
