//! Derivatives by the parameters, and the conditions that keep these admissible, for fits.

use super::Model;
use crate::algebra::by_parameters::by_parameters;
use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Graph, Id, Length, Node};
use crate::algebra::rational::Rational;
use crate::read::notation::condition_text;
use crate::read::parse::{Declaration, Parameter};

/// What a fit needs of an energy.
#[derive(Clone, Debug)]
pub struct ByParameters {
    /// ∂ψ1/∂p, ∂ψ2/∂p, ∂ψ3/∂p inside the domain for each parameter p, or for the entry of each list.
    pub gradient: Vec<[Id; 3]>,
    /// Conditions that keep parameters admissible; those on the entries of lists come last.
    pub constraints: Vec<Constraint>,
    /// Conditions on parameters that keep given stretches inside the domain.
    pub domain: Vec<Constraint>,
}

/// A condition on parameters: an expression that is positive, or at least not negative, if it holds.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Origin of the condition.
    pub limit: Limit,
    /// The length of the lists for whose entries it holds, one by one.
    pub length: Option<Length>,
    /// The expression.
    pub value: Id,
    /// Its derivative by each parameter, or by the entry of each list.
    pub by_parameters: Vec<Id>,
}

/// A limit on the parameters of a material, the origin of a condition on them.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// A comparison of `admissible(…)`, by its text.
    Admissible(String),
    /// The shear modulus at rest is positive.
    ShearModulus,
    /// The bulk modulus at rest is not negative.
    BulkModulus,
    /// A comparison of `domain(…)` at given stretches, by its text.
    Domain(String),
}

impl Model {
    /// The derivatives and conditions of a fit, derived at each call. To be called after everything else is
    /// made of the model: programs depend on what the graph already contains. A graph whose size is limited
    /// may be full afterwards, and the result then means nothing.
    pub fn by_parameters(&mut self, declaration: &Declaration) -> ByParameters {
        let options = &declaration.options;
        let graph = &mut self.graph;
        let variables: Vec<_> = declaration.parameters.iter().enumerate().map(variable).collect();
        let gradient = by_parameters(graph, &variables, self.plain.gradient);
        let admissible = options.admissible.iter().zip(&self.constrained);
        let admissible = admissible
            .filter_map(|(condition, &value)| Some((Limit::Admissible(condition_text(condition)), value?)));
        let bulk = bulk(graph, self.moduli);
        let moduli = [(Limit::ShearModulus, self.moduli[0]), (Limit::BulkModulus, bulk)];
        // Moduli of a stressed rest state determine no response.
        let moduli = moduli.into_iter().filter(|_| !options.prestressed);
        let domain = declaration.bounds().map(|condition| Limit::Domain(condition_text(condition)));
        let domain = domain.zip(self.bounds.iter().copied());
        let mut constraint = |(limit, value)| constraint(graph, &variables, limit, value);
        let mut constraints: Vec<_> = admissible.chain(moduli).map(&mut constraint).collect();
        constraints.sort_by_key(|constraint| constraint.length.is_some());
        let domain = domain.map(constraint).collect();
        ByParameters { gradient, constraints, domain }
    }
}

/// A parameter, or the entry of a list, as a variable of derivatives.
fn variable((k, parameter): (usize, &Parameter)) -> Node {
    if parameter.length().is_some() { Node::Entry(k) } else { Node::Parameter(k) }
}

fn constraint(graph: &mut Graph, variables: &[Node], limit: Limit, value: Id) -> Constraint {
    // What holds for entries is a sum over them; see `Resolver::condition`.
    let (length, value) = match (&limit, graph.node(value)) {
        (Limit::Admissible(_), &Node::Sum(length, body)) => (Some(length), body),
        _ => (None, value),
    };
    let by_parameters = by_parameters(graph, variables, [value]).into_iter().map(|[slope]| slope).collect();
    Constraint { limit, length, value, by_parameters }
}

/// λ + 2μ/3.
fn bulk(graph: &mut Graph, [shear, lame]: [Id; 2]) -> Id {
    let two_thirds = Rational::new(2, 3).unwrap_or(Rational::ONE);
    let shear = graph.scale(shear, two_thirds);
    let bulk = graph.add(lame, shear);
    expand_products(graph, bulk)
}
