//! Derivatives of expressions by the parameters, in the groups that a program computes together.

use crate::algebra::expr::{Graph, Id, Length, Node};
use crate::read::parse::Declaration;

/// Derivatives of expressions by each number among the parameters.
#[derive(Clone, Debug)]
pub struct Slopes {
    /// Derivatives by formulas, a group for the numbers and one for the lists of each length.
    pub groups: Vec<Group>,
    /// Parameters by which no formula differentiates: functions, and those that would need a third derivative
    /// of one.
    pub differences: Vec<usize>,
}

/// Derivatives by parameters that are numbers, or by the current entries of lists of one length.
#[derive(Clone, Debug)]
pub struct Group {
    /// The length of the lists; `None` for numbers.
    pub length: Option<Length>,
    /// The parameters, by their places in the declaration; at least one.
    pub parameters: Vec<usize>,
    /// The derivatives of all expressions by the first of them, then those by the next.
    pub roots: Vec<Id>,
}

impl Slopes {
    /// The groups of derivatives, given those of all expressions by each parameter of the declaration.
    #[must_use]
    pub fn new(graph: &Graph, declaration: &Declaration, by_parameters: &[Vec<Id>]) -> Self {
        let is_difference = |&k: &usize| {
            declaration.parameters[k].is_function() || needs_third_derivative(graph, &by_parameters[k])
        };
        let (differences, known): (Vec<_>, Vec<_>) = (0..by_parameters.len()).partition(is_difference);
        let group = |length: Option<Length>| {
            let is_member = |&k: &usize| declaration.parameters[k].length() == length;
            let parameters: Vec<_> = known.iter().copied().filter(is_member).collect();
            let roots = parameters.iter().flat_map(|&k| by_parameters[k].iter().copied()).collect();
            (!parameters.is_empty()).then_some(Group { length, parameters, roots })
        };
        let lengths = std::iter::once(None).chain((0..declaration.lengths.len()).map(Some));
        Self { groups: lengths.filter_map(group).collect(), differences }
    }
}

/// True if a derivative of a function occurs that functions do not provide.
fn needs_third_derivative(graph: &Graph, expressions: &[Id]) -> bool {
    graph.reachable(expressions).into_iter().any(|id| match *graph.node(id) {
        Node::Function(_, order, _) => order > 2,
        Node::FunctionQuotient(_, order, ..) => order > 1,
        _ => false,
    })
}
