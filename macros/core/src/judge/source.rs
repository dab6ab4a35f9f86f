//! Interface of a declaration to the judges: its tokens and the expressions that they stand for.

use syn::Ident;

use crate::algebra::expr::{Graph, Id};
use crate::algebra::interpret::{Point, evaluate};
use crate::read::domain::Volume;
use crate::read::notation::Notation;
use crate::read::parse::{Declaration, mentions};
use crate::read::resolve::Nodes;

/// A declaration whose names are resolved.
pub(crate) struct Source<'a> {
    pub(crate) declaration: &'a Declaration,
    /// The node of each expression of the body.
    pub(crate) nodes: Nodes,
    /// The energy as written.
    pub(crate) energy: Id,
    /// Expressions that are positive inside the domain, apart from J, in the order of the conditions.
    pub(crate) bounds: &'a [Id],
    /// Expressions of parameters that are positive.
    pub(crate) admissible: &'a [Id],
    pub(crate) volume: Volume,
    /// The notation of messages.
    pub(crate) notation: Notation,
}

impl Source<'_> {
    /// True if the conditions of the domain hold, except for those on J.
    pub(crate) fn is_inside(&self, graph: &Graph, point: &Point) -> bool {
        self.bounds.iter().all(|&bound| evaluate(graph, bound, point).value > 0.0)
    }

    /// True if the parameters are admissible and give the energy a value at rest. At other stretches a
    /// missing value may be the very mistake to be found.
    pub(crate) fn is_good_at_rest(&self, graph: &Graph, point: &Point) -> bool {
        let rest = at_rest(point);
        self.admissible.iter().all(|&id| evaluate(graph, id, &rest).value > 0.0)
            && self.is_inside(graph, &rest)
            && evaluate(graph, self.energy, &rest).value.is_finite()
    }

    /// Invariants I1 and I2 that are written in the energy.
    pub(crate) fn invariants(&self) -> Vec<&'static str> {
        ["I1", "I2"].into_iter().filter(|invariant| self.is_written_in(&[*invariant])).collect()
    }

    /// True if one of the names is written in the energy.
    pub(crate) fn is_written_in(&self, names: &[&str]) -> bool {
        mentions(&self.declaration.body, names)
    }

    /// The word `extend` of the attribute.
    pub(crate) fn extend(&self) -> Option<&Ident> {
        self.declaration.options.words.iter().find(|word| *word == "extend")
    }
}

/// The undeformed state with the parameters of a point.
pub(crate) fn at_rest(point: &Point) -> Point {
    Point { stretches: [1.0; 3], ..point.clone() }
}
