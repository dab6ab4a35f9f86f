//! Choice of the preconditioner of conjugate gradients: the blocks on the diagonal if these take few
//! iterations, otherwise multigrid.
//!
//! Blocks cost next to nothing. They are suitable for bodies that are soft for their time step: there inertia
//! holds each node by itself. Without inertia, and in a fine mesh, their iterations grow with the number of
//! elements along an edge, and those of [multigrid](crate::system::linear::multigrid) do not; an iteration of
//! it costs six times as much, and its levels take the time of ten more to make.
//!
//! So blocks are chosen if inertia has a large enough share of the diagonal, and are given up if they
//! converge too slowly. Levels are made for the first system of a step that needs them. For later systems the
//! finest level takes the current matrix, and the others stay in use while they cost no more iterations than
//! new ones would, measured by the iterations of fresh ones for each digit.
//!
//! All of this is decided by the matrix and by numbers of iterations, never by a clock, and nothing is kept
//! from one step for the next: a step depends on the state before it alone, to the last bit, whether a run
//! was interrupted there or not.

use crate::system::linear::block_jacobi::BlockJacobi;
use crate::system::linear::conjugate_gradients::{End, Iteration};
use crate::system::linear::fits;
use crate::system::linear::multigrid::{Division, Multigrid, diagonals};
use crate::system::nodal_stiffness::NodalStiffness;

/// Number of iterations for each digit of the solution above which blocks on the diagonal are replaced.
const BLOCKS: f64 = 20.0;

/// Share of inertia in the diagonal above which blocks are chosen.
///
/// With a share s the condition of D⁻¹A is about 2.8/s, and blocks take 1.15 √(2.8/s) iterations for each
/// digit: here fourteen, the time that levels take.
const SOFT: f64 = 0.02;

/// Number of iterations that take as long as making new levels.
const SET_UP: f64 = 10.0;

/// Positive definite approximation of the inverse of a stiffness, zero at pinned nodes: for conjugate
/// gradients, on one machine or on many, among which a [`Division`] divides the nodes.
///
/// Chosen by the share of inertia in the diagonal, and by how many iterations systems take: the 3×3 blocks on
/// the diagonal, or multigrid, whose levels serve for later matrices as long as they are worth it.
#[derive(Clone)]
pub struct Preconditioner<D: Division> {
    division: D,
    blocks: BlockJacobi,
    multigrid: Option<Multigrid<D, D::Last>>,
    in_use: InUse,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum InUse {
    /// Not chosen yet.
    Nothing,
    Blocks,
    /// Levels of the current matrix.
    Fresh,
    /// Levels of an earlier matrix, except for the finest, and the number of iterations for each digit that
    /// they needed when fresh.
    Old {
        for_a_digit: f64,
    },
    /// Levels must be made.
    Wanted,
}

impl<D: Division> Preconditioner<D> {
    /// Memory for the nodes that this machine owns, with their division.
    #[must_use]
    pub fn new(nodes: usize, division: D) -> Self {
        Self { division, blocks: BlockJacobi::new(nodes), multigrid: None, in_use: InUse::Nothing }
    }

    /// Discards all information from earlier systems.
    pub fn forget(&mut self) {
        self.in_use = InUse::Nothing;
    }

    /// Number of rows of each level, on all machines, and the solver of the last, where multigrid is in use.
    #[must_use]
    pub fn levels(&self) -> Option<(&[usize], &D::Last)> {
        let has_levels = matches!(self.in_use, InUse::Fresh | InUse::Old { .. });
        self.multigrid.as_ref().filter(|_| has_levels).map(Multigrid::levels)
    }

    /// Takes a matrix, of which this is the machine's part, with the nodes at `x`, m. Inertia has added
    /// `inertia(node)` to each entry on the diagonal.
    ///
    /// # Errors
    /// [`Division::Error`], also for [`LinearError::Length`](crate::system::LinearError::Length) where a
    /// slice or the division does not have the length of the stiffness.
    pub fn take(
        &mut self,
        stiffness: &NodalStiffness,
        is_free: &[bool],
        x: &[[f64; 3]],
        inertia: impl Fn(usize) -> f64,
    ) -> Result<(), D::Error> {
        let matrix = stiffness.matrix();
        let division = &mut self.division;
        let rows = matrix.pattern().rows();
        fits("is_free", is_free.len(), rows)?;
        let owned = rows.saturating_sub(division.copies());
        fits("stiffness", owned, self.blocks.len())?;
        fits("x", x.len().min(owned), owned)?;
        let diagonals = diagonals(matrix, division);
        if self.in_use == InUse::Nothing {
            let softness = softness(&diagonals, is_free, inertia, division);
            self.in_use = if softness >= SOFT { InUse::Blocks } else { InUse::Wanted };
        }
        match (self.in_use, &mut self.multigrid) {
            (InUse::Nothing | InUse::Blocks, _) => self.blocks.factor(|node| &diagonals[node]),
            (InUse::Old { .. }, Some(multigrid)) => multigrid.take(division, matrix, &diagonals, is_free),
            _ => {
                self.multigrid = None;
                let made = Multigrid::new(matrix, &diagonals, is_free, x, division)?;
                (self.multigrid, self.in_use) = (Some(made), InUse::Fresh);
            }
        }
        Ok(())
    }

    /// Replaces `z` by about A⁻¹ r, of the nodes that this machine owns, or of the first of them where zeros
    /// follow.
    pub fn apply(&mut self, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        match (self.in_use, &mut self.multigrid) {
            (InUse::Nothing | InUse::Blocks, _) | (_, None) => self.blocks.solve(r, z),
            (_, Some(multigrid)) => multigrid.solve(&mut self.division, r, z),
        }
    }

