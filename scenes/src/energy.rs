//! What a body is made of, chosen by name. The only file here that knows the catalogue.

use std::fmt;

use piola::Inversion;
use piola::batch;
use piola::material::{Description, Moduli};
use piola_materials::{CATALOGUE, Entry};

use crate::error::Error;

/// The stretch below which materials are extended unless something else is asked for.
///
/// Small enough that no body in equilibrium gets there, large enough that the extension's stiffness, of the order of
/// μ/ε², does not swamp that of the body.
pub const EXTENSION: f64 = 0.1;

/// A material of the catalogue with its parameters, not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Energy {
    material: String,
    parameters: Vec<(String, Vec<f64>)>,
    inversion: Option<Inversion>,
}

impl Energy {
    /// The material of that name, in which case, spaces, `_` and `-` do not count.
    #[must_use]
    pub fn of(material: &str) -> Self {
        Self { material: material.into(), parameters: Vec::new(), inversion: None }
    }

    /// With a value for a parameter, or several for a list; an earlier value of that name is replaced.
    #[must_use]
    pub fn with(mut self, parameter: &str, values: impl Into<Vec<f64>>) -> Self {
        self.parameters.retain(|(name, _)| name != parameter);
        self.parameters.push((parameter.into(), values.into()));
        self
    }

    /// With this behaviour outside its domain, in place of an extension below [`EXTENSION`] where it has one.
    #[must_use]
    pub fn inverting(mut self, inversion: Inversion) -> Self {
        self.inversion = Some(inversion);
        self
    }

    /// Looks the material up and checks its parameters.
    ///
    /// # Errors
    /// Where there is no such material, it has no such parameter, one has no value, or the material refuses one.
    pub fn build(&self) -> Result<Substance, Error> {
        let matches = |entry: &&Entry| {
            same_name(entry.name, &self.material) || same_name(entry.description.name, &self.material)
        };
        let entry = CATALOGUE.iter().find(matches).ok_or_else(|| Error::UnknownMaterial {
            name: self.material.clone(),
            known: CATALOGUE.iter().map(|entry| entry.name).collect(),
        })?;
        let values = self.values(entry.name, &entry.description)?;
        let inversion = self.inversion(&entry.description);
        let refused = |reason| Error::Inadmissible { material: entry.name, reason };
        Ok(Substance {
            name: entry.name,
            elements: entry.elements(&values, inversion).map_err(refused)?,
            moduli: entry.moduli(&values, inversion).map_err(refused)?,
        })
    }

    /// The values in the order of the declaration.
    fn values(&self, material: &'static str, description: &Description) -> Result<Vec<&[f64]>, Error> {
        let known: Vec<_> = description.parameters.iter().map(|parameter| parameter.name).collect();
        if let Some((parameter, _)) = self.parameters.iter().find(|(name, _)| !known.contains(&name.as_str()))
        {
            return Err(Error::UnknownParameter { material, parameter: parameter.clone(), known });
        }
        let value = |wanted: &str| {
            self.parameters.iter().find(|(name, _)| name == wanted).map(|(_, values)| values.as_slice())
        };
        let missing: Vec<_> = known.iter().copied().filter(|name| value(name).is_none()).collect();
        if missing.is_empty() {
            Ok(known.into_iter().filter_map(value).collect())
        } else {
            Err(Error::MissingParameters { material, missing })
        }
    }

    fn inversion(&self, description: &Description) -> Inversion {
        self.inversion.unwrap_or(match description.extends {
            true => Inversion::Extend { epsilon: EXTENSION },
            false => Inversion::Refuse,
        })
    }
}

/// A material with its parameters, checked.
pub struct Substance {
    /// Its name in the catalogue.
    pub name: &'static str,
    /// What elements see of it.
    pub elements: Box<dyn batch::Energy<f64>>,
    /// Its small-strain moduli.
    pub moduli: Moduli,
}

/// A page for each material of the catalogue.
pub fn pages() -> impl Iterator<Item = Page<'static>> {
    CATALOGUE.iter().map(|entry| Page {
        name: entry.name,
        description: &entry.description,
        typical: entry.typical,
    })
}

/// A material's page for a reader: formula, parameters with typical values, domain, small-strain moduli.
#[derive(Clone, Copy, Debug)]
pub struct Page<'a> {
    name: &'a str,
    description: &'a Description,
    typical: &'a [&'a [f64]],
}

impl fmt::Display for Page<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, description, typical } = self;
        let Description {
            summary, formula, parameters, domain, extends, refusal, admissible, moduli, ..
        } = description;
        writeln!(f, "{name}\n  {summary}")?;
        writeln!(f, "  ψ = {formula}")?;
        for parameter in *parameters {
            let list = if parameter.is_list { " One for each term." } else { "" };
            writeln!(f, "  {:12} {}{list}", parameter.name, parameter.doc)?;
        }
        if !admissible.is_empty() {
            writeln!(f, "  admissible   {}", admissible.join(", "))?;
        }
        let given = parameters.iter().zip(*typical).map(|(parameter, values)| {
            let values: Vec<_> = values.iter().map(f64::to_string).collect();
            format!("{}={}", parameter.name, values.join(","))
        });
        writeln!(f, "  typical      {}", given.collect::<Vec<_>>().join(" "))?;
        let beyond = match refusal {
            _ if *extends => ", can be extended beyond".to_owned(),
            Some(reason) => format!(", not extended: {reason}"),
            None => String::new(),
        };
        writeln!(f, "  domain       {domain}{beyond}")?;
        writeln!(f, "  small strain μ = {}, λ = {}", moduli[0], moduli[1])
    }
}

/// Names are compared without what people write in different ways.
fn same_name(one: &str, other: &str) -> bool {
    let letters = |name: &str| -> String {
        name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
    };
    letters(one) == letters(other)
}

#[cfg(test)]
mod tests {
    use piola::material::Parameter;

    use super::*;

    const GENT: Description = Description {
        name: "Gent",
        summary: "Rubber that locks.",
        formula: "…",
        parameters: &[
            Parameter { name: "mu", doc: "Shear modulus, Pa.", is_list: false },
            Parameter { name: "jm", doc: "Where it locks.", is_list: false },
        ],
        domain: "J > 0",
        extends: true,
        refusal: None,
        admissible: &[],
        moduli: ["mu", "kappa"],
    };

    #[test]
    fn values_come_in_the_order_of_the_declaration() {
        let energy = Energy::of("gent").with("jm", [3.0]).with("mu", [1.0]).with("mu", [2.0]);
        assert_eq!(energy.values("gent", &GENT), Ok(vec![&[2.0][..], &[3.0][..]]));
    }

    #[test]
    fn unknown_and_missing_parameters_are_named() {
        let message = |energy: Energy| energy.values("gent", &GENT).err().map(|error| error.to_string());
        assert_eq!(
            message(Energy::of("gent").with("mue", [1.0])).as_deref(),
            Some("gent has no parameter `mue`; it has `mu`, `jm`")
        );
        assert_eq!(
            message(Energy::of("gent").with("mu", [1.0])).as_deref(),
            Some("gent needs a value for `jm`; add --param jm=…")
        );
    }

    #[test]
    fn spelling_of_names_is_forgiven() {
        assert!(same_name("Saint Venant–Kirchhoff", "saint-venant_kirchhoff"));
        assert!(!same_name("neo-Hookean", "stable neo-Hookean"));
    }
}
