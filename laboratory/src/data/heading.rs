//! Headers of columns: parsing of names into a quantity and its unit.

use super::unit::{StressUnit, plain};

/// A quantity that a column may hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Quantity {
    /// The name of a test.
    Mode,
    /// λ; in canonical files the control of any test, γ and J included.
    Stretch,
    /// The nominal strain λ − 1; γ of a simple shear and J − 1 of a volumetric test.
    Strain,
    /// ln λ, and ln J of a volumetric test.
    TrueStrain,
    /// γ of a simple shear.
    Shear,
    /// J of a volumetric test.
    Volume,
    /// J − 1 of a volumetric test.
    VolumeStrain,
    /// Force by area at rest.
    Stress,
    /// Force by area as deformed.
    TrueStress,
    /// Minus the mean stress of a volumetric test.
    Pressure,
    /// A force or a length, which needs the dimensions of the specimen.
    Sized,
    /// Something else.
    Other,
}

impl Quantity {
    /// The name in sentences.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Mode => "the test",
            Self::Stretch => "stretch",
            Self::Strain => "nominal strain",
            Self::TrueStrain => "true strain",
            Self::Shear => "shear",
            Self::Volume => "volume ratio",
            Self::VolumeStrain => "volume strain",
            Self::Stress => "nominal stress",
            Self::TrueStress => "true stress",
            Self::Pressure => "pressure",
            Self::Sized => "a force or a length",
            Self::Other => "nothing",
        }
    }

    /// True if it is a quantity that a machine sets.
    pub(super) fn is_control(self) -> bool {
        (Self::Stretch..=Self::VolumeStrain).contains(&self)
    }

    /// True if it is a control that is 0 at rest.
    pub(super) fn is_strain(self) -> bool {
        matches!(self, Self::Strain | Self::TrueStrain | Self::Shear | Self::VolumeStrain)
    }

    /// True if it is a quantity that a machine measures.
    pub(super) fn is_stress(self) -> bool {
        (Self::Stress..=Self::Pressure).contains(&self)
    }
}

/// Unit in the form that is written after a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    Stress(StressUnit),
    /// A number without dimension, by its size.
    Share(f64),
    /// A unit of force or length.
    Sized,
    /// Another unit, such as of time or temperature.
    Other,
}

/// Units of strain, force, length and other quantities in such files, as [`plain`] leaves them.
const UNITS: [(Unit, &[&str]); 6] = [
    (
        Unit::Share(1.0),
        &["-", "–", "—", "1", "mm/mm", "m/m", "cm/cm", "in/in", "mmmm-1", "mm-1", "inin-1", "dimensionless"],
    ),
    (Unit::Share(0.01), &["%", "percent", "pct", "prozent"]),
    (Unit::Share(1e-3), &["‰", "permille", "promille", "mm/m", "millistrain"]),
    (
        Unit::Share(1e-6),
        &["µε", "uε", "µe", "µm/m", "um/m", "microstrain", "microstrains", "µstrain", "ustrain"],
    ),
    (
        Unit::Sized,
        &["n", "kn", "mn", "lbf", "lb", "kgf", "kg", "g", "gf", "mm", "cm", "m", "in", "inch", "µm", "um"],
    ),
    (
        Unit::Other,
        &[
            "s", "sec", "min", "h", "ms", "hz", "1/s", "s-1", "%/s", "%/min", "mm/min", "mm/s", "n/mm", "°c",
            "c", "k", "j", "mm2", "mj",
        ],
    ),
];

/// The unit of a name, if it is known.
pub(super) fn unit(text: &str) -> Option<Unit> {
    if text.len() > 24 {
        return None;
    }
    let text = text.trim_matches(|c: char| "()[]{}<> ".contains(c));
    let name = plain(text);
    let listed = UNITS.iter().find(|(_, names)| names.contains(&&*name)).map(|(unit, _)| *unit);
    listed.or_else(|| text.parse().ok().map(Unit::Stress))
}

/// True if a text is likely to be an unknown unit of strain.
fn is_like_unit(text: &str) -> bool {
    let name = plain(text);
    text.contains(['%', '‰', '^', '⁻', '×', 'µ', 'μ'])
        || ["10-3", "10-6", "1e-3", "1e-6", "mstrain", "mε"].contains(&name.trim_start_matches('x'))
}

/// A column by its header.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Heading {
    /// The header as given.
    pub(super) text: String,
    pub(super) quantity: Quantity,
    pub(super) unit: Option<Unit>,
    /// Text instead of a known unit.
    pub(super) unknown: Option<String>,
    /// True if a word names one of two kinds of stress or strain.
    pub(super) is_specific: bool,
    /// True if the numbers count compression as positive.
    pub(super) is_compressive: bool,
}

