//! Energies typed on the page, and values for the parameters that have none yet.

use std::collections::BTreeMap;

use piola::material::{Moduli, Parameter};
use piola_declare::{Energy, FormulaOptions};
use piola_scenes::error::Error;
use piola_scenes::material::MaterialSpec;

/// The longest text, in bytes: several times the longest declaration of the catalogue.
const MAX_TEXT: usize = 12 * 1024;
/// Maximum number of new parameters for which all combinations of values are tried; any more begin with 1.
const MOST_TRIED: usize = 6;

/// The material of an energy with these values. A missing parameter has the value of the present material, if
/// that has one of its name and form, or else begins with [another value](begin).
///
/// # Errors
/// An error of the material.
pub(crate) fn material(
    energy: Energy,
    given: &BTreeMap<String, Vec<f64>>,
    present: &MaterialSpec,
    moduli: Moduli,
) -> Result<MaterialSpec, Error> {
    let spec = MaterialSpec::declared(energy);
    let description = spec.description()?.clone();
    let of_present = description.parameters.iter().filter_map(|parameter| {
        let values = present.values_of(&parameter.name);
        // A list may have one entry; a number of the same name is none of them.
        let fits = if parameter.is_list() { !values.is_empty() } else { values.len() == 1 };
        fits.then_some((&*parameter.name, values))
    });
    let given = given.iter().map(|(name, values)| (name.as_str(), values.as_slice()));
    let spec = of_present.chain(given).fold(spec, |spec, (name, values)| spec.with_parameter(name, values));
    begin(spec, moduli)?.explicit()
}

/// The energy of a formula, whose names with values are parameters, or of a declaration in Rust.
///
/// # Errors
/// [`Error::Usage`] for a long text, [`Error::Declaration`].
pub(crate) fn energy(text: &str, given: &BTreeMap<String, Vec<f64>>) -> Result<Energy, Error> {
    if text.len() > MAX_TEXT {
        return Err(Error::Usage(format!(
            "the text of an energy has at most {MAX_TEXT} bytes here, and this one has {}; put a longer one into a file, \
             for `piola view --material FILE.rs`",
            text.len()
        )));
    }
    let names = given.keys().map(|name| (name.clone(), String::new()));
    let parameters = Some(names.collect());
    let options = FormulaOptions { parameters, further: true, ..FormulaOptions::default() };
    Energy::from_text_with(text, &options).map_err(Error::Declaration)
}

/// Gives each parameter without a value the shear modulus of the body, or 1: the combination with which the
/// material is about as stiff as the body was.
///
/// A formula does not declare which of its parameters are moduli.
fn begin(spec: MaterialSpec, body: Moduli) -> Result<MaterialSpec, Error> {
    let is_new = |parameter: &&Parameter| spec.values_of(&parameter.name).is_empty();
    let parameters = &spec.description()?.parameters;
    let new: Vec<_> = parameters.iter().filter(is_new).map(|parameter| parameter.name.to_string()).collect();
    let with = |combination: usize| {
        let valued = new.iter().enumerate().map(|(k, name)| (name, combination >> k & 1 == 1));
        valued.fold(spec.clone(), |spec, (name, is_modulus)| {
            spec.with_parameter(name, [if is_modulus { body.mu } else { 1.0 }])
        })
    };
    let distance = |combination: &usize| {
        let stiffness = with(*combination).build().map(|info| info.moduli);
        let away = stiffness
            .map(|moduli| (moduli.mu / body.mu).ln().abs() + (moduli.bulk() / body.bulk()).ln().abs());
        away.ok().filter(|away| away.is_finite()).unwrap_or(f64::MAX)
    };
    let tried = 1_usize << new.len().min(MOST_TRIED);
    let nearest = (0..tried).min_by(|one, other| distance(one).total_cmp(&distance(other)));
    Ok(with(nearest.unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODY: Moduli = Moduli { mu: 1e5, lambda: 4e5 };

    fn typed(text: &str, given: &[(&str, f64)]) -> Result<MaterialSpec, Error> {
        let given = given.iter().map(|&(name, value)| (name.to_owned(), vec![value])).collect();
        let present = MaterialSpec::new("neo_hookean").with_parameter("mu", [3e4]);
        material(energy(text, &given)?, &given, &present, BODY)
    }

    #[test]
    fn a_name_with_a_value_is_a_parameter() {
        let text = "mu/2*(I1 - 3) - mu*ln(J) + C*(J - 1)^2";
        assert!(typed(text, &[]).unwrap_err().to_string().contains("unknown name `C`"));
        assert_eq!(typed(text, &[("C", 2e5)]).unwrap().values_of("C"), [2e5]);
    }

    #[test]
    fn parameters_without_values_are_those_of_the_body_or_make_it_as_stiff() {
        let text = "mu/2*(I1 - 3) - mu*ln(J) + K/2*(J - 1)^2 + mu/n*(I1 - 3)^2";
        let spec = typed(text, &[]).unwrap();
        assert_eq!(["mu", "K", "n"].map(|name| spec.values_of(name)[0]), [3e4, 1e5, 1.0]);
        let spec = typed(text, &[("n", 7.0), ("mu", 2e4)]).unwrap();
        assert_eq!(["mu", "K", "n"].map(|name| spec.values_of(name)[0]), [2e4, 1e5, 7.0]);
    }

    #[test]
    fn a_list_of_the_body_is_no_value_for_a_number() {
        let present = MaterialSpec::typical("ogden").unwrap();
        let text = "mu/2*(I1 - 3) - mu*ln(J) + kappa/2*(J - 1)^2";
        let given = BTreeMap::new();
        let spec = material(energy(text, &given).unwrap(), &given, &present, BODY).unwrap();
        assert_eq!([spec.values_of("mu"), spec.values_of("kappa")], [&[1e5], present.values_of("kappa")]);
    }

    #[test]
    fn declarations_in_rust_are_known_by_their_function() {
        let gent = piola_materials::DECLARATIONS.iter().find(|known| known.name == "gent").unwrap();
        assert_eq!(typed(gent.source, &[]).unwrap().values_of("jm"), [108.0]);
    }

    #[test]
    fn mistakes_are_told_with_their_places() {
        let Err(Error::Declaration(mistakes)) = typed("mu/2*(I1 - 3", &[]) else { panic!() };
        assert_eq!(mistakes.list[0].place.unwrap().column, 6);
        let unknown = typed("mu/2*(I1 - 3) - mu*ln(J)", &[("nu", 0.3)]).unwrap_err().to_string();
        assert!(unknown.contains("nu") && unknown.contains("mu"), "{unknown}");
        let long = typed(&"1 + ".repeat(4000), &[]).unwrap_err().to_string();
        assert!(long.contains("16000"), "{long}");
    }
}
