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
//! *Many machines.* Each level is divided as [`Division`] says; on one machine nothing is exchanged.
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
use crate::system::graph::Graph;

use division::ROWS;
use level::{Coarse, Level};

pub(crate) use division::diagonals;
pub use division::{Division, Whole};
pub use last::{LastLevel, LastSolver};

/// Levels of a matrix of 3×3 blocks: none at first.
#[derive(Clone)]
pub(crate) struct Multigrid<D: Division> {
    /// Division of the nodes.
    division: D,
    levels: Option<Levels<D, D::Last>>,
}

#[derive(Clone)]
struct Levels<D, L> {
    /// Number of rows of each level, on all machines.
    rows: Vec<usize>,
    /// Times the matrix: its largest entry becomes 1.
    scale: f64,
    finest: Level<3>,
    /// Levels with the divisions of their rows.
    coarse: Vec<(Level<6>, D)>,
    last: L,
    last_division: D,
    /// The right side of the finest level.
    b: Vec<[f32; 3]>,
    /// Right sides, then solutions, of the coarse levels and the last.
    coarse_b: Vec<Vec<[f32; 6]>>,
}

impl<D: Division> Multigrid<D> {
    /// No levels, for nodes that are divided like this.
    pub(crate) fn new(division: D) -> Self {
        Self { division, levels: None }
    }

    pub(crate) fn division_mut(&mut self) -> &mut D {
        &mut self.division
    }

    /// Number of rows of each level, on all machines, and the solver of the last, if levels have been made.
    pub(crate) fn levels(&self) -> Option<(&[usize], &D::Last)> {
        self.levels.as_ref().map(|levels| (levels.rows.as_slice(), &levels.last))
    }

    /// Makes all levels for a matrix of 3×3 blocks, one row for each node. The blocks on its diagonal are
    /// those that all machines' parts add up to.
    ///
    /// `order` is the one in which rows are taken, which should keep neighbours together; rows that are not
    /// `included` have zeros for right sides and solutions.
    ///
    /// # Errors
    /// [`Division::Error`], also for an entry that is not finite.
    pub(crate) fn set_up(
        &mut self,
        matrix: &SymmetricBlocks<f64, 3>,
        diagonals: &[[[f64; 3]; 3]],
        graph: &Graph,
        order: &[u32],
        included: &[bool],
        positions: &[[f64; 3]],
    ) -> Result<(), D::Error> {
        self.levels = None;
        let division = &mut self.division;
        let owned = diagonals.len();
        let nodes = division.total(owned as f64) as usize;
        let scale = scale_of(diagonals, division);
        let motions = rigid(&positions[..owned], division);
        let (finest, mut next) =
            Level::new(matrix, diagonals, scale, graph, order, included, &motions, division)?;
        let mut coarse = Vec::new();
        let mut counts = vec![nodes];
        loop {
            let Coarse { matrix, diagonals, graph, motions, division } = &mut next;
            let rows = division.total(diagonals.len() as f64) as usize;
            // An aggregate has two rows at least, except where all neighbours are of other machines.
            let has_stalled = counts.last().is_some_and(|&before| 2 * rows > before);
            counts.push(rows);
            if has_stalled || division.is_last(rows, nodes) {
                break;
            }
            let all = vec![true; graph.rows()];
            let order: Vec<u32> = (0..graph.rows() as u32).collect();
            let (level, after) =
                Level::new(matrix, diagonals, scale, graph, &order, &all, motions, division)?;
            coarse.push((level, std::mem::replace(&mut next, after).division));
        }
        let Coarse { matrix, motions, division: last_division, .. } = next;
        let last = last_division.last(&LastLevel { matrix: &matrix, scale, motions: &motions })?;
        let rows =
            [finest.coarse_rows()].into_iter().chain(coarse.iter().map(|(level, _)| level.coarse_rows()));
        let coarse_b = rows.map(|rows| vec![[0.0; 6]; rows]).collect();
        let b = vec![[0.0; 3]; owned];
        self.levels = Some(Levels { rows: counts, scale, finest, coarse, last, last_division, b, coarse_b });
        Ok(())
    }

    /// Takes other entries for the finest level, and leaves the others as they are.
    pub(crate) fn take(
        &mut self,
        matrix: &SymmetricBlocks<f64, 3>,
        diagonals: &[[[f64; 3]; 3]],
        included: &[bool],
    ) {
        if let Some(levels) = &mut self.levels {
            levels.finest.take(matrix, diagonals, levels.scale, included, &mut self.division);
        }
    }

    /// Computes about A⁻¹ r, by one cycle, of the rows that this machine owns; where `r` and `z` are shorter,
    /// zeros follow.
    pub(crate) fn solve(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        let Self { division, levels } = self;
        let Some(Levels { scale, finest, coarse, last, last_division, b, coarse_b, .. }) = levels else {
            z.iter_mut().zip(r).for_each(|(z, r)| *z = *r);
            return;
        };
        let largest =
            r.par_iter().with_min_len(ROWS).flatten_iter().map(|r| r.abs()).reduce(|| 0.0, f64::max);
        let largest = division.largest(largest);
        let unit = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        b.par_iter_mut().zip(r).with_min_len(ROWS).for_each(|(b, r)| *b = r.map(|r| (unit * r) as f32));
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
            coarse_b[depth][..level.owned()].copy_from_slice(level.x());
            division.copy(&mut coarse_b[depth]);
        }
        finest.up(&coarse_b[0], division);
        let unit = *scale / unit;
        let rows = z.par_iter_mut().zip(finest.x()).with_min_len(ROWS);
        rows.for_each(|(z, x)| *z = x.map(|x| unit * f64::from(x)));
    }
}

/// Rigid motions of the body at each node: displacements along the axes, and by turns about them at its
/// centre.
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

/// The factor that makes the largest entry on the diagonal 1.
fn scale_of(diagonals: &[[[f64; 3]; 3]], division: &impl Division) -> f64 {
    let entries = diagonals.iter().flat_map(|block| (0..3).map(|c| block[c][c].abs()));
    let largest = division.largest(entries.fold(0.0, f64::max));
    if largest.is_normal() { largest.recip() } else { 1.0 }
}

#[cfg(test)]
mod tests;
