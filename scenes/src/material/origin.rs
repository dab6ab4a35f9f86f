//! Where a material's energy is from, the catalogue or text, and what is made of both alike.

use piola::batch::TileMaterial;
use piola::interpreter::Interpreted;
use piola::material::{Blocks, Constraint, Declared, Description, Fittable, MaterialError, Moduli, Text};
use piola::{Inversion, Material};
use piola_declare::Energy;
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;
use piola_materials::{Entry, FittableVisitor, Visitor};

/// The origin of an energy.
pub(super) enum Origin<'a> {
    /// An energy that was compiled.
    Catalogue(&'static Entry),
    /// An energy that was declared at run time.
    Declared(&'a Energy),
}

impl Origin<'_> {
    /// The name by which the material is known.
    pub(super) fn name(&self) -> Text {
        match self {
            Self::Catalogue(entry) => entry.name.into(),
            Self::Declared(energy) => energy.description().name.clone(),
        }
    }

    pub(super) fn description(&self) -> &Description {
        match self {
            Self::Catalogue(entry) => &entry.description,
            Self::Declared(energy) => energy.description(),
        }
    }

    /// The material for the elements of a body.
    pub(super) fn elements(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn TileMaterial<f64>>, MaterialError> {
        match self {
            Self::Catalogue(entry) => entry.elements(values, inversion),
            Self::Declared(energy) => Ok(Box::new(energy.material(values, inversion)?)),
        }
    }

    pub(super) fn moduli(&self, values: &[&[f64]], inversion: Inversion) -> Result<Moduli, MaterialError> {
        match self {
            Self::Catalogue(entry) => entry.moduli(values, inversion),
            Self::Declared(energy) => Ok(Moduli::of(&energy.material(values, inversion)?)),
        }
    }

    pub(super) fn specimen(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn Specimen>, MaterialError> {
        match self {
            Self::Catalogue(entry) => entry.visit(values, inversion, Boxed),
            Self::Declared(energy) => Ok(Box::new(energy.material(values, inversion)?)),
        }
    }

    /// The material itself, if it was declared at run time.
    pub(super) fn interpreted(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Option<Interpreted>, MaterialError> {
        match self {
            Self::Catalogue(_) => Ok(None),
            Self::Declared(energy) => energy.material(values, inversion).map(Some),
        }
    }

    pub(super) fn candidate(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn Candidate>, MaterialError> {
        match self {
            Self::Catalogue(entry) => entry.visit_fittable(values, inversion, Boxed),
            Self::Declared(energy) if !energy.is_fittable() => {
                Err(MaterialError::NotFittable { material: self.name() })
            }
            Self::Declared(energy) => {
                let material = energy.material(values, inversion)?;
                Ok(Box::new(Fitted { energy: (*energy).clone(), material }))
            }
        }
    }
}

/// A material behind a pointer, whichever of the catalogue it is.
struct Boxed;

impl Visitor for Boxed {
    type Output = Box<dyn Specimen>;

    fn visit<M: Declared + 'static>(self, material: M) -> Self::Output {
        Box::new(material)
    }
}

impl FittableVisitor for Boxed {
    type Output = Box<dyn Candidate>;

    fn visit<M: Fittable + 'static>(self, material: M) -> Self::Output {
        Box::new(material)
    }
}

/// A material of an energy that was declared at run time, to be fitted.
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
