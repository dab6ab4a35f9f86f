//! A gradient of the energy between two states, with which steps keep energy and angular momentum.
//!
//! An integrator that moves a body from x to x' by forces f keeps its energy if (x' − x)·f = Ψ(x) − Ψ(x'),
//! and its angular momentum if ½(x + x') × f adds up to zero. For linear tetrahedra both are conditions on a
//! stress P between the states of an element, with Fm = ½(F + F'):
//!
//! ```text
//! P : (F' − F) = ψ(F') − ψ(F)        P Fmᵀ symmetric
//! ```
//!
//! The second one holds for P = Fm S with a symmetric S. Then P : (F' − F) = S : ΔE with the change of
//! Green's strain, since FᵀF is quadratic in F:
//!
//! ```text
//! ΔE = ½ (F'ᵀF' − FᵀF) = sym(Fmᵀ (F' − F))        S : ΔE = Δψ
//! ```
//!
//! **The mean stress.** Along the straight line between the two strains E(s) = E + s ΔE, the mean of S(E(s))
//! has this property, as ψ depends on E alone. The mean of two points by Gauss, s = ½ ∓ 1/√12, has it up to
//! terms of fourth order in ΔE, relative to S, and what is missing is made up along ΔE \[Gon00\]:
//!
//! ```text
//! S = S̄ + β ΔE        S̄ = ½ (S(E(s1)) + S(E(s2)))        β = (Δψ − S̄ : ΔE)/(ΔE : ΔE)
//! ```
//!
//! **Without cancellation.** Gonzalez takes one point, in the middle; his β is a difference of close energies
//! over the square of a small strain, and has no digits where the motion is slow. By two points β is needed
//! for strains above one in a thousand only: below that the difference is less than the rounding error of the
//! energies, which is what they would be kept to anyway, and β is zero.
//!
//! **The stress at a strain.** F is not needed, any G with GᵀG = I + 2 E will do: the Cholesky factor. The
//! volume never falls below that of the ends, because the cube root of det C is concave.
//!
//! **Inverted elements.** The stress is by strain, and strain does not tell an element from its mirror image.
//! Where an element turns inside out ΔE may be zero though Δψ is not, and no S has S : ΔE = Δψ. So det F must
//! be positive before and after.
//!
//! **The tangent.** With dE' = sym(F'ᵀ dF'),
//!
//! ```text
//! dS = dS̄ + dβ ΔE + β dE'             dS̄ = ½ Σ sk (dS/dE)k : dE'
//! dβ = ((S' − S̄ − 2 β ΔE) : dE' − dS̄ : ΔE)/(ΔE : ΔE)
//! dP = ½ dF' S + Fm dS
//! ```
//!
//! It is not symmetric: strains of the force are taken in the middle and those of the stress at the end.
//!
//! \[Gon00\] Gonzalez, *Exact energy and momentum conserving algorithms for general models in nonlinear
//! elasticity*, 2000.

#![expect(non_snake_case, reason = "F, S, E as in the literature")]

use std::fmt;
use std::ops::Range;

use super::body::Body;
use super::element::Tetrahedron;
use super::response::same;
use crate::batch::{Batch, LengthError};
use crate::point::Matrix3;
use crate::point::measures::{Measure, voigt};
use crate::status::Survey;

