//! Classification of a body at rest, in its rest shape or elsewhere.
//!
//! A body may stay in another state than its rest shape: in a minimum of its energy elsewhere, at a saddle
//! without a disturbance, if an energy does not change by reflection, or at a kink of an energy, where λ2 +
//! λ3 = 0 and no force vanishes. These differ in the forces and in the smallest eigenvalue of the stiffness
//! K, unfiltered, with springs and other terms,
//!
//! ```text
//! K v = ω² M v,   M the lumped masses,
//! ```
//!
//! among the motions of free nodes that are not rigid ones. It comes from a factor of K + σM, σ the first of
//! growing shifts for which that is positive definite, by [Lanczos' method](crate::system::linear): the
//! smallest eigenvalue of K is the largest of (K + σM)⁻¹M, the better separated from the others the smaller σ
//! is.

use crate::NoSuchNode;
use crate::point::Filter;
use crate::system::assemble::Elastic;
use crate::system::linear::lanczos::{add, dot, largest, norm};
use crate::system::{Body, Cholesky, LinearError, LowerTriangle, NodalStiffness, Pins, Tetrahedron};

use super::integrator::Stage;
use super::minimisation::demand_admissible;
use super::newton::NewtonError;
use super::objective::{Objective, Quadratic};
use super::simulation::Simulation;
use super::term::NodeBlocks;

mod rigid;

/// Residual, as a share of the largest force, below which forces are in balance.
const BALANCE: f64 = 1e-6;

/// Largest force, as a share of [`Equilibrium::unit_force`], below which a body is free of stress.
const NO_STRESS: f64 = 1e-9;

/// The first shift σ, as a share of the largest entry of M⁻¹K on the diagonal, and the factor from one shift
/// to the next.
const FIRST_SHIFT: f64 = 1e-6;
const NEXT_SHIFT: f64 = 10.0;

/// The last shift, as such a share: it surely outweighs a row of 3·4 entries for each of some dozens of
/// neighbours.
const LAST_SHIFT: f64 = 1e3;

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
    /// The smallest eigenvalue of the stiffness beyond the rigid motions; `None` if nothing else can move.
    pub smallest_eigenvalue: Option<Eigenvalue>,
    /// Number of rigid motions that pins and springs leave: six for a free body.
    pub rigid_motions: usize,
    /// Number of inverted elements.
    pub inverted: usize,
    /// The smallest λ2 + λ3 of an element: 0 if it is flattened to a line or reflected, where energies of λ
    /// have kinks.
    pub smallest_sum: f64,
}

/// Eigenvalue ω², 1/s², with a bound for its error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Eigenvalue {
    /// Computed value.
    pub value: f64,
    /// Largest distance from an exact eigenvalue: the norm of the residual of its vector, rounding included.
    pub error: f64,
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
    /// Undecided: the smallest eigenvalue is zero within its error.
    Undecided,
}

impl Equilibrium {
    /// Analyses a body at its current positions, regardless of its velocities.
    ///
    /// Needs memory for the stiffness, its factor and at most a hundred vectors, and takes about as long as
    /// ten to a hundred Newton iterations.
    ///
    /// # Errors
    /// [`NewtonError::Inadmissible`] for an element outside the domain of its material,
    /// [`NewtonError::ElementNotFinite`], [`NewtonError::NotFinite`],
    /// [`NewtonError::NotPositive`] if no shift makes the stiffness definite,
    /// [`NewtonError::Linear`].
    pub fn of(simulation: &Simulation) -> Result<Self, NewtonError> {
        let (body, positions) = (simulation.body(), simulation.positions());
        let mut elastic = Elastic::new(body);
        let survey = elastic.evaluate(body, positions);
        demand_admissible(&survey, body, &elastic)?;
        let stage = Stage::at_rest(positions.len());
        let quadratic = Quadratic {
            masses: body.masses(),
            stage: &stage,
            damping: 0.0,
            regularisation: 0.0,
            guard: 0.0,
            gravity: simulation.settings().gravity,
            forces: simulation.forces(),
        };
        let mut blocks = NodeBlocks::default();
        let terms = simulation.all_terms();
        terms.linearise(positions, &mut blocks);
        if let Some(node) = blocks.missing() {
            return Err(NoSuchNode { element: None, node, nodes: positions.len() }.into());
        }
        let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
        let mut stiffness = NodalStiffness::new(body, &pairs)?;
        let tangents = stiffness.linearise(body, &mut elastic, Filter::None, |_, _| {});
        demand_admissible(&tangents, body, &elastic)?;
        let objective =
            Objective { body, elastic: &mut elastic, quadratic, terms, blocks: &mut blocks, viscosity: None };
        let mut gradient = vec![[0.0; 3]; positions.len()];
        objective.gradient(positions, &mut gradient);

        let pins = Pins::at(simulation.pinned().iter().copied());
        let mut matrix = LowerTriangle::new(&stiffness, &pins)?;
        matrix.fill(&stiffness, |_| 0.0)?;
        blocks.add_to_triangle(&mut matrix);
        let rigid = rigid::motions(simulation, matrix.free_nodes())?;
        let smallest_eigenvalue = Spectrum::new(body.masses(), matrix, &rigid)?.smallest()?;

        let square = |x: &[f64; 3]| x.iter().map(|c| c * c).sum::<f64>();
        let is_free = |node: &usize| simulation.pinned().binary_search(node).is_err();
        let free = (0..positions.len()).filter(is_free);
        let forces = elastic.gradients().flatten().map(square);
        Ok(Self {
            residual: free.map(|node| square(&gradient[node])).sum::<f64>().sqrt(),
            largest_force: forces.fold(0.0, f64::max).sqrt(),
            unit_force: unit_force(body),
            smallest_eigenvalue,
            rigid_motions: rigid.len(),
            inverted: elastic.stretches().filter(|stretches| stretches[2] < 0.0).count(),
            smallest_sum: elastic.stretches().map(|[_, l2, l3]| l2 + l3).fold(f64::INFINITY, f64::min),
        })
    }

