//! Multigrid level: a matrix, a smoother, and the transfer to the next level and back.

use std::sync::Arc;

use super::aggregation::aggregate;
use super::division::{Division, Numbers, ROWS, diagonals};
use super::last::Block;
use super::rows::{Columns, Parts, Rows, WholeRows, coarse_rows, columns_of};
use crate::system::graph::Graph;
use crate::system::linear::LinearError;
use crate::system::linear::symmetric_blocks::{Pattern, SymmetricBlocks};
use crate::system::lists::Lists;
use crate::system::parts::{for_each_entry, for_each_part};

/// Degree of the Chebyshev polynomials.
const DEGREE: usize = 2;

/// Smallest eigenvalue that a polynomial damps, relative to the largest eigenvalue.
const DAMPED: f32 = 0.1;

/// Number of iterations of the power method for the first matrix.
const FIRST_POWERS: usize = 12;

/// Number of iterations of the power method for each later matrix.
pub(super) const POWERS: usize = 3;

/// Factor between the estimate of the power method and the bound of the eigenvalues.
const MARGIN: f64 = 1.1;

/// Tolerance of linear dependence: norm of the orthogonal part of a motion, relative to the motion.
const DEPENDENT: f64 = 1e-6;

/// Matrix in f32, and memory for a cycle.
#[derive(Clone)]
pub(super) struct Level<const N: usize> {
    matrix: SymmetricBlocks<f32, N>,
    /// Inverses of the blocks on the diagonal of owned rows; zero for rows that are not included.
    inverses: Vec<[[f32; N]; N]>,
    /// Upper bound of the eigenvalues of D⁻¹A.
    largest: f32,
    /// Estimate of the eigenvector of the largest eigenvalue of D⁻¹A.
    roughest: Vec<[f32; N]>,
    prolongation: Rows<f32, N, 6>,
    columns: Columns,
    /// Solution in the owned rows.
    pub(super) x: Vec<[f32; N]>,
    /// Residual b − A x in owned rows.
    residual: Vec<[f32; N]>,
    step: Vec<[f32; N]>,
    product: Vec<[f32; N]>,
}

/// Matrix and rigid motions of the next level, before its set-up.
pub(super) struct Coarse<D> {
    pub(super) matrix: SymmetricBlocks<f64, 6>,
    pub(super) diagonals: Vec<Block>,
    pub(super) division: D,
    /// Rigid motions of the body as motions of the aggregates.
    pub(super) motions: Vec<Block>,
}

impl<const N: usize> Level<N> {
    /// Level of `scale` times a matrix, and the data of the next level.
    pub(super) fn new<D: Division>(
        matrix: &SymmetricBlocks<f64, N>,
        diagonals: &[[[f64; N]; N]],
        scale: f64,
        included: &[bool],
        motions: &[[[f64; 6]; N]],
        division: &mut D,
    ) -> Result<(Self, Coarse<D>), D::Error> {
        let owned = diagonals.len();
        let zeros = |rows: usize| vec![[0.0; N]; rows];
        let mut level = Self {
            matrix: SymmetricBlocks::new(matrix.pattern().clone())?,
            inverses: vec![[[0.0; N]; N]; owned],
            largest: 0.0,
            roughest: (0..included.len()).map(anything).collect(),
            prolongation: Rows::none(),
            columns: Columns::none(),
            x: zeros(owned),
            residual: zeros(owned),
            step: zeros(included.len()),
            product: zeros(included.len()),
        };
        level.take(matrix, diagonals, scale, included, FIRST_POWERS, division);

        let (aggregates, count) = aggregate(matrix.pattern(), included, owned);
        let mut numbers = Numbers::new(division.first(count), count);
        let (mut tentative, motions) = orthonormal(&aggregates, count, motions)?;
        extend(&mut tentative, &mut numbers, division);
        let whole = WholeRows::new(matrix.pattern())?;
        let product = whole.multiply(matrix, included, &tentative, numbers.len());
        let product = sum(product, owned, &mut numbers, division);
        let damping = scale * MARGIN * 4.0 / (3.0 * f64::from(level.largest));
        let mut prolongation = Rows::make(owned, numbers.len(), |row, sum| {
            let inverse = level.inverses[row].map(|row| row.map(|entry| damping * f64::from(entry)));
            for (column, product) in product.row(row) {
                let block = sum.block(column);
                let own = tentative.row(row).next().filter(|(aggregate, _)| *aggregate == column);
                if let Some((_, tentative)) = own {
                    *block = *tentative;
                }
                for r in 0..N {
                    for k in 0..N {
                        for c in 0..6 {
                            block[r][c] -= inverse[r][k] * product[k][c];
                        }
                    }
                }
            }
        });
        drop(product);
        extend(&mut prolongation, &mut numbers, division);
        let product = whole.multiply(matrix, included, &prolongation, numbers.len());
        let columns = columns_of(&prolongation, numbers.len())?;
        let upper = coarse_rows(&prolongation, &columns, &product);
        drop(product);
        level.prolongation = prolongation.first(owned).map(|entry| entry as f32);
        level.columns = match division.copies() {
            0 => columns,
            _ => columns_of(&level.prolongation, numbers.len())?,
        };

        let above = |row: usize| {
            let columns = upper.row(row).map(move |(column, _)| (row, column as u32));
            columns.filter(|&(row, column)| column as usize != row)
        };
        let graph = Graph::of_upper(upper.len(), || (0..upper.len()).flat_map(above))?;
        let order = (0..graph.len() as u32).collect();
        let pattern = Arc::new(Pattern::new(graph, order)?);
        let mut coarse = SymmetricBlocks::new(pattern.clone())?;
        for (row, column, block) in pattern.stored() {
            if let Some((_, entries)) = upper.row(row).find(|&(other, _)| other == column) {
                coarse.blocks_mut()[block] = *entries;
            }
        }
        let mut division = division.coarse(count, numbers.others())?;
        let diagonals = regular_diagonals(&mut coarse, &mut division);
        Ok((level, Coarse { matrix: coarse, diagonals, division, motions }))
    }

