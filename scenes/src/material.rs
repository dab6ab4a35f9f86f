//! Materials of bodies, chosen by name.
//!
//! Energies are interpreted, except for elements of a body whose energy the program has compiled: the
//! bindings compile those that most programs use, the command `piola` none.
//!
//! \[Ogden72\] Ogden, *Large deformation isotropic elasticity: on the correlation of theory and experiment
//! for incompressible rubberlike solids*, 1972.

use std::collections::BTreeMap;
use std::sync::{LazyLock, OnceLock};

use piola::__private::message::quoted;
use piola::batch;
use piola::interpreter::Interpreted;
use piola::material::{Description, Form, MaterialError, Moduli, Text};
use piola::{Inversion, Spline, Univariate};
use piola_declare::emit::Emission;
use piola_declare::{Energy, nearest};
use piola_laboratory::fit::Candidate;
use piola_materials::{DECLARATIONS, Declaration};
use serde::{Deserialize, Serialize};

use crate::error::{Error, list};

/// Stretch below which a material is extended unless its specification has another.
///
/// Small enough that no body in equilibrium reaches it, large enough that the extension's stiffness, of the
/// order of μ/ε², does not swamp that of the body.
pub const EXTENSION: f64 = 0.1;

/// Small-strain moduli of most scenes: E = 1 MPa, ν = 0.45.
///
/// # Panics
/// Never: a solid with these is elastic.
#[must_use]
pub fn soft_moduli() -> Moduli {
    Moduli::from_young_poisson(1e6, 0.45).expect("an elastic solid")
}

/// Ogden's three exponents \[Ogden72\] with the shear modulus shared 0.6 : 0.2 : 0.2 among them.
///
/// The small-strain shear modulus is Σ μₚαₚ/2, so a term with the share s has μₚ = 2 s μ/αₚ; the bulk
/// response is that of the first Lamé parameter. The third term, of which natural rubber has a fortieth,
/// resists flattening.
#[must_use]
pub fn ogden(moduli: Moduli) -> MaterialSpec {
    const EXPONENTS: [f64; 3] = [1.3, 5.0, -2.0];
    const SHARES: [f64; 3] = [0.6, 0.2, 0.2];
    let mu: [f64; 3] = std::array::from_fn(|p| 2.0 * SHARES[p] * moduli.mu / EXPONENTS[p]);
    MaterialSpec::new("Ogden")
        .with_parameter("mu", mu)
        .with_parameter("alpha", EXPONENTS)
        .with_parameter("kappa", [moduli.lambda])
}

/// A material with its parameters, not yet checked: one of the catalogue, or of an energy that was declared
/// at run time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialSpec {
    /// The name in messages, which for a material of the catalogue also chooses the energy.
    pub material: String,
    /// The energy, if it was declared at run time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub energy: Option<Energy>,
    parameters: Vec<(String, Vec<f64>)>,
    /// Small-strain moduli from which the parameters follow if none is given.
    moduli: Option<Moduli>,
    /// The behaviour outside of the domain, if one has been chosen.
    pub inversion: Option<Inversion>,
}

impl MaterialSpec {
    /// The material of a name, with no parameters yet; ignores case, spaces, `_` and `-`.
    #[must_use]
    pub fn new(material: &str) -> Self {
        Self {
            material: material.into(),
            energy: None,
            parameters: Vec::new(),
            moduli: None,
            inversion: None,
        }
    }

    /// Material of an energy that was declared at run time, with no parameters yet except for the typical
    /// ones of the declaration.
    #[must_use]
    pub fn declared(energy: Energy) -> Self {
        let spec = Self::new(&energy.description().name).with_typical(&energy);
        Self { energy: Some(energy), ..spec }
    }

    /// The specification with the typical parameters of an energy.
    fn with_typical(self, energy: &Energy) -> Self {
        let parameters = energy.description().parameters.iter().zip(energy.typical());
        parameters.fold(self, |spec, (parameter, values)| spec.with_parameter(&parameter.name, values))
    }

