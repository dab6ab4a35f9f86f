//! Symmetric matrix of N×N blocks, of which the upper half is stored, and its product with a vector.
//!
//! The memory traffic determines the time of a product with a large matrix, and half a matrix needs half of
//! it. But a block above the diagonal then contributes to two rows, one of which may belong to another
//! thread. Rows are therefore divided into chunks of fixed size. Each chunk gathers its part of the vector,
//! and sums its products for its own rows and for rows of other chunks. A second pass adds the sums of each
//! row in the order of the chunks. This needs no atomics, and gives the same bits for any number of threads.
//!
//! A chunk should touch few rows of other chunks. The order of the rows therefore keeps neighbours together.

use std::sync::Arc;

use piola::lanes::Real;

use super::LinearError;
use crate::system::graph::Graph;
use crate::system::lists::Lists;
use crate::system::memory::{filled, reserved};
use crate::system::parts::for_each_entry;

/// Number of rows in a chunk: its sums and its part of the vector stay in the cache next to the processor.
const ROWS: usize = 256;

/// Number of rows that a thread takes at a time in the second pass.
const SUMS: usize = 1024;

/// Upper half of a symmetric matrix.
#[derive(Clone)]
pub(crate) struct SymmetricBlocks<E, const N: usize> {
    pattern: Arc<Pattern>,
    /// Blocks, chunk by chunk and row by row, the block on the diagonal first. Blocks on the diagonal are
    /// stored in full.
    blocks: Vec<[[E; N]; N]>,
    memory: Vec<Memory<E, N>>,
}

/// Places of the blocks of a matrix, which depend on its graph and on the order of its rows.
pub(crate) struct Pattern {
    pub(crate) graph: Graph,
    /// Rows in an order that keeps neighbours together.
    pub(crate) order: Vec<u32>,
    chunks: Vec<Chunk>,
    /// Chunk of each row, and place of the row in the chunk.
    place_of_row: Vec<Place>,
    /// Sums of each row, in the order of the chunks.
    sums: Lists<Place>,
}

/// Chunk of rows, with the columns of their blocks.
struct Chunk {
    /// Rows of the chunk, then the other columns of their blocks.
    rows: Vec<u32>,
    /// Start of each row of the chunk among the blocks, followed by the end of the last row.
    starts: Vec<usize>,
    /// Place of the column of each block among `rows`.
    columns: Vec<u32>,
}

/// Place of a row in a chunk.
#[derive(Clone, Copy, Default)]
struct Place {
    chunk: u32,
    place: u32,
}

/// Part of a product in a chunk.
#[derive(Clone)]
struct Memory<E, const N: usize> {
    x: Vec<[E; N]>,
    sums: Vec<[E; N]>,
}

impl Chunk {
    /// Number of rows of the chunk.
    fn own(&self) -> usize {
        self.starts.len() - 1
    }

    /// Indices of all blocks of the chunk.
    fn range(&self) -> std::ops::Range<usize> {
        self.starts[0]..self.starts[self.own()]
    }
}