    /// True if no element bears stress above rounding.
    #[must_use]
    pub fn is_stress_free(&self) -> bool {
        self.largest_force <= NO_STRESS * self.unit_force
    }

    /// Classifies the equilibrium by the residual and the smallest eigenvalue.
    #[must_use]
    pub fn stability(&self) -> Stability {
        if self.residual > BALANCE * self.largest_force && !self.is_stress_free() {
            return Stability::Unbalanced;
        }
        match self.smallest_eigenvalue {
            Some(Eigenvalue { value, error }) if value < -error => Stability::Saddle,
            Some(Eigenvalue { value, error }) if value <= error => Stability::Undecided,
            _ => Stability::Stable,
        }
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

/// The stiffness over the unknowns, and the rigid motions that are left out of it.
struct Spectrum<'a> {
    /// Stiffness K of the unknowns.
    stiffness: LowerTriangle,
    /// Mass of each unknown.
    masses: Vec<f64>,
    rigid: &'a [Vec<f64>],
}

impl<'a> Spectrum<'a> {
    fn new(masses: &[f64], stiffness: LowerTriangle, rigid: &'a [Vec<f64>]) -> Result<Self, NewtonError> {
        if !stiffness.values().iter().all(|entry| entry.is_finite()) {
            return Err(NewtonError::NotFinite);
        }
        let masses = stiffness.free_nodes().iter().flat_map(|&node| [masses[node]; 3]).collect();
        Ok(Self { stiffness, masses, rigid })
    }

    fn smallest(&self) -> Result<Option<Eigenvalue>, NewtonError> {
        let mut cholesky = Cholesky::of_pattern(self.stiffness.entries())?;
        self.factor(&mut cholesky)?;
        let vector = largest(&self.masses, self.rigid, |x, product| {
            product.iter_mut().zip(x.iter().zip(&self.masses)).for_each(|(product, (x, m))| *product = m * x);
            cholesky.substitute(product);
        })?;
        let eigenvalue = vector.map(|vector| self.quotient(&vector)).transpose()?;
        match eigenvalue.is_none_or(|Eigenvalue { value, error }| value.is_finite() && error.is_finite()) {
            true => Ok(eigenvalue),
            false => Err(NewtonError::NotFinite),
        }
    }

    /// Factors K + σM for the first σ for which it is positive definite.
    fn factor(&self, cholesky: &mut Cholesky) -> Result<(), NewtonError> {
        let ratios = self.stiffness.diagonal().zip(&self.masses).map(|(entry, mass)| entry.abs() / mass);
        let scale = ratios.fold(0.0, f64::max);
        // A body without stiffness needs some positive shift.
        let scale = if scale > 0.0 { scale } else { 1.0 };
        let mut shift = FIRST_SHIFT;
        loop {
            let mut shifted = self.stiffness.values().to_vec();
            for (&start, mass) in self.stiffness.column_starts().iter().zip(&self.masses) {
                shifted[start] += shift * scale * mass;
            }
            match cholesky.factor(&shifted) {
                Ok(()) => return Ok(()),
                Err(LinearError::NotPositive { .. }) if shift < LAST_SHIFT => shift *= NEXT_SHIFT,
                Err(LinearError::NotPositive { column }) => {
                    return Err(NewtonError::NotPositive {
                        node: self.stiffness.free_nodes()[column / 3],
                        shift,
                    });
                }
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Rayleigh quotient ω² = vᵀKv/vᵀMv, from which some eigenvalue differs by no more than the norm of M⁻¹Kv
    /// − ω²v, for v of norm 1.
    fn quotient(&self, vector: &[f64]) -> Result<Eigenvalue, NewtonError> {
        let mut product = vec![0.0; vector.len()];
        self.stiffness.multiply(vector, &mut product)?;
        product.iter_mut().zip(&self.masses).for_each(|(product, m)| *product /= m);
        let length = dot(&self.masses, vector, vector);
        let value = dot(&self.masses, vector, &product) / length;
        add(-value, vector, &mut product);
        Ok(Eigenvalue { value, error: norm(&self.masses, &product) / length.sqrt() })
    }
}

#[cfg(test)]
mod tests;
