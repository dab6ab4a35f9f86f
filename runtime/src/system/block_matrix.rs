//! Assembly for meshes of one's own: from the stiffnesses that a batch computes of linear tetrahedra to a
//! sparse matrix.
//!
//! For callers with a mesh of their own and no [`Body`](super::Body): built once from the element
//! connectivity and the fixed nodes. After that each set of stiffnesses, as [`Batch`](crate::batch::Batch)
//! writes them, is summed without atomics, without allocation, and with the same bits for any number of
//! threads.
//!
//! This module knows no material and no rest shape.

use super::fill::{NodePairs, fill};
use super::linear::LinearError;
use super::memory::filled;
use super::pattern::Pattern;
use super::pins::Pins;
use crate::batch::{Layout, LengthError, PACKED_12};
use crate::lanes::Scalar;

/// The lower triangle of a symmetric matrix with a 3×3 block for each two nodes that share a tetrahedron,
/// N/m.
///
/// Three rows and columns belong to each node that is not pinned, in an order that keeps a factor sparse: see
/// [`Pattern::free_of_node`].
///
/// ```
/// use piola::batch::{Batch, Layout};
/// use piola::material;
/// use piola::system::{BlockMatrix, Cholesky, Pins};
///
/// /// Rubber.
/// #[material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // A mesh of one's own: here a tetrahedron at rest with edges along the axes, all but node 1 held.
/// let (nodes, tets, pins) = (4, [[0, 1, 2, 3]], Pins::at([0, 2, 3]));
/// let F = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
/// let rest = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0 / 6.0];
/// // Once …
/// let mut matrix = BlockMatrix::new(nodes, &tets, &pins)?;
/// let pattern = matrix.pattern();
/// let mut cholesky = Cholesky::new(pattern.column_starts(), pattern.row_indices())?;
/// // … and for each deformation:
/// let rubber = Rubber::new(1e6, 4e6)?;
/// let (mut gradients, mut stiffnesses) = ([0.0; 12], [0.0; 144]);
/// Batch::new(&rubber).stiffnesses(&F, &rest, &mut gradients, &mut stiffnesses)?;
/// matrix.assemble(&stiffnesses, Layout::Points, |_| 0.0)?;
/// cholesky.factor(matrix.values())?;
///
/// // A newton along x: λ + 2μ over an area of 1/2 and a length of 1, a third of which hangs on the node.
/// let mut displacement = [1.0, 0.0, 0.0];
/// cholesky.solve(&mut displacement)?;
/// assert!((displacement[0] - 6.0 / 6e6).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct BlockMatrix {
    pattern: Pattern,
    values: Vec<f64>,
}

impl BlockMatrix {
    /// A matrix of zeros for tetrahedra of four different nodes each, without rows and columns of pinned
    /// nodes.
    ///
    /// A free node of no tetrahedron, such as one of another kind of element, has a block on the diagonal all
    /// the same, and no other. As long as `diagonal` of [`BlockMatrix::assemble`] puts nothing there the
    /// matrix is singular, and [`Cholesky::factor`](super::Cholesky::factor) answers
    /// [`LinearError::NotPositive`] with one of its columns; a pin leaves the node out.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`] for a tetrahedron or a pin, [`LinearError::RepeatedNode`],
    /// [`LinearError::OutOfMemory`].
    pub fn new(nodes: usize, tets: &[[usize; 4]], pins: &Pins) -> Result<Self, LinearError> {
        let pattern = Pattern::of_tets(nodes, tets, pins)?;
        let values = filled(pattern.entries().row_idx().len(), 0.0)?;
        Ok(Self { pattern, values })
    }

    /// Sums the stiffnesses that [`Batch::stiffnesses`](crate::batch::Batch::stiffnesses) writes in this
    /// layout, 144 entries of each tetrahedron, N/m, and adds `diagonal(node)` to the diagonal for each free
    /// node, such as a mass over the square of a time step.
    ///
    /// In [`Layout::Lines`] the padding of the last line is left out.
    ///
    /// # Errors
    /// [`LengthError`] if there are not as many stiffnesses as tetrahedra.
    pub fn assemble(
        &mut self,
        stiffnesses: &[f64],
        layout: Layout,
        diagonal: impl Fn(usize) -> f64 + Sync,
    ) -> Result<(), LengthError> {
        self.sum::<144>(stiffnesses, layout, |row, column| 12 * row + column, &diagonal)
    }

    /// Sums the stiffnesses that [`Batch::packed_stiffnesses`](crate::batch::Batch::packed_stiffnesses)
    /// writes, 78 entries of each tetrahedron; otherwise like [`BlockMatrix::assemble`].
    ///
    /// # Errors
    /// [`LengthError`] if there are not as many stiffnesses as tetrahedra.
    pub fn assemble_packed(
        &mut self,
        stiffnesses: &[f64],
        layout: Layout,
        diagonal: impl Fn(usize) -> f64 + Sync,
    ) -> Result<(), LengthError> {
        self.sum::<78>(stiffnesses, layout, |row, column| PACKED_12[row][column], &diagonal)
    }

    fn sum<const N: usize>(
        &mut self,
        numbers: &[f64],
        layout: Layout,
        place: impl Fn(usize, usize) -> usize + Sync,
        diagonal: &(impl Fn(usize) -> f64 + Sync),
    ) -> Result<(), LengthError> {
        let group = match layout {
            Layout::Points => 1,
            Layout::Lines => f64::LINE,
        };
        let points = self.pattern.elements().next_multiple_of(group);
        if numbers.len() != N * points {
            let found = numbers.len();
            return Err(LengthError { slice: "stiffnesses", found, components: N, points, group });
        }
        fill(&self.pattern, &Slice::<_, N> { numbers, layout, place }, diagonal, &mut self.values);
        Ok(())
    }

    /// Rows and columns of the entries, and the nodes they belong to.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Values of the stored entries, N/m, in the order of [`Pattern::row_indices`], as
    /// [`Cholesky::factor`](super::Cholesky::factor) takes them.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

/// Stiffnesses of N entries each in a slice; `place` maps a row and a column to one of them.
struct Slice<'a, F, const N: usize> {
    numbers: &'a [f64],
    layout: Layout,
    place: F,
}

impl<F: Fn(usize, usize) -> usize + Sync, const N: usize> NodePairs for Slice<'_, F, N> {
    fn block(&self, element: usize, i: usize, j: usize) -> [[f64; 3]; 3] {
        let Self { numbers, layout, place } = self;
        let mut block = [[0.0; 3]; 3];
        for a in 0..3 {
            for c in 0..3 {
                let number = place(3 * i + a, 3 * j + c);
                block[a][c] = numbers[layout.index::<f64>(element, N, number)];
            }
        }
        block
    }
}

#[cfg(test)]
mod tests;
