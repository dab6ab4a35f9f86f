//! Linear tetrahedra: from nodal positions to energies, nodal forces and 12×12 stiffnesses.
//!
//! With Ds = [x1−x0, x2−x0, x3−x0] the deformation gradient is F = Ds Dm⁻¹, constant in an element of rest
//! volume v, and x_n (n = 1, 2, 3) moves it by ∂F_ab/∂x_na = (Dm⁻¹)_nb. The energy is v ψ(F), its gradient in
//! x_n is v P Dm⁻ᵀ e_n [SZLSB11 §2: G = P Bm], and node 0 takes minus the sum of the others, because nothing
//! changes when all move alike. **The nodal force is minus that gradient.**
//!
//! Elements are evaluated in groups of one material, a tile of a batch each ([`crate::batch`]), in stages
//! that share one singular value decomposition per element: the energy decomposes, and gradients and
//! stiffnesses start from what it found. A line search thus pays for one decomposition per trial and the next
//! Newton iteration for none.
//!
//! The filter acts on dP/dF, a 9×9 matrix, and its result is pulled back to the nodes. Clamping the
//! eigenvalues of the 12×12 stiffness instead, as some codes do, gives another matrix on irregular elements;
//! both are semidefinite.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.
//!
//! This module knows no sparsity and no time.

#![expect(non_snake_case, reason = "the letters of the paper: Ds, B")]

use crate::batch::Energy;
use crate::batch::element::{ElementTile, Marks, TILE};
use crate::batch::operator::StiffnessFactors;
use crate::lanes::Backend;
use crate::mesh::RestShape;
use crate::point::{Filter, stretches_in_range};

/// Linear tetrahedron of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tetrahedron {
    /// Indices of its nodes.
    pub nodes: [usize; 4],
    /// Shape at rest.
    pub shape: RestShape,
    /// Tag in the mesh: [`TetMesh::tag`](crate::mesh::TetMesh::tag).
    pub tag: usize,
}

impl Tetrahedron {
    /// Deformation gradient F = Ds Dm⁻¹, as its rows.
    #[inline]
    #[must_use]
    pub fn deformation_gradient(&self, positions: &[[f64; 3]]) -> [[f64; 3]; 3] {
        let [x0, x1, x2, x3] = self.nodes.map(|node| positions[node]);
        let B = &self.shape.inverse;
        std::array::from_fn(|a| {
            let Ds = [x1[a] - x0[a], x2[a] - x0[a], x3[a] - x0[a]];
            std::array::from_fn(|b| Ds[0] * B[0][b] + Ds[1] * B[1][b] + Ds[2] * B[2][b])
        })
    }
}

/// Second derivatives of an element's energy in its nodal positions, N/m: ∂²E/∂x_i∂x_j of the node pairs i ≥
/// j in the order (0,0), (1,0), (1,1), (2,0), …
pub(crate) type Stiffness = [[[f64; 3]; 3]; 10];

/// Index of the block of the nodes i ≥ j.
#[inline(always)]
pub(crate) const fn pair(i: usize, j: usize) -> usize {
    i * (i + 1) / 2 + j
}

/// What an evaluation says of many elements beside its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Survey {
    /// How many lie outside the domain of their energy.
    pub refused: usize,
    /// How many are at a pole of their tangent, which got a bounded value.
    pub bounded: usize,
    /// How many have an infinite or NaN deformation, energy, gradient or stiffness, whichever of these was
    /// evaluated.
    pub nonfinite: usize,
    /// How many tangents the filter changed.
    pub filtered: usize,
    /// Tag of the first refused or nonfinite one.
    pub first_offender: Option<usize>,
    /// Smallest det F; +∞ of none.
    pub min_det: f64,
}

impl Survey {
    /// Of no elements.
    pub const NONE: Self = Self {
        refused: 0,
        bounded: 0,
        nonfinite: 0,
        filtered: 0,
        first_offender: None,
        min_det: f64::INFINITY,
    };

    /// Of these elements and those that follow them.
    #[must_use]
    pub fn and(self, next: Self) -> Self {
        Self {
            refused: self.refused + next.refused,
            bounded: self.bounded + next.bounded,
            nonfinite: self.nonfinite + next.nonfinite,
            filtered: self.filtered + next.filtered,
            first_offender: self.first_offender.or(next.first_offender),
            min_det: self.min_det.min(next.min_det),
        }
    }

