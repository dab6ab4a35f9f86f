//! Classification of a body at rest, in its rest shape or elsewhere.
//!
//! A body may stay in another state than its rest shape: in a minimum of its energy elsewhere, at a saddle
//! without a disturbance, if an energy does not change by reflection, or at a kink of an energy, where λ2 +
//! λ3 = 0 and no force vanishes. These differ in the forces and in the signs of the eigenvalues of the
//! stiffness K, unfiltered, with springs and other terms,
//!
//! ```text
//! K v = ω² M v,   M the lumped masses,
//! ```
//!
//! among the motions of free nodes that are not rigid ones. In equilibrium a rigid motion r needs no force, K
//! r = 0, and vᵀK v does not depend on the rigid part of v. Its sign can therefore be judged on any motions
//! of which no rigid one is left: springs hold as many unknowns as there are rigid motions, each where one of
//! them moves it most. The stiffness with these springs is positive definite exactly if all ω² of other
//! motions are positive, and a Cholesky factorisation exists exactly for such a matrix (Sylvester's law of
//! inertia). Factorisations of K ± σM, with a σ above all rounding errors, then separate stable from unstable
//! and from undecided.

use piola::point::Filter;

use crate::system::assemble::Elastic;
use crate::system::linear::multigrid::Undivided;
use crate::system::{Body, Cholesky, LinearError, LowerTriangle, NodalStiffness, Pins, Tetrahedron};

use super::error::NewtonError;
use super::minimisation::demand_admissible;
use super::simulation::Simulation;
use super::term::NodeBlocks;

mod rigid;

/// Residual, as a share of the largest force, below which forces are in balance.
const BALANCE: f64 = 1e-6;

/// Largest force, as a share of [`Equilibrium::unit_force`], below which a body is free of stress.
const NO_STRESS: f64 = 1e-9;

/// The shift σ, as a share of the largest entry of M⁻¹K on the diagonal: eigenvalues below it are not
/// distinguished from zero.
///
/// A factorisation is that of a matrix that differs by some roundings of its entries, with a share of 1e-13
/// for rows of some hundred entries. The springs reduce the eigenvalues of soft motions, by which held points
/// move against the rest of the body; σ leaves them three digits.
const SHIFT: f64 = 1e-12;

/// Residual, stability and inversion of a body at its current positions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Equilibrium {
    /// Norm of the forces on the free nodes, N: all forces of statics together.
    pub residual: f64,
    /// The largest force of an element on one of its nodes, N.
    pub largest_force: f64,
    /// Estimated force of the stiffest element on a face of its size at a strain of one, N.
    pub unit_force: f64,
    /// Balance of forces, and signs of the eigenvalues of the stiffness beyond the rigid motions.
    pub stability: Stability,
    /// Number of rigid motions that pins and springs leave: six for a free body.
    pub rigid_motions: usize,
    /// Number of inverted elements.
    pub inverted: usize,
    /// The smallest λ2 + λ3 of an element: 0 if it is flattened to a line or reflected, where energies of λ
    /// have kinks.
    pub smallest_sum: f64,
}

/// Classification of an [`Equilibrium`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Stability {
    /// Unbalanced forces: the body will move.
    Unbalanced,
    /// Stable: the stiffness is positive on all motions that are not rigid.
    Stable,
    /// Unstable: the stiffness has a negative eigenvalue, though forces are in balance.
    Saddle,
    /// Undecided: the smallest eigenvalue is zero within rounding errors.
    Undecided,
}

