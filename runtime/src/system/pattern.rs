//! Sparsity of the stiffness matrix: which entries exist, and which element blocks add up to each.
//!
//! Unknowns are the coordinates of the nodes that are not pinned, numbered so that a Cholesky factor stays
//! sparse (approximate minimum degree on the graph of nodes, whose edges are 3×3 blocks). This module knows
//! no values.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::amd;
use faer::sparse::{SymbolicSparseColMat, SymbolicSparseColMatRef};

use super::element::Tetrahedron;
use super::linear::LinearError;
use super::memory::{filled, reserved};
use super::pins::Pins;

/// The lower triangle of a symmetric matrix of 3×3 blocks, one row and column of blocks per free node.
#[derive(Clone, Debug)]
pub struct Pattern {
    elements: usize,
    free_of_node: Vec<Option<usize>>,
    node_of_free: Vec<usize>,
    /// Start of each column of blocks, and the end of the last. The first block of a column is on the
    /// diagonal.
    columns: Vec<usize>,
    rows: Vec<usize>,
    /// Start of the contributions to each block, and the end of the last.
    gather_starts: Vec<usize>,
    gather: Vec<ElementBlock>,
    entries: Arc<SymbolicSparseColMat<usize>>,
}

/// A 3×3 block of an element, one of those that add up to a block of the matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ElementBlock {
    pub(crate) element: u32,
    /// The nodes i ≥ j of the element.
    pub(crate) i: u8,
    pub(crate) j: u8,
    pub(crate) transposed: bool,
}

impl Pattern {
    /// The pattern of these elements among `nodes` nodes, without rows and columns of pinned ones.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`] for an element or a pin, [`LinearError::RepeatedNode`],
    /// [`LinearError::OutOfMemory`].
    pub fn new(nodes: usize, elements: &[Tetrahedron], pins: &Pins) -> Result<Self, LinearError> {
        Self::with_pairs(nodes, elements, &[], pins)
    }

    /// The pattern of these elements with a block for each of some pairs of nodes as well.
    pub(crate) fn with_pairs(
        nodes: usize,
        elements: &[Tetrahedron],
        pairs: &[[usize; 2]],
        pins: &Pins,
    ) -> Result<Self, LinearError> {
        let tets: Vec<[usize; 4]> = elements.iter().map(|element| element.nodes).collect();
        Self::of_tets_and_pairs(nodes, &tets, pairs, pins)
    }

    /// The pattern of tetrahedra that join these nodes, four different ones each. A free node of no
    /// tetrahedron has its block on the diagonal and no other.
    ///
    /// # Errors
    /// [`LinearError::NoSuchNode`] for a tetrahedron or a pin, [`LinearError::RepeatedNode`],
    /// [`LinearError::OutOfMemory`].
    pub fn of_tets(nodes: usize, tets: &[[usize; 4]], pins: &Pins) -> Result<Self, LinearError> {
        Self::of_tets_and_pairs(nodes, tets, &[], pins)
    }

