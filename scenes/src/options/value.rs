//! Values of options that have a notation of their own: parameters, and how inverted material is treated.

use piola::Inversion;

/// A parameter as it is given on the command line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Given {
    pub(crate) name: String,
    /// Its values in SI units, several to a list.
    pub(crate) values: Vec<f64>,
    /// Whether they were given with a unit, in which case that is Pa.
    has_unit: bool,
}

impl Given {
    /// Documentation of the parameter, as in a declaration.
    pub(crate) fn documentation(&self) -> String {
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
pub(crate) fn parameter(text: &str) -> Result<Given, String> {
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
pub(crate) fn inversion(text: &str) -> Result<Inversion, String> {
    if text == "refuse" {
        return Ok(Inversion::Refuse);
    }
    let epsilon = text.parse().map_err(|_| "write `refuse`, or a stretch between 0 and 1")?;
    Ok(Inversion::Extend { epsilon })
}
