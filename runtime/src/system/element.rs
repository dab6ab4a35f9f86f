//! Linear tetrahedra: from nodal positions to energies, nodal forces and 12×12 stiffnesses.
//!
//! With Ds = [x1−x0, x2−x0, x3−x0] the deformation gradient is F = Ds Dm⁻¹, constant in an element of rest volume v,
//! and x_n (n = 1, 2, 3) moves it by ∂F_ab/∂x_na = (Dm⁻¹)_nb. The energy is v ψ(F), its gradient in x_n is
//! v P Dm⁻ᵀ e_n [SZLSB11 §2: G = P Bm], and node 0 takes minus the sum of the others, because nothing changes when
//! all move alike. **The nodal force is minus that gradient.**
//!
//! Evaluation goes in stages that share one singular value decomposition per element: [`ElementEnergy::evaluate`]
//! decomposes, and gradients and stiffnesses start from what it found. A line search thus pays for one decomposition
//! per trial and the next Newton iteration for none.
//!
//! The filter acts on dP/dF, a 9×9 matrix, and its result is pulled back to the nodes. Clamping the eigenvalues of
//! the 12×12 stiffness instead, as some codes do, gives another matrix on irregular elements; both are semidefinite.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*, 2011.
//!
//! This module knows no sparsity and no time.

#![expect(non_snake_case, reason = "the letters of the paper: F, U, V, P")]

use crate::material::{Blocks, Material};
use crate::mesh::RestShape;
use crate::point::{Filter, Svd, contract, decompose, project, stretches_in_range};
use crate::quotient::pole_floor;

/// A tetrahedron of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Element {
    /// Its nodes.
    pub nodes: [usize; 4],
    /// Its shape at rest.
    pub shape: RestShape,
    /// The number by which the mesh calls it.
    pub tag: usize,
}

impl Element {
    /// F = Ds Dm⁻¹, row by row.
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

/// Second derivatives of an element's energy in its nodal positions, N/m, as 3×3 blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElementStiffness {
    /// ∂²E/∂x_i∂x_j of the node pairs i ≥ j in the order (0,0), (1,0), (1,1), (2,0), …
    pub blocks: [[[f64; 3]; 3]; 10],
}

impl ElementStiffness {
    /// All zero.
    pub const ZERO: Self = Self { blocks: [[[0.0; 3]; 3]; 10] };

    /// The whole matrix; unknown 3i+a is coordinate a of node i.
    #[must_use]
    pub fn to_matrix(&self) -> [[f64; 12]; 12] {
        std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                let (i, a, j, c) = (row / 3, row % 3, column / 3, column % 3);
                if i >= j { self.blocks[pair(i, j)][a][c] } else { self.blocks[pair(j, i)][c][a] }
            })
        })
    }
}

/// Where the block of the nodes i ≥ j is kept.
#[inline(always)]
pub(crate) const fn pair(i: usize, j: usize) -> usize {
    i * (i + 1) / 2 + j
}

/// What an evaluation says of many elements beside its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Survey {
    /// How many lie outside the domain of their energy.
    pub refused: usize,
    /// How many are at a pole of their tangent, which got a bounded value.
    pub bounded: usize,
    /// How many have an infinite or NaN deformation, energy, gradient or stiffness, whichever of these was evaluated.
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

    /// Of one element whose numbers are finite or not.
    fn of_numbers(element: &Element, finite: bool) -> Self {
        Self {
            nonfinite: usize::from(!finite),
            first_offender: (!finite).then_some(element.tag),
            ..Self::NONE
        }
    }

    /// Whether every element has a meaningful energy.
    #[must_use]
    pub fn is_admissible(&self) -> bool {
        self.refused == 0 && self.nonfinite == 0
    }
}

/// A material as elements see it: one dynamic dispatch for each block of elements.
///
/// Implemented for every [`Material`]. All slices of a call have one entry per element of the block.
pub trait ElementEnergy: Send + Sync {
    /// Decomposes F = U diag(λ) Vᵀ and evaluates the energies, J. Entries of refused elements are meaningless.
    fn evaluate(
        &self,
        elements: &[Element],
        positions: &[[f64; 3]],
        points: &mut [Svd<f64>],
        energies: &mut [f64],
    ) -> Survey;