    fn of_tets_and_pairs(
        nodes: usize,
        tets: &[[usize; 4]],
        pairs: &[[usize; 2]],
        pins: &Pins,
    ) -> Result<Self, LinearError> {
        let named = tets.as_flattened().iter().chain(pairs.as_flattened()).chain(pins.nodes());
        if let Some(&node) = named.into_iter().find(|&&node| node >= nodes) {
            return Err(LinearError::NoSuchNode { node, nodes });
        }
        let repeated = |tet: &[usize; 4]| {
            (1..4).map(|k| tet[k]).find(|node| tet.iter().filter(|other| *other == node).count() > 1)
        };
        if let Some((element, node)) =
            tets.iter().enumerate().find_map(|(element, tet)| Some((element, repeated(tet)?)))
        {
            return Err(LinearError::RepeatedNode { element, node });
        }
        let node_of_free = order(nodes, tets, pairs, pins)?;
        let mut free_of_node = filled(nodes, None)?;
        for (free, &node) in node_of_free.iter().enumerate() {
            free_of_node[node] = Some(free);
        }

        // One record per contribution, sorted by column, row and element: the order of summation, fixed for
        // good. A pair brings a block to which no element contributes.
        let mut records = reserved(10 * tets.len() + pairs.len())?;
        for (index, tet) in tets.iter().enumerate() {
            let index = u32::try_from(index).map_err(|_| LinearError::OutOfMemory)?;
            for i in 0..4 {
                for j in 0..=i {
                    if let (Some(row), Some(column)) = (free_of_node[tet[i]], free_of_node[tet[j]]) {
                        let transposed = row < column;
                        let contribution =
                            ElementBlock { element: index, i: i as u8, j: j as u8, transposed };
                        records.push((row.min(column), row.max(column), Some(contribution)));
                    }
                }
            }
        }
        for &[a, b] in pairs {
            if let (Some(row), Some(column)) = (free_of_node[a], free_of_node[b]) {
                records.push((row.min(column), row.max(column), None));
            }
        }
        records.sort_unstable();

        let mut pattern = Self {
            elements: tets.len(),
            columns: filled(node_of_free.len() + 1, 0)?,
            rows: Vec::new(),
            gather_starts: vec![0],
            gather: reserved(records.len())?,
            entries: Arc::new(SymbolicSparseColMat::new_checked(0, 0, vec![0], None, Vec::new())),
            free_of_node,
            node_of_free,
        };
        let mut later = records.as_slice();
        for column in 0..pattern.node_of_free.len() {
            let (of_column, rest) = later.split_at(later.partition_point(|record| record.0 == column));
            later = rest;
            if of_column.first().is_none_or(|first| first.1 != column) {
                pattern.add_block(column, &[]);
            }
            of_column.chunk_by(|a, b| a.1 == b.1).for_each(|block| pattern.add_block(block[0].1, block));
            pattern.columns[column + 1] = pattern.rows.len();
        }
        pattern.entries = Arc::new(pattern.scalar_entries()?);
        Ok(pattern)
    }

    /// Adds the next block of a column, with what adds up to it.
    fn add_block(&mut self, row: usize, records: &[(usize, usize, Option<ElementBlock>)]) {
        self.rows.push(row);
        self.gather.extend(records.iter().filter_map(|record| record.2));
        self.gather_starts.push(self.gather.len());
    }

    /// The scalars of the lower triangle, column by column: of a block on the diagonal its own lower
    /// triangle.
    fn scalar_entries(&self) -> Result<SymbolicSparseColMat<usize>, LinearError> {
        let unknowns = self.unknowns();
        let (mut starts, mut rows) =
            (reserved(unknowns + 1)?, reserved(self.column_start(self.node_of_free.len()))?);
        starts.push(0);
        for column in 0..self.node_of_free.len() {
            for c in 0..3 {
                for &row in &self.rows[self.columns[column]..self.columns[column + 1]] {
                    rows.extend(if row == column { c..3 } else { 0..3 }.map(|r| 3 * row + r));
                }
                starts.push(rows.len());
            }
        }
        Ok(SymbolicSparseColMat::new_checked(unknowns, unknowns, starts, None, rows))
    }

    /// Number of elements that it was made of.
    pub(crate) fn elements(&self) -> usize {
        self.elements
    }