    /// Of the derivatives of a tile's elements.
    fn of_marks(marks: &Marks, elements: &[Tetrahedron]) -> Self {
        let nonfinite = marks.nonfinite & !marks.refused;
        let count = |bits: u64| bits.count_ones() as usize;
        Self {
            bounded: count(marks.bounded),
            nonfinite: count(nonfinite),
            filtered: count(marks.filtered),
            first_offender: set(nonfinite, elements).next().map(|(_, element)| element.tag),
            ..Self::NONE
        }
    }

    /// Whether every element has a meaningful energy.
    #[must_use]
    pub fn is_admissible(&self) -> bool {
        self.refused == 0 && self.nonfinite == 0
    }
}

/// Elements of one material, evaluated together, with the results of the last evaluation.
#[derive(Clone, Debug)]
pub(crate) struct ElementGroup {
    tile: ElementTile,
    pub(crate) energies: [f64; TILE],
    pub(crate) gradients: [[[f64; 3]; 4]; TILE],
}

impl ElementGroup {
    pub(crate) fn new(elements: &[Tetrahedron]) -> Self {
        Self {
            tile: ElementTile::new(Backend::best(), elements.iter().map(|element| element.shape)),
            energies: [0.0; TILE],
            gradients: [[[0.0; 3]; 4]; TILE],
        }
    }

    pub(crate) fn stretches(&self, lane: usize) -> [f64; 3] {
        self.tile.stretches(lane)
    }

    /// Evaluates the energies, J. Those of refused elements are meaningless.
    pub(crate) fn evaluate(
        &mut self,
        material: &dyn Energy<f64>,
        elements: &[Tetrahedron],
        positions: &[[f64; 3]],
    ) -> Survey {
        let corners = elements.iter().map(|element| element.nodes.map(|node| positions[node]));
        let verdict = self.tile.evaluate(material, corners, &mut self.energies);
        let mut survey = Survey::NONE;
        for lane in 0..elements.len() {
            let [l1, l2, l3] = self.tile.stretches(lane);
            survey.min_det = survey.min_det.min(l1 * l2 * l3);
        }
        for (lane, element) in set(verdict.refused | verdict.nonfinite, elements) {
            let admitted = verdict.refused >> lane & 1 == 0;
            let in_range = stretches_in_range(self.tile.stretches(lane));
            let finite = in_range && (!admitted || self.energies[lane].is_finite());
            survey = survey.and(Survey {
                refused: usize::from(finite && !admitted),
                nonfinite: usize::from(!finite),
                first_offender: (!admitted || !finite).then_some(element.tag),
                ..Survey::NONE
            });
        }
        survey
    }

    /// Evaluates the gradients of the energies evaluated last in the nodal positions, N: minus the forces.
    /// Their survey leaves out `refused` and `min_det`, which that of the energies has.
    pub(crate) fn evaluate_gradients(
        &mut self,
        material: &dyn Energy<f64>,
        elements: &[Tetrahedron],
    ) -> Survey {
        let gradients = self.gradients[..elements.len()].as_flattened_mut().as_flattened_mut();
        Survey::of_marks(&self.tile.gradients(material, gradients), elements)
    }

    /// Evaluates gradients, and second derivatives after the filter.
    pub(crate) fn evaluate_stiffnesses(
        &mut self,
        material: &dyn Energy<f64>,
        elements: &[Tetrahedron],
        filter: Filter,
        stiffnesses: &mut [Stiffness],
    ) -> Survey {
        let gradients = self.gradients[..elements.len()].as_flattened_mut().as_flattened_mut();
        let stiffnesses = stiffnesses[..elements.len()].as_flattened_mut();
        let stiffnesses = stiffnesses.as_flattened_mut().as_flattened_mut();
        Survey::of_marks(&self.tile.stiffnesses(material, filter, gradients, stiffnesses), elements)
    }

    /// Evaluates gradients, and second derivatives after the filter, as factors.
    pub(crate) fn evaluate_factors(
        &mut self,
        material: &dyn Energy<f64>,
        elements: &[Tetrahedron],
        filter: Filter,
        factors: &mut StiffnessFactors,
    ) -> Survey {
        let gradients = self.gradients[..elements.len()].as_flattened_mut().as_flattened_mut();
        Survey::of_marks(&self.tile.factored_stiffnesses(material, filter, gradients, factors), elements)
    }
}

/// The elements of a tile whose bit is set, with their lanes.
fn set(bits: u64, elements: &[Tetrahedron]) -> impl Iterator<Item = (usize, &Tetrahedron)> {
    elements.iter().enumerate().filter(move |(lane, _)| bits >> lane & 1 == 1)
}

#[cfg(test)]
pub(crate) mod tests;
