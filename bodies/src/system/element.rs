//! Linear tetrahedra: from nodal positions to energies, nodal forces and 12×12 stiffnesses.
//!
//! With Ds = [x1−x0, x2−x0, x3−x0] the deformation gradient is F = Ds Dm⁻¹, constant in an element of rest
//! volume v, and x_n (n = 1, 2, 3) moves it by ∂F_ab/∂x_na = (Dm⁻¹)_nb. The energy is v ψ(F), its gradient in
//! x_n is v P Dm⁻ᵀ e_n [SZLSB11 §2: G = P Bm], and node 0 takes minus the sum of the others, because nothing
//! changes when all move alike. **The nodal force is minus that gradient.**
//!
//! Elements are evaluated in groups of one material, a tile of a batch each ([`piola::batch`]), in stages
//! that share at most one singular value decomposition per element: the energy decomposes, and gradients and
//! stiffnesses start from its result. A line search thus pays for one decomposition per trial and the next
//! Newton iteration for none. Energies of I1, I2 and J alone need it for filtered stiffnesses only.
//!
//! The filter acts on dP/dF, a 9×9 matrix, and its result is pulled back to the nodes. Clamping the
//! eigenvalues of the 12×12 stiffness instead, as some codes do, gives another matrix on irregular elements;
//! both are semidefinite.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.
//!
//! This module is independent of sparsity and time.

#![expect(non_snake_case, reason = "the letters of the paper: Ds, B")]

use std::ops::Range;

use piola::batch::TileMaterial;
use piola::batch::element::{Elements, TILE, survey};
use piola::point::{Filter, Matrix3};
use piola::{Status, Survey};

use crate::mesh::RestShape;

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
    /// Deformation gradient F = Ds Dm⁻¹, as its rows; `positions` holds the position of each node of the
    /// mesh.
    ///
    /// # Panics
    /// If there is no position of one of its nodes.
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
pub(crate) type StiffnessBlocks = [[[f64; 3]; 3]; 10];

/// Index of the block of the nodes i ≥ j.
#[inline(always)]
pub(crate) const fn pair(i: usize, j: usize) -> usize {
    i * (i + 1) / 2 + j
}

/// Statuses of evaluated elements, and their smallest det F.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Evaluated {
    /// Counts over elements in the order of [`Body::elements`](super::Body::elements).
    pub(crate) survey: Survey,
    /// Smallest det F; +∞ without elements.
    pub(crate) min_det: f64,
}

impl Evaluated {
    pub(crate) const NONE: Self = Self {
        survey: Survey { refused: 0, bounded: 0, nonfinite: 0, filtered: 0, first: None },
        min_det: f64::INFINITY,
    };
}

/// Elements of one material, evaluated together, with the results of the last evaluation.
#[derive(Clone, Debug)]
pub(crate) struct ElementGroup {
    elements: Elements,
    /// Indices among the elements of the body.
    pub(crate) range: Range<usize>,
    pub(crate) energies: [f64; TILE],
    /// Energies at the positions before.
    pub(crate) base: [f64; TILE],
    pub(crate) gradients: [[[f64; 3]; 4]; TILE],
    /// Survey of the last evaluation; the smallest det F is that of the last energies.
    pub(crate) evaluated: Evaluated,
}

impl ElementGroup {
    /// Elements of which the first is number `start` of the material's, and number `first` of the body's.
    pub(crate) fn new(start: usize, first: usize, elements: &[Tetrahedron]) -> Self {
        Self {
            elements: Elements::new(start, elements.iter().map(|element| element.shape.components())),
            range: first..first + elements.len(),
            energies: [0.0; TILE],
            base: [0.0; TILE],
            gradients: [[[0.0; 3]; 4]; TILE],
            evaluated: Evaluated::NONE,
        }
    }

    /// F of an element, as evaluated last.
    pub(crate) fn deformation_gradient(&self, lane: usize) -> Matrix3<f64> {
        self.elements.deformation_gradient(lane)
    }

    /// Evaluates the energies, J, which are meaningless for refused elements.
    pub(crate) fn evaluate(
        &mut self,
        material: &dyn TileMaterial<f64>,
        elements: &[Tetrahedron],
        positions: &[[f64; 3]],
    ) {
        let corners = elements.iter().map(|element| element.nodes.map(|node| positions[node]));
        let mut status = self.elements.evaluate(material, corners, &mut self.energies);
        let mut min_det = f64::INFINITY;
        for lane in 0..elements.len() {
            let F = self.elements.deformation_gradient(lane);
            min_det = min_det.min(determinant(&F));
            // The energy of a refused element need not be finite.
            let is_refused = status.refused >> lane & 1 == 1;
            if is_refused && self.elements.is_in_range(lane) {
                status.nonfinite &= !(1 << lane);
            }
        }
        status.refused &= !status.nonfinite;
        self.evaluated = Evaluated { survey: survey(status, self.range.start), min_det };
    }

    /// Gradients of the energies evaluated last in the nodal positions, N: minus the forces.
    pub(crate) fn evaluate_gradients(&mut self, material: &dyn TileMaterial<f64>, elements: &[Tetrahedron]) {
        let gradients = self.gradients[..elements.len()].as_flattened_mut().as_flattened_mut();
        let status = self.elements.gradients(material, gradients);
        self.evaluated.survey = survey(of_derivatives(status), self.range.start);
    }

    /// Gradients, and second derivatives after the filter.
    pub(crate) fn evaluate_stiffnesses(
        &mut self,
        material: &dyn TileMaterial<f64>,
        elements: &[Tetrahedron],
        filter: Filter,
        stiffnesses: &mut [StiffnessBlocks],
    ) {
        let gradients = self.gradients[..elements.len()].as_flattened_mut().as_flattened_mut();
        let stiffnesses = stiffnesses[..elements.len()].as_flattened_mut();
        let stiffnesses = stiffnesses.as_flattened_mut().as_flattened_mut();
        let status = self.elements.stiffnesses(material, filter, gradients, stiffnesses);
        self.evaluated.survey = survey(of_derivatives(status), self.range.start);
    }
}

pub(super) fn determinant([[a, b, c], [d, e, f], [g, h, i]]: &Matrix3<f64>) -> f64 {
    a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
}

/// Status of derivatives alone: the evaluation of the energies has reported refused elements before.
fn of_derivatives(status: Status<u64>) -> Status<u64> {
    Status { refused: 0, nonfinite: status.nonfinite & !status.refused, ..status }
}

#[cfg(test)]
pub(crate) mod tests;