    /// Replaces the matrix by `scale` times a matrix of the same pattern, and computes an upper bound of the
    /// eigenvalues of D⁻¹A by `powers` iterations of the power method.
    pub(super) fn take(
        &mut self,
        matrix: &SymmetricBlocks<f64, N>,
        diagonals: &[[[f64; N]; N]],
        scale: f64,
        included: &[bool],
        powers: usize,
        division: &mut impl Division,
    ) {
        self.matrix.for_each_chunk(|_, first, blocks| {
            for (single, block) in blocks.iter_mut().zip(&matrix.blocks()[first..]) {
                *single = block.map(|row| row.map(|entry| (scale * entry) as f32));
            }
        });
        for_each_entry(&mut self.inverses, ROWS, |row, single| {
            *single = match included[row] {
                true => inverse(&diagonals[row].map(|row| row.map(|entry| scale * entry)))
                    .map(|row| row.map(|entry| entry as f32)),
                false => [[0.0; N]; N],
            };
        });
        let Self { matrix, roughest, product, inverses, .. } = self;
        let owned = inverses.len();
        let mut largest = 1.0;
        for _ in 0..powers {
            division.copy(roughest);
            matrix.multiply(roughest, product);
            division.sum(product);
            for_each_entry(&mut roughest[..owned], ROWS, |row, x| {
                *x = times(&inverses[row], &product[row]);
            });
            let entries = roughest[..owned].as_flattened().iter();
            let square = division.total(entries.map(|&x| f64::from(x) * f64::from(x)).sum());
            if square > 0.0 && square.is_finite() {
                largest = square.sqrt();
                let unit = (1.0 / largest) as f32;
                for_each_part(roughest, ROWS, |_, x| {
                    x.as_flattened_mut().iter_mut().for_each(|x| *x *= unit)
                });
            }
        }
        self.largest = (MARGIN * largest) as f32;
    }

    /// Smooths the error of x = 0 for a right side, and restricts this machine's part of the residual to the
    /// next level.
    pub(super) fn down(&mut self, b: &[[f32; N]], coarse: &mut [[f32; 6]], division: &mut impl Division) {
        for_each_part(&mut self.x, ROWS, |_, x| x.fill([0.0; N]));
        self.residual.copy_from_slice(&b[..self.x.len()]);
        self.smooth(true, division);
        let Self { residual, prolongation, columns, .. } = self;
        for_each_entry(coarse, ROWS / 16, |column, coarse| {
            let mut sum = [0.0; 6];
            for &(row, index) in columns.of(column) {
                let (block, residual) = (prolongation.block(index as usize), &residual[row as usize]);
                for k in 0..N {
                    for c in 0..6 {
                        sum[c] += block[k][c] * residual[k];
                    }
                }
            }
            *coarse = sum;
        });
    }