/// Gauss points on the line between two strains.
const POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// A gradient of the energy of deformation between two states of a body, for an integrator of one's own that
/// keeps energy and momenta: its product with the displacement is the change of the energy, and its forces
/// and torques about the state in the middle add up to zero. For states that are close it is the gradient
/// there.
///
/// It is used in this order: [`begin`](DiscreteGradient::begin) with the state before, then for each state
/// after that is tried [`evaluate`](DiscreteGradient::evaluate) and
/// [`add_gradient`](DiscreteGradient::add_gradient), and, where its derivative is asked for,
/// [`linearise`](DiscreteGradient::linearise) and [`tangents`](DiscreteGradient::tangents). Memory: 1.3 kB
/// for each element.
///
/// ```
/// use piola::mesh::tetrahedral_box;
/// use piola::system::{Body, DiscreteGradient, ElasticResponse};
///
/// /// Rubber.
/// #[piola::material(domain(J > 0.0))]
/// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
/// }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let body = Body::new(&tetrahedral_box([2, 1, 1], [0.2, 0.1, 0.1])?, Rubber::new(1e5, 4e5)?, 1000.0)?;
/// let before = body.rest().to_vec();
/// let displacement: Vec<[f64; 3]> = before.iter().map(|&[x, y, _]| [0.5 * x, 0.3 * x * y, 0.0]).collect();
/// let mut between = DiscreteGradient::new(&body);
/// between.begin(&body, &before)?;
/// between.evaluate(&body, &displacement)?;
/// let mut gradient = vec![[0.0; 3]; before.len()];
/// between.add_gradient(&body, &mut gradient)?;
/// let work: f64 = gradient.iter().flatten().zip(displacement.iter().flatten()).map(|(g, d)| g * d).sum();
///
/// let moved = before.iter().zip(&displacement).map(|(x, d)| [x[0] + d[0], x[1] + d[1], x[2]]);
/// let after: Vec<[f64; 3]> = moved.collect();
/// let (energy, _) = ElasticResponse::new(&body).energy(&body, &after)?;
/// assert!((work - energy).abs() < 1e-12 * energy);
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct DiscreteGradient {
    nodes: usize,
    /// F of each element before.
    before: Vec<Matrix3<f64>>,
    energies_before: Vec<f64>,
    between: [Samples; 2],
    after: Samples,
    energies_after: Vec<f64>,
    elements: Vec<Mean>,
}

/// Deformation gradients of all elements, with what a batch finds there.
#[derive(Clone)]
struct Samples {
    F: Vec<f64>,
    S: Vec<f64>,
    dS_dE: Vec<f64>,
}

/// Strain and stress of an element between two states.
#[derive(Clone, Copy, Default)]
struct Mean {
    /// Fm.
    middle: Matrix3<f64>,
    /// ΔE, its components as those of a stress.
    strain: [f64; 6],
    /// S.
    stress: [f64; 6],
    /// S̄ and β, where a difference of energies is made up for.
    correction: Option<([f64; 6], f64)>,
}

/// Reason why a [`DiscreteGradient`] cannot be evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DiscreteGradientError {
    /// An element is inverted in the state before or after, or has no finite energy, stress or tangent there
    /// or between.
    Element {
        /// Tag of the element.
        tag: usize,
    },
    /// A slice or the body does not have the length of the body that the memory was made for.
    Length(LengthError),
}

impl fmt::Display for DiscreteGradientError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Element { tag } => write!(
                f,
                "element {tag} is inverted, or its energy is not finite, before or after or between: begin with a state whose \
                 elements are all upright, and try one that is closer to it"
            ),
            Self::Length(error) => error.fmt(f),
        }
    }
}

crate::chained::wraps!(DiscreteGradientError { Length(LengthError) });

impl fmt::Debug for DiscreteGradient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "DiscreteGradient {{ nodes: {}, elements: {} }}", self.nodes, self.elements.len())
    }
}

/// Derivative of the gradient in the four nodes of an element, by those in the same nodes after: N/m.
type NodalTangent = [[f64; 12]; 12];

impl DiscreteGradient {
    /// Allocates the memory for a body.
    #[must_use]
    pub fn new(body: &Body) -> Self {
        let elements = body.elements().len();
        let samples = || Samples {
            F: vec![0.0; 9 * elements],
            S: vec![0.0; 6 * elements],
            dS_dE: vec![0.0; 36 * elements],
        };
        Self {
            nodes: body.rest().len(),
            before: vec![[[0.0; 3]; 3]; elements],
            energies_before: vec![0.0; elements],
            between: [samples(), samples()],
            after: Samples { dS_dE: Vec::new(), ..samples() },
            energies_after: vec![0.0; elements],
            elements: vec![Mean::default(); elements],
        }
    }

