//! An energy whose parameters are sought, with its type out of sight, and its parameters as one row of
//! numbers.

use piola::material::{Constraint, Description, Fittable, Form, MaterialError, Text};

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

/// The parameters of an energy, lists and functions value by value.
#[derive(Clone, Debug, Default)]
pub(super) struct Numbers {
    /// Names such as `kappa`, `mu_1` for the first entry of a list, or `f_1` for the first value of a
    /// function.
    pub(super) names: Vec<String>,
    /// For each, the name of the parameter that it belongs to.
    owners: Vec<Text>,
    pub(super) values: Vec<f64>,
    /// For each, true if it is an exponent that is whole, and so cannot change by little.
    pub(super) are_whole: Vec<bool>,
    /// The number of entries of each parameter, and its form.
    parameters: Vec<(usize, Form)>,
}

impl Numbers {
    pub(super) fn of(candidate: &dyn Candidate) -> Self {
        let mut numbers = Self::default();
        for (parameter, list) in candidate.description().parameters.iter().zip(candidate.values()) {
            for entry in 1..=list.len() {
                numbers.names.push(match parameter.is_list() {
                    true => format!("{}_{entry}", parameter.name),
                    false => parameter.name.to_string(),
                });
                numbers.owners.push(parameter.name.clone());
                numbers.are_whole.push(parameter.is_whole());
            }
            numbers.parameters.push((list.len(), parameter.form));
            numbers.values.extend(list);
        }
        numbers
    }

    /// True if `name` is a parameter, or a list that contains this entry.
    pub(super) fn is_named(&self, number: usize, name: &str) -> bool {
        self.names[number] == name || self.owners[number] == name
    }

    /// The values as lists, one for each parameter.
    pub(super) fn lists(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let mut rest = values;
        let mut next = |length: usize| {
            let (list, after) = rest.split_at(length);
            rest = after;
            list.to_vec()
        };
        self.parameters.iter().map(|&(length, _)| next(length)).collect()
    }

    /// The numbers of the parameters that are not the same, each list being in an order of its own: terms of
    /// a sum that change places are the same energy, those of each sum by themselves. Values of a function
    /// are compared in their order.
    pub(super) fn differing(
        &self,
        one: &[f64],
        other: &[f64],
        is_same: impl Fn(usize, f64, f64) -> bool,
    ) -> Vec<usize> {
        let mut begin = 0;
        let mut differing = Vec::new();
        for &(length, form) in &self.parameters {
            let list = begin..begin + length;
            let [one, other] = [one, other].map(|values| {
                let mut sorted = values[list.clone()].to_vec();
                if form == Form::List {
                    sorted.sort_by(f64::total_cmp);
                }
                sorted
            });
            let mut pairs = list.clone().zip(one.into_iter().zip(other));
            if !pairs.all(|(number, (one, other))| is_same(number, one, other)) {
                differing.extend(list);
            }
            begin += length;
        }
        differing
    }
}
