//! Division of the rows of a level among machines, for multigrid.
//!
//! The part of a matrix on a machine is the sum over its elements. The matrix is the sum over the machines.
//! The rows of a part are the rows that the machine owns, followed by copies of rows of other machines. A
//! product consists of the products of the parts between two exchanges. First, the entries of a vector are
//! sent from owners to copies. Afterwards, the results at copies are sent to their owners and added. PᵀA P is
//! the sum of such products of the parts too, if each machine has the rows of P of its copies. All rows of an
//! aggregate have the same owner.

use std::collections::HashMap;

use piola::lanes::Real;

use super::last::{Last, LastLevel, LastSolver};
use crate::system::linear::LinearError;
use crate::system::linear::symmetric_blocks::SymmetricBlocks;
use crate::system::parts::for_each_entry;

/// Number of rows that a thread takes at a time.
pub(super) const ROWS: usize = 1024;

/// Division of the rows of a matrix among machines, on one of the machines.
///
/// The rows of a machine are the rows that it owns, followed by copies of rows that other machines own. All
/// machines must call all functions, in the same order. If a function cannot communicate with other machines,
/// the division keeps the error for the code that created it, and the vectors are meaningless.
pub trait Division: Sized {
    /// Error of the functions that can fail.
    type Error: From<LinearError>;
    /// Solver of the last level.
    type Last: LastSolver;

    /// Number of copies; these are the last rows.
    fn copies(&self) -> usize;