    /// Sets the state before: positions of the nodes, m.
    ///
    /// # Errors
    /// [`DiscreteGradientError`].
    pub fn begin(&mut self, body: &Body, positions: &[[f64; 3]]) -> Result<(), DiscreteGradientError> {
        self.fit(body, "positions", positions.len())?;
        for (F, element) in self.before.iter_mut().zip(body.elements()) {
            *F = element.deformation_gradient(positions);
        }
        tag_of(body, self.before.iter().position(|F| !is_upright(F)))?;
        let (F, energies) = (self.before.as_flattened().as_flattened(), &mut self.energies_before);
        tag_of(body, energies_of(body, F, energies))
    }

    /// Evaluates the stress between the state before and the one with the nodes displaced from it, m.
    ///
    /// # Errors
    /// [`DiscreteGradientError`].
    pub fn evaluate(&mut self, body: &Body, displacement: &[[f64; 3]]) -> Result<(), DiscreteGradientError> {
        self.fit(body, "displacement", displacement.len())?;
        let Self { before, energies_before, between, after, energies_after, elements, .. } = self;
        for (index, element) in body.elements().iter().enumerate() {
            let (F, change) = (&before[index], element.deformation_gradient(displacement));
            let F_after = sum(F, 1.0, &change);
            if !is_upright(&F_after) {
                return Err(DiscreteGradientError::Element { tag: element.tag });
            }
            let mean = &mut elements[index];
            mean.middle = sum(F, 0.5, &change);
            let strain = symmetric_product(&mean.middle, &change);
            mean.strain = voigt::from_stress(&strain);
            let squares = symmetric_product(F, F);
            for (samples, s) in between.iter_mut().zip(POINTS) {
                let root = cholesky(&sum(&squares, 2.0 * s, &strain))
                    .ok_or(DiscreteGradientError::Element { tag: element.tag })?;
                samples.F[9 * index..9 * index + 9].copy_from_slice(root.as_flattened());
            }
            after.F[9 * index..9 * index + 9].copy_from_slice(F_after.as_flattened());
        }
        tag_of(body, energies_of(body, &after.F, energies_after))?;
        for samples in &mut *between {
            tag_of(body, samples.stresses(body))?;
        }
        for (material, range) in body.materials() {
            let stiffness = material.rest_stiffness().abs();
            for index in range {
                let mean = &mut elements[index];
                let [first, second] = [0, 1].map(|k| six(&between[k].S, index));
                let stress = std::array::from_fn(|k| 0.5 * (first[k] + second[k]));
                let [energy, before] = [energies_after[index], energies_before[index]];
                let missing = energy - before - contraction(&stress, &mean.strain);
                let square: f64 = after.F[9 * index..9 * index + 9].iter().map(|entry| entry * entry).sum();
                let noise = 2.0 * f64::EPSILON * (stiffness * square.max(1.0) + energy.abs() + before.abs());
                let beta = missing / contraction(&mean.strain, &mean.strain);
                mean.stress = stress;
                mean.correction = (missing.abs() > noise).then_some((stress, beta));
                if mean.correction.is_some() {
                    (0..6).for_each(|k| mean.stress[k] += beta * mean.strain[k]);
                }
            }
        }
        Ok(())
    }

    /// Adds the gradient, where it was evaluated last, to `total`, N.
    ///
    /// # Errors
    /// [`LengthError`].
    pub fn add_gradient(&self, body: &Body, total: &mut [[f64; 3]]) -> Result<(), LengthError> {
        self.fit(body, "total", total.len())?;
        for (element, mean) in body.elements().iter().zip(&self.elements) {
            let P = product(&mean.middle, &voigt::to_stress(&mean.stress));
            for (&node, G) in element.nodes.iter().zip(shape_gradients(element)) {
                for a in 0..3 {
                    total[node][a] += element.shape.volume * dot(P[a], G);
                }
            }
        }
        Ok(())
    }