impl Pattern {
    /// Pattern of a graph, with rows divided into chunks in this order.
    pub(crate) fn new(graph: Graph, order: Vec<u32>) -> Result<Self, LinearError> {
        let rows = graph.len();
        let mut rank = filled(rows, 0_u32)?;
        for (at, &row) in order.iter().enumerate() {
            rank[row as usize] = at as u32;
        }
        let mut chunks: Vec<Chunk> = reserved(rows.div_ceil(ROWS))?;
        let mut place_of_row = filled(rows, Place::default())?;
        let mut place_here = filled(rows, u32::MAX)?;
        let mut blocks = 0;
        let mut later: Vec<u32> = Vec::new();
        for own in order.chunks(ROWS) {
            let mut chunk = Chunk { rows: own.to_vec(), starts: vec![blocks], columns: Vec::new() };
            for (place, &row) in own.iter().enumerate() {
                place_here[row as usize] = place as u32;
                place_of_row[row as usize] = Place { chunk: chunks.len() as u32, place: place as u32 };
            }
            for (place, &row) in own.iter().enumerate() {
                chunk.columns.push(place as u32);
                later.clear();
                let is_later = |&other: &u32| rank[other as usize] > rank[row as usize];
                later.extend(graph.of(row as usize).iter().copied().filter(is_later));
                later.sort_unstable_by_key(|&other| rank[other as usize]);
                for &other in &later {
                    let place = &mut place_here[other as usize];
                    if *place == u32::MAX {
                        *place = chunk.rows.len() as u32;
                        chunk.rows.push(other);
                    }
                    chunk.columns.push(*place);
                }
                blocks += 1 + later.len();
                chunk.starts.push(blocks);
            }
            chunk.rows.iter().for_each(|&row| place_here[row as usize] = u32::MAX);
            chunks.push(chunk);
        }
        u32::try_from(blocks).map_err(|_| LinearError::OutOfMemory)?;

        let of_chunk = |chunk: usize| {
            let place = move |place: usize| Place { chunk: chunk as u32, place: place as u32 };
            chunks[chunk].rows.iter().enumerate().map(move |(at, &row)| (row as usize, place(at)))
        };
        let sums = Lists::new(rows, || (0..chunks.len()).flat_map(of_chunk))?;
        Ok(Self { graph, order, chunks, place_of_row, sums })
    }

    pub(crate) fn rows(&self) -> usize {
        self.place_of_row.len()
    }

    pub(crate) fn len(&self) -> usize {
        self.chunks.last().map_or(0, |chunk| chunk.range().end)
    }

    pub(crate) fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// Index of the block on the diagonal of a row.
    pub(crate) fn diagonal(&self, row: usize) -> usize {
        let Place { chunk, place } = self.place_of_row[row];
        self.chunks[chunk as usize].starts[place as usize]
    }

    /// Index of the block of two rows, and true if it is stored as the block of `column` and `row`.
    pub(crate) fn block(&self, row: usize, column: usize) -> Option<(usize, bool)> {
        let find = |row: usize, column: usize| {
            let mut stored = self.upper(row);
            stored.find(|&(_, other)| other == column).map(|(block, _)| block)
        };
        find(row, column).map(|block| (block, false)).or_else(|| find(column, row).map(|block| (block, true)))
    }

    /// Chunk of a block, and index of the block in it.
    pub(crate) fn chunk_of(&self, block: usize) -> (usize, usize) {
        let chunk = self.chunks.partition_point(|chunk| chunk.range().end <= block);
        (chunk, block - self.chunks[chunk].starts[0])
    }

    /// Stored blocks of a row, each with its column: the block on the diagonal, then the later blocks.
    pub(crate) fn upper(&self, row: usize) -> impl Iterator<Item = (usize, usize)> {
        let Place { chunk, place } = self.place_of_row[row];
        let chunk = &self.chunks[chunk as usize];
        let range = chunk.starts[place as usize]..chunk.starts[place as usize + 1];
        let first = chunk.starts[0];
        range.map(move |block| (block, chunk.rows[chunk.columns[block - first] as usize] as usize))
    }

    /// Row, column and index of each stored block, row by row.
    pub(crate) fn stored(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        let row = move |row: usize| self.upper(row).map(move |(block, column)| (row, column, block));
        (0..self.rows()).flat_map(row)
    }
}

impl<E: Real, const N: usize> SymmetricBlocks<E, N> {
    pub(crate) fn new(pattern: Arc<Pattern>) -> Result<Self, LinearError> {
        let zero = E::splat(0.0);
        let memory = |chunk: &Chunk| {
            let zeros = || filled(chunk.rows.len(), [zero; N]);
            Ok(Memory { x: zeros()?, sums: zeros()? })
        };
        Ok(Self {
            blocks: filled(pattern.len(), [[zero; N]; N])?,
            memory: pattern.chunks.iter().map(memory).collect::<Result<_, LinearError>>()?,
            pattern,
        })
    }

