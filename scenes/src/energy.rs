//! What a body is made of, chosen by name. The only file here that knows the catalogue.
//!
//! \[Ogden72\] Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment for
//! incompressible rubberlike solids*, 1972.

use std::collections::BTreeMap;
use std::fmt;

use piola::Inversion;
use piola::batch;
use piola::material::{Declared, Description, Fittable, Inadmissible, Moduli};
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;
use piola_materials::{CATALOGUE, Entry, FittableVisitor, Visitor};
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// The stretch below which materials are extended unless something else is asked for.
///
/// Small enough that no body in equilibrium gets there, large enough that the extension's stiffness, of the order of
/// μ/ε², does not swamp that of the body.
pub const EXTENSION: f64 = 0.1;

/// Small-strain moduli of most bodies here: E = 1 MPa, ν = 0.45.
#[must_use]
pub fn soft() -> Moduli {
    const YOUNG: f64 = 1e6;
    const POISSON: f64 = 0.45;
    Moduli {
        mu: YOUNG / (2.0 * (1.0 + POISSON)),
        lambda: YOUNG * POISSON / ((1.0 + POISSON) * (1.0 - 2.0 * POISSON)),
    }
}

/// Ogden's three exponents \[Ogden72\] with the shear modulus shared 0.6 : 0.2 : 0.2 among them.
///
/// The small-strain shear modulus is Σ μₚαₚ/2, so a term with the share s has μₚ = 2 s μ/αₚ; the bulk response is that
/// of the first Lamé parameter. The third term, of which natural rubber has a fortieth, resists flattening.
#[must_use]
pub fn ogden(moduli: Moduli) -> Energy {
    const EXPONENTS: [f64; 3] = [1.3, 5.0, -2.0];
    const SHARES: [f64; 3] = [0.6, 0.2, 0.2];
    let mu: [f64; 3] = std::array::from_fn(|p| 2.0 * SHARES[p] * moduli.mu / EXPONENTS[p]);
    Energy::of("Ogden").with("mu", mu).with("alpha", EXPONENTS).with("kappa", [moduli.lambda])
}

/// A material of the catalogue with its parameters, not yet checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Energy {
    material: String,
    parameters: Vec<(String, Vec<f64>)>,
    /// What the parameters follow from where none is given.
    #[serde(with = "moduli")]
    moduli: Option<Moduli>,
    #[serde(with = "inversion")]
    inversion: Option<Inversion>,
}

impl Energy {
    /// The material of that name, in which case, spaces, `_` and `-` do not count.
    #[must_use]
    pub fn of(material: &str) -> Self {
        Self { material: material.into(), parameters: Vec::new(), moduli: None, inversion: None }
    }

    /// The material of that name with these moduli at small strain: [`ogden`], or else the typical parameters of the
    /// catalogue, [matched](Entry::matching). A parameter that is given later on takes their place, and all others must then be
    /// given, too.
    #[must_use]
    pub fn like(material: &str, moduli: Moduli) -> Self {
        match same_name(material, "Ogden") {
            true => ogden(moduli),
            false => Self { moduli: Some(moduli), ..Self::of(material) },
        }
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

    /// The material of that name with the typical parameters that the catalogue has for it.
    ///
    /// # Errors
    /// Where there is no such material.
    pub fn typical(material: &str) -> Result<Self, Error> {
        let entry = find(material)?;
        let parameters = entry.description.parameters.iter().zip(entry.typical());
        Ok(parameters
            .fold(Self::of(entry.name), |energy, (parameter, values)| energy.with(parameter.name, *values)))
    }

    /// The same with every parameter given.
    ///
    /// # Errors
    /// As [`Energy::build`].
    pub fn explicit(&self) -> Result<Self, Error> {
        let parameters = self.build()?.parameters.into_iter();
        let parameters = parameters.map(|(name, values)| (name.to_owned(), values)).collect();
        Ok(Self { parameters, moduli: None, ..self.clone() })
    }

    /// Whether it is the material of that name, in the spelling that is forgiven.
    #[must_use]
    pub fn is(&self, material: &str) -> bool {
        find(&self.material).is_ok_and(|entry| find(material).is_ok_and(|other| std::ptr::eq(entry, other)))
    }

    /// What the material says of itself.
    ///
    /// # Errors
    /// Where there is no such material.
    pub fn description(&self) -> Result<&'static Description, Error> {
        find(&self.material).map(|entry| &entry.description)
    }

