//! Multigrid by smoothed aggregation [VMB96]: a preconditioner for the stiffness of bodies of any size.
//!
//! With block-Jacobi preconditioning, conjugate gradients propagate a change by one element in each
//! iteration. Twice as many elements along an edge of a body therefore need twice as many iterations.
//! Multigrid transfers the slow part of an error, in which neighbours move alike, to a smaller system, and
//! the slow part of its error to a still smaller one. The last system is solved by a factorisation. The
//! number of iterations then hardly grows.
//!
//! *Levels.* Rows (on the finest level: nodes) are grouped into aggregates of a row and its neighbours. An
//! aggregate moves as a rigid body, with six unknowns. Let T be the matrix of the rigid motions of the
//! aggregates at their nodes, orthonormal within an aggregate, and D the blocks of A on the diagonal. Then
//! P = (I − ω D⁻¹A) T with ω = 4/(3 λmax) interpolates corrections smoothly from aggregates to nodes, and
//! PᵀA P is the matrix of the next level. On each level, combinations of the motions of the aggregates
//! represent the six rigid motions of the whole body at the positions of the stiffness. These motions need no
//! energy, and must be preserved.
//!
//! *Cycle.* Chebyshev polynomials of degree 2 in D⁻¹A [ABHT03] smooth the error on a level, before and after
//! the correction by the next level. The polynomials need λmax(D⁻¹A), which the power method computes. They
//! are symmetric, so that the cycle is symmetric, as conjugate gradients require.
//!
//! *Precision.* A cycle is computed in f32, which halves the memory traffic. The matrix is scaled so that a
//! stiffness in any unit is in the range of f32. The matrices of the levels are computed in f64, because of
//! the cancellation in PᵀA P.
//!
//! *Indefinite matrices.* The polynomial is positive at negative eigenvalues, and the diagonal of the last
//! level is increased until the factorisation succeeds. The cycle is therefore positive definite for any
//! matrix. Conjugate gradients detect the negative curvature of the matrix.
//!
//! *Many machines.* A [`Division`] divides each level; on one machine nothing is exchanged.
//!
//! \[VMB96\] Vaněk, Mandel, Brezina, *Algebraic Multigrid by Smoothed Aggregation for Second and Fourth Order
//! Elliptic Problems*, 1996.
//! \[ABHT03\] Adams, Brezina, Hu, Tuminaro, *Parallel Multigrid Smoothing: Polynomial versus Gauss–Seidel*,
//! 2003.

mod aggregation;
mod division;
mod last;
mod level;
mod rows;

use rayon::prelude::*;

use super::symmetric_blocks::SymmetricBlocks;
use crate::system::parts::for_each_entry;

use division::ROWS;
use level::{Coarse, Level, POWERS};

pub(crate) use division::diagonals;
pub use division::{Division, Undivided};
pub use last::{LastLevel, LastSolver};

/// Multigrid levels of a matrix of 3×3 blocks, with the solver `L` of the last level of a division `D`.
#[derive(Clone)]
pub(crate) struct Multigrid<D, L> {
    /// Number of rows of each level, on all machines.
    rows: Vec<usize>,
    /// Scale of the matrix, with which its largest entry is 1.
    scale: f64,
    finest: Level<3>,
    /// Levels, each with the division of its rows.
    coarse: Vec<(Level<6>, D)>,
    last: L,
    last_division: D,
    b: Vec<[f32; 3]>,
    /// Right sides, then solutions, of the coarse levels and the last.
    coarse_b: Vec<Vec<[f32; 6]>>,
}

impl<D: Division> Multigrid<D, D::Last> {
    /// Number of rows of each level, on all machines, and the solver of the last.
    pub(crate) fn levels(&self) -> (&[usize], &D::Last) {
        (&self.rows, &self.last)
    }

