//! Assembly for meshes of one's own: from the stiffnesses that a batch has made of linear tetrahedra to a sparse matrix.
//!
//! Who has a mesh but no [`Body`](super::Body) says once which nodes the tetrahedra join, and which of them are held. After
//! that each set of stiffnesses, as [`Batch`](crate::batch::Batch) writes them, is summed without atomics, without allocation,
//! and with the same bits for any number of threads.
//!
//! This module knows no material and no rest shape.

use faer::sparse::SparseColMatRef;

use super::Pins;
use super::fill::{NodePairs, fill};
use super::linear::LinearError;
use super::pattern::Pattern;
use crate::batch::{Layout, LengthError, PACKED_12};
use crate::lanes::Scalar;

/// The lower triangle of a symmetric matrix with a 3×3 block for each two nodes that share a tetrahedron, N/m.
///
/// Three rows and columns belong to each node that is not pinned, in an order that keeps a factor sparse: see
/// [`Pattern::free_of_node`].
///
/// ```
/// use piola::batch::{Batch, Layout};
/// use piola::material;
/// use piola::system::linear::Cholesky;
/// use piola::system::{BlockMatrix, Pins};
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
/// let mut cholesky = Cholesky::new(matrix.pattern().entries())?;
/// // … and for each deformation:
/// let rubber = Rubber::new(1e6, 4e6)?;
/// let (mut gradients, mut stiffnesses) = ([0.0; 12], [0.0; 144]);
/// Batch::new(&rubber).stiffnesses(&F, &rest, &mut gradients, &mut stiffnesses)?;
/// matrix.assemble(&stiffnesses, Layout::Points, |_| 0.0)?;
/// cholesky.factor(matrix.entries())?;
///
/// // A newton along x: λ + 2μ over an area of 1/2 and a length of 1, a third of which hangs on the node.
/// let mut displacement = [1.0, 0.0, 0.0];
/// cholesky.solve(&mut displacement);
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
    /// Zero, for tetrahedra of four different nodes each, without rows and columns of pinned nodes.
    ///
    /// # Errors
    /// Where a tetrahedron or a pin names a node that does not exist, or the pattern does not fit into memory.
    pub fn new(nodes: usize, tets: &[[usize; 4]], pins: &Pins) -> Result<Self, LinearError> {
        let pattern = Pattern::of_tets(nodes, tets, pins)?;
        let values = vec![0.0; pattern.entries().row_idx().len()];
        Ok(Self { pattern, values })
    }

    /// Sums what [`Batch::stiffnesses`](crate::batch::Batch::stiffnesses) has written in this layout, 144 numbers of each
    /// tetrahedron, and adds `diagonal(node)` to the diagonal, such as a mass over the square of a time step.
    ///
    /// In [`Layout::Lines`] what fills up the last line belongs to no tetrahedron and is left out.
    ///
    /// # Errors
    /// Where there are not as many stiffnesses as tetrahedra.
    pub fn assemble(
        &mut self,
        stiffnesses: &[f64],
        layout: Layout,
        diagonal: impl Fn(usize) -> f64 + Sync,
    ) -> Result<(), LengthError> {
        self.sum::<144>(stiffnesses, layout, |row, column| 12 * row + column, &diagonal)
    }

    /// As [`BlockMatrix::assemble`], of what [`Batch::packed_stiffnesses`](crate::batch::Batch::packed_stiffnesses) has
    /// written, 78 numbers of each.
    ///
    /// # Errors
    /// Where there are not as many stiffnesses as tetrahedra.
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

    /// The matrix as [`Cholesky::factor`](super::linear::Cholesky::factor) takes it.
    #[must_use]
    pub fn entries(&self) -> SparseColMatRef<'_, usize, f64> {
        SparseColMatRef::new(self.pattern.entries(), &self.values)
    }
}

/// Stiffnesses of N numbers each in a slice; `place` says which of them is that of a row and a column.
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