    /// Number of unknowns: three for each free node.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        3 * self.node_of_free.len()
    }

    /// The node of each free number: unknowns 3k, 3k+1, 3k+2 are the coordinates of node `node_of_free()[k]`.
    #[must_use]
    pub fn node_of_free(&self) -> &[usize] {
        &self.node_of_free
    }

    /// The number of each node among the free ones; `None` for a pinned node.
    #[must_use]
    pub fn free_of_node(&self) -> &[Option<usize>] {
        &self.free_of_node
    }

    /// Start of each column among the stored scalars, and the end of the last: compressed columns of the
    /// lower triangle, as [`Cholesky::new`](super::Cholesky::new) takes them.
    #[must_use]
    pub fn column_starts(&self) -> &[usize] {
        self.entries().col_ptr()
    }

    /// Row of each stored scalar, ascending in each column from the diagonal.
    #[must_use]
    pub fn row_indices(&self) -> &[usize] {
        self.entries().row_idx()
    }

    pub(crate) fn entries(&self) -> SymbolicSparseColMatRef<'_, usize> {
        (*self.entries).as_ref()
    }

    pub(crate) fn shared_entries(&self) -> &Arc<SymbolicSparseColMat<usize>> {
        &self.entries
    }

    /// Index of the first block of each column of blocks.
    pub(crate) fn columns(&self) -> &[usize] {
        &self.columns
    }

    /// The element blocks that add up to a block.
    pub(crate) fn contributions(&self, block: usize) -> &[ElementBlock] {
        &self.gather[self.gather_starts[block]..self.gather_starts[block + 1]]
    }

    /// Index of the block of two free nodes, row ≥ column.
    pub(crate) fn block(&self, row: usize, column: usize) -> Option<usize> {
        let start = self.columns[column];
        self.rows[start..self.columns[column + 1]].binary_search(&row).ok().map(|position| start + position)
    }

    /// The blocks of a column, each as its row and its index.
    pub(crate) fn blocks_of(&self, column: usize) -> impl Iterator<Item = (usize, usize)> {
        let range = self.columns[column]..self.columns[column + 1];
        self.rows[range.clone()].iter().copied().zip(range)
    }

    /// Index of the first scalar of a column of blocks.
    pub(crate) fn column_start(&self, column: usize) -> usize {
        // The k-th block brings 9 scalars, the one on the diagonal 6.
        9 * self.columns[column] - 3 * column
    }

    /// Index of entry (r, c) of a block of this column. On the diagonal only r ≥ c is stored.
    pub(crate) fn scalar(&self, column: usize, block: usize, r: usize, c: usize) -> usize {
        let below = self.columns[column + 1] - self.columns[column] - 1;
        // Columns c' < c hold 3 − c' scalars of the diagonal block and 3 of each block below.
        let start = self.column_start(column) + c * 3 * below + 3 * c - c * c.saturating_sub(1) / 2;
        match block - self.columns[column] {
            0 => start + r - c,
            position => start + (3 - c) + 3 * (position - 1) + r,
        }
    }
}

/// Orders the free nodes so that a Cholesky factor stays sparse.
fn order(
    nodes: usize,
    tets: &[[usize; 4]],
    pairs: &[[usize; 2]],
    pins: &Pins,
) -> Result<Vec<usize>, LinearError> {
    let mut is_pinned = filled(nodes, false)?;
    for &node in pins.nodes() {
        is_pinned[node] = true;
    }
    let mut free: Vec<usize> = reserved(nodes - pins.nodes().len())?;
    free.extend((0..nodes).filter(|&node| !is_pinned[node]));
    let mut index = filled(nodes, None)?;
    for (number, &node) in free.iter().enumerate() {
        index[node] = Some(number);
    }
    let mut edges = reserved(free.len() + 16 * tets.len() + 2 * pairs.len())?;
    // On the diagonal, where a node of no tetrahedron stands alone.
    edges.extend((0..free.len()).map(|number| (number, number)));
    for tet in tets {
        for &i in tet {
            edges.extend(tet.iter().filter_map(|&j| index[i].zip(index[j])));
        }
    }
    for &[a, b] in pairs {
        if let (Some(i), Some(j)) = (index[a], index[b]) {
            edges.extend([(i, j), (j, i)]);
        }
    }
    edges.sort_unstable();
    edges.dedup();
    let mut starts = filled(free.len() + 1, 0)?;
    for (at, &(column, _)) in edges.iter().enumerate() {
        starts[column + 1] = at + 1;
    }
    let rows: Vec<usize> = edges.into_iter().map(|(_, row)| row).collect();
    let graph = SymbolicSparseColMatRef::new_checked(free.len(), free.len(), &starts, None, &rows);

    let (mut forward, mut inverse) = (filled(free.len(), 0)?, filled(free.len(), 0)?);
    let scratch = amd::order_scratch::<usize>(free.len(), rows.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| LinearError::OutOfMemory)?;
    amd::order(&mut forward, &mut inverse, graph, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| LinearError::OutOfMemory)?;
    Ok(forward.into_iter().map(|number| free[number]).collect())
}
