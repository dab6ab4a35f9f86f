//! The constructor of an energy: checks of the values of parameters, with the errors of a compiled one.

use std::borrow::Cow;
use std::sync::Arc;

use piola::__private::interpreter::{ParameterValues, Program, Programs, Value};
use piola::__private::{
    Values, check_parameters, defined_at_rest, extends, same_length, stable_at_rest, stress_free_at_rest,
};
use piola::interpreter::Interpreted;
use piola::material::{Description, Form, MaterialError, Text};
use piola::{Inversion, Spline, Univariate};
use piola_codegen::model::Model;
use piola_codegen::read::parse::{Declaration, Entries};

use crate::condition::Condition;
use crate::lower::lower;

/// Checks of the values of an energy's parameters.
#[derive(Debug)]
pub(crate) struct Constructor {
    /// The length of each list, by its place among the lengths.
    lengths: Vec<Option<usize>>,
    /// The lengths that the declaration itself states.
    stated: Vec<Option<usize>>,
    /// For each length, true if its lists are arrays instead of vectors.
    are_arrays: Vec<bool>,
    admissible: Vec<Condition>,
    /// Conditions under which an extension restores; `None` without an extension.
    extend: Option<Vec<Condition>>,
    /// Bounds of the domain that parameters decide at rest.
    at_rest: Vec<(Program, Condition)>,
    pub(crate) is_prestressed: bool,
    has_functions: bool,
}

impl Constructor {
    /// The checks of a declaration; `None` if a program needs more registers than there are.
    pub(crate) fn new(declaration: &Declaration, model: &mut Model) -> Option<Self> {
        let options = &declaration.options;
        let conditions = |all: &[syn::Expr]| all.iter().map(|one| Condition::new(declaration, one)).collect();
        let bounds: Vec<_> = declaration.bounds().cloned().collect();
        let mut at_rest = Vec::new();
        for (k, value) in model.bounds_at_rest.clone() {
            let program = lower(declaration, &model.program(&[value]))?;
            at_rest.extend(bounds.get(k).map(|bound| (program, Condition::new(declaration, bound))));
        }
        let stated = declaration.lengths.iter().map(|entries| match entries {
            Entries::Known(syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(length), .. })) => {
                length.base10_parse().ok()
            }
            _ => None,
        });
        Some(Self {
            lengths: declaration.parameters.iter().map(|parameter| parameter.length()).collect(),
            stated: stated.collect(),
            are_arrays: declaration.lengths.iter().map(|entries| !entries.are_known_at_run_time()).collect(),
            admissible: conditions(&options.admissible),
            extend: options.extend.as_deref().map(conditions),
            at_rest,
            is_prestressed: options.prestressed,
            has_functions: declaration.has_functions(),
        })
    }

    /// The conditions on the parameters, with those of an extension.
    pub(crate) fn conditions(&self, inversion: Inversion) -> impl Iterator<Item = &Condition> {
        let extended = matches!(inversion, Inversion::Extend { .. });
        self.admissible.iter().chain(self.extend.iter().flatten().filter(move |_| extended))
    }

    /// The values of the parameters, each in its form.
    pub(crate) fn values(
        &self,
        description: &Description,
        given: &[&[f64]],
    ) -> Result<ParameterValues, MaterialError> {
        self.each(description, given, |_, list| Spline::from_values(list))
    }

    /// Material with other values of the parameters, in the form that a fit changes.
    pub(crate) fn changed_values(
        &self,
        description: &Description,
        old: &ParameterValues,
        given: &[Vec<f64>],
    ) -> Result<ParameterValues, MaterialError> {
        let given: Vec<_> = given.iter().map(Vec::as_slice).collect();
        self.each(description, &given, |k, list| match old.all().get(k) {
            Some(Value::Function(function)) => function.with_values(list),
            _ => Spline::from_values(list),
        })
    }

    fn each(
        &self,
        description: &Description,
        given: &[&[f64]],
        function: impl Fn(usize, &[f64]) -> Result<Spline, MaterialError>,
    ) -> Result<ParameterValues, MaterialError> {
        let mut read = Values::new(given, Cow::Borrowed(&description.parameters))?;
        let mut firsts: Vec<Option<(&Text, usize)>> = vec![None; self.stated.len()];
        let mut values = Vec::new();
        for (k, (parameter, list)) in description.parameters.iter().zip(given).enumerate() {
            let value = match (parameter.form, self.lengths[k]) {
                (Form::Points | Form::Function, _) => Value::Function(function(k, read.slice())?),
                (_, None) => Value::Numbers(vec![read.number()?]),
                (_, Some(length)) => {
                    let (name, first) = *firsts[length].get_or_insert((&parameter.name, list.len()));
                    if self.are_arrays[length] {
                        read.entries(self.stated[length].unwrap_or(first))?;
                    } else {
                        same_length((&parameter.name, read.slice().len()), (name, first))?;
                    }
                    Value::Numbers(list.to_vec())
                }
            };
            values.push(value);
        }
        Ok(ParameterValues::new(values))
    }

    /// The material with these values, if they are admissible.
    pub(crate) fn build(
        &self,
        description: &Description,
        programs: &Arc<Programs>,
        values: ParameterValues,
        inversion: Inversion,
    ) -> Result<Interpreted, MaterialError> {
        let numbers = values.all().iter().map(|value| match value {
            Value::Numbers(numbers) => &numbers[..],
            Value::Function(_) => &[],
        });
        check_parameters(&description.parameters, numbers)?;
        for condition in &self.admissible {
            if let Some(given) = condition.violation(&values) {
                return Err(MaterialError::Violated { condition: condition.text.clone(), given });
            }
        }
        let material = Interpreted::new(programs.clone(), values.clone(), Inversion::Refuse);
        for (program, condition) in &self.at_rest {
            let inside = material.compute(program, &[], 0)[0] > 0.0;
            if !inside {
                let (condition, given) = (condition.text.clone(), condition.numbers(&values));
                return Err(MaterialError::RestOutside { condition, given });
            }
        }
        let material = match (self.is_prestressed, self.has_functions) {
            (true, false) => material,
            (true, true) => defined_at_rest(material)?,
            (false, false) => stable_at_rest(material)?,
            (false, true) => {
                defined_at_rest(material).and_then(stable_at_rest).and_then(stress_free_at_rest)?
            }
        };
        let Inversion::Extend { .. } = inversion else { return Ok(material) };
        let Some(conditions) = &self.extend else {
            let (material, reason) = (description.name.clone(), description.refusal.clone());
            return Err(MaterialError::NoExtension { material, reason });
        };
        extends(inversion)?;
        for condition in conditions {
            if let Some(given) = condition.violation(&values) {
                return Err(MaterialError::DoesNotRestore { condition: condition.text.clone(), given });
            }
        }
        Ok(Interpreted::new(programs.clone(), values, inversion))
    }
}