    /// Replaces the copies by the entries of their owners.
    fn copy<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]);

    /// Adds all copies of each owned row to the row.
    fn sum<E: Real + Into<f64>, const N: usize>(&mut self, rows: &mut [[E; N]]);

    /// List, for each copy, that its owner writes for the row.
    fn lists_for_copies(&mut self, list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<Vec<u64>>;

    /// Owned rows, each with a list that another machine writes for its copy of the row. The argument of
    /// `list` is the number of the copy among the copies of the machine.
    fn lists_for_owners(&mut self, list: impl FnMut(usize, &mut Vec<u64>)) -> Vec<(usize, Vec<u64>)>;

    /// Sum of each number over all machines.
    fn totals<const N: usize>(&self, numbers: [f64; N]) -> [f64; N];

    /// Sum over all machines.
    fn total(&self, number: f64) -> f64 {
        self.totals([number])[0]
    }

    /// Maximum over all machines.
    fn largest(&self, number: f64) -> f64;

    /// Global number of the first row of this machine, which owns `rows` rows; rows are counted machine after
    /// machine.
    fn first(&self, rows: usize) -> u64;

    /// Division of the next level, in which this machine owns `rows` rows and has copies of the rows with the
    /// global numbers `copies`.
    ///
    /// # Errors
    /// [`Division::Error`].
    fn coarse(&self, rows: usize, copies: Vec<u64>) -> Result<Self, Self::Error>;

    /// True if a level with `rows` rows of all machines is the last one, for `nodes` nodes of all machines.
    fn is_last(&self, rows: usize, nodes: usize) -> bool;

    /// Solver of the last level, if this is its division.
    ///
    /// # Errors
    /// [`Division::Error`].
    fn last(&self, level: &LastLevel<'_>) -> Result<Self::Last, Self::Error>;
}

/// Division of a matrix on one machine: it owns all rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Undivided;

/// Largest number of rows of a level that is always factored. Large bodies have a larger last level, with
/// half the square root of the number of nodes as the number of rows; its factor still takes less time than
/// the finest level.
const FEW: usize = 64;

impl Division for Undivided {
    type Error = LinearError;
    type Last = Last;

    fn copies(&self) -> usize {
        0
    }

    fn copy<E: Real + Into<f64>, const N: usize>(&mut self, _: &mut [[E; N]]) {}

    fn sum<E: Real + Into<f64>, const N: usize>(&mut self, _: &mut [[E; N]]) {}

    fn lists_for_copies(&mut self, _: impl FnMut(usize, &mut Vec<u64>)) -> Vec<Vec<u64>> {
        Vec::new()
    }

    fn lists_for_owners(&mut self, _: impl FnMut(usize, &mut Vec<u64>)) -> Vec<(usize, Vec<u64>)> {
        Vec::new()
    }

    fn totals<const N: usize>(&self, numbers: [f64; N]) -> [f64; N] {
        numbers
    }

    fn largest(&self, number: f64) -> f64 {
        number
    }

    fn first(&self, _: usize) -> u64 {
        0
    }

    fn coarse(&self, _: usize, _: Vec<u64>) -> Result<Self, LinearError> {
        Ok(Self)
    }

    fn is_last(&self, rows: usize, nodes: usize) -> bool {
        rows <= FEW.max(nodes.isqrt() / 2)
    }

    fn last(&self, level: &LastLevel<'_>) -> Result<Last, LinearError> {
        Last::new(level)
    }
}

/// Global numbers of the columns of a machine's part: the columns of the machine, then columns of others.
pub(super) struct Numbers {
    first: u64,
    own: usize,
    others: Vec<u64>,
    places: HashMap<u64, usize>,
}

impl Numbers {
    /// Consecutive numbers, from `first` on, of the columns of this machine.
    pub(super) fn new(first: u64, own: usize) -> Self {
        Self { first, own, others: Vec::new(), places: HashMap::new() }
    }

    pub(super) fn len(&self) -> usize {
        self.own + self.others.len()
    }

    /// Global numbers of the columns of other machines.
    pub(super) fn others(self) -> Vec<u64> {
        self.others
    }

    fn of(&self, column: usize) -> u64 {
        match column.checked_sub(self.own) {
            None => self.first + column as u64,
            Some(other) => self.others[other],
        }
    }

    /// Column with a global number; a new number is added as another column.
    fn column(&mut self, number: u64) -> usize {
        match number.checked_sub(self.first) {
            Some(column) if column < self.own as u64 => column as usize,
            _ => {
                let Self { own, others, places, .. } = self;
                *places.entry(number).or_insert_with(|| {
                    others.push(number);
                    *own + others.len() - 1
                })
            }
        }
    }

    /// Writes a row of a matrix into a list.
    pub(super) fn write<'a, const N: usize>(
        &self,
        row: impl Iterator<Item = (usize, &'a [[f64; 6]; N])>,
        list: &mut Vec<u64>,
    ) {
        for (column, block) in row {
            list.push(self.of(column));
            list.extend(block.as_flattened().iter().map(|entry| entry.to_bits()));
        }
    }

    /// Reads a row written by another machine.
    pub(super) fn read<const N: usize>(&mut self, list: &[u64]) -> Vec<(usize, [[f64; 6]; N])> {
        let blocks = list.chunks_exact(1 + 6 * N);
        blocks.map(|words| (self.column(words[0]), block(&words[1..]))).collect()
    }
}

fn block<const C: usize, const R: usize>(words: &[u64]) -> [[f64; C]; R] {
    std::array::from_fn(|r| std::array::from_fn(|c| f64::from_bits(words[C * r + c])))
}

/// Blocks on the diagonal of the sum of all machines' parts, in the rows that this machine owns.
pub(crate) fn diagonals<const N: usize>(
    matrix: &SymmetricBlocks<f64, N>,
    division: &mut impl Division,
) -> Vec<[[f64; N]; N]> {
    let owned = matrix.pattern().rows() - division.copies();
    let mut blocks = vec![[[0.0; N]; N]; owned];
    for_each_entry(&mut blocks, ROWS, |row, block| *block = *matrix.diagonal(row));
    let parts = division.lists_for_owners(|copy, list| {
        list.extend(matrix.diagonal(owned + copy).as_flattened().iter().map(|entry| entry.to_bits()));
    });
    for (row, words) in parts {
        let part: [[f64; N]; N] = block(&words);
        for (entry, part) in blocks[row].as_flattened_mut().iter_mut().zip(part.as_flattened()) {
            *entry += part;
        }
    }
    blocks
}

#[cfg(test)]
mod tests;
