//! Terms of the energy in addition to that of deformation: springs, contact, and anything else that acts on
//! nodes.
//!
//! A step minimises the sum of inertia, the energy of deformation and all terms together, so that contact
//! obeys the same line search and the same refusal of a trial as an energy that ends at J = 0.

use piola::lanes::Real;

use crate::system::LowerTriangle;
use crate::system::linear::symmetric_blocks::SymmetricBlocks;

use super::spring::Spring;

mod check;

pub(super) use check::contradiction;
pub use check::{TermViolation, check_term};

/// Potential energy of the nodal positions, which a [`Simulation`](super::Simulation) adds to that of
/// deformation: see [`Simulation::set_terms`](super::Simulation::set_terms).
///
/// Its functions receive the position of every node, m, and must depend on these alone: the same positions
/// give the same bits. [`check_term`] compares its derivatives with differences.
///
/// ```
/// use std::sync::Arc;
///
/// use piola_bodies::mesh::tetrahedral_box;
/// use piola_bodies::step::{NodeBlocks, Simulation, SimulationSettings, Term, check_term};
/// use piola_bodies::system::{Body, Pins};
///
/// /// A plane y = 0 that pushes back with ½ k y² where a node is below it.
/// struct Ground {
///     /// N/m.
///     stiffness: f64,
/// }
///
/// impl Term for Ground {
///     fn energy(&self, positions: &[[f64; 3]]) -> Option<f64> {
///         Some(positions.iter().map(|x| 0.5 * self.stiffness * x[1].min(0.0).powi(2)).sum())
///     }
///
///     fn add_gradient(&self, positions: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
///         for (x, g) in positions.iter().zip(gradient) {
///             g[1] += self.stiffness * x[1].min(0.0);
///         }
///     }
///
///     fn add_second_derivatives(&self, positions: &[[f64; 3]], blocks: &mut NodeBlocks) {
///         for (node, _) in positions.iter().enumerate().filter(|(_, x)| x[1] < 0.0) {
///             blocks.add(node, node, [[0.0; 3], [0.0, self.stiffness, 0.0], [0.0; 3]]);
///         }
///     }
/// }
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let body = Body::new(&tetrahedral_box([1, 1, 1], [0.1; 3])?, Rubber::new(1e5, 4e5)?, 1000.0)?;
/// let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], ..Default::default() };
/// let mut cube = Simulation::new(body, &Pins::none(), settings)?;
/// let ground = Ground { stiffness: 1e4 };
/// check_term(&ground, &[[0.0, -0.01, 0.0], [0.1, 0.01, 0.0]], false)?;
/// cube.set_terms(vec![Arc::new(ground)]);
/// let report = cube.step(0.01)?;
/// assert!(report.energies.terms > 0.0 && cube.positions()[0][1] > -9.81 * 1e-4);
/// # Ok(())
/// # }
/// ```
pub trait Term: Send + Sync {
    /// Energy, J; `None` outside the domain of the term, which no step will enter.
    fn energy(&self, positions: &[[f64; 3]]) -> Option<f64>;

    /// Adds the gradient of the energy, N, at each node.
    fn add_gradient(&self, positions: &[[f64; 3]], gradient: &mut [[f64; 3]]);

    /// Adds the second derivatives of the energy, N/m.
    ///
    /// Newton's method converges if they are positive semidefinite, so that negative eigenvalues are best
    /// left out.
    fn add_second_derivatives(&self, positions: &[[f64; 3]], blocks: &mut NodeBlocks);

    /// Largest share of a displacement that a line search may try first, above 0, or else the step fails: all
    /// of it by default.
    ///
    /// For a barrier that a long step could jump over, to a point of finite energy, return a share that stops
    /// before it.
    fn longest_step(&self, positions: &[[f64; 3]], displacement: &[[f64; 3]]) -> f64 {
        let _ = (positions, displacement);
        1.0
    }

    /// Change of the energy between positions; `None` if the second ones are outside the domain.
    ///
    /// By default the difference of two energies, each with an assumed error of ten roundings. A term whose
    /// energy is large compared with its changes should override it.
    fn change(&self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Option<EnergyChange> {
        let (from, to) = (self.energy(from)?, self.energy(to)?);
        let noise = 10.0 * f64::UNIT_ROUNDOFF * (from.abs() + to.abs());
        Some(EnergyChange { difference: to - from, noise })
    }
}

/// Difference of energies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyChange {
    /// The later energy minus the earlier one, J.
    pub difference: f64,
    /// Bound for the rounding error of the difference, J.
    pub noise: f64,
}

