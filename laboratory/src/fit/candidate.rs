//! An energy whose parameters are sought.

use piola::Material;
use piola::interpreter::Interpreted;
use piola::material::{Blocks, Description, MaterialError};
use piola_declare::{Constraint, Energy};

use crate::specimen::Specimen;

/// A material of an energy that was declared at run time, which can be rebuilt with other parameters.
#[derive(Clone, Debug)]
pub struct Candidate {
    energy: Energy,
    material: Interpreted,
}

impl Candidate {
    /// The material of an energy, as [`Energy::material`] makes it.
    #[must_use]
    pub fn new(energy: Energy, material: Interpreted) -> Self {
        Self { energy, material }
    }

    /// Names, formula and domain of the declaration.
    #[must_use]
    pub fn description(&self) -> &Description {
        self.energy.description()
    }

    /// The parameters, one list for each of the description: [`Energy::values`].
    #[must_use]
    pub fn values(&self) -> Vec<Vec<f64>> {
        self.energy.values(&self.material)
    }

    /// The energy with these parameters and without extension.
    ///
    /// # Errors
    /// [`MaterialError`] of [`Energy::with_values`].
    pub fn with_values(&self, values: &[Vec<f64>]) -> Result<Self, MaterialError> {
        Ok(Self::new(self.energy.clone(), self.energy.with_values(&self.material, values)?))
    }

    /// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each number p among the parameters, at stretches λ1 ≥ λ2 ≥ λ3 > 0:
    /// [`Energy::gradient_by_parameters`].
    #[must_use]
    pub fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]> {
        self.energy.gradient_by_parameters(&self.material, stretches)
    }

    /// The conditions on the parameters: [`Energy::constraints`].
    #[must_use]
    pub fn constraints(&self) -> Vec<Constraint> {
        self.energy.constraints(&self.material)
    }

    /// The conditions of the domain at stretches λ1 ≥ λ2 ≥ λ3 > 0: [`Energy::domain_constraints`].
    #[must_use]
    pub fn domain_constraints(&self, stretches: [f64; 3]) -> Vec<Constraint> {
        self.energy.domain_constraints(&self.material, stretches)
    }
}

impl Specimen for Candidate {
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