    /// Evaluates what tangents need where the stress was evaluated last.
    ///
    /// # Errors
    /// [`DiscreteGradientError`].
    pub fn linearise(&mut self, body: &Body) -> Result<(), DiscreteGradientError> {
        self.fit(body, "nodes", body.rest().len())?;
        for samples in &mut self.between {
            tag_of(body, samples.tangents(body))?;
        }
        tag_of(body, self.after.stresses(body))
    }

    /// The derivative of the gradient by positions after, in the twelve coordinates of the nodes of each
    /// element, N/m: not symmetric. The elements are those of the body, in its order, where the gradient was
    /// [linearised](DiscreteGradient::linearise) last; none of a body of another number of elements.
    pub fn tangents(&self, body: &Body) -> impl ExactSizeIterator<Item = [[f64; 12]; 12]> {
        let elements = if self.elements.len() == body.elements().len() { body.elements() } else { &[] };
        elements.iter().enumerate().map(|(index, element)| self.tangent(element, index))
    }

    fn tangent(&self, element: &Tetrahedron, index: usize) -> NodalTangent {
        let mean = &self.elements[index];
        let D = self.stress_tangent(index);
        let F_after: Matrix3<f64> =
            std::array::from_fn(|a| std::array::from_fn(|b| self.after.F[9 * index + 3 * a + b]));
        let S = voigt::to_stress(&mean.stress);
        let gradients = shape_gradients(element);
        // Strains by a unit of each unknown: of the force, and of the stress as stresses.
        let forces: [[f64; 6]; 12] =
            std::array::from_fn(|row| nodal_strain(&mean.middle, gradients[row / 3], row % 3));
        let stresses: [[f64; 6]; 12] = std::array::from_fn(|column| {
            let strain = nodal_strain(&F_after, gradients[column / 3], column % 3);
            D.map(|row| (0..6).map(|k| row[k] * strain[k]).sum())
        });
        let mut tangent = [[0.0; 12]; 12];
        for row in 0..12 {
            for column in 0..12 {
                let mut entry: f64 = (0..6).map(|k| forces[row][k] * stresses[column][k]).sum();
                if row % 3 == column % 3 {
                    let [G, H] = [gradients[row / 3], gradients[column / 3]];
                    entry += 0.5 * dot(S.map(|s| dot(s, H)), G);
                }
                tangent[row][column] = element.shape.volume * entry;
            }
        }
        tangent
    }

    /// Whether the body and a slice of vectors of its nodes have the lengths that the memory was made for.
    fn fit(&self, body: &Body, slice: &'static str, found: usize) -> Result<(), LengthError> {
        same("elements", body.elements().len(), self.elements.len(), 1)?;
        same("nodes", body.rest().len(), self.nodes, 1)?;
        same(slice, found, self.nodes, 1)
    }

    /// dS/dE', which takes strains with doubled shears to stresses.
    fn stress_tangent(&self, index: usize) -> [[f64; 6]; 6] {
        let mut D = [[0.0; 6]; 6];
        for (samples, s) in self.between.iter().zip(POINTS) {
            for row in 0..6 {
                for column in 0..6 {
                    D[row][column] += 0.5 * s * samples.dS_dE[36 * index + 6 * row + column];
                }
            }
        }
        let Mean { strain, correction: Some((mean, beta)), .. } = self.elements[index] else { return D };
        let after = six(&self.after.S, index);
        let doubled = |k: usize| if k < 3 { 1.0 } else { 2.0 };
        let square = contraction(&strain, &strain);
        let slopes: [f64; 6] = std::array::from_fn(|k| {
            let of_mean: f64 = (0..6).map(|row| D[row][k] * doubled(row) * strain[row]).sum();
            (after[k] - mean[k] - 2.0 * beta * strain[k] - of_mean) / square
        });
        for row in 0..6 {
            for column in 0..6 {
                D[row][column] += strain[row] * slopes[column];
            }
            D[row][row] += beta / doubled(row);
        }
        D
    }
}