    /// Gradients of the energies in the nodal positions, N: minus the forces. `points` as left by `evaluate`, which has said
    /// what is `refused` and `min_det`.
    fn gradients(&self, elements: &[Element], points: &[Svd<f64>], gradients: &mut [[[f64; 3]; 4]])
    -> Survey;

    /// Gradients, and second derivatives after the filter; as [`ElementEnergy::gradients`].
    fn stiffnesses(
        &self,
        elements: &[Element],
        points: &[Svd<f64>],
        filter: Filter,
        gradients: &mut [[[f64; 3]; 4]],
        stiffnesses: &mut [ElementStiffness],
    ) -> Survey;

    /// ψ11 at rest, Pa: how stiff the material is, and so how large the rounding error of an energy.
    fn rest_stiffness(&self) -> f64;
}

/// The largest twist in an element's stiffness, relative to the rest of its tangent: far above what is ordinary, far below
/// 1/u. The collapsed horse recovers to the same digits with anything from 1e2 to 1e8.
const STIFFEST: f64 = 1e6;

impl<M: Material> ElementEnergy for M {
    fn evaluate(
        &self,
        elements: &[Element],
        positions: &[[f64; 3]],
        points: &mut [Svd<f64>],
        energies: &mut [f64],
    ) -> Survey {
        let mut survey = Survey::NONE;
        for (element, (point, energy)) in elements.iter().zip(points.iter_mut().zip(energies)) {
            let F = element.deformation_gradient(positions);
            *point = decompose(self, &F);
            let stretches = point.stretches;
            let admitted = self.admits(stretches);
            *energy = element.shape.volume * self.energy(stretches);
            let finite = stretches_in_range(stretches) && (!admitted || energy.is_finite());
            survey = survey.and(Survey {
                refused: usize::from(finite && !admitted),
                nonfinite: usize::from(!finite),
                first_offender: (!admitted || !finite).then_some(element.tag),
                min_det: stretches[0] * stretches[1] * stretches[2],
                ..Survey::NONE
            });
        }
        survey
    }

    fn gradients(
        &self,
        elements: &[Element],
        points: &[Svd<f64>],
        gradients: &mut [[[f64; 3]; 4]],
    ) -> Survey {
        let mut survey = Survey::NONE;
        for ((element, point), gradient) in elements.iter().zip(points).zip(gradients) {
            *gradient = nodal_gradient(element, point, self.gradient(point.stretches));
            survey = survey.and(Survey::of_numbers(element, all_finite(gradient)));
        }
        survey
    }

    fn stiffnesses(
        &self,
        elements: &[Element],
        points: &[Svd<f64>],
        filter: Filter,
        gradients: &mut [[[f64; 3]; 4]],
        stiffnesses: &mut [ElementStiffness],
    ) -> Survey {
        let mut survey = Survey::NONE;
        let outputs = gradients.iter_mut().zip(stiffnesses);
        for ((element, point), (gradient, stiffness)) in elements.iter().zip(points).zip(outputs) {
            let blocks = self.blocks(point.stretches);
            *gradient = nodal_gradient(element, point, blocks.gradient);
            let (blocks, filtered) = project(&blocks, filter);
            let (blocks, blunted) = blunt(blocks);
            *stiffness = element_stiffness(element, point, &blocks);
            let [_, second, third] = point.stretches;
            let at_pole = self.has_pole() && second + third < pole_floor(point.stretches);
            // Derivatives leave the range of the numbers before the energy does.
            let finite = all_finite(gradient) && stiffness.blocks.iter().all(all_finite);
            survey = survey.and(Survey {
                filtered: usize::from(filtered),
                bounded: usize::from(at_pole || blunted),
                ..Survey::of_numbers(element, finite)
            });
        }
        survey
    }

    fn rest_stiffness(&self) -> f64 {
        self.blocks([1.0; 3]).hessian[0]
    }
}

