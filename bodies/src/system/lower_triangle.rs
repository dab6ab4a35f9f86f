//! The stiffness of a body as the lower triangle of a sparse matrix, for factorisations.
//!
//! Unknowns are the coordinates of the nodes that are not pinned, numbered so that a Cholesky factor stays
//! sparse: by approximate minimum degree on the graph of nodes, whose edges are 3×3 blocks. Without the
//! feature `faer` they have the order of the nodes.

use std::ops::Range;
use std::sync::Arc;

use piola::NoSuchNode;

use super::linear::{LinearError, fits, ordering};
use super::memory::{filled, reserved};
use super::nodal_stiffness::NodalStiffness;
use super::pins::Pins;

/// Lower triangle of a [`NodalStiffness`], N/m, without the rows and columns of pinned nodes, in compressed
/// columns: the form of SciPy's `csc_matrix` and of most sparse solvers.
///
/// Entries of column c are those from `column_starts()[c]` to `column_starts()[c + 1]`, their rows ascending
/// from the diagonal, which is always stored. Three rows belong to each free node, in an order that keeps a
/// factor sparse (with the feature `faer`; otherwise in the order of the nodes). Read as compressed rows, the
/// same slices are the upper triangle.
#[derive(Clone, Debug)]
pub struct LowerTriangle {
    column_starts: Arc<Vec<usize>>,
    row_indices: Arc<Vec<usize>>,
    values: Vec<f64>,
    /// Index of each entry among the scalars of the blocks of the stiffness.
    sources: Vec<u32>,
    /// Number of blocks of the stiffness.
    blocks: usize,
    free_nodes: Vec<usize>,
    /// Index of each node in `free_nodes`; `None` for a pinned node.
    free_of_node: Vec<Option<usize>>,
}

impl LowerTriangle {
    /// Matrix of zeros, which [`LowerTriangle::fill`] replaces by the entries of the stiffness.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`] for a pin, [`LinearError::OutOfMemory`].
    pub fn new(stiffness: &NodalStiffness, pins: &Pins) -> Result<Self, LinearError> {
        let pattern = stiffness.matrix().pattern();
        let graph = &pattern.graph;
        let nodes = graph.len();
        if let Some(&node) = pins.nodes().iter().find(|&&node| node >= nodes) {
            return Err(LinearError::NoSuchNode(NoSuchNode { element: None, node, nodes }));
        }
        let blocks = pattern.len();
        u32::try_from(9 * blocks).map_err(|_| LinearError::OutOfMemory)?;
        let free_nodes = ordering::order(graph, pins)?;
        let mut free_of_node = filled(nodes, None)?;
        free_nodes.iter().enumerate().for_each(|(free, &node)| free_of_node[node] = Some(free));

        let unknowns = 3 * free_nodes.len();
        let (mut starts, mut rows, mut sources) =
            (reserved(unknowns + 1)?, reserved(9 * blocks)?, reserved(9 * blocks)?);
        starts.push(0);
        // Row, index and transposition of the blocks of a column.
        let mut of_column = Vec::new();
        for (column, &node) in free_nodes.iter().enumerate() {
            of_column.clear();
            of_column.push((column, pattern.diagonal(node), false));
            for &other in graph.of(node) {
                let row = free_of_node[other as usize].filter(|&row| row > column);
                let block = row.and_then(|row| Some((row, pattern.block(other as usize, node)?)));
                of_column.extend(block.map(|(row, (block, is_transposed))| (row, block, is_transposed)));
            }
            of_column.sort_unstable();
            for c in 0..3 {
                for &(row, block, is_transposed) in &of_column {
                    for r in if row == column { c } else { 0 }..3 {
                        let entry = if is_transposed { 3 * c + r } else { 3 * r + c };
                        rows.push(3 * row + r);
                        sources.push((9 * block + entry) as u32);
                    }
                }
                starts.push(rows.len());
            }
        }
        Ok(Self {
            values: filled(rows.len(), 0.0)?,
            column_starts: Arc::new(starts),
            row_indices: Arc::new(rows),
            sources,
            blocks,
            free_nodes,
            free_of_node,
        })
    }