/// Words of quantities that no fit can use, although `strain` or `stress` is in their names.
const OTHERS: &str = "rate max maximum min minimum peak break fracture failure yield ultimate bruch transverse lateral \
    width thickness poisson poissons modulus secant tangent plastic creep thermal residual error std \
    stdev sd deviation energy tensor green lagrange almansi mises reduced normalized normalised second 2nd \
    pk2";
const NOMINAL: &str =
    "nominal engineering eng engr technical tech technische nenn piola first 1st pk1 conventional";
const TRUE: &str = "true log logarithmic ln hencky cauchy wahre wahrer wahr";
const COMPRESSIVE: &str = "compressive compression compress druck stauchung";

impl Heading {
    /// The column of a header, with the unit that stands in a row below it, which may be empty.
    pub(super) fn of(text: &str, below: &str) -> Self {
        let (name, own, unknown) = name_and_unit(text);
        let unit = own.or(unit(below));
        let unknown = match unit == own {
            true => unknown.or_else(|| (unit.is_none() && is_like_unit(below)).then(|| below.into())),
            false => None,
        };
        let words = words(&name);
        let has = |list: &str| list.split(' ').any(|listed| words.iter().any(|word| word == listed));
        let is_true = has(TRUE) || words.iter().any(|word| word == "le") || name.trim() == "S11";
        let quantity = match (quantity(&name, &words, is_true), unit) {
            (_, Some(Unit::Sized)) => Quantity::Sized,
            (_, Some(Unit::Other)) => Quantity::Other,
            // In percent these are strains.
            (Quantity::Sized, Some(Unit::Share(_))) if has("elongation extension deformation") => {
                Quantity::Strain
            }
            (quantity, Some(Unit::Stress(_))) if !quantity.is_stress() => Quantity::Other,
            (quantity, Some(Unit::Share(_))) if quantity.is_stress() => Quantity::Other,
            (quantity, _) => quantity,
        };
        Self {
            text: text.into(),
            quantity,
            unit,
            unknown,
            is_specific: has(NOMINAL) || is_true,
            is_compressive: quantity != Quantity::Stretch && has(COMPRESSIVE),
        }
    }
}

fn quantity(name: &str, words: &[String], is_true: bool) -> Quantity {
    let has = |list: &str| list.split(' ').any(|listed| words.iter().any(|word| word == listed));
    let joined = words.join(" ");
    let is_kirchhoff = has("kirchhoff") && !has("piola");
    let has_stress =
        has("stress stresses spannung σ sigma τ tau") || matches!(name.trim(), "P" | "P11" | "P12" | "S11");
    let has_strain = has("strain strains dehnung stauchung ε eps epsilon γ gamma ne le");
    let has_volume = has("volume volumetric vol");
    match joined.as_str() {
        "mode" | "test" | "type" | "experiment" | "test mode" | "test type" | "type of test" | "loading"
        | "loading mode" | "deformation mode" | "load case" => Quantity::Mode,
        _ if has(OTHERS) || is_kirchhoff || has_stress && has_strain => Quantity::Other,
        "j" | "v v" | "jacobian" | "det f" => Quantity::Volume,
        _ if has("stretch stretches λ lambda lam streckung verstreckung") => Quantity::Stretch,
        _ if has("ratio") && has("extension elongation") => Quantity::Stretch,
        _ if has("ratio") && has_volume => Quantity::Volume,
        _ if has_strain && has_volume => Quantity::VolumeStrain,
        _ if has_strain && has("shear γ gamma") => Quantity::Shear,
        _ if has_strain && is_true => Quantity::TrueStrain,
        _ if has_strain => Quantity::Strain,
        _ if has_stress && is_true => Quantity::TrueStress,
        _ if has_stress => Quantity::Stress,
        _ if has("pressure") => Quantity::Pressure,
        _ if has(SIZED) => Quantity::Sized,
        _ => Quantity::Other,
    }
}

/// Words of forces and lengths.
const SIZED: &str = "force load kraft standardkraft prüfkraft extension elongation displacement deformation crosshead \
    position stroke travel deflection weg standardweg traversenweg längenänderung verlängerung";

