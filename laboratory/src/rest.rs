//! Small-strain moduli of a material in words.

use std::fmt;

use piola::material::Moduli;

use crate::curve::Volume;

/// Small-strain moduli as reports print them: shear modulus, bulk modulus, Poisson's ratio.
///
/// ```
/// use piola::material::Moduli;
/// use piola_laboratory::AtRest;
/// use piola_laboratory::curve::Volume;
///
/// let rubber = AtRest { moduli: Moduli { mu: 0.4e6, lambda: 20e6 }, volume: Volume::Free };
/// assert_eq!(rubber.to_string(), "μ = 400 kPa, K = 20.27 MPa, ν = 0.4902");
/// assert_eq!(rubber.warning(), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtRest {
    /// The moduli, Pa.
    pub moduli: Moduli,
    /// Treatment of the volume of the specimen.
    pub volume: Volume,
}

impl AtRest {
    /// True if the volume is kept although the energy has no resistance to its change.
    fn has_no_bulk(&self) -> bool {
        self.volume == Volume::Kept && self.moduli.bulk().abs() <= 1e-9 * self.moduli.mu.abs()
    }

    /// A sentence about a Poisson's ratio that hardly any solid has: below 0, or beyond 1/2.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let poisson = self.moduli.poisson();
        let meaning = match poisson {
            // Roundings of K − 2μ/3.
            -1e-9..=0.5 => return None,
            _ if poisson.is_nan() => return None,
            _ if self.has_no_bulk() => return None,
            _ if self.moduli.bulk() < 0.0 => "pressure makes it grow",
            _ => "it grows thicker when it is pulled",
        };
        Some(format!(
            "Poisson's ratio of the material is {}: {meaning}; are all moduli in the same unit, Pa unless another is \
             written after the number, and compressibilities such as D1 in 1/Pa?",
            digits(poisson)
        ))
    }
}

impl fmt::Display for AtRest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { moduli, volume } = self;
        write!(f, "μ = {}", pascals(moduli.mu))?;
        if !self.has_no_bulk() {
            write!(f, ", K = {}, ν = {}", pascals(moduli.bulk()), digits(moduli.poisson()))?;
        }
        if *volume == Volume::Kept { f.write_str("; the volume is kept") } else { Ok(()) }
    }
}

/// A number with four significant digits at most.
pub(crate) fn digits(number: f64) -> String {
    let rounded: f64 = format!("{number:.3e}").parse().unwrap_or(number);
    match rounded.abs() {
        0.0 | 1e-3..1e6 => rounded.to_string(),
        _ => format!("{rounded:e}"),
    }
}

pub(crate) fn pascals(stress: f64) -> String {
    let units = [(1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa")];
    let unit = units.into_iter().find(|(size, _)| stress.abs() >= *size && stress.abs() < 1e4 * size);
    let (size, name) = unit.unwrap_or((1.0, "Pa"));
    format!("{} {name}", digits(stress / size))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [0.0, 1.0, -0.577_350_27, 12_345.6, 1.2e-7].map(digits),
            ["0", "1", "-0.5774", "12350", "1.2e-7"]
        );
        assert_eq!([3.8e5, 8.1e10, 2e7, 1.0].map(pascals), ["380 kPa", "81 GPa", "20 MPa", "1 Pa"]);
    }

    #[test]
    fn ratios_of_common_solids_are_not_warned_of() {
        let warning = |bulk: f64, volume| {
            AtRest { moduli: Moduli { mu: 1.0, lambda: bulk - 2.0 / 3.0 }, volume }.warning()
        };
        for bulk in [0.67, 1.0, 1e3, 1e12] {
            assert_eq!(warning(bulk, Volume::Free), None, "{bulk}");
        }
        for mu in [0.1, 0.3, 0.7, 1.1, 0.35e6, 0.4e6, 0.63e6] {
            let moduli = Moduli { mu, lambda: 2.0 / 3.0 * mu - 2.0 * mu / 3.0 };
            assert_eq!(AtRest { moduli, volume: Volume::Free }.warning(), None, "{mu}");
            let auxetic = Moduli { mu, lambda: -1e-6 * mu };
            assert!(AtRest { moduli: auxetic, volume: Volume::Free }.warning().is_some(), "{mu}");
        }
        assert_eq!(warning(f64::NAN, Volume::Free), None);
        assert!(warning(0.0, Volume::Free).is_some_and(|text| text.contains("is -1: it grows thicker")));
        assert!(warning(-0.1, Volume::Free).is_some_and(|text| text.contains("pressure makes it grow")));
        // Energies without a term in J are meant to keep their volume; moduli in two units are not.
        assert_eq!(warning(1e-16, Volume::Kept), None);
        assert!(warning(1e-5, Volume::Kept).is_some());
    }
}
