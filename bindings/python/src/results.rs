//! Results after the computation: points without valid ones, and the order of components.

use crate::arrays::Axes;
use crate::quantity::{Number, Order};

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
            self.entries[position] = E::splat(f64::NAN);
        }
    }

    /// Puts components into an order: the 6 of a stress, or the 36 of a tangent, by row and by column.
    pub(crate) fn reorder(&mut self, order: Order) {
        /// Exchanges 23 and 12.
        const ABAQUS: [usize; 6] = [0, 1, 2, 5, 4, 3];
        if order == Order::Voigt {
            return;
        }
        for component in 0..self.components {
            let other = 6 * ABAQUS[component / 6] + ABAQUS[component % 6];
            if component < other {
                for point in 0..self.points {
                    self.entries.swap(self.position(point, component), self.position(point, other));
                }
            }
        }
    }
}
