//! Shapes at rest of a tile's tetrahedra, and how their nodes come into lines and out of them.

use super::sink::{Layout, Lines, Sink, Source};
use crate::mesh::RestShape;

/// The shapes at rest of a tile's elements.
#[derive(Clone, Debug)]
pub(crate) struct RestShapes(Lines<f64, 10>);

impl RestShapes {
    pub(crate) fn new(shapes: impl Iterator<Item = RestShape>) -> Self {
        let mut lines = Lines::zero();
        for (lane, shape) in shapes.enumerate() {
            let numbers = shape.inverse.as_flattened().iter().chain([&shape.volume]);
            for (k, &number) in numbers.enumerate() {
                lines.set(lane, k, number);
            }
        }
        Self(lines)
    }

    pub(super) fn source(&self) -> Source<'_, f64, 10> {
        self.0.source()
    }
}

/// Stores Ds: row a, column k is coordinate a of corner k + 1 less that of corner 0.
#[inline]
pub(super) fn set_edges(edges: &mut Lines<f64, 9>, lane: usize, [x0, x1, x2, x3]: [[f64; 3]; 4]) {
    for a in 0..3 {
        edges.set(lane, 3 * a, x1[a] - x0[a]);
        edges.set(lane, 3 * a + 1, x2[a] - x0[a]);
        edges.set(lane, 3 * a + 2, x3[a] - x0[a]);
    }
}

pub(super) fn by_elements(to: &mut [f64]) -> Sink<'_, f64> {
    Sink { to, layout: Layout::Points, non_temporal: None, served: 0 }
}
