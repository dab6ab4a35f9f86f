//! Values of options with their own notation: parameters, and the treatment of inverted material.

use piola::__private::message::quoted;
use piola::Inversion;
use piola::material::Unit;
use piola_laboratory::data::StressUnit;

/// A parameter as it is given on the command line.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Given {
    /// Its name.
    pub name: String,
    /// Its values in SI units, several to a list.
    pub values: Vec<f64>,
    /// The kind of their unit, if they were given with one: a stress, or one by a stress.
    pub unit: Option<Unit>,
}

impl Given {
    /// Documentation of the parameter, as in a declaration, if it has a unit.
    #[must_use]
    pub fn documentation(&self) -> String {
        match self.unit {
            Some(Unit::Pascal) => format!("Parameter {}, Pa.", self.name),
            Some(Unit::PerPascal) => format!("Parameter {}, 1/Pa.", self.name),
            _ => String::new(),
        }
    }
}

/// Reads `NAME=V,V,V`, with or without a unit after the last value, which is that of all, or after each: a
/// unit of stress, or one by a unit of stress as in `2e-5/MPa` and `2e-5 1/MPa`. A last 0 needs none.
///
/// # Errors
/// Description of the mistake, with a correction.
pub fn parameter(text: &str) -> Result<Given, String> {
    let (name, values) = text.split_once('=').ok_or("write NAME=VALUE, or NAME=V,V,V for a list")?;
    let values: Vec<_> = values.split(',').map(value).collect::<Result<_, _>>()?;
    let common = values.iter().rfind(|(value, unit)| unit.is_some() || *value != 0.0).and_then(|last| last.1);
    let unit = |(_, own): &(f64, Option<(Unit, f64)>)| own.or(common);
    if common.is_none() && values.iter().any(|(_, own)| own.is_some()) {
        return Err("the last value has no unit; write one after it, or after each".into());
    }
    if values.iter().any(|value| unit(value).map(|(kind, _)| kind) != common.map(|(kind, _)| kind)) {
        return Err("the values have units of two kinds; write one after the last value".into());
    }
    let in_si = |value: &(f64, _)| match unit(value) {
        Some((Unit::PerPascal, size)) => value.0 / size,
        Some((_, size)) => value.0 * size,
        None => value.0,
    };
    let (values, unit) = (values.iter().map(in_si).collect(), common.map(|(kind, _)| kind));
    Ok(Given { name: name.trim().into(), values, unit })
}

/// Reads a modulus, in Pa or with a unit of stress after it.
pub(super) fn modulus(text: &str) -> Result<f64, String> {
    match value(text)? {
        (number, None) => Ok(number),
        (number, Some((Unit::Pascal, size))) => Ok(number * size),
        _ => Err(format!("`{}` is a unit by a stress; write a stress, such as 20MPa", quoted(text))),
    }
}

/// A number, and the kind of the unit after it with the stress, Pa, that it is made of.
fn value(text: &str) -> Result<(f64, Option<(Unit, f64)>), String> {
    let text = text.trim();
    if let Ok(number) = text.parse() {
        return Ok((number, None));
    }
    // The letter of an exponent has digits behind it.
    let is_unit = |(at, c): &(usize, char)| match c {
        'e' | 'E' => !text[at + 1..].starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c)),
        c => c.is_alphabetic() || *c == '/' || c.is_whitespace(),
    };
    let end = text.char_indices().find(is_unit).map_or(text.len(), |(at, _)| at);
    let (number, unit) = text.split_at(end);
    let number = number.parse().map_err(|_| format!("`{}` is not a number", quoted(text)))?;
    let unit = unit.trim();
    let (kind, name) = match unit.strip_prefix("1/").or_else(|| unit.strip_prefix('/')) {
        Some(stress) => (Unit::PerPascal, stress),
        None => (Unit::Pascal, unit),
    };
    match name.trim().parse().map(StressUnit::pascals) {
        Ok(size) => Ok((number, Some((kind, size)))),
        Err(error) => Err(format!(
            "`{}` is not a number: {error} after it, or one divided by it, as in `2e-5/MPa`",
            quoted(text)
        )),
    }
}

/// Reads `refuse` or the stretch where an extension begins.
///
/// # Errors
/// Description of the notation.
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
        // Of Abaqus and CalculiX.
        for text in ["D1=2e-5/MPa", "D1=2e-5 1/MPa", "D1 = 2E-5 / MPa"] {
            assert_eq!(read(text), Ok(("D1".into(), vec![2e-5 / 1e6])), "{text}");
            assert_eq!(parameter(text).map(|given| given.documentation()), Ok("Parameter D1, 1/Pa.".into()));
        }
        assert_eq!(read("D1=1/Pa"), Ok(("D1".into(), vec![1.0])));
        assert_eq!(read("mu=60psi").map(|(_, values)| values), Ok(vec![60.0 * 6_894.757_293_168_361]));
        assert_eq!(read("mu=0.4 N/mm²"), Ok(("mu".into(), vec![0.4e6])));
        assert_eq!(read("mu=1MPa,2kPa"), Ok(("mu".into(), vec![1e6, 2e3])));
        assert_eq!(read("mu=160MPa,40MPa,0"), Ok(("mu".into(), vec![160e6, 40e6, 0.0])));
        assert_eq!(read("mu=0,0"), Ok(("mu".into(), vec![0.0, 0.0])));
        assert_eq!(modulus("20MPa"), Ok(2e7));
        assert!(modulus("20/MPa").is_err_and(|error| error.contains("by a stress")));
        assert!(parameter("mu=1MPa,2/kPa").is_err_and(|error| error.contains("two kinds")));
        assert!(parameter("mu=1MPa,2").is_err_and(|error| error.contains("the last value has no unit")));
        assert!(parameter("mu=1mm").is_err_and(|error| error.contains("`1mm`") && error.contains("psi")));
        assert!(parameter("mu").is_err_and(|error| error.contains("NAME=VALUE")));
        assert!(parameter("mu=soft").is_err_and(|error| error.contains("`soft`")));
    }
}
