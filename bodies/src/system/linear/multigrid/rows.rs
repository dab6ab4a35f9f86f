//! Sparse matrices of blocks in compressed rows, and the products for the matrix of the next level.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::system::linear::LinearError;
use crate::system::linear::symmetric_blocks::{Pattern, SymmetricBlocks};
use crate::system::lists::Lists;

/// Number of rows in a chunk, which one thread computes.
const ROWS: usize = 512;

/// Blocks that are added to rows: each row, with its columns and blocks.
pub(super) type Parts<const R: usize, const C: usize> = HashMap<usize, Vec<(usize, [[f64; C]; R])>>;

/// Sparse matrix of R×C blocks: the columns and blocks of each row.
pub(super) type Rows<E, const R: usize, const C: usize> = Lists<(u32, [[E; C]; R])>;

impl<E: Copy, const R: usize, const C: usize> Rows<E, R, C> {
    pub(super) fn push(&mut self, column: usize, block: [[E; C]; R]) {
        self.values.push((column as u32, block));
    }

    /// The first `rows` rows.
    pub(super) fn first(mut self, rows: usize) -> Self {
        self.starts.truncate(rows + 1);
        self.values.truncate(self.starts[rows]);
        self
    }

    pub(super) fn row(&self, row: usize) -> impl Iterator<Item = (usize, &[[E; C]; R])> {
        self.of(row).iter().map(|(column, block)| (*column as usize, block))
    }

    pub(super) fn block(&self, index: usize) -> &[[E; C]; R] {
        &self.values[index].1
    }

    pub(super) fn map<T>(self, change: impl Fn(E) -> T) -> Rows<T, R, C> {
        let values = self.values.iter().map(|(column, block)| (*column, block.map(|row| row.map(&change))));
        Lists { values: values.collect(), starts: self.starts }
    }
}

impl<const R: usize, const C: usize> Rows<f64, R, C> {
    /// Adds blocks to some of the first `rows` rows; the result does not have later rows.
    pub(super) fn add(self, rows: usize, columns: usize, parts: &Parts<R, C>) -> Self {
        if parts.is_empty() {
            return self.first(rows);
        }
        Self::make(rows, columns, |row, sum| {
            self.row(row).for_each(|(column, block)| *sum.block(column) = *block);
            for (column, part) in parts.get(&row).into_iter().flatten() {
                let entries = sum.block(*column).as_flattened_mut().iter_mut();
                entries.zip(part.as_flattened()).for_each(|(entry, part)| *entry += part);
            }
        })
    }

    /// Computes rows in parallel, in chunks of fixed size.
    pub(super) fn make(rows: usize, columns: usize, make: impl Fn(usize, &mut Sum<R, C>) + Sync) -> Self {
        let parts: Vec<Self> = (0..rows.div_ceil(ROWS))
            .into_par_iter()
            .map_init(
                || Sum { place: vec![u32::MAX; columns], row: Vec::new() },
                |sum, part| {
                    let mut made = Self::none();
                    for row in part * ROWS..rows.min((part + 1) * ROWS) {
                        make(row, sum);
                        sum.row.iter().for_each(|&(column, _)| sum.place[column as usize] = u32::MAX);
                        made.values.append(&mut sum.row);
                        made.end();
                    }
                    made
                },
            )
            .collect();
        let mut all = Self::none();
        all.values.reserve_exact(parts.iter().map(|part| part.values.len()).sum());
        all.starts.reserve_exact(rows);
        for part in parts {
            let first = all.values.len();
            all.starts.extend(part.starts[1..].iter().map(|end| first + end));
            all.values.extend(part.values);
        }
        all
    }
}

/// Row during its summation.
pub(super) struct Sum<const R: usize, const C: usize> {
    /// Place of each column of the matrix in the row; `u32::MAX` for a column without a block.
    place: Vec<u32>,
    row: Vec<(u32, [[f64; C]; R])>,
}

impl<const R: usize, const C: usize> Sum<R, C> {
    /// Block of a column; a new block is zero.
    pub(super) fn block(&mut self, column: usize) -> &mut [[f64; C]; R] {
        let place = &mut self.place[column];
        if *place == u32::MAX {
            *place = self.row.len() as u32;
            self.row.push((column as u32, [[0.0; C]; R]));
        }
        &mut self.row[*place as usize].1
    }
}

/// All blocks of each row of a symmetric matrix: column, index, and true if the block is transposed.
pub(super) struct WholeRows(Lists<(u32, u32, bool)>);

impl WholeRows {
    pub(super) fn new(pattern: &Pattern) -> Result<Self, LinearError> {
        let both = |(row, column, block): (usize, usize, usize)| {
            let here = (row, (column as u32, block as u32, false));
            let there = (column, (row as u32, block as u32, true));
            [here].into_iter().chain((column != row).then_some(there))
        };
        Ok(Self(Lists::new(pattern.rows(), || pattern.stored().flat_map(both))?))
    }

    /// Product of the `included` rows of a symmetric matrix with another matrix.
    pub(super) fn multiply<const N: usize, const C: usize>(
        &self,
        matrix: &SymmetricBlocks<f64, N>,
        included: &[bool],
        right: &Rows<f64, N, C>,
        columns: usize,
    ) -> Rows<f64, N, C> {
        let make = |row: usize, sum: &mut Sum<N, C>| {
            if !included[row] {
                return;
            }
            for &(other, block, transposed) in self.0.of(row) {
                let block = &matrix.blocks()[block as usize];
                let block = if transposed {
                    std::array::from_fn(|r| std::array::from_fn(|c| block[c][r]))
                } else {
                    *block
                };
                for (column, factor) in right.row(other as usize) {
                    let sum = sum.block(column);
                    for r in 0..N {
                        for k in 0..N {
                            for c in 0..C {
                                sum[r][c] += block[r][k] * factor[k][c];
                            }
                        }
                    }
                }
            }
        };
        Rows::make(self.0.len(), columns, make)
    }
}

/// Blocks of each column of a matrix in compressed rows: row, and index of the block.
pub(super) type Columns = Lists<(u32, u32)>;

pub(super) fn columns_of<E: Copy, const R: usize, const C: usize>(
    matrix: &Rows<E, R, C>,
    columns: usize,
) -> Result<Columns, LinearError> {
    let of_row = |row: usize| {
        let range = matrix.starts[row]..matrix.starts[row + 1];
        range.map(move |index| (matrix.values[index].0 as usize, (row as u32, index as u32)))
    };
    Lists::new(columns, || (0..matrix.len()).flat_map(of_row))
}

/// Upper half of the symmetric matrix Pᵀ (A P), row by row.
pub(super) fn coarse_rows<const N: usize, const C: usize>(
    prolongation: &Rows<f64, N, C>,
    columns: &Columns,
    product: &Rows<f64, N, C>,
) -> Rows<f64, C, C> {
    let make = |coarse: usize, sum: &mut Sum<C, C>| {
        // The block on the diagonal is first, even if nothing is added to it.
        sum.block(coarse);
        for &(row, index) in columns.of(coarse) {
            let left = prolongation.block(index as usize);
            for (column, right) in product.row(row as usize).filter(|&(column, _)| column >= coarse) {
                let sum = sum.block(column);
                for k in 0..N {
                    for r in 0..C {
                        for c in 0..C {
                            sum[r][c] += left[k][r] * right[k][c];
                        }
                    }
                }
            }
        }
    };
    Rows::make(columns.len(), columns.len(), make)
}
