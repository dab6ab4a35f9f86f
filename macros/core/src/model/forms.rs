//! The forms of an energy: rewritings that keep its value and save digits, range or sign, in their order.
//!
//! | form | made by | of | for |
//! |---|---|---|---|
//! | squares | [`with_squares`] | energy and bounds as resolved | judges, readers, the continuation |
//! | accurate | [`with_squares_in_sums`] | energy in squares | the next form |
//! | joined | [`over_one_denominator`] | accurate energy | the next form; needs the samples of judges |
//! | in range | [`separate`], for J > 0 | joined energy, bounds in squares | derivatives |
//! | evaluated | [`lower`], then [`squares_alone`] | derivatives, bounds in range | programs |
//!
//! Squares are found in what is written, and so come first. What they were written as is left out last: some
//! derivatives are those of it.

use rustc_hash::FxHashMap;

use crate::algebra::cancellation::{Ways, over_one_denominator};
use crate::algebra::excess::{has_squares, squares_alone, with_squares, with_squares_in_sums};
use crate::algebra::expr::{Graph, Id};
use crate::algebra::extension::lower;
use crate::algebra::interpret::Point;
use crate::algebra::volume::{Purpose, separate};
use crate::judge::Source;
use crate::read::domain::Volume;
use crate::read::resolve::Nodes;

/// The energy and the bounds in squares, and the nodes of its parts with them.
pub(super) fn in_squares(graph: &mut Graph, energy: Id, bounds: Vec<Id>, nodes: &mut Nodes) -> (Id, Vec<Id>) {
    let energy = with_squares(graph, energy);
    if has_squares(graph, energy) {
        nodes.replace(|id| with_squares(graph, id));
    }
    (energy, bounds.into_iter().map(|bound| with_squares(graph, bound)).collect())
}

/// An energy and its bounds in the forms that are differentiated and evaluated.
pub(super) struct Prepared {
    /// The energy in range.
    pub(super) energy: Id,
    /// The bounds, evaluated.
    pub(super) bounds: Vec<Id>,
    /// True if real powers are taken of sums of squares, in the energy or in a bound.
    pub(super) has_squares: bool,
    /// The paths on which sums are tested for cancellation.
    pub(super) ways: Ways,
}

/// The forms that follow the first one.
pub(super) fn prepare(graph: &mut Graph, source: &Source<'_>, samples: &[Point]) -> Prepared {
    let in_range = |graph: &mut Graph, id| match source.volume {
        Volume::Positive => separate(graph, id, Purpose::Evaluation),
        _ => id,
    };
    let mut evaluated = Evaluated::default();
    let bounds = source.bounds.iter().map(|&bound| {
        let bound = in_range(graph, bound);
        evaluated.of(graph, bound)
    });
    let bounds = bounds.collect();
    let ways = Ways::new(samples, |point| source.is_inside(graph, point));
    let accurate = with_squares_in_sums(graph, source.energy);
    let joined = over_one_denominator(graph, accurate, &ways);
    let has_squares =
        has_squares(graph, accurate) || source.bounds.iter().any(|&bound| has_squares(graph, bound));
    Prepared { energy: in_range(graph, joined), bounds, has_squares, ways }
}

/// The last form of expressions, which programs compute.
#[derive(Default)]
pub(super) struct Evaluated {
    lowered: FxHashMap<Id, Id>,
    alone: FxHashMap<Id, Id>,
}

impl Evaluated {
    pub(super) fn of(&mut self, graph: &mut Graph, id: Id) -> Id {
        let id = lower(graph, id, &mut self.lowered);
        squares_alone(graph, id, &mut self.alone)
    }
}
