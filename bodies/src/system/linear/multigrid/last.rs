//! Last level, which a direct solver solves.

use crate::system::linear::LinearError;
use crate::system::linear::symmetric_blocks::SymmetricBlocks;
use crate::system::memory::filled;

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
    /// Six rigid motions of the body in the unknowns of each owned row, each motion in a column.
    pub motions: &'a [Block],
}

impl LastLevel<'_> {
    /// Row, column and entries of the blocks of this machine's part. There is one block for two different
    /// rows; the block of `column` and `row` is its transpose.
    pub fn blocks(&self) -> impl Iterator<Item = (usize, usize, Block)> {
        let entries = |block: &Block| block.map(|row| row.map(|x| self.scale * x));
        self.matrix.stored().map(move |(row, column, block)| (row, column, entries(block)))
    }
}

/// Factor of the last level, on one machine: A = L Lᵀ, dense, in blocks of the six unknowns of a row.
///
/// The last level has a few hundred rows at most, and little of its factor is zero.
#[derive(Clone)]
pub struct Last {
    /// The blocks of a row up to the diagonal, row after row, transposed: entry (c, r) of the block (i, j)
    /// belongs to row r of i and column c of j. In a factor the blocks on the diagonal are L⁻ᵀ.
    blocks: Vec<Block>,
    b: Vec<[f64; 6]>,
}

impl Last {
    /// Factors `scale` times a matrix, with a larger diagonal if necessary.
    pub(super) fn new(level: &LastLevel<'_>) -> Result<Self, LinearError> {
        let rows = level.matrix.pattern().rows();
        let mut last = Self { blocks: filled(first(rows), [[0.0; 6]; 6])?, b: filled(rows, [0.0; 6])? };
        let diagonal = (0..rows).map(|row| level.matrix.diagonal(row));
        let entries = diagonal.flat_map(|block| (0..6).map(|c| (level.scale * block[c][c]).abs()));
        let largest = entries.fold(0.0, f64::max);
        let mut growth = 0.0;
        loop {
            last.fill(level, growth * largest);
            match last.factor() {
                Ok(()) => return Ok(last),
                Err(LinearError::NotPositive { .. }) if growth < 1.0 && largest > 0.0 => {
                    growth = if growth == 0.0 { FIRST_GROWTH } else { 100.0 * growth };
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Takes the entries of a matrix, with a larger diagonal.
    fn fill(&mut self, level: &LastLevel<'_>, added: f64) {
        self.blocks.fill([[0.0; 6]; 6]);
        // The blocks of the upper triangle are the transposed ones of the lower.
        for (row, column, block) in level.blocks() {
            self.blocks[first(column) + row] = block;
        }
        for row in 0..level.matrix.pattern().rows() {
            let block = &mut self.blocks[first(row) + row];
            (0..6).for_each(|c| block[c][c] += added);
        }
    }

    /// Replaces the matrix by its factor, row by row: L_ij = (A_ij − Σ L_ik L_jkᵀ) L_jj⁻ᵀ for k < j.
    fn factor(&mut self) -> Result<(), LinearError> {
        let mut start = 0;
        for i in 0.. {
            let (before, row) = self.blocks.split_at_mut(start);
            if row.is_empty() {
                break;
            }
            for j in 0..i {
                let other = &before[first(j)..=first(j) + j];
                let mut block = row[j];
                for (a, b) in other[..j].iter().zip(&*row) {
                    subtract_product(a, b, &mut block);
                }
                row[j] = [[0.0; 6]; 6];
                // Transposed: L_jj⁻¹ times the block.
                for c in 0..6 {
                    for k in 0..=c {
                        for r in 0..6 {
                            row[j][c][r] += other[j][k][c] * block[k][r];
                        }
                    }
                }
            }
            let mut block = row[i];
            for a in &row[..i] {
                subtract_product(a, a, &mut block);
            }
            let column = |pivot: usize| LinearError::NotPositive { column: 6 * i + pivot };
            row[i] = inverse_factor(&block).map_err(column)?;
            start += i + 1;
        }
        Ok(())
    }
}

impl LastSolver for Last {
    /// Solves L Lᵀ x = b.
    fn solve(&mut self, single: &mut [[f32; 6]]) {
        let Self { blocks, b } = self;
        for (b, single) in b.iter_mut().zip(&*single) {
            *b = single.map(f64::from);
        }
        for i in 0..b.len() {
            let row = &blocks[first(i)..=first(i) + i];
            let (before, rest) = b.split_at_mut(i);
            let mut sum = rest[0];
            for (block, y) in row.iter().zip(&*before) {
                for c in 0..6 {
                    (0..6).for_each(|r| sum[r] -= block[c][r] * y[c]);
                }
            }
            rest[0] = [0.0; 6];
            for c in 0..6 {
                (c..6).for_each(|r| rest[0][r] += row[i][c][r] * sum[c]);
            }
        }
        for i in (0..b.len()).rev() {
            let row = &blocks[first(i)..=first(i) + i];
            let (before, rest) = b.split_at_mut(i);
            let y = rest[0];
            rest[0] = std::array::from_fn(|c| (c..6).map(|r| row[i][c][r] * y[r]).sum());
            for (block, y) in row.iter().zip(before) {
                for c in 0..6 {
                    y[c] -= (0..6).map(|r| block[c][r] * rest[0][r]).sum::<f64>();
                }
            }
        }
        for (single, b) in single.iter_mut().zip(b) {
            *single = b.map(|x| x as f32);
        }
    }
}

/// 6×6 entries: the six unknowns of an aggregate by those of another, or by six motions.
pub(super) type Block = [[f64; 6]; 6];

/// Index of the first block of a row.
fn first(row: usize) -> usize {
    row * (row + 1) / 2
}

/// Subtracts aᵀ b.
#[inline(always)]
fn subtract_product(a: &Block, b: &Block, block: &mut Block) {
    for (a, b) in a.iter().zip(b) {
        for c in 0..6 {
            for r in 0..6 {
                block[c][r] -= a[c] * b[r];
            }
        }
    }
}

/// L⁻ᵀ of a symmetric block L Lᵀ, of which the entries (c, r) with c ≤ r are read, or the pivot that is not
/// positive.
fn inverse_factor(block: &Block) -> Result<Block, usize> {
    // Lᵀ, row by row.
    let mut upper = [[0.0; 6]; 6];
    for c in 0..6 {
        for r in c..6 {
            let sum = block[c][r] - (0..c).map(|k| upper[k][c] * upper[k][r]).sum::<f64>();
            upper[c][r] = match r == c {
                true if sum > 0.0 && sum.is_finite() => sum.sqrt(),
                true => return Err(c),
                false => sum / upper[c][c],
            };
        }
    }
    let mut inverse = [[0.0; 6]; 6];
    for r in 0..6 {
        inverse[r][r] = 1.0 / upper[r][r];
        for c in (0..r).rev() {
            let sum: f64 = (c + 1..=r).map(|k| upper[c][k] * inverse[k][r]).sum();
            inverse[c][r] = -sum / upper[c][c];
        }
    }
    Ok(inverse)
}