    /// Sets up all levels for a matrix of 3×3 blocks, with one row for each node and the division of the
    /// nodes. `diagonals` are the blocks on the diagonal of the sum of all machines' parts.
    ///
    /// Rows that are not `included` have zeros in right sides and solutions.
    pub(crate) fn new(
        matrix: &SymmetricBlocks<f64, 3>,
        diagonals: &[[[f64; 3]; 3]],
        included: &[bool],
        positions: &[[f64; 3]],
        division: &mut D,
    ) -> Result<Self, D::Error> {
        let owned = diagonals.len();
        let nodes = division.total(owned as f64) as usize;
        let scale = scale_of(diagonals, division);
        let motions = rigid(&positions[..owned], division);
        let (finest, mut next) = Level::new(matrix, diagonals, scale, included, &motions, division)?;
        let (mut coarse, mut coarse_b) = (Vec::new(), Vec::new());
        let mut counts = vec![nodes];
        loop {
            let Coarse { matrix, diagonals, motions, division } = &mut next;
            let all = vec![true; matrix.pattern().rows()];
            coarse_b.push(vec![[0.0; 6]; all.len()]);
            let rows = division.total(diagonals.len() as f64) as usize;
            // An aggregate has at least two rows, unless all neighbours belong to other machines.
            let has_stalled = counts.last().is_some_and(|&before| 2 * rows > before);
            counts.push(rows);
            if has_stalled || division.is_last(rows, nodes) {
                break;
            }
            let (level, after) = Level::new(matrix, diagonals, scale, &all, motions, division)?;
            coarse.push((level, std::mem::replace(&mut next, after).division));
        }
        let Coarse { matrix, motions, division: last_division, .. } = next;
        let last = last_division.last(&LastLevel { matrix: &matrix, scale, motions: &motions })?;
        let b = vec![[0.0; 3]; owned];
        Ok(Self { rows: counts, scale, finest, coarse, last, last_division, b, coarse_b })
    }

    /// Replaces the entries of the finest level, and leaves the other levels unchanged.
    pub(crate) fn take(
        &mut self,
        division: &mut D,
        matrix: &SymmetricBlocks<f64, 3>,
        diagonals: &[[[f64; 3]; 3]],
        included: &[bool],
    ) {
        self.finest.take(matrix, diagonals, self.scale, included, POWERS, division);
    }

    /// Computes an approximation of A⁻¹ r by one cycle, in the rows that this machine owns. If `r` and `z`
    /// are shorter, zeros follow.
    pub(crate) fn solve(&mut self, division: &mut D, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        let Self { scale, finest, coarse, last, last_division, b, coarse_b, .. } = self;
        let largest =
            r.par_iter().with_min_len(ROWS).flatten_iter().map(|r| r.abs()).reduce(|| 0.0, f64::max);
        let largest = division.largest(largest);
        let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        let rows = b.len().min(r.len());
        for_each_entry(&mut b[..rows], ROWS, |row, b| *b = r[row].map(|r| (unit * r) as f32));
        finest.down(b, &mut coarse_b[0], division);
        for (depth, (level, division)) in coarse.iter_mut().enumerate() {
            let (to_here, after) = coarse_b.split_at_mut(depth + 1);
            division.sum(&mut to_here[depth]);
            level.down(&to_here[depth], &mut after[0], division);
        }
        let depth = coarse.len();
        last_division.sum(&mut coarse_b[depth]);
        last.solve(&mut coarse_b[depth]);
        last_division.copy(&mut coarse_b[depth]);
        for (depth, (level, division)) in coarse.iter_mut().enumerate().rev() {
            level.up(&coarse_b[depth + 1], division);
            coarse_b[depth][..level.x.len()].copy_from_slice(&level.x);
            division.copy(&mut coarse_b[depth]);
        }
        finest.up(&coarse_b[0], division);
        let unit = *scale / unit;
        let x = &finest.x;
        let rows = z.len().min(x.len());
        for_each_entry(&mut z[..rows], ROWS, |row, z| *z = x[row].map(|x| unit * f64::from(x)));
    }
}

/// Rigid motions of the body at each node: translations along the axes, and rotations about the axes through
/// its centre.
fn rigid(positions: &[[f64; 3]], division: &impl Division) -> Vec<[[f64; 6]; 3]> {
    let nodes = division.total(positions.len() as f64).max(1.0);
    let centre: [f64; 3] =
        std::array::from_fn(|c| division.total(positions.iter().map(|x| x[c]).sum::<f64>()) / nodes);
    let away = |x: &[f64; 3]| -> [f64; 3] { std::array::from_fn(|c| x[c] - centre[c]) };
    let size = division.largest(positions.iter().flat_map(away).fold(0.0, |size: f64, x| size.max(x.abs())));
    let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
    let motions = positions.iter().map(|x| {
        let [x, y, z] = away(x).map(|x| unit * x);
        [[1.0, 0.0, 0.0, 0.0, z, -y], [0.0, 1.0, 0.0, -z, 0.0, x], [0.0, 0.0, 1.0, y, -x, 0.0]]
    });
    motions.collect()
}

/// Factor with which the largest entry on the diagonal is 1.
fn scale_of(diagonals: &[[[f64; 3]; 3]], division: &impl Division) -> f64 {
    let entries = diagonals.iter().flat_map(|block| (0..3).map(|c| block[c][c].abs()));
    let largest = division.largest(entries.fold(0.0, f64::max));
    if largest.is_normal() { largest.recip() } else { 1.0 }
}

#[cfg(test)]
mod tests;
