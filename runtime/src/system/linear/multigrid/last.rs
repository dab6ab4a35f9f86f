//! Last level, which a direct solver solves.

use crate::system::linear::symmetric_blocks::SymmetricBlocks;
use crate::system::linear::{Cholesky, LinearError};

/// First increase of the diagonal of the last level, relative to its largest entry, if the factorisation
/// fails. Each further increase is a hundred times larger.
const FIRST_GROWTH: f64 = 1e-12;

/// Solver of the last level of multigrid.
pub trait LastSolver {
    /// Replaces a right side by the solution, in the rows that this machine owns.
    fn solve(&mut self, b: &mut [[f32; 6]]);
}

/// Matrix of the last level of multigrid, with six unknowns for each row.
pub struct LastLevel<'a> {
    pub(super) matrix: &'a SymmetricBlocks<f64, 6>,
    /// Scale of the matrix.
    pub(super) scale: f64,
    pub(super) motions: &'a [[[f64; 6]; 6]],
}

impl LastLevel<'_> {
    /// Row, column and entries of the blocks of this machine's part. There is one block for two different
    /// rows; the block of `column` and `row` is its transpose.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, [[f64; 6]; 6])> {
        let pattern = self.matrix.pattern();
        let row = move |row: usize| pattern.upper(row).map(move |(block, column)| (row, column, block));
        let entries = |block: usize| self.matrix.blocks()[block].map(|row| row.map(|x| self.scale * x));
        (0..pattern.rows()).flat_map(row).map(move |(row, column, block)| (row, column, entries(block)))
    }

    /// Six rigid motions of the body in the unknowns of each owned row, each motion in a column.
    #[must_use]
    pub fn motions(&self) -> &[[[f64; 6]; 6]] {
        self.motions
    }
}

/// Factor of the last level, on one machine.
#[derive(Clone)]
pub struct Last {
    cholesky: Cholesky,
    b: Vec<f64>,
}

impl Last {
    /// Factors `scale` times a matrix, with a larger diagonal if necessary.
    pub(super) fn new(level: &LastLevel<'_>) -> Result<Self, LinearError> {
        let LastLevel { matrix, scale, .. } = *level;
        let pattern = matrix.pattern();
        let unknowns = 6 * pattern.rows();
        let (mut starts, mut rows) = (vec![0], Vec::new());
        for column in 0..unknowns {
            rows.extend(column..unknowns);
            starts.push(rows.len());
        }
        let mut cholesky = Cholesky::new(&starts, &rows)?;
        let mut values = vec![0.0; rows.len()];
        for row in 0..pattern.rows() {
            for (block, column) in pattern.upper(row) {
                for r in 0..6 {
                    for c in (0..6).filter(|&c| column > row || c >= r) {
                        // Below the diagonal: column `row`, row `column`.
                        values[starts[6 * row + r] + (6 * column + c) - (6 * row + r)] =
                            scale * matrix.blocks()[block][r][c];
                    }
                }
            }
        }
        let largest =
            (0..unknowns).fold(0.0, |largest: f64, column| largest.max(values[starts[column]].abs()));
        let mut growth = 0.0;
        loop {
            match cholesky.factor(&values) {
                Ok(()) => return Ok(Self { cholesky, b: vec![0.0; unknowns] }),
                Err(LinearError::NotPositive { .. }) if growth < 1.0 && largest > 0.0 => {
                    let next = if growth == 0.0 { FIRST_GROWTH } else { 100.0 * growth };
                    for column in 0..unknowns {
                        values[starts[column]] += (next - growth) * largest;
                    }
                    growth = next;
                }
                Err(error) => return Err(error),
            }
        }
    }
}

impl LastSolver for Last {
    fn solve(&mut self, b: &mut [[f32; 6]]) {
        for (double, single) in self.b.iter_mut().zip(b.as_flattened()) {
            *double = f64::from(*single);
        }
        self.cholesky.substitute(&mut self.b);
        for (single, double) in b.as_flattened_mut().iter_mut().zip(&self.b) {
            *single = *double as f32;
        }
    }
}