/// The words of a name in small letters, without numbers behind them; `nennspannung` and `TrueStress` are
/// two each.
fn words(name: &str) -> Vec<String> {
    const NOUNS: &[&str] = &["strain", "stress", "stretch", "spannung", "dehnung"];
    let mut words = Vec::new();
    for word in name.split(|c: char| !c.is_alphanumeric()) {
        let word = word.to_lowercase();
        let word =
            if matches!(&*word, "pk1" | "pk2") { &word } else { word.trim_end_matches(char::is_numeric) };
        let noun = NOUNS.iter().find(|noun| word.len() > noun.len() && word.ends_with(*noun));
        let (front, noun) = word.split_at(word.len() - noun.map_or(0, |noun| noun.len()));
        words.extend([front, noun].into_iter().filter(|word| !word.is_empty()).map(str::to_owned));
    }
    words
}

/// Bytes of a header beyond which no unit is looked for.
const LONGEST: usize = 200;

/// A header without its unit, the unit, and what may be an unknown one.
///
/// The unit stands in brackets; or behind a space, `_`, `/` or a comma, or in capitals behind small letters.
/// A share may also stand before the name.
fn name_and_unit(text: &str) -> (String, Option<Unit>, Option<String>) {
    if text.len() > LONGEST {
        return (text.into(), None, None);
    }
    // `(1)` and `(-)` may also number or join.
    let rank = |inside: &str| match unit(inside) {
        Some(Unit::Share(_)) if matches!(inside.trim(), "1" | "-" | "–" | "—") => 1,
        Some(Unit::Share(_) | Unit::Stress(_)) => 4,
        Some(_) => 3,
        None if is_like_unit(inside) => 2,
        None => 0,
    };
    let last = brackets(text).into_iter().max_by_key(|(_, inside)| rank(inside));
    let (name, bracket) = match last.filter(|(_, inside)| rank(inside) > 0) {
        Some((at, inside)) => {
            let after = text.get(at + inside.len() + 2..).unwrap_or_default();
            let (name, unit) = (format!("{} {after}", &text[..at]), unit(inside));
            if rank(inside) > 1 {
                return (name, unit, unit.is_none().then(|| inside.into()));
            }
            (name, unit)
        }
        None => (text.into(), None),
    };
    let name = name.trim();
    let (mut last, mut letters, mut unknown) = (' ', 0, None);
    for (at, c) in name.char_indices() {
        // Behind a word, not behind the first letter of `mPa`.
        let is_capital = letters > 2 && last.is_lowercase() && c.is_uppercase();
        let is_sign = matches!(c, '%' | '‰');
        // A letter alone is one of a specimen.
        let is_letter = !is_sign && name.len() - at == c.len_utf8();
        if (!last.is_alphanumeric() || is_capital || is_sign) && !is_letter {
            if at > 0
                && let Some(unit) = unit(&name[at..])
            {
                return (name[..at].into(), Some(unit), None);
            }
            unknown = Some(&name[at..]).filter(|rest| is_like_unit(rest)).or(unknown);
        }
        letters = if c.is_alphabetic() { letters + 1 } else { 0 };
        last = c;
    }
    // `% strain`, `Percent strain`, `Microstrain`.
    let sign: String = name.chars().take(1).collect();
    let word = words(name).into_iter().next().unwrap_or_default();
    let is_part = |unit: &Unit| matches!(unit, Unit::Share(size) if *size < 1.0);
    match [&*sign, &*word, name].into_iter().filter_map(unit).find(is_part) {
        Some(unit) => (name.into(), Some(unit), None),
        None => (name.into(), bracket, unknown.map(str::to_owned)),
    }
}