/// Second derivatives of the terms of an energy: 3×3 blocks of pairs of nodes, N/m.
#[derive(Clone, Debug, Default)]
pub struct NodeBlocks {
    nodes: usize,
    /// Row, column and entries ∂²E/∂x_row∂x_column.
    blocks: Vec<(usize, usize, [[f64; 3]; 3])>,
    /// First node that was named but does not exist.
    missing: Option<usize>,
}

impl NodeBlocks {
    /// Adds the block ∂²E/∂x_row∂x_column and, for two different nodes, its transpose as the block of
    /// `column` and `row`: add each pair of nodes once.
    ///
    /// The two nodes need not share an element. A pair that neither an element nor an earlier step has joined
    /// costs a new symbolic analysis.
    pub fn add(&mut self, row: usize, column: usize, entries: [[f64; 3]; 3]) {
        if let Some(&node) = [row, column].iter().find(|&&node| node >= self.nodes) {
            self.missing = self.missing.or(Some(node));
            return;
        }
        self.blocks.push((row, column, entries));
    }

    /// Removes all blocks, and prepares for a body of `nodes` nodes.
    pub(super) fn begin(&mut self, nodes: usize) {
        self.blocks.clear();
        (self.nodes, self.missing) = (nodes, None);
    }

    /// First node that was named but does not exist.
    pub(super) fn missing(&self) -> Option<usize> {
        self.missing
    }

    pub(super) fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        self.blocks.iter().map(|&(row, column, _)| [row, column]).filter(|[row, column]| row != column)
    }

    /// Adds the product with a displacement of each node.
    pub(super) fn add_product(&self, d: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for &(row, column, entries) in &self.blocks {
            for a in 0..3 {
                for c in 0..3 {
                    total[row][a] += entries[a][c] * d[column][c];
                    if row != column {
                        total[column][c] += entries[a][c] * d[row][a];
                    }
                }
            }
        }
    }

    /// Adds the blocks of free nodes to a matrix that has all their pairs.
    pub(super) fn add_to_triangle(&self, matrix: &mut LowerTriangle) {
        for (row, column, entries) in &self.blocks {
            matrix.add_block(*row, *column, entries);
        }
    }

    /// Adds all blocks to a matrix of a row and a column for each node that has all their pairs.
    pub(super) fn add_to_blocks(&self, matrix: &mut SymmetricBlocks<f64, 3>) {
        let pattern = matrix.pattern().clone();
        for (row, column, entries) in &self.blocks {
            let Some((block, is_transposed)) = pattern.block(*row, *column) else { continue };
            let block = &mut matrix.blocks_mut()[block];
            for r in 0..3 {
                for c in 0..3 {
                    block[r][c] += if is_transposed { entries[c][r] } else { entries[r][c] };
                }
            }
        }
    }
}

/// Springs as one term.
impl Term for Vec<Spring> {
    fn energy(&self, positions: &[[f64; 3]]) -> Option<f64> {
        Some(self.iter().map(|spring| spring.energy(positions)).sum())
    }

    fn add_gradient(&self, positions: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        for spring in self {
            let point = spring.anchor.position(positions);
            for (node, weight) in spring.weights() {
                for c in 0..3 {
                    gradient[node][c] += spring.stiffness * weight * (point[c] - spring.target[c]);
                }
            }
        }
    }

    fn add_second_derivatives(&self, _: &[[f64; 3]], blocks: &mut NodeBlocks) {
        for spring in self {
            for (i, (row, row_weight)) in spring.weights().enumerate() {
                for (j, (column, column_weight)) in spring.weights().take(i + 1).enumerate() {
                    // An anchor may name a node twice: then this block is its own transpose.
                    let twice = if i != j && row == column { 2.0 } else { 1.0 };
                    let k = twice * spring.stiffness * row_weight * column_weight;
                    blocks.add(row, column, [[k, 0.0, 0.0], [0.0, k, 0.0], [0.0, 0.0, k]]);
                }
            }
        }
    }

    /// Computes ½ k (|q − t|² − |p − t|²) as k (q − p)·(½(p + q) − t), without a difference of energies.
    fn change(&self, from: &[[f64; 3]], to: &[[f64; 3]]) -> Option<EnergyChange> {
        let mut change = EnergyChange::default();
        for spring in self {
            let Spring { anchor, target, stiffness } = spring;
            let (p, q) = (anchor.position(from), anchor.position(to));
            for c in 0..3 {
                let moved: f64 = spring.weights().map(|(node, w)| w * (to[node][c] - from[node][c])).sum();
                change.difference += stiffness * moved * (0.5 * (p[c] + q[c]) - target[c]);
                change.noise += stiffness * moved.abs() * (p[c].abs() + q[c].abs() + target[c].abs());
            }
        }
        change.noise *= 8.0 * f64::UNIT_ROUNDOFF;
        Some(change)
    }
}

#[cfg(all(test, feature = "faer"))]
mod tests;
