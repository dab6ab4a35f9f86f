//! Origin of a material's energy, compiler or text, and functions that treat both alike.

use std::sync::{LazyLock, OnceLock};

use piola::batch::TileMaterial;
use piola::interpreter::Interpreted;
use piola::material::{Blocks, Constraint, Declared, Description, Fittable, MaterialError, Moduli, Text};
use piola::{Inversion, Material};
use piola_declare::Energy;
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;
use piola_materials::{DECLARATIONS, Declaration, Entry, FittableVisitor, Visitor};

use super::same_name;

/// An energy of the catalogue.
pub(super) struct Known {
    declaration: &'static Declaration,
    /// The compiled energy, if the program was built with it.
    compiled: Option<&'static Entry>,
    /// The energy declared at run time, made when it is first used.
    energy: OnceLock<Energy>,
}

static CATALOGUE: LazyLock<Vec<Known>> = LazyLock::new(|| {
    let known = |declaration: &'static Declaration| Known {
        declaration,
        compiled: piola_materials::find(declaration.name),
        energy: OnceLock::new(),
    };
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
        match self.compiled() {
            Some(entry) => &entry.description,
            None => self.energy().description(),
        }
    }

    /// The material for the elements of a body.
    pub(super) fn elements(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn TileMaterial<f64>>, MaterialError> {
        match self.compiled() {
            Some(entry) => Ok(entry.material(values, inversion)?),
            None => Ok(self.energy().boxed(values, inversion)?),
        }
    }

    pub(super) fn moduli(&self, values: &[&[f64]], inversion: Inversion) -> Result<Moduli, MaterialError> {
        match self.compiled() {
            Some(entry) => entry.moduli(values, inversion),
            None => Ok(Moduli::of(&self.interpreted(values, inversion)?)),
        }
    }

    pub(super) fn specimen(
        &self,
        values: &[&[f64]],
        inversion: Inversion,
    ) -> Result<Box<dyn Specimen>, MaterialError> {
        match self.compiled() {
            Some(entry) => entry.visit(values, inversion, Boxed),
            None => Ok(Box::new(self.interpreted(values, inversion)?)),
        }
    }

    /// The material as a program, whether the compiler has made another of it or not.
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
        if let Some(entry) = self.compiled() {
            return entry.visit_fittable(values, inversion, Boxed);
        }
        let energy = self.energy();
        if !energy.is_fittable() {
            return Err(MaterialError::NotFittable { material: energy.description().name.clone() });
        }
        Ok(Box::new(Fitted { energy: energy.clone(), material: energy.material(values, inversion)? }))
    }

    fn compiled(&self) -> Option<&'static Entry> {
        match self {
            Self::Catalogue(known) => known.compiled,
            Self::Declared(_) => None,
        }
    }

    /// The energy, to be interpreted or printed.
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

/// A compiled material behind a pointer.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A program is built with all energies or with two; the others give the same results either way.
    #[test]
    fn energies_that_are_not_compiled_are_those_that_are() {
        for known in CATALOGUE.iter() {
            let Some(entry) = known.compiled else { continue };
            let interpreted =
                Known { declaration: known.declaration, compiled: None, energy: OnceLock::new() };
            let origins = [known, Box::leak(Box::new(interpreted))].map(Origin::Catalogue);
            let [one, other] = &origins;
            assert_eq!(one.name(), other.name());
            assert_eq!(one.description(), other.description());
            let values = entry.typical();
            // Generated code computes moduli with the logarithms and fused operations of the standard
            // library: they differ by a few roundings of their terms.
            let moduli = origins.each_ref().map(|origin| {
                let Moduli { mu, lambda, .. } = origin.moduli(&values, Inversion::Refuse).expect("typical");
                [mu, lambda]
            });
            for k in 0..2 {
                let error = (moduli[0][k] - moduli[1][k]).abs();
                assert!(error <= 1e-12 * moduli[0][0].max(moduli[0][1]), "{}: {moduli:?}", entry.name);
            }
            let at = [1.1, 1.0, 0.95];
            let blocks = origins.each_ref().map(|origin| {
                origin.specimen(&values, Inversion::Refuse).expect("typical parameters").blocks(at)
            });
            assert_eq!(blocks[0], blocks[1], "{}", entry.name);
            let fitted = origins.each_ref().map(|origin| {
                let candidate = origin.candidate(&values, Inversion::Refuse)?;
                Ok::<_, MaterialError>((candidate.description(), candidate.values()))
            });
            assert_eq!(fitted[0], fitted[1], "{}", entry.name);
        }
    }
}
