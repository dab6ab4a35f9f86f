//! Assembly: from elements to the vectors and the matrix of a body, with the same bits for any number of threads.
//!
//! Parallel assembly usually scatters: each thread adds its elements into shared entries, with atomics or with a
//! colouring of the mesh, and the order in which floating-point numbers are added, hence the last bits of the sum,
//! depends on who comes first. Here it gathers instead, in two stages that need neither:
//!
//! 1. *Elements.* Blocks of elements are evaluated in parallel, each element into a slot of its own.
//! 2. *Entries.* Each entry of the matrix has a list of the element blocks that add up to it, made once with the
//!    sparsity pattern and sorted by element. Columns are summed in parallel, each entry by one thread in the order
//!    of its list. Nodal vectors and energies are summed by one thread in the order of the elements: that takes
//!    microseconds.
//!
//! Work is divided into blocks of fixed size, whatever the number of threads, and no sum crosses a division. A sum
//! therefore depends on the mesh alone. The price is the buffer between the stages, 720 bytes of stiffness for each
//! element, which stays in the cache for the bodies this is made for.
//!
//! Energies near an equilibrium differ by less than the rounding error of their sum. So differences are taken per
//! element and then summed with compensation [Neu74], and [`Elastic::difference_noise`] bounds what is left.
//!
//! [Neu74] Neumaier, *Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen*, 1974.

use rayon::prelude::*;

use super::Body;
use super::element::{ElementStiffness, Survey, pair};
use super::pattern::Pattern;
use crate::point::{Filter, Svd};

/// Elements of a block, evaluated by one dynamic dispatch for each material in it: enough to pay for it, few enough for their data to stay in the cache.
const BLOCK: usize = 64;

/// Columns of blocks summed by one thread without a further division.
const COLUMNS: usize = 64;

/// Energies, gradients and stiffnesses of all elements at the positions evaluated last.
pub(crate) struct Elastic {
    points: Vec<Svd<f64>>,
    energies: Vec<f64>,
    /// Energies at the positions before.
    base: Vec<f64>,
    gradients: Vec<[[f64; 3]; 4]>,
    stiffnesses: Vec<ElementStiffness>,
    /// One for each block.
    surveys: Vec<Survey>,
}

impl Elastic {
    pub(crate) fn new(body: &Body) -> Self {
        let elements = body.elements.len();
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Self {
            points: vec![Svd { U: identity, stretches: [1.0; 3], V: identity }; elements],
            energies: vec![0.0; elements],
            base: vec![0.0; elements],
            gradients: vec![[[0.0; 3]; 4]; elements],
            stiffnesses: vec![ElementStiffness::ZERO; elements],
            surveys: vec![Survey::NONE; elements.div_ceil(BLOCK)],
        }
    }

    /// Evaluates the energies at these positions.
    pub(crate) fn evaluate(&mut self, body: &Body, positions: &[[f64; 3]]) -> Survey {
        let outputs = self.points.par_chunks_mut(BLOCK).zip(self.energies.par_chunks_mut(BLOCK));
        let jobs = body.elements.par_chunks(BLOCK).zip(outputs).zip(&mut self.surveys).enumerate();
        jobs.for_each(|(block, ((elements, (points, energies)), survey))| {
            *survey = Survey::NONE;
            for (material, piece) in body.pieces(BLOCK * block, elements.len()) {
                let (points, energies) = (&mut points[piece.clone()], &mut energies[piece.clone()]);
                *survey = survey.and(material.evaluate(&elements[piece], positions, points, energies));
            }
        });
        self.survey()
    }

    /// Evaluates the gradients where the energies were evaluated last.
    pub(crate) fn evaluate_gradients(&mut self, body: &Body) {
        let inputs = body.elements.par_chunks(BLOCK).zip(self.points.par_chunks(BLOCK));
        let jobs = inputs.zip(self.gradients.par_chunks_mut(BLOCK)).enumerate();
        jobs.for_each(|(block, ((elements, points), gradients))| {
            for (material, piece) in body.pieces(BLOCK * block, elements.len()) {
                material.gradients(&elements[piece.clone()], &points[piece.clone()], &mut gradients[piece]);
            }
        });
    }

    /// Evaluates gradients and filtered stiffnesses where the energies were evaluated last.
    pub(crate) fn evaluate_stiffnesses(&mut self, body: &Body, filter: Filter) -> Survey {
        let inputs = body.elements.par_chunks(BLOCK).zip(self.points.par_chunks(BLOCK));
        let outputs = self.gradients.par_chunks_mut(BLOCK).zip(self.stiffnesses.par_chunks_mut(BLOCK));
        let jobs = inputs.zip(outputs).zip(&mut self.surveys).enumerate();
        jobs.for_each(|(block, (((elements, points), (gradients, stiffnesses)), survey))| {
            *survey = Survey::NONE;
            for (material, piece) in body.pieces(BLOCK * block, elements.len()) {
                let (gradients, stiffnesses) =
                    (&mut gradients[piece.clone()], &mut stiffnesses[piece.clone()]);
                let (elements, points) = (&elements[piece.clone()], &points[piece]);
                *survey = survey.and(material.stiffnesses(elements, points, filter, gradients, stiffnesses));
            }
        });
        self.survey()
    }

    /// What the evaluation before says.
    pub(crate) fn survey(&self) -> Survey {
        self.surveys.iter().fold(Survey::NONE, |sum, next| sum.and(*next))
    }

