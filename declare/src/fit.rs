//! Derivatives by the parameters, and the conditions that keep these admissible, for fits.

use std::iter;

use piola::__private::interpreter::{Program, Value};
use piola::interpreter::Interpreted;
use piola_codegen::algebra::expr::{Function, Graph, Id, Node};
use piola_codegen::model::{self, ByParameters, Limit, Model};
use piola_codegen::read::parse::Declaration;

use crate::lower::lower;

mod differences;

use differences::by_values;

/// A condition on the parameters of a material, as a function of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Constraint {
    /// The condition.
    pub limit: Limit,
    /// A measure of the distance to the limit, positive inside: for `a > b` the difference a − b.
    pub value: f64,
    /// The derivative of the value by each number among the parameters, in the order of
    /// [`Energy::values`](crate::Energy::values), lists entry by entry.
    pub gradient: Vec<f64>,
}

/// Programs for fits of an energy.
#[derive(Debug)]
pub(crate) struct Fit {
    /// ∂ψi/∂p for each number p.
    pub(crate) gradient: Slopes,
    /// The conditions on the parameters alone.
    pub(crate) constraints: Vec<Condition>,
    /// The conditions of the domain at given stretches.
    pub(crate) domain: Vec<Condition>,
}

impl Fit {
    /// The programs of a declaration; `None` if one needs more registers than there are, or the graph becomes
    /// full.
    pub(crate) fn new(declaration: &Declaration, model: &mut Model) -> Option<Self> {
        let ByParameters { gradient, constraints, domain } = model.by_parameters(declaration);
        if model.graph.is_full() {
            return None;
        }
        let gradient: Vec<_> = gradient.iter().map(|triple| triple.to_vec()).collect();
        let gradient = Slopes::new(declaration, model, &gradient)?;
        let mut conditions = |constraints: Vec<model::Constraint>| {
            let conditions = constraints.into_iter().map(|one| Condition::new(declaration, model, one));
            conditions.collect::<Option<Vec<_>>>()
        };
        Some(Self { gradient, constraints: conditions(constraints)?, domain: conditions(domain)? })
    }
}

/// The conditions for a material, at the stretches that are the arguments of those of the domain.
pub(crate) fn constraints(
    conditions: &[Condition],
    material: &Interpreted,
    arguments: &[f64],
) -> Vec<Constraint> {
    conditions.iter().flat_map(|condition| condition.constraints(material, arguments)).collect()
}

/// A condition on the parameters as a program, with its derivatives.
#[derive(Debug)]
pub(crate) struct Condition {
    limit: Limit,
    /// A list for each of whose entries it must hold.
    list: Option<usize>,
    value: Program,
    slopes: Slopes,
}

impl Condition {
    fn new(declaration: &Declaration, model: &mut Model, constraint: model::Constraint) -> Option<Self> {
        let is_of_length = |length| {
            let mut parameters = declaration.parameters.iter();
            parameters.position(|parameter| parameter.length() == Some(length))
        };
        let slopes: Vec<_> = constraint.by_parameters.iter().map(|&slope| vec![slope]).collect();
        Some(Self {
            limit: constraint.limit,
            list: constraint.length.and_then(is_of_length),
            value: lower(declaration, &model.program(&[constraint.value]))?,
            slopes: Slopes::new(declaration, model, &slopes)?,
        })
    }

    fn constraints(&self, material: &Interpreted, arguments: &[f64]) -> Vec<Constraint> {
        let value = |material: &Interpreted, entry: usize| material.compute(&self.value, arguments, entry)[0];
        let Some(list) = self.list else {
            let slopes = self.slopes.each(material, arguments, &|material| [value(material, 0)]);
            let gradient = slopes.into_iter().map(|[slope]| slope).collect();
            return vec![Constraint { limit: self.limit.clone(), value: value(material, 0), gradient }];
        };
        let of_entry = |entry| {
            let mut gradient: Vec<_> = values(material).iter().map(|list| vec![0.0; list.len()]).collect();
            for (parameter, place, slope) in self.slopes.of_entry(material, entry) {
                gradient[parameter][place] = slope;
            }
            let (limit, value) = (self.limit.clone(), value(material, entry));
            Constraint { limit, value, gradient: gradient.concat() }
        };
        (0..length(material.values(), list)).map(of_entry).collect()
    }
}