    /// Replaces the values by the stiffness for which this was made, and adds `diagonal(node)`, N/m, to the
    /// diagonal for each free node, such as a mass over the square of a time step.
    ///
    /// # Errors
    /// [`LinearError::Length`] if the stiffness has another number of blocks.
    pub fn fill(
        &mut self,
        stiffness: &NodalStiffness,
        diagonal: impl Fn(usize) -> f64,
    ) -> Result<(), LinearError> {
        fits("stiffness", stiffness.len(), self.blocks)?;
        let scalars = stiffness.matrix().blocks().as_flattened().as_flattened();
        for (value, &source) in self.values.iter_mut().zip(&self.sources) {
            *value = scalars[source as usize];
        }
        self.add_to_diagonal(|_, node| diagonal(node));
        Ok(())
    }

    /// Adds `added(row, node)` to the diagonal for each row, which belongs to a free node.
    pub(crate) fn add_to_diagonal(&mut self, added: impl Fn(usize, usize) -> f64) {
        for (row, &start) in self.column_starts[..3 * self.free_nodes.len()].iter().enumerate() {
            self.values[start] += added(row, self.free_nodes[row / 3]);
        }
    }

    /// Adds to the block of two nodes and to its transpose; does nothing if a node is pinned or no element
    /// has both.
    pub(crate) fn add_block(&mut self, row: usize, column: usize, block: &[[f64; 3]; 3]) {
        let Some((i, j)) = self.free_of_node[row].zip(self.free_of_node[column]) else { return };
        for c in 0..3 {
            let range = self.column(3 * i.min(j) + c);
            let first = if i == j { c } else { 0 };
            let rows = &self.row_indices[range.clone()];
            let Ok(at) = rows.binary_search(&(3 * i.max(j) + first)) else { return };
            for (value, r) in self.values[range.start + at..].iter_mut().zip(first..3) {
                *value += if i < j { block[c][r] } else { block[r][c] };
            }
        }
    }

    /// Separates some of the free nodes from the others: their rows and columns become rows and columns of
    /// the unit matrix.
    pub(crate) fn hold(&mut self, held: &[bool]) {
        for column in 0..3 * held.len() {
            for at in self.column(column) {
                let row = self.row_indices[at];
                if held[row / 3] || held[column / 3] {
                    self.values[at] = f64::from(u8::from(row == column));
                }
            }
        }
    }

    /// Free nodes, which are not pinned: rows and columns 3k, 3k+1 and 3k+2 are the coordinates of node
    /// `free_nodes()[k]`.
    #[must_use]
    pub fn free_nodes(&self) -> &[usize] {
        &self.free_nodes
    }

    fn column(&self, column: usize) -> Range<usize> {
        self.column_starts[column]..self.column_starts[column + 1]
    }

    /// Start of each column among the entries, and the end of the last.
    #[must_use]
    pub fn column_starts(&self) -> &[usize] {
        &self.column_starts
    }

    /// Row of each entry.
    #[must_use]
    pub fn row_indices(&self) -> &[usize] {
        &self.row_indices
    }

    /// The entries, N/m.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The entries on the diagonal, N/m.
    #[cfg(feature = "faer")]
    pub(crate) fn diagonal(&self) -> impl Iterator<Item = f64> {
        let starts = self.column_starts();
        starts[..starts.len() - 1].iter().map(|&start| self.values[start])
    }

    /// Computes A x for the whole matrix, both triangles.
    ///
    /// # Errors
    /// [`LinearError::Length`] unless `x` and `product` have one entry for each row.
    pub fn multiply(&self, x: &[f64], product: &mut [f64]) -> Result<(), LinearError> {
        let unknowns = 3 * self.free_nodes.len();
        fits("x", x.len(), unknowns)?;
        fits("product", product.len(), unknowns)?;
        product.fill(0.0);
        for column in 0..unknowns {
            let range = self.column(column);
            let entries = self.row_indices()[range.clone()].iter().zip(&self.values[range]);
            let mut sum = 0.0;
            for (&row, value) in entries {
                sum += value * x[row];
                if row != column {
                    product[row] += value * x[column];
                }
            }
            product[column] += sum;
        }
        Ok(())
    }
}

#[cfg(all(test, feature = "faer"))]
mod tests;