    /// Sum of the energies, J.
    pub(crate) fn energy(&self) -> f64 {
        self.energies.iter().copied().collect::<Compensated>().value()
    }

    /// Makes the positions evaluated last the base of differences.
    pub(crate) fn set_base(&mut self) {
        self.base.copy_from_slice(&self.energies);
    }

    /// Energy minus that of the base, J.
    pub(crate) fn difference(&self) -> f64 {
        self.energies
            .iter()
            .zip(&self.base)
            .map(|(energy, base)| energy - base)
            .collect::<Compensated>()
            .value()
    }

    /// What rounding may contribute to the difference, J.
    ///
    /// An energy density is a sum that cancels at rest; its terms are of the order of the modulus times |F|². Each
    /// is taken to err by 4u, which leaves room for the ten or so operations of an energy.
    pub(crate) fn difference_noise(&self, body: &Body) -> f64 {
        let mut noise = 0.0;
        for (material, run) in body.pieces(0, body.elements.len()) {
            let stiffness = material.rest_stiffness().abs();
            for index in run {
                let square: f64 = self.points[index].stretches.iter().map(|stretch| stretch * stretch).sum();
                let scale = body.elements[index].shape.volume * stiffness * square.max(1.0);
                noise += scale + self.energies[index].abs() + self.base[index].abs();
            }
        }
        2.0 * f64::EPSILON * noise
    }

    /// Adds the gradient of the energy to `total`, one entry per node.
    pub(crate) fn add_gradient(&self, body: &Body, total: &mut [[f64; 3]]) {
        for (element, gradient) in body.elements.iter().zip(&self.gradients) {
            for (&node, g) in element.nodes.iter().zip(gradient) {
                for c in 0..3 {
                    total[node][c] += g[c];
                }
            }
        }
    }

    /// Adds K d to `total` for a displacement d that is zero at most nodes.
    pub(crate) fn add_product(&self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for (element, stiffness) in body.elements.iter().zip(&self.stiffnesses) {
            for (j, &from) in element.nodes.iter().enumerate() {
                let d = displacement[from];
                if d == [0.0; 3] {
                    continue;
                }
                for (i, &to) in element.nodes.iter().enumerate() {
                    for a in 0..3 {
                        for c in 0..3 {
                            let entry = match i >= j {
                                true => stiffness.blocks[pair(i, j)][a][c],
                                false => stiffness.blocks[pair(j, i)][c][a],
                            };
                            total[to][a] += entry * d[c];
                        }
                    }
                }
            }
        }
    }

    /// Sums the stiffnesses into the entries of the pattern and adds `diagonal(node)` to the diagonal.
    pub(crate) fn fill(&self, pattern: &Pattern, diagonal: impl Fn(usize) -> f64 + Sync, values: &mut [f64]) {
        let columns = pattern.node_of_free().len();
        fill_columns(pattern, &self.stiffnesses, &diagonal, 0..columns, values);
    }
}

/// Sums a range of columns into the slice that holds them, by halves in parallel.
fn fill_columns(
    pattern: &Pattern,
    stiffnesses: &[ElementStiffness],
    diagonal: &(impl Fn(usize) -> f64 + Sync),
    columns: std::ops::Range<usize>,
    values: &mut [f64],
) {
    if columns.len() > COLUMNS {
        let middle = columns.start + columns.len() / 2;
        let (left, right) =
            values.split_at_mut(pattern.column_start(middle) - pattern.column_start(columns.start));
        rayon::join(
            || fill_columns(pattern, stiffnesses, diagonal, columns.start..middle, left),
            || fill_columns(pattern, stiffnesses, diagonal, middle..columns.end, right),
        );
        return;
    }
    let offset = pattern.column_start(columns.start);
    for column in columns {
        let first = pattern.columns()[column];
        for block in first..pattern.columns()[column + 1] {
            let sum = sum_block(pattern, stiffnesses, block);
            let shift = if block == first { diagonal(pattern.node_of_free()[column]) } else { 0.0 };
            for c in 0..3 {
                for r in if block == first { c } else { 0 }..3 {
                    let added = if r == c { shift } else { 0.0 };
                    values[pattern.scalar(column, block, r, c) - offset] = sum[r][c] + added;
                }
            }
        }
    }
}

/// A block of the matrix: the sum of its contributions in the order of their list.
fn sum_block(pattern: &Pattern, stiffnesses: &[ElementStiffness], block: usize) -> [[f64; 3]; 3] {
    let mut sum = [[0.0; 3]; 3];
    for contribution in pattern.contributions(block) {
        let part = &stiffnesses[contribution.element as usize].blocks[usize::from(contribution.pair)];
        for r in 0..3 {
            for c in 0..3 {
                sum[r][c] += if contribution.transposed { part[c][r] } else { part[r][c] };
            }
        }
    }
    sum
}

/// A sum that carries its rounding errors along [Neu74].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Compensated {
    sum: f64,
    error: f64,
}

impl Compensated {
    pub(crate) fn add(&mut self, x: f64) {
        let sum = self.sum + x;
        self.error += if self.sum.abs() >= x.abs() { (self.sum - sum) + x } else { (x - sum) + self.sum };
        self.sum = sum;
    }

    pub(crate) fn value(self) -> f64 {
        self.sum + self.error
    }
}

impl FromIterator<f64> for Compensated {
    fn from_iter<I: IntoIterator<Item = f64>>(numbers: I) -> Self {
        let mut total = Self::default();
        numbers.into_iter().for_each(|x| total.add(x));
        total
    }
}

#[cfg(test)]
mod tests;