/// Derivatives of expressions by each number among the parameters.
#[derive(Debug)]
pub(crate) struct Slopes {
    /// Programs of the derivatives by numbers, and by the entries of the lists of one length, whose first is
    /// named.
    programs: Vec<(Option<usize>, Vec<usize>, Program)>,
    /// Parameters by which no formula differentiates: functions, and what would need a third derivative of
    /// one.
    differences: Vec<usize>,
}

impl Slopes {
    /// Makes programs of the derivatives of the expressions by each parameter, or by the current entry of
    /// each list.
    fn new(declaration: &Declaration, model: &mut Model, by_parameters: &[Vec<Id>]) -> Option<Self> {
        let parameters = &declaration.parameters;
        let is_difference = |&k: &usize| {
            parameters[k].is_function() || needs_third_derivative(&model.graph, &by_parameters[k])
        };
        let (differences, known): (Vec<_>, Vec<_>) = (0..parameters.len()).partition(is_difference);
        let mut programs = Vec::new();
        for length in iter::once(None).chain((0..declaration.lengths.len()).map(Some)) {
            let alike: Vec<_> = known.iter().copied().filter(|&k| parameters[k].length() == length).collect();
            let Some(&first) = alike.first() else { continue };
            let roots: Vec<_> = alike.iter().flat_map(|&k| by_parameters[k].iter().copied()).collect();
            programs.push((length.and(Some(first)), alike, lower(declaration, &model.program(&roots))?));
        }
        Some(Self { programs, differences })
    }

    /// The derivatives of N results by each number, lists entry by entry.
    pub(crate) fn each<const N: usize>(
        &self,
        material: &Interpreted,
        arguments: &[f64],
        results: &dyn Fn(&Interpreted) -> [f64; N],
    ) -> Vec<[f64; N]> {
        let values = material.values();
        let mut slopes: Vec<Vec<[f64; N]>> = vec![Vec::new(); values.len()];
        for (list, parameters, program) in &self.programs {
            for entry in 0..list.map_or(1, |list| length(values, list)) {
                let computed = material.compute(program, arguments, entry);
                for (&k, slope) in parameters.iter().zip(computed.chunks_exact(N)) {
                    slopes[k].push(std::array::from_fn(|result| slope[result]));
                }
            }
        }
        for &k in &self.differences {
            slopes[k] = match &values[k] {
                Value::Numbers(numbers) => by_values(numbers, |moved| {
                    Some(results(&with(material, k, Value::Numbers(moved.to_vec()))))
                }),
                Value::Function(function) => by_values(&function.values(), |moved| {
                    Some(results(&with(material, k, Value::Function(function.with_values(moved).ok()?))))
                }),
            };
        }
        slopes.concat()
    }

    /// The derivatives of one result, a condition on the entry of lists, each with its parameter and place.
    /// By lists of other lengths, which may be shorter, they are zero.
    fn of_entry(&self, material: &Interpreted, entry: usize) -> Vec<(usize, usize, f64)> {
        let of_program = |(list, parameters, program): &(Option<usize>, Vec<usize>, Program)| {
            let place = if list.is_some() { entry } else { 0 };
            let slopes = parameters.iter().zip(material.compute(program, &[], entry));
            slopes.map(|(&k, slope)| (k, place, slope)).collect::<Vec<_>>()
        };
        let has_entry = |list: Option<usize>| list.is_none_or(|list| entry < length(material.values(), list));
        self.programs.iter().filter(|(list, ..)| has_entry(*list)).flat_map(of_program).collect()
    }
}

/// True if a derivative of a function occurs that functions do not provide.
fn needs_third_derivative(graph: &Graph, expressions: &[Id]) -> bool {
    graph.reachable(expressions).into_iter().any(|id| match *graph.node(id) {
        Node::Apply(Function::Given(_, order), _) => order > 2,
        Node::Quotient(Function::Given(_, order), ..) => order > 1,
        _ => false,
    })
}

/// Values of the parameters, one list for each, in the form that a fit changes.
pub(crate) fn values(material: &Interpreted) -> Vec<Vec<f64>> {
    let list = |value: &Value| match value {
        Value::Numbers(numbers) => numbers.clone(),
        Value::Function(function) => function.values(),
    };
    material.values().iter().map(list).collect()
}

/// The material with another value of a parameter, which is not checked.
fn with(material: &Interpreted, parameter: usize, value: Value) -> Interpreted {
    let mut values = material.values().to_vec();
    values[parameter] = value;
    material.clone_with(values)
}

fn length(values: &[Value], parameter: usize) -> usize {
    values.get(parameter).map_or(0, |value| value.numbers().len())
}
