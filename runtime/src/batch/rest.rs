//! Shapes at rest of a tile's tetrahedra, and how what belongs to their nodes comes out of lines.

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

pub(super) fn by_elements(to: &mut [f64]) -> Sink<'_, f64> {
    Sink { to, layout: Layout::Points, non_temporal: None, served: 0 }
}