/// Texts in brackets, and where each opens; the last may be left open.
fn brackets(text: &str) -> Vec<(usize, &str)> {
    let opened = text.match_indices(['(', '[', '{']);
    let inside = |(at, _): (usize, &str)| {
        let rest = &text[at + 1..];
        (at, rest.split_once([')', ']', '}']).map_or(rest, |(inside, _)| inside))
    };
    opened.map(inside).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(header: &str, quantity: Quantity, size: Option<f64>) {
        let heading = Heading::of(header, "");
        let found = heading.unit.and_then(|unit| match unit {
            Unit::Stress(unit) => Some(unit.pascals()),
            Unit::Share(size) => Some(size),
            _ => None,
        });
        assert_eq!((heading.quantity, found), (quantity, size), "{header}");
    }

    #[test]
    fn headers_name_a_quantity_and_its_unit() {
        check("stretch", Quantity::Stretch, None);
        check("λ", Quantity::Stretch, None);
        check("λ₁ (-)", Quantity::Stretch, Some(1.0));
        check("Stretch ratio", Quantity::Stretch, None);
        check("extension_ratio", Quantity::Stretch, None);
        check("Strain [%]", Quantity::Strain, Some(0.01));
        check("strain%", Quantity::Strain, Some(0.01));
        check("strain_pct", Quantity::Strain, Some(0.01));
        for before in
            ["% strain", "%Strain", "Percent strain", "pct strain", "PctStrain", "Percent strain (1)"]
        {
            check(before, Quantity::Strain, Some(0.01));
        }
        check("% Elongation", Quantity::Strain, Some(0.01));
        for last in ["Strain (1) [%]", "Strain [%] (1)", "Strain % (1)", "Strain (-) (%)", "Strain (1) %"] {
            check(last, Quantity::Strain, Some(0.01));
        }
        check("Strain (1)", Quantity::Strain, Some(1.0));
        check("Strain (ΔL/L0) [-]", Quantity::Strain, Some(1.0));
        check("Strain (ε)", Quantity::Strain, None);
        check("Strain [‰]", Quantity::Strain, Some(1e-3));
        for micro in ["Strain [µε]", "Strain (μϵ)", "Strain [microstrain]", "Microstrain", "Micro strain"]
        {
            check(micro, Quantity::Strain, Some(1e-6));
        }
        check("Stress (1) [MPa]", Quantity::Stress, Some(1e6));
        check("Stress [MPa] (C)", Quantity::Stress, Some(1e6));
        check("Stress (10^6 Pa)", Quantity::Stress, None);
        check("eng_strain", Quantity::Strain, None);
        check("EngStrain", Quantity::Strain, None);
        check("Tensile strain (Strain 1) (mm/mm)", Quantity::Strain, Some(1.0));
        check("Strain (mm mm^-1)", Quantity::Strain, Some(1.0));
        check("Elongation (%)", Quantity::Strain, Some(0.01));
        check("True strain", Quantity::TrueStrain, None);
        check("log. strain", Quantity::TrueStrain, None);
        check("LE11", Quantity::TrueStrain, None);
        check("NE11", Quantity::Strain, None);
        check("Shear strain γ", Quantity::Shear, None);
        check("J", Quantity::Volume, None);
        check("V/V0", Quantity::Volume, None);
        check("volumetric strain / %", Quantity::VolumeStrain, Some(0.01));
        check("nominal_stress_MPa", Quantity::Stress, Some(1e6));
        check("Nominal stress, psi", Quantity::Stress, Some(6_894.757_293_168_361));
        check("Stress (N/mm^2)", Quantity::Stress, Some(1e6));
        check("Stress in kPa", Quantity::Stress, Some(1e3));
        check("stressMPa", Quantity::Stress, Some(1e6));
        check("σ [N/mm²]", Quantity::Stress, Some(1e6));
        check("P (kPa)", Quantity::Stress, Some(1e3));
        check("1st Piola-Kirchhoff stress (Pa)", Quantity::Stress, Some(1.0));
        check("True stress / MPa", Quantity::TrueStress, Some(1e6));
        check("Cauchy stress [MPa]", Quantity::TrueStress, Some(1e6));
        check("S11", Quantity::TrueStress, None);
        check("Nennspannung in MPa", Quantity::Stress, Some(1e6));
        check("wahre Dehnung", Quantity::TrueStrain, None);
        check("Pressure (bar)", Quantity::Pressure, Some(1e5));
        check("Test type", Quantity::Mode, None);
        check("Load (N)", Quantity::Sized, None);
        check("Extension (mm)", Quantity::Sized, None);
        check("Strain (mm)", Quantity::Sized, None);
        check("Stress (N)", Quantity::Sized, None);
        for other in [
            "Time (s)",
            "Strain rate (1/s)",
            "Strain rate",
            "Max. stress (MPa)",
            "Transverse strain (%)",
            "Strain at break (%)",
            "2nd PK stress (MPa)",
            "Kirchhoff stress (MPa)",
            "Green strain",
            "Temperature",
            "Poisson's ratio",
            "Tensor shear strain",
            "Strain energy (MPa)",
            "",
            "Specimen label",
            "strain (MPa)",
            "stress (%)",
        ] {
            check(
                other,
                Quantity::Other,
                Heading::of(other, "").unit.and_then(|unit| match unit {
                    Unit::Stress(unit) => Some(unit.pascals()),
                    Unit::Share(size) => Some(size),
                    _ => None,
                }),
            );
        }
        assert!(Heading::of("Compressive strain (%)", "").is_compressive);
        assert!(Heading::of("Druckspannung", "").is_compressive);
    }

    #[test]
    fn long_headers_take_no_longer_than_they_are() {
        for text in ["(".repeat(1_000_000), "a ".repeat(1_000_000), "strain".repeat(200_000)] {
            assert_eq!(Heading::of(&text, "").unit, None);
        }
    }
}
