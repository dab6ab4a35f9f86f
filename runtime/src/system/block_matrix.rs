//! Assembly for meshes of one's own: from the stiffnesses that a batch computes of linear tetrahedra to a
//! sparse matrix.
//!
//! For callers with a mesh of their own and no [`Body`], and for a body whose integrator is a caller's: built
//! once from the element connectivity and the fixed nodes. After that each set of stiffnesses, as
//! [`Batch`](crate::batch::Batch) writes them, is summed without atomics, without allocation, and with the
//! same bits for any number of threads.
//!
//! This module knows no material.

use faer::sparse::SparseColMatRef;

use super::body::Body;
use super::fill::{NodePairs, fill};
use super::linear::LinearError;
use super::lower_triangle::LowerTriangle;
use super::memory::filled;
use super::pattern::Pattern;
use super::pins::Pins;
use super::stiffnesses::ElementStiffnesses;
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

    /// A matrix of zeros for the elements of a body, without rows and columns of pinned nodes:
    /// [`ElasticResponse::stiffness`](super::ElasticResponse::stiffness) writes its stiffness there.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`] for a pin, [`LinearError::OutOfMemory`].
    pub fn of_body(body: &Body, pins: &Pins) -> Result<Self, LinearError> {
        let pattern = Pattern::new(body.rest().len(), body.elements(), pins)?;
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

    /// Replaces the entries by the sums of stiffnesses of elements.
    pub(super) fn fill(&mut self, stiffnesses: &ElementStiffnesses) {
        stiffnesses.fill(&self.pattern, |_| 0.0, &mut self.values);
    }

    /// Adds to the block of two nodes, N/m, and to its transpose, as for a contact or a spring between them;
    /// on the diagonal to the one block of a node. Nothing is added where a node is pinned.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`], or [`LinearError::NotJoined`] if no tetrahedron has both nodes.
    pub fn add_block(&mut self, row: usize, column: usize, block: [[f64; 3]; 3]) -> Result<(), LinearError> {
        let nodes = self.pattern.free_of_node().len();
        if let Some(&node) = [row, column].iter().find(|&&node| node >= nodes) {
            return Err(LinearError::NoSuchNode { node, nodes });
        }
        let Some(at) = self.place(row, column) else {
            let free = self.pattern.free_of_node();
            let is_free = free[row].is_some() && free[column].is_some();
            return if is_free { Err(LinearError::NotJoined { nodes: [row, column] }) } else { Ok(()) };
        };
        for r in 0..3 {
            for c in 0..if row == column { r + 1 } else { 3 } {
                let entry = if at.is_transposed { block[c][r] } else { block[r][c] };
                self.values[self.pattern.scalar(at.column, at.block, r, c)] += entry;
            }
        }
        Ok(())
    }

    /// The block of two nodes, N/m; `None` where a node is pinned or missing, or no tetrahedron has both.
    #[must_use]
    pub fn block(&self, row: usize, column: usize) -> Option<[[f64; 3]; 3]> {
        let at = self.place(row, column)?;
        let entry = |r: usize, c: usize| {
            let (r, c) = if at.is_transposed || (row == column && r < c) { (c, r) } else { (r, c) };
            self.values[self.pattern.scalar(at.column, at.block, r, c)]
        };
        Some(std::array::from_fn(|r| std::array::from_fn(|c| entry(r, c))))
    }

    /// Where the block of two nodes is stored.
    fn place(&self, row: usize, column: usize) -> Option<Place> {
        let number = |node: usize| *self.pattern.free_of_node().get(node)?;
        let (i, j) = (number(row)?, number(column)?);
        let (below, column) = (i.max(j), i.min(j));
        Some(Place { column, block: self.pattern.block(below, column)?, is_transposed: i < j })
    }

    /// Rows and columns of the entries, and the nodes they belong to.
    #[must_use]
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The matrix as a solver takes it.
    #[must_use]
    pub fn lower_triangle(&self) -> LowerTriangle<'_> {
        LowerTriangle(SparseColMatRef::new(self.pattern.entries(), &self.values))
    }

    /// Values of the stored entries, N/m, in the order of [`Pattern::row_indices`], as
    /// [`Cholesky::factor`](super::Cholesky::factor) takes them.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of [`BlockMatrix::values`], to be changed.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }
}

/// A block of a column, stored as it is asked for or transposed.
struct Place {
    column: usize,
    block: usize,
    is_transposed: bool,
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