    /// Adds the correction of the next level, and smooths the error again.
    pub(super) fn up(&mut self, coarse: &[[f32; 6]], division: &mut impl Division) {
        let Self { step, prolongation, x, .. } = self;
        for_each_entry(&mut step[..x.len()], ROWS, |row, step| {
            let mut sum = [0.0; N];
            for (column, block) in prolongation.row(row) {
                for r in 0..N {
                    for c in 0..6 {
                        sum[r] += block[r][c] * coarse[column][c];
                    }
                }
            }
            *step = sum;
        });
        self.follow(division);
        self.smooth(false, division);
    }

    /// Adds the Chebyshev polynomial of D⁻¹A, times D⁻¹ r, to x; the residual is updated on demand.
    fn smooth(&mut self, keep_residual: bool, division: &mut impl Division) {
        let (theta, delta) = (0.5 * (1.0 + DAMPED) * self.largest, 0.5 * (1.0 - DAMPED) * self.largest);
        let sigma = theta / delta;
        let mut rho = 1.0 / sigma;
        self.advance(0.0, 1.0 / theta);
        for step in 1..=DEGREE {
            if step < DEGREE || keep_residual {
                self.follow(division);
            } else {
                self.add_step();
            }
            if step < DEGREE {
                let next = 1.0 / (2.0 * sigma - rho);
                self.advance(next * rho, 2.0 * next / delta);
                rho = next;
            }
        }
    }

    /// Computes step = a step + b D⁻¹ r.
    fn advance(&mut self, a: f32, b: f32) {
        let Self { step, residual, inverses, .. } = self;
        for_each_entry(&mut step[..residual.len()], ROWS, |row, step| {
            let damped = times(&inverses[row], &residual[row]);
            for c in 0..N {
                // The previous step may contain any values, and must not be used.
                step[c] = if a == 0.0 { b * damped[c] } else { a * step[c] + b * damped[c] };
            }
        });
    }

    /// Computes x += step and r −= A step.
    fn follow(&mut self, division: &mut impl Division) {
        division.copy(&mut self.step);
        self.matrix.multiply(&self.step, &mut self.product);
        division.sum(&mut self.product);
        let Self { residual, product, .. } = self;
        for_each_part(residual, ROWS, |first, residual| {
            let product = product[first..].as_flattened();
            residual
                .as_flattened_mut()
                .iter_mut()
                .zip(product)
                .for_each(|(residual, product)| *residual -= product);
        });
        self.add_step();
    }

    fn add_step(&mut self) {
        let Self { x, step, .. } = self;
        for_each_part(x, ROWS, |first, x| {
            let step = step[first..].as_flattened();
            x.as_flattened_mut().iter_mut().zip(step).for_each(|(x, step)| *x += step);
        });
    }
}

