//! Points along the trailing axes of arrays, which are columns: number k of point p is at k times the number
//! of points, plus p.
//!
//! They are copied to the lines of a batch and back, a chunk of points at a time that stays in the cache.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::ops::Range;

use piola::batch::{Kernels, Layout, LengthError};
use piola::{StatusCell, Survey};
use rayon::prelude::*;

use crate::quantity::{Materials, Quantity};

/// Points of a chunk: the 81 entries of their tangents, 83 kB, stay in the second cache.
const CHUNK: usize = 128;

/// Deformation gradients in columns, and what is to be computed of them.
pub(crate) struct Columns<'a, E> {
    pub(crate) materials: &'a Materials<'a, E>,
    pub(crate) quantity: Quantity,
    pub(crate) F: &'a [E],
    /// One for each point, or none.
    pub(crate) cells: &'a [StatusCell],
    pub(crate) count: usize,
}

/// Columns of each result for some of the points.
struct Part<'a, E> {
    points: Range<usize>,
    results: Vec<Vec<&'a mut [E]>>,
}

impl<E: Kernels> Columns<'_, E> {
    /// Computes all points, with parts of them on each thread if wanted.
    pub(crate) fn compute(&self, results: Vec<&mut [E]>, threads: bool) -> Result<Survey, LengthError> {
        if self.count == 0 {
            return Ok(Survey::default());
        }
        let shares = if threads { 4 * rayon::current_num_threads() } else { 1 };
        let parts = self.parts(results, self.count.div_ceil(shares).next_multiple_of(CHUNK));
        let surveys: Vec<_> = match threads {
            true => parts.into_par_iter().map(|part| self.part(part)).collect(),
            false => parts.into_iter().map(|part| self.part(part)).collect(),
        };
        surveys.into_iter().sum()
    }

    /// Cuts the columns of all results into parts of a given number of points.
    fn parts<'b>(&self, results: Vec<&'b mut [E]>, length: usize) -> Vec<Part<'b, E>> {
        let ranges = (0..self.count).step_by(length).map(|start| start..self.count.min(start + length));
        let empty = |points| Part { points, results: results.iter().map(|_| Vec::new()).collect() };
        let mut parts: Vec<_> = ranges.map(empty).collect();
        for (k, result) in results.into_iter().enumerate() {
            for column in result.chunks_mut(self.count) {
                for (part, piece) in parts.iter_mut().zip(column.chunks_mut(length)) {
                    part.results[k].push(piece);
                }
            }
        }
        parts
    }

    /// Computes the points of a part, chunk by chunk.
    fn part(&self, Part { points: range, mut results }: Part<'_, E>) -> Result<Survey, LengthError> {
        let mut F = [E::default(); 9 * CHUNK];
        let mut rooms: Vec<_> = self.quantity.numbers().map(|n| vec![E::default(); n * CHUNK]).collect();
        let mut sum = Survey::default();
        for start in range.clone().step_by(CHUNK) {
            let points = start..range.end.min(start + CHUNK);
            let room = points.len().next_multiple_of(E::LINE);
            self.to_lines(points.clone(), &mut F);
            let cells = if self.cells.is_empty() { 0 } else { room };
            let cells: Vec<_> = (0..cells).map(|_| StatusCell::default()).collect();
            let mut lines: Vec<_> = self
                .quantity
                .numbers()
                .zip(&mut rooms)
                .map(|(n, room_of)| &mut room_of[..n * room])
                .collect();
            let survey = self.materials.with_batch(start, room, |batch| {
                let batch = batch.with_layout(Layout::Lines).with_statuses(&cells);
                self.quantity.compute(&batch, &F[..9 * room], &mut lines)
            })?;
            sum = sum + Survey { first: survey.first.map(|first| start + first), ..survey };
            for (cell, computed) in self.cells.iter().skip(start).zip(cells.iter().take(points.len())) {
                cell.set(computed.get());
            }
            for (lines, columns) in lines.iter().zip(&mut results) {
                from_lines(lines, columns, points.start - range.start..points.end - range.start);
            }
        }
        Ok(sum)
    }

    /// Copies points to lines, the last of which is filled up with identities.
    fn to_lines(&self, points: Range<usize>, lines: &mut [E]) {
        for (k, column) in self.F.chunks_exact(self.count).enumerate() {
            let filler = E::splat(if k % 4 == 0 { 1.0 } else { 0.0 });
            for (line, from) in column[points.clone()].chunks(E::LINE).enumerate() {
                let to = &mut lines[(9 * line + k) * E::LINE..][..E::LINE];
                to[..from.len()].copy_from_slice(from);
                to[from.len()..].fill(filler);
            }
        }
    }
}

/// Copies points from lines to a part of each column.
fn from_lines<E: Kernels>(lines: &[E], columns: &mut [&mut [E]], points: Range<usize>) {
    let n = columns.len();
    for (k, column) in columns.iter_mut().enumerate() {
        for (line, to) in column[points.clone()].chunks_mut(E::LINE).enumerate() {
            to.copy_from_slice(&lines[(n * line + k) * E::LINE..][..to.len()]);
        }
    }
}