impl Samples {
    /// Evaluates S; the index of an element without one, if any.
    fn stresses(&mut self, body: &Body) -> Option<usize> {
        first_of_all(body, |batch, Range { start, end }| {
            let (F, S) = (&self.F[9 * start..9 * end], &mut self.S[6 * start..6 * end]);
            batch.measured_stresses(Measure::SecondPiola, F, S)
        })
    }

    /// Evaluates S and dS/dE; the index of an element without them, if any.
    fn tangents(&mut self, body: &Body) -> Option<usize> {
        first_of_all(body, |batch, Range { start, end }| {
            let (F, S) = (&self.F[9 * start..9 * end], &mut self.S[6 * start..6 * end]);
            batch.measured_tangents(Measure::SecondPiola, F, S, &mut self.dS_dE[36 * start..36 * end])
        })
    }
}

/// Evaluates ψ; the index of an element without it, if any.
fn energies_of(body: &Body, F: &[f64], energies: &mut [f64]) -> Option<usize> {
    first_of_all(body, |batch, Range { start, end }| {
        batch.energies(&F[9 * start..9 * end], &mut energies[start..end])
    })
}

/// Calls a batch for the elements of each material. Returns the index of the first that it cannot compute.
fn first_of_all(
    body: &Body,
    mut call: impl FnMut(Batch<'_, f64>, Range<usize>) -> Result<Survey, LengthError>,
) -> Option<usize> {
    body.materials().find_map(|(material, range)| {
        let start = range.start;
        match call(Batch::new(material).with_threads(true), range) {
            Ok(survey) => survey.first.map(|index| start + index),
            // The slices are those of all elements.
            Err(LengthError { .. }) => Some(start),
        }
    })
}

fn tag_of(body: &Body, index: Option<usize>) -> Result<(), DiscreteGradientError> {
    index.map_or(Ok(()), |index| Err(DiscreteGradientError::Element { tag: body.elements()[index].tag }))
}

/// Gradients of the shape functions of the four nodes, 1/m.
fn shape_gradients(element: &Tetrahedron) -> [[f64; 3]; 4] {
    let [g1, g2, g3] = element.shape.inverse;
    [std::array::from_fn(|c| -(g1[c] + g2[c] + g3[c])), g1, g2, g3]
}

/// sym(FᵀdF) as a strain with doubled shears, for dF = e_c ⊗ G.
fn nodal_strain(F: &Matrix3<f64>, [g0, g1, g2]: [f64; 3], c: usize) -> [f64; 6] {
    let [f0, f1, f2] = F[c];
    [f0 * g0, f1 * g1, f2 * g2, f1 * g2 + f2 * g1, f0 * g2 + f2 * g0, f0 * g1 + f1 * g0]
}

/// a : b for symmetric tensors, both by their components.
fn contraction(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
}

fn six(numbers: &[f64], index: usize) -> [f64; 6] {
    std::array::from_fn(|k| numbers[6 * index + k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sum(a: &Matrix3<f64>, factor: f64, b: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][j] + factor * b[i][j]))
}

fn product(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// sym(aᵀb).
fn symmetric_product(a: &Matrix3<f64>, b: &Matrix3<f64>) -> Matrix3<f64> {
    let entry = |i: usize, j: usize| (0..3).map(|k| a[k][i] * b[k][j]).sum::<f64>();
    std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (entry(i, j) + entry(j, i))))
}

/// The upper triangular G with GᵀG = C, if C is positive definite.
fn cholesky(C: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let root = |x: f64| (x > 0.0).then(|| x.sqrt());
    let g00 = root(C[0][0])?;
    let (g01, g02) = (C[0][1] / g00, C[0][2] / g00);
    let g11 = root(C[1][1] - g01 * g01)?;
    let g12 = (C[1][2] - g01 * g02) / g11;
    let g22 = root(C[2][2] - g02 * g02 - g12 * g12)?;
    Some([[g00, g01, g02], [0.0, g11, g12], [0.0, 0.0, g22]])
}

/// Whether det F > 0.
fn is_upright([[a, b, c], [d, e, f], [g, h, i]]: &Matrix3<f64>) -> bool {
    a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g) > 0.0
}

#[cfg(test)]
mod tests;