/// Without a branch for each entry, so that the compiler may test several at once.
#[inline]
fn all_finite<const ROWS: usize>(rows: &[[f64; 3]; ROWS]) -> bool {
    rows.iter().flatten().fold(true, |all, x| all & x.is_finite())
}

/// Cuts off what a factorisation cannot resolve, and says whether there was anything.
///
/// Where a stress jumps in the restoring sense, as of a rotated linear solid at λ2 + λ3 = 0 with λ(λ1 − 3) > 2μ, the energy
/// has a convex kink: the twist D⁺ is positive and unbounded, no filter touches it, and the factors of a matrix that
/// holds it beside ordinary entries lose all digits of those. A stiffness [`STIFFEST`] times the others is rigid enough.
#[inline]
fn blunt(mut blocks: Blocks<f64>) -> (Blocks<f64>, bool) {
    let scale = blocks.hessian.iter().chain(&blocks.flip).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let limit = STIFFEST * scale;
    let blunted = blocks.twist.iter().any(|&twist| twist > limit);
    // Not `min`, which would turn NaN into a plausible number.
    blocks.twist = blocks.twist.map(|twist| if twist > limit { limit } else { twist });
    (blocks, blunted)
}

/// v P Dm⁻ᵀ with P = U diag(ψ1, ψ2, ψ3) Vᵀ; its column n is the gradient in the position of node n + 1.
#[inline]
fn nodal_gradient(element: &Element, point: &Svd<f64>, principal: [f64; 3]) -> [[f64; 3]; 4] {
    let W = shape_gradients(element, point, element.shape.volume);
    let mut gradient = [[0.0; 3]; 4];
    for a in 0..3 {
        let row: [f64; 3] = std::array::from_fn(|l| point.U[a][l] * principal[l]);
        for n in 0..3 {
            let g = row[0] * W[n][0] + row[1] * W[n][1] + row[2] * W[n][2];
            gradient[n + 1][a] = g;
            gradient[0][a] -= g;
        }
    }
    gradient
}

/// The stiffness from the blocks of the tangent: [`contract`] with √v Dm⁻¹V in place of V, with no 9×12 product.
///
/// Node 0 takes minus the sums over the others, so that a common translation is resisted by rounding alone.
#[inline]
fn element_stiffness(element: &Element, point: &Svd<f64>, blocks: &Blocks<f64>) -> ElementStiffness {
    let W = shape_gradients(element, point, element.shape.volume.sqrt());
    let mut stiffness = ElementStiffness::ZERO;
    contract(&point.U, &W, blocks, |a, c, block| {
        // `block[x][y]` belongs to coordinate a of node x + 1 and coordinate c of node y + 1; for a ≠ c it stands for
        // its mirror image too.
        let rows = block.map(|row| row[0] + row[1] + row[2]);
        let columns: [f64; 3] = std::array::from_fn(|y| block[0][y] + block[1][y] + block[2][y]);
        let all = rows[0] + rows[1] + rows[2];
        let mut put = |i, j, straight, mirrored| {
            stiffness.blocks[pair(i, j)][a][c] = straight;
            stiffness.blocks[pair(i, j)][c][a] = mirrored;
        };
        put(0, 0, all, all);
        for x in 0..3 {
            // In a block with a = c rows and columns are the same numbers, added in the same order.
            put(x + 1, 0, -rows[x], -columns[x]);
            for y in 0..=x {
                put(x + 1, y + 1, block[x][y], block[y][x]);
            }
        }
    });
    stiffness
}

/// Row n is the gradient of the barycentric coordinate of node n + 1, seen from the principal frame at rest, times `factor`.
#[inline]
fn shape_gradients(element: &Element, point: &Svd<f64>, factor: f64) -> [[f64; 3]; 3] {
    let V = &point.V;
    element
        .shape
        .inverse
        .map(|row| std::array::from_fn(|l| factor * (row[0] * V[0][l] + row[1] * V[1][l] + row[2] * V[2][l])))
}

#[cfg(test)]
mod tests;
