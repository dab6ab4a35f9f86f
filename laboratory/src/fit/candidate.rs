//! An energy whose parameters are sought, with its type out of sight.

use piola::material::{Constraint, Description, Fittable, MaterialError};

use crate::specimen::Specimen;

/// A [`Specimen`] that can be rebuilt with other parameters: any [`Fittable`] material.
pub trait Candidate: Specimen {
    /// Names, formula and domain of the declaration.
    fn description(&self) -> Description;

    /// The parameters, one list for each of the description: [`Fittable::values`].
    fn values(&self) -> Vec<Vec<f64>>;

    /// The energy with these parameters and without extension.
    ///
    /// # Errors
    /// [`MaterialError`] if the constructor refuses.
    fn with_values(&self, values: &[Vec<f64>]) -> Result<Box<dyn Candidate>, MaterialError>;

    /// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p for each number p among the parameters, at stretches λ1 ≥ λ2 ≥ λ3 > 0.
    fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]>;

    /// The conditions on the parameters: [`Fittable::constraints`].
    fn constraints(&self) -> Vec<Constraint>;

    /// The conditions of the domain at stretches λ1 ≥ λ2 ≥ λ3 > 0: [`Fittable::domain_constraints`].
    fn domain_constraints(&self, stretches: [f64; 3]) -> Vec<Constraint>;
}

impl<M: Fittable + 'static> Candidate for M {
    fn description(&self) -> Description {
        M::DESCRIPTION
    }

    fn values(&self) -> Vec<Vec<f64>> {
        Fittable::values(self)
    }

    fn with_values(&self, values: &[Vec<f64>]) -> Result<Box<dyn Candidate>, MaterialError> {
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        Ok(Box::new(Fittable::with_values(self, &values)?))
    }

    fn gradient_by_parameters(&self, stretches: [f64; 3]) -> Vec<[f64; 3]> {
        Fittable::gradient_by_parameters(self, stretches)
    }

    fn constraints(&self) -> Vec<Constraint> {
        Fittable::constraints(self)
    }

    fn domain_constraints(&self, stretches: [f64; 3]) -> Vec<Constraint> {
        Fittable::domain_constraints(self, stretches)
    }
}
