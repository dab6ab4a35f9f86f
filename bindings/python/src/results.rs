//! Results after the computation: points without valid ones.

use crate::arrays::Axes;
use crate::quantity::Number;

/// A result with the same number of components for each point.
pub(crate) struct Results<'a, E> {
    pub(crate) entries: &'a mut [E],
    pub(crate) axes: Axes,
    pub(crate) components: usize,
    pub(crate) points: usize,
}

impl<E: Number> Results<'_, E> {
    /// Position of a component of a point among the entries.
    fn position(&self, point: usize, component: usize) -> usize {
        match self.axes {
            Axes::Leading => self.components * point + component,
            Axes::Trailing => self.points * component + point,
        }
    }

    /// Sets all components of a point to NaN.
    pub(crate) fn invalidate(&mut self, point: usize) {
        for component in 0..self.components {
            let position = self.position(point, component);
            self.entries[position] = E::NAN;
        }
    }
}