    /// Number of iterations after which a system with this tolerance is restarted with another
    /// preconditioner.
    #[must_use]
    pub fn patience(&self, tolerance: f64) -> usize {
        let digits = -tolerance.log10();
        match self.in_use {
            InUse::Blocks => (digits * BLOCKS).ceil() as usize,
            InUse::Old { for_a_digit } => (2.0 * (digits * for_a_digit + SET_UP)) as usize,
            InUse::Nothing | InUse::Fresh | InUse::Wanted => usize::MAX,
        }
    }

    /// Chooses the preconditioner of the next system by the iterations of the last one; returns true if that
    /// one must be solved again.
    pub fn judge(&mut self, Iteration { iterations, end }: Iteration, tolerance: f64) -> bool {
        let (digits, iterations) = (-tolerance.log10(), iterations as f64);
        let has_failed = matches!(end, End::Limit | End::NotFinite);
        match self.in_use {
            InUse::Blocks if end == End::Limit => {
                self.in_use = InUse::Wanted;
                return true;
            }
            InUse::Fresh if end == End::Converged => {
                self.in_use = InUse::Old { for_a_digit: iterations / digits };
            }
            // A matrix that is not definite gives no information about the next one.
            InUse::Fresh => self.in_use = InUse::Wanted,
            InUse::Old { .. } if has_failed => {
                self.in_use = InUse::Wanted;
                return true;
            }
            InUse::Old { for_a_digit } if iterations > digits * for_a_digit + SET_UP => {
                self.in_use = InUse::Wanted;
            }
            InUse::Nothing | InUse::Blocks | InUse::Old { .. } | InUse::Wanted => {}
        }
        false
    }
}

/// Share of inertia in the diagonal of a matrix, on average over the free nodes: 1 for nodes that move by
/// themselves, 0 for statics.
fn softness(
    diagonals: &[[[f64; 3]; 3]],
    is_free: &[bool],
    inertia: impl Fn(usize) -> f64,
    division: &impl Division,
) -> f64 {
    let free = || (0..diagonals.len()).filter(|&node| is_free[node]);
    let share = |node: usize| {
        let block = diagonals[node];
        3.0 * inertia(node) / (block[0][0] + block[1][1] + block[2][2])
    };
    division.total(free().map(share).sum()) / division.total(free().count() as f64).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::linear::multigrid::Undivided;
    use crate::system::testing::{beam, neo_hookean};
    use crate::system::{Body, LinearError};

    fn after(in_use: InUse, iterations: usize, end: End, tolerance: f64) -> (InUse, bool) {
        let mut preconditioner = Preconditioner { in_use, ..Preconditioner::new(0, Undivided) };
        let again = preconditioner.judge(Iteration { iterations, end }, tolerance);
        (preconditioner.in_use, again)
    }

    #[test]
    fn blocks_are_chosen_where_inertia_counts_and_left_where_they_take_too_long() {
        let diagonals = [[[4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]]; 2];
        let softness = |inertia: f64| softness(&diagonals, &[true, false], |_| inertia, &Undivided);
        assert_eq!((softness(0.0), softness(2.0)), (0.0, 0.5));
        let preconditioner = Preconditioner { in_use: InUse::Blocks, ..Preconditioner::new(0, Undivided) };
        assert_eq!((preconditioner.patience(1e-3), preconditioner.patience(0.5)), (60, 7));
        assert_eq!(after(InUse::Blocks, 30, End::Converged, 1e-3), (InUse::Blocks, false));
        assert_eq!(after(InUse::Blocks, 60, End::Limit, 1e-3), (InUse::Wanted, true));
        assert_eq!(after(InUse::Blocks, 5, End::NegativeCurvature, 1e-3), (InUse::Blocks, false));
    }

    #[test]
    fn slices_of_other_lengths_are_refused() {
        let body = Body::new(&beam(1), neo_hookean(), 1000.0).expect("a body");
        let stiffness = NodalStiffness::of_body(&body).expect("small");
        let take = |nodes: usize, free: usize, x: usize| {
            let mut preconditioner = Preconditioner::new(nodes, Undivided);
            preconditioner.take(&stiffness, &vec![true; free], &body.rest()[..x], |_| 0.0)
        };
        let error = |slice, found, expected| Err(LinearError::Length { slice, found, expected });
        assert_eq!(take(8, 7, 8), error("is_free", 7, 8));
        assert_eq!(take(8, 8, 7), error("x", 7, 8));
        assert_eq!(take(9, 8, 8), error("stiffness", 8, 9));
    }

    #[test]
    fn levels_serve_as_long_as_they_are_worth_it() {
        let old = InUse::Old { for_a_digit: 5.0 };
        assert_eq!(after(InUse::Fresh, 15, End::Converged, 1e-3), (old, false));
        assert_eq!(Preconditioner { in_use: old, ..Preconditioner::new(0, Undivided) }.patience(1e-2), 40);
        assert_eq!(after(old, 19, End::Converged, 1e-2), (old, false));
        assert_eq!(after(old, 25, End::Converged, 1e-2), (InUse::Wanted, false));
        assert_eq!(after(old, 40, End::Limit, 1e-2), (InUse::Wanted, true));
        assert_eq!(after(old, 7, End::NotFinite, 1e-2), (InUse::Wanted, true));
        assert_eq!(after(InUse::Fresh, 9, End::NegativeCurvature, 1e-3), (InUse::Wanted, false));
        // A system that fresh levels cannot solve is not retried.
        assert_eq!(after(InUse::Fresh, 900, End::Limit, 1e-3), (InUse::Wanted, false));
    }
}
