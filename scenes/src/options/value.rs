//! Values of options that have a notation of their own: parameters, and how inverted material is treated.

use piola::Inversion;

/// A parameter as it is given on the command line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Given {
    /// Its name.
    pub name: String,
    /// Its values in SI units, several to a list.
    pub values: Vec<f64>,
    /// Whether they were given with a unit, in which case that is Pa.
    has_unit: bool,
}

impl Given {
    /// Documentation of the parameter, as in a declaration.
    #[must_use]
    pub fn documentation(&self) -> String {
        if self.has_unit {
            format!("Parameter {}, Pa.", self.name)
        } else {
            format!("Parameter {}.", self.name)
        }
    }
}

/// Units of stress, with their sizes in Pa; longer names first.
const UNITS: [(&str, f64); 4] = [("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9), ("Pa", 1.0)];

/// Reads `NAME=V,V,V`, with or without a unit of stress behind the last value.
///
/// # Errors
/// What is wrong, and what to write.
pub fn parameter(text: &str) -> Result<Given, String> {
    let (name, values) = text.split_once('=').ok_or("write NAME=VALUE, or NAME=V,V,V for a list")?;
    let unit = UNITS.into_iter().find_map(|(unit, size)| Some((values.trim().strip_suffix(unit)?, size)));
    let (values, size) = unit.unwrap_or((values, 1.0));
    let number = |value: &str| {
        let number: f64 = value.trim().parse().map_err(|_| format!("`{value}` is not a number"))?;
        Ok::<_, String>(number * size)
    };
    let values = values.split(',').map(number).collect::<Result<_, _>>()?;
    Ok(Given { name: name.trim().into(), values, has_unit: unit.is_some() })
}

/// Reads `refuse` or the stretch where an extension begins.
///
/// # Errors
/// What to write.
pub fn inversion(text: &str) -> Result<Inversion, String> {
    if text == "refuse" {
        return Ok(Inversion::Refuse);
    }
    let epsilon = text.parse().map_err(|_| "write `refuse`, or a stretch between 0 and 1")?;
    Ok(Inversion::Extend { epsilon })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_numbers_are_parameters() {
        let read = |text| parameter(text).map(|given| (given.name, given.values));
        assert_eq!(read("mu=1e5"), Ok(("mu".into(), vec![1e5])));
        assert_eq!(read("alpha = 1.3, 5,-2"), Ok(("alpha".into(), vec![1.3, 5.0, -2.0])));
        assert_eq!(read("mu=0.25 MPa"), Ok(("mu".into(), vec![0.25e6])));
        assert_eq!(read("mu=1,2kPa"), Ok(("mu".into(), vec![1e3, 2e3])));
        assert!(parameter("mu").is_err_and(|error| error.contains("NAME=VALUE")));
        assert!(parameter("mu=soft").is_err_and(|error| error.contains("`soft`")));
    }
}
