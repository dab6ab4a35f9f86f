//! Multigrid by smoothed aggregation [VMB96]: a preconditioner for the stiffness of bodies of any size.
//!
//! Conjugate gradients preconditioned by the blocks on the diagonal carry a change from node to node, one
//! element in each iteration, so that a body of twice the elements along an edge needs twice the
//! iterations. Here the slow part of an error, in which neighbours move alike, is handed to a smaller
//! system, and its slow part to a still smaller one, until a factorisation takes what is left: the number
//! of iterations hardly grows.
//!
//! *Levels.* Rows (at first: nodes) are grouped into aggregates of a row and its neighbours. An aggregate
//! moves as a rigid body: six unknowns. With T the matrix that gives the nodes their parts of those
//! motions, orthonormal within an aggregate, and D the blocks of A on the diagonal, P = (I − ω D⁻¹A) T, ω =
//! 4/(3 λmax), carries corrections from an aggregate to its nodes, smoothly, and PᵀA P is the matrix of the
//! next level. The six rigid motions of the whole body, at the positions where the stiffness is taken, are
//! combinations of those of the aggregates, on each level: they cost no energy, and must not be lost.
//!
//! *Cycle.* Chebyshev polynomials in D⁻¹A of degree 2 [ABHT03] damp what a level can carry, before and after
//! the next one has corrected the rest. The polynomials need λmax(D⁻¹A), found by the power method, and are
//! symmetric: so is the cycle, which conjugate gradients demand.
//!
//! *Precision.* A cycle is in f32, scaled so that stiffness of any unit fits: half of what it reads. The
//! matrices of the levels are made in f64, since PᵀA P cancels.
//!
//! *Indefinite matrices.* A polynomial stays positive at negative eigenvalues, and the factor of the last
//! level gets a larger diagonal until it exists, so that the cycle is positive definite whatever the matrix
//! is; conjugate gradients find the negative curvature of the matrix itself.
//!
//! \[VMB96\] Vaněk, Mandel, Brezina, *Algebraic Multigrid by Smoothed Aggregation for Second and Fourth Order
//! Elliptic Problems*, 1996.
//! \[ABHT03\] Adams, Brezina, Hu, Tuminaro, *Parallel Multigrid Smoothing: Polynomial versus Gauss–Seidel*,
//! 2003.

mod aggregation;
mod level;
mod rows;

use rayon::prelude::*;

use super::symmetric_blocks::SymmetricBlocks;
use super::{Cholesky, LinearError};
use crate::system::graph::Graph;

use level::{Coarse, Level, ROWS};

/// Rows of a level that is always factored. Large bodies have a larger last level, of half the root of the
/// number of their nodes: its factor takes less time than the finest level all the same.
const FEW: usize = 64;

/// Growth of the diagonal of the last level, relative to its largest entry, where the factor fails: a
/// hundredfold more each time.
const FIRST_GROWTH: f64 = 1e-12;

/// Levels of a matrix of 3×3 blocks: none at first.
#[derive(Clone, Default)]
pub(crate) struct Multigrid {
    levels: Option<Levels>,
}

#[derive(Clone)]
struct Levels {
    /// Times the matrix: its largest entry becomes 1.
    scale: f64,
    finest: Level<3>,
    coarse: Vec<Level<6>>,
    last: Last,
    /// The right side of the finest level.
    b: Vec<[f32; 3]>,
    /// Right sides, then solutions, of the coarse levels and the last.
    coarse_b: Vec<Vec<[f32; 6]>>,
}

/// The factor of the last level.
#[derive(Clone)]
struct Last {
    cholesky: Cholesky,
    b: Vec<f64>,
}