    /// The values given for a parameter, several for a list, none where none is given.
    #[must_use]
    pub fn values_of(&self, parameter: &str) -> &[f64] {
        let given = self.parameters.iter().find(|(name, _)| name == parameter);
        given.map_or(&[], |(_, values)| values)
    }

    /// Looks the material up and checks its parameters.
    ///
    /// # Errors
    /// Where there is no such material, it has no such parameter, one has no value, or the material refuses one.
    pub fn build(&self) -> Result<Substance, Error> {
        let Resolved { entry, values, inversion } = self.resolve()?;
        let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
        let refused = |reason| Error::Inadmissible { material: entry.name, reason };
        let names = entry.description.parameters.iter().map(|parameter| parameter.name);
        Ok(Substance {
            name: entry.name,
            parameters: names.zip(&values).map(|(name, values)| (name, values.to_vec())).collect(),
            elements: entry.elements(&values, inversion).map_err(refused)?,
            moduli: entry.moduli(&values, inversion).map_err(refused)?,
        })
    }

    /// The material on the bench, for test curves and their stability.
    ///
    /// # Errors
    /// As [`Energy::build`].
    pub fn specimen(&self) -> Result<Box<dyn Specimen>, Error> {
        struct Boxed;
        impl Visitor for Boxed {
            type Output = Box<dyn Specimen>;
            fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
                Box::new(material)
            }
        }
        self.visit(|entry, values, inversion| entry.visit(values, inversion, Boxed))
    }

    /// The same for fits of its parameters.
    ///
    /// # Errors
    /// As [`Energy::build`], and where the material has functions as parameters.
    pub fn candidate(&self) -> Result<Box<dyn Candidate>, Error> {
        struct Boxed;
        impl FittableVisitor for Boxed {
            type Output = Box<dyn Candidate>;
            fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
                Box::new(material)
            }
        }
        self.visit(|entry, values, inversion| entry.visit_fittable(values, inversion, Boxed))
    }

    /// What an entry of the catalogue makes of all parameters.
    fn visit<T>(
        &self,
        visit: impl Fn(&Entry, &[&[f64]], Inversion) -> Result<T, Inadmissible>,
    ) -> Result<T, Error> {
        let Resolved { entry, values, inversion } = self.resolve()?;
        let values: Vec<_> = values.iter().map(Vec::as_slice).collect();
        visit(entry, &values, inversion)
            .map_err(|reason| Error::Inadmissible { material: entry.name, reason })
    }

    /// Looks the material up and gives each parameter its values, which it may refuse.
    fn resolve(&self) -> Result<Resolved, Error> {
        let entry = find(&self.material)?;
        let refused = |reason| Error::Inadmissible { material: entry.name, reason };
        let values = match self.moduli {
            Some(moduli) if self.parameters.is_empty() => entry.matching(moduli).map_err(refused)?,
            _ => self.values(entry.name, &entry.description)?.into_iter().map(<[f64]>::to_vec).collect(),
        };
        Ok(Resolved { entry, values, inversion: self.inversion(&entry.description) })
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

/// All that a material is built from.
struct Resolved {
    entry: &'static Entry,
    /// In the order of the declaration.
    values: Vec<Vec<f64>>,
    inversion: Inversion,
}

/// Values by the names of the parameters.
pub type Parameters = BTreeMap<&'static str, Vec<f64>>;

/// A material with its parameters, checked.
pub struct Substance {
    /// Its name in the catalogue.
    pub name: &'static str,
    /// Its parameters.
    pub parameters: Parameters,
    /// What elements see of it.
    pub elements: Box<dyn batch::Energy<f64>>,
    /// Its small-strain moduli.
    pub moduli: Moduli,
}

/// Name and description of each material of the catalogue.
pub fn catalogue() -> impl Iterator<Item = (&'static str, &'static Description)> {
    CATALOGUE.iter().map(|entry| (entry.name, &entry.description))
}

/// The entry of that name, in the catalogue's spelling or that of the declaration.
fn find(material: &str) -> Result<&'static Entry, Error> {
    let matches =
        |entry: &&Entry| same_name(entry.name, material) || same_name(entry.description.name, material);
    CATALOGUE.iter().find(matches).ok_or_else(|| Error::UnknownMaterial {
        name: material.into(),
        known: CATALOGUE.iter().map(|entry| entry.name).collect(),
    })
}