    /// The material of a name with moduli at small strain: [`ogden`], or else the typical parameters of the
    /// catalogue, [matched](piola_materials::matching): [`MaterialSpec::build`] refuses moduli that they do
    /// not reach. A parameter that is given later on replaces them all, so the others must be given, too.
    #[must_use]
    pub fn matching(material: &str, moduli: Moduli) -> Self {
        match same_name(material, "Ogden") {
            true => ogden(moduli),
            false => Self { moduli: Some(moduli), ..Self::new(material) },
        }
    }

    /// Gives a parameter its value, or several to a list; an earlier value of that name is replaced.
    #[must_use]
    pub fn with_parameter(mut self, parameter: &str, values: impl Into<Vec<f64>>) -> Self {
        self.parameters.retain(|(name, _)| name != parameter);
        self.parameters.push((parameter.into(), values.into()));
        self
    }

    /// Chooses the behaviour outside of the domain; otherwise a material that can be extended is, below
    /// [`EXTENSION`].
    #[must_use]
    pub fn with_inversion(self, inversion: Inversion) -> Self {
        Self { inversion: Some(inversion), ..self }
    }

    /// The material of a name with its typical parameters in the catalogue.
    ///
    /// # Errors
    /// [`Error::Unknown`].
    pub fn typical(material: &str) -> Result<Self, Error> {
        let (name, energy) = find(material)?;
        Ok(Self::new(name).with_typical(energy))
    }

    /// The specification with every parameter given, those that follow from moduli too.
    ///
    /// # Errors
    /// Like [`MaterialSpec::build`].
    pub fn explicit(&self) -> Result<Self, Error> {
        let parameters = self.build()?.parameters.into_iter();
        let parameters = parameters.map(|(name, values)| (name.to_string(), values)).collect();
        Ok(Self { parameters, moduli: None, ..self.clone() })
    }

    /// True if it is the material with this name in the catalogue, in any spelling.
    #[must_use]
    pub fn is(&self, material: &str) -> bool {
        self.energy.is_none() && same_name(&self.material, material)
    }

    /// The description of the material's declaration.
    ///
    /// # Errors
    /// [`Error::Unknown`].
    pub fn description(&self) -> Result<&Description, Error> {
        Ok(self.known()?.1.description())
    }

    /// Values given for a parameter, several for a list; empty if none is given.
    #[must_use]
    pub fn values_of(&self, parameter: &str) -> &[f64] {
        let given = self.parameters.iter().find(|(name, _)| name == parameter);
        given.map_or(&[], |(_, values)| values)
    }

    /// Finds the material and checks its parameters.
    ///
    /// # Errors
    /// [`Error::Unknown`], [`Error::MissingParameters`] or [`Error::Inadmissible`]; [`Error::Usage`] for a
    /// parameter that the material does not have.
    pub fn build(&self) -> Result<MaterialInfo, Error> {
        let (name, _) = self.known()?;
        let compiled = if self.energy.is_none() { piola_materials::find(&name) } else { None };
        self.resolve(|energy, values, inversion| {
            let names = energy.description().parameters.iter().map(|parameter| parameter.name.clone());
            let elements: Box<dyn batch::TileMaterial<f64>> =
                match compiled.map(|entry| entry.material(values, inversion)) {
                    // Lists have a few lengths there.
                    None | Some(Err(MaterialError::Shape { .. })) => energy.boxed(values, inversion)?,
                    Some(material) => material?,
                };
            Ok(MaterialInfo {
                name: name.clone(),
                parameters: names.zip(values).map(|(name, values)| (name, values.to_vec())).collect(),
                elements,
                moduli: Moduli::of(&energy.material(values, inversion)?),
            })
        })
    }

    /// The material as a program, also in `f32`, and as a specimen of the laboratory.
    ///
    /// # Errors
    /// Like [`MaterialSpec::build`].
    pub fn interpreted(&self) -> Result<Interpreted, Error> {
        self.resolve(|energy, values, inversion| energy.material(values, inversion))
    }

    /// The material as source text of another language: [`Energy::emit`].
    ///
    /// # Errors
    /// Like [`MaterialSpec::build`], and [`Error::Emit`].
    pub fn emit(&self, emission: &Emission) -> Result<String, Error> {
        Ok(self.resolve(|energy, values, inversion| Ok(energy.emit(values, inversion, emission)))??)
    }

