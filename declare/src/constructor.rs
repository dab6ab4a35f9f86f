//! The constructor of an energy: checks of the values of parameters, with the errors of a compiled one.

use std::borrow::Cow;
use std::sync::Arc;

use piola::__private::interpreter::{Program, Programs, Value};
use piola::__private::{
    Condition, Term, Values, at_rest, check_parameters, extends, inside_at_rest, same_length,
};
use piola::interpreter::Interpreted;
use piola::material::{Description, Form, MaterialError, Text};
use piola::{Inversion, Spline, Univariate};
use piola_codegen::emit::condition::{self, named};
use piola_codegen::emit::condition_text;
use piola_codegen::model::Model;
use piola_codegen::read::parse::{Declaration, Entries};

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
    /// Bounds of the domain that parameters decide at rest, as conditions and with the parameters that they
    /// name.
    at_rest: Vec<(Program, Text, Vec<usize>)>,
    pub(crate) is_prestressed: bool,
    has_functions: bool,
}

impl Constructor {
    /// The checks of a declaration; `None` if a program needs more registers than there are.
    pub(crate) fn new(declaration: &Declaration, model: &mut Model) -> Option<Self> {
        let options = &declaration.options;
        let conditions = |all: &[syn::Expr]| all.iter().map(|one| condition(declaration, one)).collect();
        let mut at_rest = Vec::new();
        for (k, value) in model.bounds_at_rest.clone() {
            let program = lower(declaration, &model.program(&[value]))?;
            let bound = declaration.bounds().nth(k);
            let checked = |bound| (program, Text::from(condition_text(bound)), named(declaration, bound));
            at_rest.extend(bound.map(checked));
        }
        Some(Self {
            lengths: declaration.parameters.iter().map(|parameter| parameter.length()).collect(),
            stated: declaration.lengths.iter().map(Entries::stated).collect(),
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

    /// The values of the parameters, each in its form; functions of the old values, if there are some, get
    /// the values that a fit changes.
    pub(crate) fn values(
        &self,
        description: &Description,
        given: &[&[f64]],
        old: &[Value],
    ) -> Result<Vec<Value>, MaterialError> {
        let function = |k: usize, list: &[f64]| match old.get(k) {
            Some(Value::Function(function)) => function.with_values(list),
            _ => Spline::from_values(list),
        };
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
        Ok(values)
    }

    /// The material with these values, if they are admissible.
    pub(crate) fn build(
        &self,
        description: &Description,
        programs: &Arc<Programs>,
        values: Vec<Value>,
        inversion: Inversion,
    ) -> Result<Interpreted, MaterialError> {
        let numbers: Vec<_> = values.iter().map(Value::numbers).collect();
        let parameters = &description.parameters;
        check_parameters(parameters, &numbers, &self.admissible)?;
        let material = Interpreted::new(programs.clone(), values.clone(), Inversion::Refuse);
        for (program, condition, names) in &self.at_rest {
            let bound = material.compute(program, &[], 0)[0];
            inside_at_rest(parameters, &numbers, bound, condition.clone(), names)?;
        }
        let material = at_rest(material, self.is_prestressed, self.has_functions)?;
        match (inversion, &self.extend) {
            (Inversion::Refuse, _) => Ok(material),
            (Inversion::Extend { .. }, None) => {
                let (material, reason) = (description.name.clone(), description.refusal.clone());
                Err(MaterialError::NoExtension { material, reason })
            }
            (Inversion::Extend { .. }, Some(conditions)) => {
                extends(parameters, &numbers, inversion, conditions)?;
                Ok(Interpreted::new(programs.clone(), values, inversion))
            }
        }
    }
}

/// A condition on parameters, which the constructor evaluates.
fn condition(declaration: &Declaration, condition: &syn::Expr) -> Condition {
    let condition::Condition { text, sides, comparison, list, names } =
        condition::Condition::new(declaration, condition, &|term| match term {
            condition::Term::Number(number) => Term::Number(number),
            condition::Term::Parameter(k) => Term::Parameter(k),
            condition::Term::Call(name, operands) => Term::Call(name.into(), operands.into()),
        });
    Condition { text: text.into(), sides, comparison, list, names: names.into() }
}