impl Multigrid {
    /// Makes all levels for a matrix of 3×3 blocks, one row for each node.
    ///
    /// `order` is the one in which rows are taken, which should keep neighbours together; rows that are not
    /// `included` have zeros for right sides and solutions.
    ///
    /// # Errors
    /// [`LinearError::OutOfMemory`]; [`LinearError::NotPositive`] if an entry is not finite.
    pub(crate) fn set_up(
        &mut self,
        matrix: &SymmetricBlocks<f64, 3>,
        graph: &Graph,
        order: &[u32],
        included: &[bool],
        positions: &[[f64; 3]],
    ) -> Result<(), LinearError> {
        self.levels = None;
        let scale = scale_of(matrix);
        let (finest, mut next) = Level::new(matrix, scale, graph, order, included, &rigid(positions))?;
        let mut coarse = Vec::new();
        // An aggregate has two rows at least, so that each level halves the one before it.
        let few = FEW.max(positions.len().isqrt() / 2);
        while next.graph.rows() > few {
            let Coarse { matrix, graph, motions } = &next;
            let all = vec![true; graph.rows()];
            let order: Vec<u32> = (0..graph.rows() as u32).collect();
            let (level, after) = Level::new(matrix, scale, graph, &order, &all, motions)?;
            coarse.push(level);
            next = after;
        }
        let last = Last::new(&next.matrix, scale)?;
        let rows = [finest.coarse_rows()].into_iter().chain(coarse.iter().map(Level::coarse_rows));
        let coarse_b = rows.map(|rows| vec![[0.0; 6]; rows]).collect();
        let b = vec![[0.0; 3]; positions.len()];
        self.levels = Some(Levels { scale, finest, coarse, last, b, coarse_b });
        Ok(())
    }

    /// Takes other entries for the finest level, and leaves the others as they are.
    pub(crate) fn take(&mut self, matrix: &SymmetricBlocks<f64, 3>, included: &[bool]) {
        if let Some(levels) = &mut self.levels {
            levels.finest.take(matrix, levels.scale, included);
        }
    }

    /// Computes about A⁻¹ r, by one cycle.
    pub(crate) fn solve(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        let Some(Levels { scale, finest, coarse, last, b, coarse_b }) = &mut self.levels else {
            z.copy_from_slice(r);
            return;
        };
        let largest =
            r.par_iter().with_min_len(ROWS).flatten_iter().map(|r| r.abs()).reduce(|| 0.0, f64::max);
        let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        b.par_iter_mut().zip(r).with_min_len(ROWS).for_each(|(b, r)| *b = r.map(|r| (unit * r) as f32));
        finest.down(b, &mut coarse_b[0]);
        for (depth, level) in coarse.iter_mut().enumerate() {
            let (to_here, after) = coarse_b.split_at_mut(depth + 1);
            level.down(&to_here[depth], &mut after[0]);
        }
        let depth = coarse.len();
        last.solve(&mut coarse_b[depth]);
        for (depth, level) in coarse.iter_mut().enumerate().rev() {
            level.up(&coarse_b[depth + 1]);
            coarse_b[depth].copy_from_slice(level.x());
        }
        finest.up(&coarse_b[0]);
        let unit = *scale / unit;
        let rows = z.par_iter_mut().zip(finest.x()).with_min_len(ROWS);
        rows.for_each(|(z, x)| *z = x.map(|x| unit * f64::from(x)));
    }
}

/// Rigid motions of the body at each node: displacements along the axes, and by turns about them at its
/// centre.
fn rigid(positions: &[[f64; 3]]) -> Vec<[[f64; 6]; 3]> {
    let centre: [f64; 3] =
        std::array::from_fn(|c| positions.iter().map(|x| x[c]).sum::<f64>() / positions.len().max(1) as f64);
    let away = |x: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|c| x[c] - centre[c]) };
    let size = positions.iter().flat_map(away).fold(0.0, |size: f64, x| size.max(x.abs()));
    let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
    let motions = positions.iter().map(|x| {
        let [x, y, z] = away(x).map(|x| unit * x);
        [[1.0, 0.0, 0.0, 0.0, z, -y], [0.0, 1.0, 0.0, -z, 0.0, x], [0.0, 0.0, 1.0, y, -x, 0.0]]
    });
    motions.collect()
}

/// The factor that makes the largest entry on the diagonal 1.
fn scale_of(matrix: &SymmetricBlocks<f64, 3>) -> f64 {
    let rows = 0..matrix.pattern().rows();
    let entries = rows.flat_map(|row| (0..3).map(move |c| matrix.diagonal(row)[c][c].abs()));
    let largest = entries.fold(0.0, f64::max);
    if largest.is_normal() { largest.recip() } else { 1.0 }
}

impl Last {
    /// Factors `scale` times a matrix, with a larger diagonal if need be.
    fn new(matrix: &SymmetricBlocks<f64, 6>, scale: f64) -> Result<Self, LinearError> {
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

    /// Replaces a right side by the solution.
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

#[cfg(test)]
mod tests;