    /// The material as a candidate of the laboratory, for fits of its parameters.
    ///
    /// # Errors
    /// Like [`MaterialSpec::build`].
    pub fn candidate(&self) -> Result<Candidate, Error> {
        self.resolve(|energy, values, inversion| {
            Ok(Candidate { energy: energy.clone(), material: energy.material(values, inversion)? })
        })
    }

    /// The specification with the values of a fit, as [`Energy::values`] lists them: those of a curve are
    /// ordinates of its control points.
    ///
    /// # Errors
    /// Like [`MaterialSpec::build`].
    pub fn with_fitted(&self, values: &[Vec<f64>]) -> Result<Self, Error> {
        self.resolve(|energy, given, _| {
            let mut parameters = energy.description().parameters.iter().zip(given).zip(values);
            parameters.try_fold(self.clone(), |spec, ((parameter, given), values)| {
                let values = if parameter.form == Form::Points {
                    let curve = Spline::from_values(given)?.with_values(values)?;
                    curve.points().flatten().collect()
                } else {
                    values.clone()
                };
                Ok(spec.with_parameter(&parameter.name, values))
            })
        })
    }

    /// The energy, and its name in messages, which for an energy of the catalogue is the one there.
    fn known(&self) -> Result<(Text, &Energy), Error> {
        match &self.energy {
            Some(energy) => Ok((self.material.clone().into(), energy)),
            None => find(&self.material).map(|(name, energy)| (name.into(), energy)),
        }
    }

    /// Finds the material, gives each parameter its values in the order of the declaration, and builds
    /// something from them.
    fn resolve<T>(
        &self,
        make: impl FnOnce(&Energy, &[&[f64]], Inversion) -> Result<T, MaterialError>,
    ) -> Result<T, Error> {
        let (name, energy) = self.known()?;
        let refused = |mut source| {
            // Its declaration has a meaningless name if it is a formula.
            if let (Some(_), MaterialError::NoExtension { material, .. }) = (&self.energy, &mut source) {
                *material = "the energy".into();
            }
            Error::Inadmissible { material: name.clone(), source }
        };
        let matched;
        let values = match self.moduli {
            Some(wanted) if self.parameters.is_empty() => {
                let moduli = |values: &[&[f64]]| Ok(Moduli::of(&energy.material(values, Inversion::Refuse)?));
                matched = piola_materials::matching(energy.description(), moduli, wanted).map_err(refused)?;
                matched.iter().map(Vec::as_slice).collect()
            }
            _ => self.values(&name, energy.description())?,
        };
        let usual = match energy.description().extends {
            true => Inversion::Extend { epsilon: EXTENSION },
            false => Inversion::Refuse,
        };
        make(energy, &values, self.inversion.unwrap_or(usual)).map_err(refused)
    }

    fn values(&self, material: &Text, description: &Description) -> Result<Vec<&[f64]>, Error> {
        let material = material.clone();
        let known = || description.parameters.iter().map(|parameter| &parameter.name);
        if let Some((name, _)) = self.parameters.iter().find(|(name, _)| !known().any(|known| known == name))
        {
            let names: Vec<&str> = known().map(|name| &**name).collect();
            return Err(Error::Usage(format!(
                "{material} has no parameter `{}`; {} has {}",
                quoted(name),
                near_or_it(name, &names),
                list(&names)
            )));
        }
        let value = |wanted: &Text| {
            self.parameters.iter().find(|(name, _)| wanted == name).map(|(_, values)| values.as_slice())
        };
        let missing: Vec<_> = known().filter(|name| value(name).is_none()).cloned().collect();
        if missing.is_empty() {
            Ok(known().filter_map(value).collect())
        } else {
            Err(Error::MissingParameters { material, missing })
        }
    }
}

/// "it", after a question if a name is similar to a known one, with or without an index.
fn near_or_it(name: &str, known: &[&str]) -> String {
    let near = |name: &str| nearest(name, known.iter().copied());
    let without_index = name.trim_end_matches(|c: char| c == '_' || c.is_ascii_digit());
    let near = near(name).or_else(|| near(without_index));
    near.map_or_else(|| "it".to_owned(), |near| format!("did you mean `{}`? It", quoted(near)))
}

