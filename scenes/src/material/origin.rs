//! Origin of a material's energy, the catalogue or a text, and functions that treat both alike.
//!
//! Energies are interpreted, except for elements of a body whose energy the program has compiled: the
//! bindings compile those that most programs use, the command `piola` none.

use std::sync::{LazyLock, OnceLock};

use piola::batch::TileMaterial;
use piola::interpreter::Interpreted;
use piola::material::{Blocks, Constraint, Description, MaterialError, Moduli, Text};
use piola::{Inversion, Material};
use piola_declare::Energy;
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;
use piola_materials::{DECLARATIONS, Declaration};

use super::same_name;

/// An energy of the catalogue.
pub(super) struct Known {
    declaration: &'static Declaration,
    /// The energy, made when it is first used.
    energy: OnceLock<Energy>,
}

static CATALOGUE: LazyLock<Vec<Known>> = LazyLock::new(|| {
    let known = |declaration| Known { declaration, energy: OnceLock::new() };
    DECLARATIONS.iter().map(known).collect()
});

/// The origin of an energy.
pub(super) enum Origin<'a> {
    /// An energy of the catalogue.
    Catalogue(&'static Known),
    /// An energy that the user has declared.
    Declared(&'a Energy),
}

impl Origin<'static> {
    /// The energy that the catalogue has under a name, in any spelling.
    pub(super) fn in_catalogue(name: &str) -> Option<Self> {
        CATALOGUE.iter().find(|known| same_name(known.declaration.name, name)).map(Self::Catalogue)
    }
}

impl<'a> Origin<'a> {
    /// The name by which the material is known.
    pub(super) fn name(&self) -> Text {
        match self {
            Self::Catalogue(known) => known.declaration.name.into(),
            Self::Declared(energy) => energy.description().name.clone(),
        }
    }

    pub(super) fn description(&self) -> &'a Description {
        self.energy().description()
    }

    /// The material for the elements of a body.
    pub(super) fn elements(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn TileMaterial<f64>>, MaterialError> {
        let compiled = match self {
            Self::Catalogue(known) => piola_materials::find(known.declaration.name),
            Self::Declared(_) => None,
        };
        match compiled.map(|entry| entry.material(values, inversion)) {
            // Lists have a few lengths there.
            None | Some(Err(MaterialError::Shape { .. })) => Ok(self.energy().boxed(values, inversion)?),
            Some(material) => Ok(material?),
        }
    }

    pub(super) fn moduli(&self, values: &[&[f64]], inversion: Inversion) -> Result<Moduli, MaterialError> {
        Ok(Moduli::of(&self.interpreted(values, inversion)?))
    }

    pub(super) fn specimen(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn Specimen>, MaterialError> {
        Ok(Box::new(self.interpreted(values, inversion)?))
    }

    /// The material as a program.
    pub(super) fn interpreted(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Interpreted, MaterialError> {
        self.energy().material(values, inversion)
    }

    pub(super) fn candidate(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn Candidate>, MaterialError> {
        let energy = self.energy();
        if !energy.is_fittable() {
            return Err(MaterialError::NotFittable { material: energy.description().name.clone() });
        }
        Ok(Box::new(Fitted { energy: energy.clone(), material: energy.material(values, inversion)? }))
    }

    /// The energy.
    ///
    /// # Panics
    /// If a declaration of the catalogue has a mistake; the tests of the catalogue compile them all.
    pub(super) fn energy(&self) -> &'a Energy {
        match self {
            Self::Catalogue(known) => {
                let source = known.declaration.source;
                known.energy.get_or_init(|| Energy::from_rust(source).expect("the catalogue has no mistake"))
            }
            Self::Declared(energy) => energy,
        }
    }
}

/// A material to be fitted.
struct Fitted {
    energy: Energy,
    material: Interpreted,
}

impl Specimen for Fitted {
    fn gradient_at_strains(&self, strains: [f64; 3]) -> [f64; 3] {
        Material::gradient_at_strains(&self.material, strains)
    }

    fn hessian(&self, stretches: [f64; 3]) -> [f64; 6] {
        Specimen::hessian(&self.material, stretches)
    }

    fn blocks(&self, stretches: [f64; 3]) -> Blocks<f64> {
        Material::blocks(&self.material, stretches)
    }

    fn admits(&self, stretches: [f64; 3]) -> bool {
        Specimen::admits(&self.material, stretches)
    }
}

impl Candidate for Fitted {
    fn description(&self) -> Description {
        self.energy.description().clone()
    }

    fn values(&self) -> Vec<Vec<f64>> {
        self.energy.values(&self.material)
    }

    fn with_values(&self, values: &[Vec<f64>]) -> Result<Box<dyn Candidate>, MaterialError> {
        let material = self.energy.with_values(&self.material, values)?;
        Ok(Box::new(Self { energy: self.energy.clone(), material }))
    }

    fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]> {
        self.energy.gradient_by_parameters(&self.material, stretches)
    }

    fn constraints(&self) -> Vec<Constraint> {
        self.energy.constraints(&self.material)
    }

    fn domain_constraints(&self, stretches: [f64; 3]) -> Vec<Constraint> {
        self.energy.domain_constraints(&self.material, stretches)
    }
}
