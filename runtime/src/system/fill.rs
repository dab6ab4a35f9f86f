//! Entries of the matrix as sums over element blocks, in the order of their lists, whatever the number of
//! threads.
//!
//! The second stage of [assembly](super::assemble). This module knows neither the origin of the blocks nor
//! their meaning.

use std::ops::Range;

use super::pattern::{ElementBlock, Pattern};

/// Columns of blocks summed by one thread without a further division.
const COLUMNS: usize = 64;

/// The stiffnesses of elements as blocks of node pairs.
pub(super) trait NodePairs: Sync {
    /// The block of an element's nodes i ≥ j, N/m.
    fn block(&self, element: usize, i: usize, j: usize) -> [[f64; 3]; 3];
}

/// Sums the stiffnesses into the entries of the pattern and adds `diagonal(node)` to the diagonal.
pub(super) fn fill(
    pattern: &Pattern,
    elements: &impl NodePairs,
    diagonal: &(impl Fn(usize) -> f64 + Sync),
    values: &mut [f64],
) {
    fill_columns(pattern, elements, diagonal, 0..pattern.node_of_free().len(), values);
}

/// Sums a range of columns into the slice that holds them, by halves in parallel.
fn fill_columns(
    pattern: &Pattern,
    elements: &impl NodePairs,
    diagonal: &(impl Fn(usize) -> f64 + Sync),
    columns: Range<usize>,
    values: &mut [f64],
) {
    if columns.len() > COLUMNS {
        let middle = columns.start + columns.len() / 2;
        let (left, right) =
            values.split_at_mut(pattern.column_start(middle) - pattern.column_start(columns.start));
        rayon::join(
            || fill_columns(pattern, elements, diagonal, columns.start..middle, left),
            || fill_columns(pattern, elements, diagonal, middle..columns.end, right),
        );
        return;
    }
    let offset = pattern.column_start(columns.start);
    for column in columns {
        let first = pattern.columns()[column];
        for block in first..pattern.columns()[column + 1] {
            let sum = sum_block(pattern.contributions(block), elements);
            let shift = if block == first { diagonal(pattern.node_of_free()[column]) } else { 0.0 };
            for c in 0..3 {
                for r in if block == first { c } else { 0 }..3 {
                    let added = if r == c { shift } else { 0.0 };
                    values[pattern.scalar(column, block, r, c) - offset] = sum[r][c] + added;
                }
            }
        }
    }
}

/// A block of the matrix: the sum of its contributions in the order of their list.
fn sum_block(contributions: &[ElementBlock], elements: &impl NodePairs) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for &ElementBlock { element, i, j, transposed } in contributions {
        let part = elements.block(element as usize, usize::from(i), usize::from(j));
        for r in 0..3 {
            for c in 0..3 {
                sum[r][c] += if transposed { part[c][r] } else { part[r][c] };
            }
        }
    }
    sum
}