impl Equilibrium {
    /// Analyses a body at its current positions, regardless of its velocities.
    ///
    /// Needs memory for the stiffness and its factor, and takes as long as two Newton iterations by
    /// [`LinearSolver::Cholesky`](super::LinearSolver::Cholesky).
    ///
    /// # Errors
    /// [`NewtonError::Inadmissible`] for an element outside the domain of its material,
    /// [`NewtonError::ElementNotFinite`], [`NewtonError::NotFinite`], [`NewtonError::Linear`].
    pub fn of(simulation: &Simulation) -> Result<Self, NewtonError> {
        let (body, positions) = (simulation.body(), simulation.positions());
        let mut elastic = Elastic::new(body);
        let survey = elastic.evaluate(body, positions);
        demand_admissible(&Undivided, &survey, body, &elastic)?;
        let mut blocks = NodeBlocks::default();
        let terms = simulation.all_terms();
        terms.linearise(positions, &mut blocks)?;
        let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
        let mut stiffness = NodalStiffness::new(body, &pairs, false)?;
        let tangents = stiffness.linearise(body, &mut elastic, Filter::None);
        demand_admissible(&Undivided, &tangents, body, &elastic)?;
        let gravity = simulation.settings().gravity;
        let weight = |mass: &f64| gravity.map(|g| 0.0 - mass * g);
        let mut gradient: Vec<[f64; 3]> = body.masses().iter().map(weight).collect();
        for (total, force) in gradient.iter_mut().zip(simulation.forces()) {
            (0..3).for_each(|c| total[c] -= force[c]);
        }
        terms.add_gradient(positions, &mut gradient);
        elastic.add_gradient(body, &mut gradient);

        let pins = Pins::at(simulation.pinned().iter().copied());
        let mut matrix = LowerTriangle::new(&stiffness, &pins)?;
        matrix.fill(&stiffness, |_| 0.0)?;
        blocks.add_to_triangle(&mut matrix);
        let rigid = rigid::motions(simulation, matrix.free_nodes());
        let in_balance = stability(&mut matrix, body.masses(), &rigid)?;

        let square = |x: &[f64; 3]| x.iter().map(|c| c * c).sum::<f64>();
        let is_free = |node: &usize| simulation.pinned().binary_search(node).is_err();
        let free = (0..positions.len()).filter(is_free);
        let forces = elastic.gradients().flatten().map(square);
        let residual = free.map(|node| square(&gradient[node])).sum::<f64>().sqrt();
        let largest_force = forces.fold(0.0, f64::max).sqrt();
        let unit_force = unit_force(body);
        if !(residual.is_finite() && largest_force.is_finite() && unit_force.is_finite()) {
            return Err(NewtonError::NotFinite);
        }
        let mut found = Self {
            residual,
            largest_force,
            unit_force,
            stability: in_balance,
            rigid_motions: rigid.len(),
            inverted: elastic.stretches().filter(|stretches| stretches[2] < 0.0).count(),
            smallest_sum: elastic.stretches().map(|[_, l2, l3]| l2 + l3).fold(f64::INFINITY, f64::min),
        };
        if residual > BALANCE * largest_force && !found.is_stress_free() {
            found.stability = Stability::Unbalanced;
        }
        Ok(found)
    }

    /// True if no element bears stress above rounding.
    #[must_use]
    pub fn is_stress_free(&self) -> bool {
        self.largest_force <= NO_STRESS * self.unit_force
    }
}

fn unit_force(body: &Body) -> f64 {
    let largest = |volume: f64, element: &Tetrahedron| volume.max(element.shape.volume);
    let forces = body.materials().map(|(material, elements)| {
        let volume = body.elements()[elements].iter().fold(0.0, largest);
        material.rest_stiffness().abs() * volume.powf(2.0 / 3.0)
    });
    forces.fold(0.0, f64::max)
}

/// Stability of a body in balance, by the signs of the eigenvalues of its stiffness beyond the rigid motions.
/// Changes the stiffness of the free nodes; `rigid` are motions of these nodes.
fn stability(
    stiffness: &mut LowerTriangle,
    masses: &[f64],
    rigid: &[Vec<f64>],
) -> Result<Stability, NewtonError> {
    if !stiffness.values().iter().all(|entry| entry.is_finite()) {
        return Err(NewtonError::NotFinite);
    }
    let mass = |row: usize, stiffness: &LowerTriangle| masses[stiffness.free_nodes()[row / 3]];
    let ratios = stiffness.diagonal().enumerate().map(|(row, entry)| entry.abs() / mass(row, stiffness));
    let scale = ratios.fold(0.0, f64::max);
    // A body without stiffness has no negative eigenvalue.
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let shift = |node: usize| SHIFT * scale * masses[node];
    if !scale.is_finite() {
        return Err(NewtonError::NotFinite);
    }
    let held = held(rigid);
    stiffness.add_to_diagonal(|row, node| match held.contains(&row) {
        true => shift(node) + scale * masses[node],
        false => shift(node),
    });
    let mut cholesky = Cholesky::new(stiffness.column_starts(), stiffness.row_indices())?;
    let mut is_positive = |stiffness: &LowerTriangle| match cholesky.factor(stiffness.values()) {
        Ok(()) => Ok(true),
        Err(LinearError::NotPositive { .. }) => Ok(false),
        Err(error) => Err(error),
    };
    if !is_positive(stiffness)? {
        return Ok(Stability::Saddle);
    }
    stiffness.add_to_diagonal(|_, node| -2.0 * shift(node));
    Ok(if is_positive(stiffness)? { Stability::Stable } else { Stability::Undecided })
}

/// Unknowns, one for each motion, such that no combination of the motions leaves all of them in place: by
/// elimination with the largest component of each motion as the pivot.
fn held(motions: &[Vec<f64>]) -> Vec<usize> {
    let mut motions = motions.to_vec();
    let mut held = Vec::new();
    for k in 0..motions.len() {
        let size = |motion: &[f64], unknown: usize| motion[unknown].abs();
        let largest = |a: &usize, b: &usize| size(&motions[k], *a).total_cmp(&size(&motions[k], *b));
        let Some(pivot) = (0..motions[k].len()).max_by(largest) else { break };
        held.push(pivot);
        let (before, after) = motions.split_at_mut(k + 1);
        for motion in after {
            let factor = motion[pivot] / before[k][pivot];
            motion.iter_mut().zip(&before[k]).for_each(|(entry, part)| *entry -= factor * part);
        }
    }
    held
}

#[cfg(test)]
mod tests;