    pub(crate) fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    pub(crate) fn blocks(&self) -> &[[[E; N]; N]] {
        &self.blocks
    }

    pub(crate) fn blocks_mut(&mut self) -> &mut [[[E; N]; N]] {
        &mut self.blocks
    }

    /// Row, column and entries of each stored block, row by row.
    pub(crate) fn stored(&self) -> impl Iterator<Item = (usize, usize, &[[E; N]; N])> {
        self.pattern.stored().map(move |(row, column, block)| (row, column, &self.blocks[block]))
    }

    pub(crate) fn diagonal(&self, row: usize) -> &[[E; N]; N] {
        &self.blocks[self.pattern.diagonal(row)]
    }

    /// Calls `change` for each chunk, in parallel, with its number, the index of its first block, and its
    /// blocks.
    pub(crate) fn for_each_chunk(&mut self, change: impl Fn(usize, usize, &mut [[[E; N]; N]]) + Sync) {
        let mut rest = self.blocks.as_mut_slice();
        let mut parts = Vec::with_capacity(self.pattern.chunks.len());
        for chunk in &self.pattern.chunks {
            let (part, after) = rest.split_at_mut(chunk.range().len());
            parts.push((chunk.range().start, part));
            rest = after;
        }
        for_each_entry(&mut parts, 1, |chunk, (first, part)| change(chunk, *first, part));
    }

    pub(crate) fn multiply(&mut self, x: &[[E; N]], product: &mut [[E; N]]) {
        let Self { pattern, blocks, memory } = self;
        for_each_entry(memory, 1, |at, memory| {
            let chunk = &pattern.chunks[at];
            for (here, &row) in memory.x.iter_mut().zip(&chunk.rows) {
                *here = x[row as usize];
            }
            chunk.multiply(&blocks[chunk.range()], memory);
        });
        let memory = &*memory;
        for_each_entry(product, SUMS, |row, total| {
            let mut sum = [E::splat(0.0); N];
            for &Place { chunk, place } in pattern.sums.of(row) {
                let part = memory[chunk as usize].sums[place as usize];
                for a in 0..N {
                    sum[a] = sum[a] + part[a];
                }
            }
            *total = sum;
        });
    }
}

impl Chunk {
    /// Computes the products of the blocks of the chunk with the vector in memory.
    fn multiply<E: Real, const N: usize>(&self, blocks: &[[[E; N]; N]], memory: &mut Memory<E, N>) {
        let Memory { x, sums } = memory;
        sums.fill([E::splat(0.0); N]);
        let first = self.starts[0];
        for place in 0..self.own() {
            let range = self.starts[place] - first..self.starts[place + 1] - first;
            let (blocks, columns) = (&blocks[range.clone()], &self.columns[range]);
            let own = x[place];
            let mut sum = [E::splat(0.0); N];
            for r in 0..N {
                for c in 0..N {
                    sum[r] = sum[r] + blocks[0][r][c] * own[c];
                }
            }
            for (block, &column) in blocks[1..].iter().zip(&columns[1..]) {
                let other = x[column as usize];
                let total = &mut sums[column as usize];
                for r in 0..N {
                    for c in 0..N {
                        sum[r] = sum[r] + block[r][c] * other[c];
                        total[c] = total[c] + block[r][c] * own[r];
                    }
                }
            }
            for r in 0..N {
                sums[place][r] = sums[place][r] + sum[r];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_that_do_not_exist_are_not_found() {
        let graph = Graph::of_upper(3, || [(0, 2)].into_iter()).expect("small");
        let pattern = Pattern::new(graph, vec![0, 1, 2]).expect("small");
        assert_eq!((pattern.rows(), pattern.len(), pattern.chunks()), (3, 4, 1));
        assert_eq!(pattern.block(0, 1), None);
        let (block, transposed) = pattern.block(2, 0).expect("neighbours");
        assert!(transposed && pattern.block(0, 2) == Some((block, false)));
        assert_eq!((pattern.chunk_of(block), pattern.diagonal(1)), ((0, block), 2));
    }
}