/// Material and density of a part of a body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MaterialPart {
    /// Group of its tetrahedra; `None` for all tetrahedra that are in no other part.
    pub group: Option<String>,
    /// The material.
    pub material: MaterialSpec,
    /// Mass per rest volume, kg/m³.
    pub density: f64,
}

/// Values by the names of the parameters.
pub type Parameters = BTreeMap<Text, Vec<f64>>;

/// A material whose parameters have been checked.
pub struct MaterialInfo {
    /// Name in the catalogue, or of the declaration.
    pub name: Text,
    /// All parameters.
    pub parameters: Parameters,
    /// The energy for the elements of a body.
    pub elements: Box<dyn batch::TileMaterial<f64>>,
    /// Small-strain moduli.
    pub moduli: Moduli,
}

pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    DECLARATIONS.iter().map(|declaration| declaration.name)
}

/// The energy that the catalogue has under a name, in any spelling, and its name there.
fn find(material: &str) -> Result<(&'static str, &'static Energy), Error> {
    /// A declaration, and its energy, made when it is first used.
    type Known = (&'static Declaration, OnceLock<Energy>);
    static CATALOGUE: LazyLock<Vec<Known>> =
        LazyLock::new(|| DECLARATIONS.iter().map(|declaration| (declaration, OnceLock::new())).collect());
    let known = CATALOGUE.iter().find(|(declaration, _)| same_name(declaration.name, material));
    let Some((Declaration { name, source, .. }, energy)) = known else {
        return Err(Error::Unknown { kind: "material", name: material.into(), known: names().collect() });
    };
    Ok((name, energy.get_or_init(|| of_catalogue(source))))
}

/// The energy of a declaration of the catalogue.
///
/// # Panics
/// If it has a mistake; the tests of the catalogue compile them all.
fn of_catalogue(source: &str) -> Energy {
    Energy::from_rust(source).expect("the catalogue has no mistake")
}

/// True if two names agree in letters and digits, ignoring case.
fn same_name(one: &str, other: &str) -> bool {
    fn letters(name: &str) -> impl Iterator<Item = char> {
        name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase)
    }
    letters(one).eq(letters(other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_and_missing_parameters_are_named() {
        let message = |parameter: &str| {
            MaterialSpec::new("gent")
                .with_parameter(parameter, [1.0])
                .build()
                .err()
                .map(|error| error.to_string())
        };
        for (given, found) in [
            ("mue", "did you mean `mu`? It"),
            ("mu_1", "did you mean `mu`? It"),
            ("Jm", "did you mean `jm`? It"),
            ("xyz", "it"),
        ] {
            let expected = format!("gent has no parameter `{given}`; {found} has `mu`, `jm`, `kappa`");
            assert_eq!(message(given), Some(expected));
        }
    }

    #[test]
    fn a_declared_energy_is_called_by_its_name() -> Result<(), Box<dyn std::error::Error>> {
        let energy = Energy::from_formula("mu/2*(I1 - 3) - mu*(J - 1) + mu*(J - 1)^2")?;
        let gel = MaterialSpec { material: "gel".into(), ..MaterialSpec::declared(energy) };
        let stored: MaterialSpec = serde_json::from_str(&serde_json::to_string(&gel)?)?;
        for gel in [gel, stored] {
            let message = |gel: MaterialSpec| gel.build().err().map(|error| error.to_string());
            assert_eq!(message(gel.clone()).as_deref(), Some("gel needs a value for `mu`"));
            let gel = gel.with_parameter("mu", [1.0]);
            let extended = gel.clone().with_inversion(Inversion::Extend { epsilon: 0.1 });
            let refused = message(extended).unwrap_or_default();
            assert!(refused.starts_with("gel: the energy has no extension"), "{refused}");
            assert_eq!(gel.build()?.name, "gel");
        }
        Ok(())
    }

    #[test]
    fn spelling_of_names_is_forgiven() {
        assert!(same_name("Saint Venant–Kirchhoff", "saint-venant_kirchhoff"));
        let energy = MaterialSpec::new("st_venant_kirchhoff");
        assert!(energy.is("StVenantKirchhoff") && energy.is("St Venant-Kirchhoff") && !energy.is("hencky"));
        assert!(!same_name("neo-Hookean", "stable neo-Hookean"));
    }
}
