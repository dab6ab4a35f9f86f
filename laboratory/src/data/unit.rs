//! Units of stress, with their usual names.

use std::fmt;
use std::str::FromStr;

use piola::__private::message::quoted;

/// A unit of stress.
///
/// ```
/// use piola_laboratory::data::StressUnit;
///
/// let pascals = |name: &str| name.parse::<StressUnit>().map(|unit| unit.pascals());
/// assert_eq!(["N/mm²", "N / mm**2", "N·mm⁻²", "Mpa"].map(pascals), [Ok(1e6), Ok(1e6), Ok(1e6), Ok(1e6)]);
/// assert_eq!(["psi", "kgf/cm^2", "bar"].map(pascals), [Ok(6894.757293168361), Ok(98066.5), Ok(1e5)]);
/// assert!(pascals("mPa").is_err() && pascals(" mN/m^2").is_err(), "thousandths");
/// let error = pascals("stone").unwrap_err();
/// assert!(error.to_string().contains("`stone` is not a unit of stress; write one of Pa, kPa, MPa, GPa, psi"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressUnit {
    name: &'static str,
    pascals: f64,
}

/// Each unit with its size in Pa and other spellings, in small letters and without signs for powers.
const UNITS: [(&str, f64, &[&str]); 11] = [
    ("Pa", 1.0, &["n/m2", "nm-2", "j/m3", "pascal"]),
    ("kPa", 1e3, &["kn/m2"]),
    ("MPa", 1e6, &["n/mm2", "nmm-2", "mn/m2", "megapascal"]),
    ("GPa", 1e9, &["kn/mm2"]),
    ("psi", 6_894.757_293_168_361, &["lbf/in2", "lb/in2", "lbs/in2", "lbf/sqin"]),
    ("ksi", 6_894_757.293_168_361, &["kip/in2"]),
    ("bar", 1e5, &[]),
    ("atm", 101_325.0, &[]),
    ("kgf/cm2", 98_066.5, &["kg/cm2", "kp/cm2"]),
    ("kgf/mm2", 9_806_650.0, &["kg/mm2", "kp/mm2"]),
    ("dyn/cm2", 0.1, &["dyne/cm2", "dynes/cm2"]),
];

impl StressUnit {
    /// The size, Pa.
    #[must_use]
    pub fn pascals(self) -> f64 {
        self.pascals
    }
}

impl fmt::Display for StressUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name)
    }
}

impl FromStr for StressUnit {
    type Err = String;

    /// Parses a unit in letters of any case, except for `m` before a capital, as in `mPa` and `mN/m²`: that
    /// would be a thousandth. A square is written `²`, `^2`, `**2` or `2`.
    fn from_str(text: &str) -> Result<Self, String> {
        let name = plain(text);
        let is_named = |(own, _, spellings): &&(&str, f64, &[&str])| {
            own.eq_ignore_ascii_case(&name) || spellings.contains(&&*name)
        };
        let is_milli = text.trim().strip_prefix('m').is_some_and(|rest| rest.starts_with(char::is_uppercase));
        let found = UNITS.iter().find(is_named).filter(|_| !is_milli);
        let &(name, pascals, _) = found.ok_or_else(|| {
            let units = UNITS.map(|(name, ..)| name).join(", ");
            format!("`{}` is not a unit of stress; write one of {units}", quoted(text.trim()))
        })?;
        Ok(Self { name, pascals })
    }
}

/// A unit in small letters, without spaces, points and signs for powers.
pub(super) fn plain(unit: &str) -> String {
    let letters = unit.chars().filter(|c| !matches!(c, ' ' | '^' | '*' | '·' | '.' | '\u{a0}'));
    let letters = letters.map(|c| match c {
        '²' => '2',
        '³' => '3',
        '−' | '⁻' => '-',
        'μ' => 'µ',
        'ϵ' => 'ε',
        c => c,
    });
    letters.flat_map(char::to_lowercase).collect()
}
