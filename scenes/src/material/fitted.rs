//! Materials as candidates of a fit.

use piola::Material;
use piola::interpreter::Interpreted;
use piola::material::{Blocks, Constraint, Description, MaterialError};
use piola_declare::Energy;
use piola_laboratory::Specimen;
use piola_laboratory::fit::Candidate;

pub(super) struct Fitted {
    pub(super) energy: Energy,
    pub(super) material: Interpreted,
}

impl Specimen for Fitted {
    fn gradient_at_strains(&self, strains: [f64; 3]) -> [f64; 3] {
        Material::gradient_at_strains(&self.material, strains)
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