/// A page for each material of the catalogue.
pub fn pages() -> impl Iterator<Item = Page<'static>> {
    CATALOGUE.iter().map(|entry| Page {
        name: entry.name,
        description: &entry.description,
        typical: entry.typical(),
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
            let list = if parameter.is_list() { " One for each term." } else { "" };
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

/// Moduli in files: the Lamé parameters `[mu, lambda]`, or null.
mod moduli {
    use piola::material::Moduli;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(super) fn serialize<S: Serializer>(
        moduli: &Option<Moduli>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        moduli.map(|Moduli { mu, lambda }| [mu, lambda]).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Moduli>, D::Error> {
        let written = Option::<[f64; 2]>::deserialize(deserializer)?;
        Ok(written.map(|[mu, lambda]| Moduli { mu, lambda }))
    }
}

/// An inversion in files: `"refuse"`, `{"extend": STRETCH}`, or null where it is left to the material.
mod inversion {
    use piola::Inversion;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Written {
        Refuse,
        Extend(f64),
    }

    pub(super) fn serialize<S: Serializer>(
        inversion: &Option<Inversion>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let written = inversion.map(|inversion| match inversion {
            Inversion::Refuse => Written::Refuse,
            Inversion::Extend { epsilon } => Written::Extend(epsilon),
        });
        written.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Inversion>, D::Error> {
        let written = Option::<Written>::deserialize(deserializer)?;
        Ok(written.map(|written| match written {
            Written::Refuse => Inversion::Refuse,
            Written::Extend(epsilon) => Inversion::Extend { epsilon },
        }))
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
    use piola::material::{Form, Parameter, Unit};

    use super::*;

    const GENT: Description = Description {
        name: "Gent",
        summary: "Rubber that locks.",
        formula: "…",
        parameters: &[
            Parameter { name: "mu", doc: "Shear modulus, Pa.", unit: Some(Unit::Pascal), form: Form::Number },
            Parameter { name: "jm", doc: "Where it locks.", unit: None, form: Form::Number },
        ],
        domain: "J > 0",
        extends: true,
        refusal: None,
        admissible: &[],
        moduli: ["mu", "kappa"],
        typical: None,
    };

    #[test]
    fn most_bodies_are_as_stiff_as_said() {
        assert_eq!(Moduli::from_young_poisson(1e6, 0.45), Ok(soft()));
    }

    #[test]
    fn values_come_in_the_order_of_the_declaration() {
        let energy = Energy::of("gent").with("jm", [3.0]).with("mu", [1.0]).with("mu", [2.0]);
        assert_eq!(energy.values("gent", &GENT), Ok(vec![&[2.0][..], &[3.0][..]]));
    }

    #[test]
    fn energies_survive_being_written() -> Result<(), Box<dyn std::error::Error>> {
        for inversion in [Inversion::Refuse, Inversion::Extend { epsilon: 0.1 }] {
            let energy = Energy::of("gent").with("mu", [0.1, 1e300]).inverting(inversion);
            let text = serde_json::to_string(&energy)?;
            assert_eq!(serde_json::from_str::<Energy>(&text)?, energy, "{text}");
        }
        Ok(())
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
    fn moduli_stand_in_for_parameters() {
        for name in
            ["rotated linear", "fixed corotated", "stable neo-Hookean", "Ogden", "st_venant_kirchhoff"]
        {
            let moduli = Energy::like(name, soft()).build().map(|substance| substance.moduli);
            let error =
                moduli.map(|moduli| (moduli.young() / 1e6 - 1.0).abs().max((moduli.poisson() - 0.45).abs()));
            // A dozen roundings.
            assert!(error.as_ref().is_ok_and(|&error| error < 1e-14), "{name}: {error:?}");
        }
        let matched = Energy::like("gent", soft());
        let explicit = matched.explicit();
        assert!(explicit.as_ref().is_ok_and(|energy| energy.values_of("jm") == [108.0]), "{explicit:?}");
        let moduli = |energy: &Energy| energy.build().map(|substance| substance.moduli);
        assert_eq!(explicit.and_then(|energy| moduli(&energy)), moduli(&matched));
        let incomplete = Energy::like("st_venant_kirchhoff", soft()).with("mu", [1.0]).build().err();
        assert!(matches!(incomplete, Some(Error::MissingParameters { .. })), "{incomplete:?}");
    }

    #[test]
    fn a_material_answers_to_both_its_names() {
        let energy = Energy::of("st_venant_kirchhoff");
        assert!(energy.is("StVK") && energy.is("St Venant-Kirchhoff") && !energy.is("hencky"));
    }

    #[test]
    fn spelling_of_names_is_forgiven() {
        assert!(same_name("Saint Venant–Kirchhoff", "saint-venant_kirchhoff"));
        assert!(!same_name("neo-Hookean", "stable neo-Hookean"));
    }
}
