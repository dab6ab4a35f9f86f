//! Headers of columns in plain form: the name of a quantity, and its unit.

use super::unit::{StressUnit, plain};

/// A quantity that a column may hold, by the table of the [module](super).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Quantity {
    Mode,
    Stretch,
    Strain,
    TrueStrain,
    Shear,
    Volume,
    VolumeStrain,
    Stress,
    TrueStress,
    Pressure,
    /// Something else, or a header that is not in plain form.
    Other,
}

use Quantity::{
    Mode, Other, Pressure, Shear, Strain, Stress, Stretch, TrueStrain, TrueStress, Volume, VolumeStrain,
};

/// Each quantity with its name in sentences and the names that mean it in a header, in small letters.
const NAMES: [(Quantity, &str, &[&str]); 10] = [
    (Mode, "the test", &["mode"]),
    (Stretch, "stretch", &["stretch", "stretch ratio", "λ", "lambda"]),
    (Strain, "nominal strain", &["strain", "nominal strain", "engineering strain", "tensile strain"]),
    (TrueStrain, "true strain", &["true strain", "log strain", "logarithmic strain"]),
    (Shear, "shear", &["shear strain", "shear", "γ", "gamma"]),
    (Volume, "volume ratio", &["volume ratio", "j", "v v0"]),
    (VolumeStrain, "volume strain", &["volume strain", "volumetric strain"]),
    (
        Stress,
        "nominal stress",
        &["stress", "nominal stress", "engineering stress", "tensile stress", "shear stress"],
    ),
    (TrueStress, "true stress", &["true stress", "cauchy stress"]),
    (Pressure, "pressure", &["pressure"]),
];

impl Quantity {
    pub(super) fn name(self) -> &'static str {
        NAMES.iter().find(|(quantity, ..)| *quantity == self).map_or("", |(_, name, _)| name)
    }

    /// True if it is a quantity that a machine measures.
    pub(super) fn is_stress(self) -> bool {
        matches!(self, Stress | TrueStress | Pressure)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    Stress(StressUnit),
    /// A number without dimension, by its size.
    Share(f64),
}

/// Units of strain, as [`plain`] leaves them.
const SHARES: [(f64, &[&str]); 4] = [
    (1.0, &["-", "1", "mm/mm", "m/m", "in/in"]),
    (0.01, &["%", "percent"]),
    (1e-3, &["‰", "mm/m"]),
    (1e-6, &["µε", "µm/m", "microstrain"]),
];

/// The unit of a name with or without brackets, if it is known.
pub(super) fn unit(text: &str) -> Option<Unit> {
    let text = text.trim_matches(|c: char| "()[] ".contains(c));
    let name = plain(text);
    let share = SHARES.iter().find(|(_, names)| names.contains(&&*name)).map(|(size, _)| Unit::Share(*size));
    share.or_else(|| text.parse().ok().map(Unit::Stress))
}

/// Bytes beyond which the end of a text is not looked at as a unit.
const LONGEST: usize = 24;

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heading {
    /// The index of the column.
    pub(super) place: usize,
    /// The header as given, or the number of the column.
    pub(super) text: String,
    pub(super) quantity: Quantity,
    pub(super) unit: Option<Unit>,
    /// True if the numbers count compression as positive.
    pub(super) is_compressive: bool,
}

impl Heading {
    /// The header of a column, which may be empty; the unit below it is that of a name without one. With two
    /// different units the quantity is not clear.
    pub(super) fn of(place: usize, text: &str, below: Option<Unit>) -> Self {
        let (name, own) = name_and_unit(text);
        let unit = own.or(below);
        // No quantity has a longer name.
        let name: String = name.chars().take(40).flat_map(char::to_lowercase).collect();
        let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        let words = words.collect::<Vec<_>>().join(" ");
        let (is_compressive, words) =
            words.strip_prefix("compressive ").map_or((false, &*words), |words| (true, words));
        let named = NAMES.iter().find(|(.., names)| names.contains(&words));
        let quantity = named.map_or(Other, |(quantity, ..)| *quantity);
        let is_plain = match quantity {
            Mode | Stretch if is_compressive => false,
            Mode => unit.is_none(),
            quantity => has_clear_unit(text, unit, quantity.is_stress()),
        };
        let are_two_units = own.zip(below).is_some_and(|(own, below)| own != below);
        let quantity = if is_plain && !are_two_units { quantity } else { Other };
        let text = if text.is_empty() { format!("column {}", place + 1) } else { text.into() };
        Self { place, text, quantity, unit, is_compressive }
    }

    /// The size of the unit, with the sign of compression.
    pub(super) fn factor(&self) -> f64 {
        let size = match self.unit {
            Some(Unit::Share(size)) => size,
            Some(Unit::Stress(unit)) => unit.pascals(),
            None => 1.0,
        };
        if self.is_compressive { -size } else { size }
    }
}

/// True if a unit is of this kind, or if the header has none, known or unknown.
pub(super) fn has_clear_unit(text: &str, unit: Option<Unit>, is_stress: bool) -> bool {
    match unit {
        Some(unit) => matches!(unit, Unit::Stress(_)) == is_stress,
        None => !text.contains(['(', '[', '%', '‰']),
    }
}

/// Words in brackets by which a stress or a strain is not the one that its name says.
const KINDS: [&str; 7] = ["true", "log", "logarithmic", "cauchy", "compressive", "shear", "volumetric"];

/// A header without its unit, and the unit: in brackets at the end, which may hold something else, as in
/// `Strain (Strain 1)`, but no other kind; or behind a space, `_`, `/` or a comma.
fn name_and_unit(text: &str) -> (&str, Option<Unit>) {
    let text = text.trim();
    if let Some(inner) = text.strip_suffix([')', ']'])
        && let Some((name, inner)) = inner.rsplit_once(['(', '['])
    {
        let mut words = inner.split(|c: char| !c.is_alphanumeric());
        let is_other = words.any(|word| KINDS.iter().any(|kind| word.eq_ignore_ascii_case(kind)));
        return (if is_other { text } else { name }, unit(inner));
    }
    let mut places = text.match_indices([' ', '_', '/', ',']).filter(|(at, _)| text.len() - at <= LONGEST);
    let split = places.find_map(|(at, _)| {
        let rest = text[at + 1..].trim();
        let known = unit(rest).filter(|unit| matches!(unit, Unit::Stress(_)) || matches!(rest, "%" | "‰"));
        known.map(|unit| (&text[..at], Some(unit)))
    });
    split.unwrap_or((text, None))
}