/// Vector without symmetry, with a component in every direction.
fn anything<const N: usize>(row: usize) -> [f32; N] {
    std::array::from_fn(|c| {
        let hash = ((N * row + c + 1) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40;
        hash as f32 / (1 << 23) as f32 - 1.0
    })
}

fn times<const N: usize>(matrix: &[[f32; N]; N], x: &[f32; N]) -> [f32; N] {
    let mut product = [0.0; N];
    for r in 0..N {
        for c in 0..N {
            product[r] += matrix[r][c] * x[c];
        }
    }
    product
}

/// Rigid motions of each aggregate, orthonormal, at its rows, and rigid motions of the body as combinations
/// of them. A motion that is impossible for an aggregate of few rows is zero in both.
fn orthonormal<const N: usize>(
    aggregates: &[Option<usize>],
    count: usize,
    motions: &[[[f64; 6]; N]],
) -> Result<(Rows<f64, N, 6>, Vec<Block>), LinearError> {
    let mut blocks = motions.to_vec();
    let mut combinations = vec![[[0.0; 6]; 6]; count];
    let members = || (0..motions.len()).filter_map(|row| Some((aggregates[row]?, row)));
    let members = Lists::new(count, members)?;
    // Gram–Schmidt orthogonalisation, twice.
    for (aggregate, combination) in combinations.iter_mut().enumerate() {
        let rows = members.of(aggregate);
        let product = |blocks: &[[[f64; 6]; N]], k: usize, c: usize| {
            let of_row = |&row: &usize| (0..N).map(|r| blocks[row][r][k] * blocks[row][r][c]).sum::<f64>();
            rows.iter().map(of_row).sum::<f64>()
        };
        for c in 0..6 {
            let before = product(&blocks, c, c);
            for _ in 0..2 {
                let along: Vec<f64> = (0..c).map(|k| product(&blocks, k, c)).collect();
                for (k, along) in along.into_iter().enumerate() {
                    for &row in rows {
                        (0..N).for_each(|r| blocks[row][r][c] -= along * blocks[row][r][k]);
                    }
                    combination[k][c] += along;
                }
            }
            let after = product(&blocks, c, c);
            let length = if after > DEPENDENT * DEPENDENT * before { after.sqrt() } else { 0.0 };
            combination[c][c] = length;
            for &row in rows {
                for r in 0..N {
                    blocks[row][r][c] = if length > 0.0 { blocks[row][r][c] / length } else { 0.0 };
                }
            }
        }
    }
    let mut rows = Rows::none();
    for (row, block) in blocks.into_iter().enumerate() {
        if let Some(aggregate) = aggregates[row] {
            rows.push(aggregate, block);
        }
        rows.end();
    }
    Ok((rows, combinations))
}

/// Adds the rows of copies, with the values of their owners.
fn extend<const N: usize>(rows: &mut Rows<f64, N, 6>, numbers: &mut Numbers, division: &mut impl Division) {
    let lists = division.lists_for_copies(|row, list| numbers.write(rows.row(row), list));
    for list in lists {
        numbers.read(&list).into_iter().for_each(|(column, block)| rows.push(column, block));
        rows.end();
    }
}

/// Owned rows of the sum of all machines' parts.
fn sum<const N: usize>(
    rows: Rows<f64, N, 6>,
    owned: usize,
    numbers: &mut Numbers,
    division: &mut impl Division,
) -> Rows<f64, N, 6> {
    let lists = division.lists_for_owners(|copy, list| numbers.write(rows.row(owned + copy), list));
    let mut parts = Parts::new();
    for (row, list) in lists {
        parts.entry(row).or_default().extend(numbers.read(&list));
    }
    rows.add(owned, numbers.len(), &parts)
}

/// Blocks on the diagonal of a coarse matrix. Motions that are impossible for an aggregate are first given a
/// diagonal entry, so that the inverse exists.
fn regular_diagonals(matrix: &mut SymmetricBlocks<f64, 6>, division: &mut impl Division) -> Vec<Block> {
    let mut diagonals = diagonals(matrix, division);
    for (row, sum) in diagonals.iter_mut().enumerate() {
        let at = matrix.pattern().diagonal(row);
        let largest = (0..6).fold(0.0, |largest: f64, c| largest.max(sum[c][c]));
        for c in 0..6 {
            if sum[c][c] == 0.0 {
                sum[c][c] = if largest > 0.0 { largest } else { 1.0 };
                matrix.blocks_mut()[at][c][c] = sum[c][c];
            }
        }
    }
    diagonals
}

/// Inverse of a symmetric block. If the block is not positive definite, the inverse of the unit matrix times
/// its norm.
fn inverse<const N: usize>(block: &[[f64; N]; N]) -> [[f64; N]; N] {
    // Gauss–Jordan elimination, without pivoting, which a positive definite block does not need.
    let mut a = *block;
    let mut inverse: [[f64; N]; N] = std::array::from_fn(|r| std::array::from_fn(|c| f64::from(r == c)));
    for k in 0..N {
        let pivot = a[k][k];
        if !(pivot > 0.0 && pivot.is_finite()) {
            let norm = block.as_flattened().iter().map(|x| x * x).sum::<f64>().sqrt();
            let diagonal = if norm > 0.0 && norm.is_finite() { 1.0 / norm } else { 1.0 };
            return std::array::from_fn(|r| std::array::from_fn(|c| if r == c { diagonal } else { 0.0 }));
        }
        for c in 0..N {
            a[k][c] /= pivot;
            inverse[k][c] /= pivot;
        }
        for r in (0..N).filter(|&r| r != k) {
            let factor = a[r][k];
            for c in 0..N {
                a[r][c] -= factor * a[k][c];
                inverse[r][c] -= factor * inverse[k][c];
            }
        }
    }
    inverse
}
