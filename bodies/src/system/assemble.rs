//! Assembly: from elements to the vectors and the matrix of a body, with the same bits for any number of
//! threads.
//!
//! Parallel assembly usually scatters: each thread adds its elements into shared entries, with atomics or
//! with a colouring of the mesh, and the order in which floating-point numbers are added, hence the last bits
//! of the sum, depends on which thread comes first. Here it gathers instead, in two stages that need neither:
//!
//! 1. *Elements.* Groups of elements are evaluated in parallel, each element into a place of its own.
//! 2. *Entries.* Each entry of the matrix has a list of the element blocks that add up to it, made once with
//!    the sparsity pattern and sorted by element. Rows are summed in parallel, each entry by one thread in
//!    the order of its list. Nodal vectors and energies are summed by one thread in the order of the
//!    elements: that takes microseconds.
//!
//! Work is divided into groups of fixed size, regardless of the number of threads, and no sum crosses a
//! division. A sum therefore depends on the mesh alone. The price is the buffer between the stages, 720 bytes
//! of stiffness for each element. Bodies are assembled in waves of some thousand elements, which share one
//! buffer that stays in the cache ([`NodalStiffness`](super::nodal_stiffness::NodalStiffness)).
//!
//! Energies near an equilibrium differ by less than the rounding error of their sum. So differences are taken
//! per element and then summed with compensation [Neu74], and [`Elastic::difference_noise`] bounds the
//! remaining error.
//!
//! [Neu74] Neumaier, *Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen*, 1974.

use std::ops::Range;

use rayon::prelude::*;

use piola::Status;
use piola::batch::TileMaterial;
use piola::batch::element::{TILE, survey};
use piola::point::{Filter, svd};

use super::body::Body;
use super::element::{ElementGroup, Evaluated, StiffnessBlocks, Tetrahedron};
use super::parts::for_each_entry;

/// Energies and gradients of all elements at the positions evaluated last.
#[derive(Clone)]
pub(crate) struct Elastic {
    groups: Vec<State>,
    /// Energies at the positions before, group by group.
    base: Vec<[f64; TILE]>,
}

/// A group of elements, and the survey of its last evaluation.
#[derive(Clone)]
struct State {
    group: ElementGroup,
    elements: Range<usize>,
    evaluated: Evaluated,
}

impl Elastic {
    pub(crate) fn new(body: &Body) -> Self {
        let state = |elements: Range<usize>| State {
            group: ElementGroup::new(body.number_in_part(elements.start), &body.elements()[elements.clone()]),
            elements,
            evaluated: Evaluated::NONE,
        };
        let groups: Vec<State> = body.groups().map(|(_, elements)| state(elements)).collect();
        let base = vec![[0.0; TILE]; groups.len()];
        Self { groups, base }
    }

    pub(crate) fn evaluate(&mut self, body: &Body, positions: &[[f64; 3]]) -> Evaluated {
        self.for_each_group(|state| {
            let mut min_det = f64::INFINITY;
            state.evaluate(body, |group, material, elements| {
                let (status, det) = group.evaluate(material, elements, positions);
                min_det = det;
                status
            });
            state.evaluated.min_det = min_det;
        });
        self.survey()
    }

    /// Evaluates the gradients where the energies were evaluated last.
    pub(crate) fn evaluate_gradients(&mut self, body: &Body) {
        self.for_each_group(|state| state.evaluate(body, ElementGroup::evaluate_gradients));
    }

    fn for_each_group(&mut self, evaluate: impl Fn(&mut State) + Sync) {
        for_each_entry(&mut self.groups, 1, |_, state| evaluate(state));
    }

    /// Evaluates gradients and filtered stiffnesses of the groups from `first` on, one for each tile, where
    /// the energies were evaluated last.
    pub(crate) fn linearise(
        &mut self,
        body: &Body,
        filter: Filter,
        first: usize,
        tiles: &mut [[StiffnessBlocks; TILE]],
    ) {
        self.groups[first..].par_iter_mut().zip(tiles).for_each(|(state, tile)| {
            state.evaluate(body, |group, material, elements| {
                group.evaluate_stiffnesses(material, elements, filter, tile)
            });
        });
    }

    pub(crate) fn survey(&self) -> Evaluated {
        self.groups.iter().fold(Evaluated::NONE, |sum, State { evaluated, .. }| Evaluated {
            survey: sum.survey + evaluated.survey,
            min_det: sum.min_det.min(evaluated.min_det),
        })
    }

    /// The energies of a group's elements, and those of the base.
    fn energies(&self) -> impl Iterator<Item = (f64, f64)> {
        self.groups.iter().zip(&self.base).flat_map(|(state, base)| {
            let energies = state.group.energies.iter().zip(base).take(state.elements.len());
            energies.map(|(&energy, &base)| (energy, base))
        })
    }

    /// Sum of the energies, J.
    pub(crate) fn energy(&self) -> f64 {
        compensated(self.energies().map(|(energy, _)| energy))
    }

    /// Makes the positions evaluated last the base of differences.
    pub(crate) fn set_base(&mut self) {
        for (base, state) in self.base.iter_mut().zip(&self.groups) {
            *base = state.group.energies;
        }
    }

    /// Energy minus the energy of the base, J.
    pub(crate) fn difference(&self) -> f64 {
        compensated(self.energies().map(|(energy, base)| energy - base))
    }

    /// Bound for the rounding error of the difference, J.
    ///
    /// An energy density is a sum that cancels at rest; its terms are of the order of the modulus times |F|².
    /// Each has an assumed error of 4u, which leaves room for the ten or so operations of an energy.
    pub(crate) fn difference_noise(&self, body: &Body) -> f64 {
        let mut noise = 0.0;
        for ((material, elements), (state, base)) in body.groups().zip(self.groups.iter().zip(&self.base)) {
            let stiffness = material.rest_stiffness().abs();
            for (lane, element) in body.elements()[elements].iter().enumerate() {
                let gradient = state.group.deformation_gradient(lane);
                let square: f64 = gradient.as_flattened().iter().map(|entry| entry * entry).sum();
                let scale = element.shape.volume * stiffness * square.max(1.0);
                noise += scale + state.group.energies[lane].abs() + base[lane].abs();
            }
        }
        2.0 * f64::EPSILON * noise
    }

    /// The principal stretches of each element where the energies were evaluated last.
    pub(crate) fn stretches(&self) -> impl Iterator<Item = [f64; 3]> {
        let lanes =
            self.groups.iter().flat_map(|state| (0..state.elements.len()).map(move |lane| (state, lane)));
        lanes.map(|(state, lane)| svd(&state.group.deformation_gradient(lane)).stretches)
    }

    /// The gradients of each element in the positions of its nodes, N, where they were evaluated last.
    #[cfg(feature = "faer")]
    pub(crate) fn gradients(&self) -> impl Iterator<Item = &[[f64; 3]; 4]> {
        self.groups.iter().flat_map(|state| &state.group.gradients[..state.elements.len()])
    }

    /// Adds the gradient of the energy to `total`, one entry per node.
    pub(crate) fn add_gradient(&self, body: &Body, total: &mut [[f64; 3]]) {
        for State { group, elements, .. } in &self.groups {
            for (element, gradient) in body.elements()[elements.clone()].iter().zip(&group.gradients) {
                for (&node, g) in element.nodes.iter().zip(gradient) {
                    for c in 0..3 {
                        total[node][c] += g[c];
                    }
                }
            }
        }
    }
}

impl State {
    /// Evaluates the group and keeps its survey; the smallest det F stays that of the last energies.
    fn evaluate(
        &mut self,
        body: &Body,
        evaluate: impl FnOnce(&mut ElementGroup, &dyn TileMaterial<f64>, &[Tetrahedron]) -> Status<u64>,
    ) {
        let elements = &body.elements()[self.elements.clone()];
        let status = evaluate(&mut self.group, body.material(self.elements.start), elements);
        self.evaluated.survey = survey(status, self.elements.start);
    }
}

/// Compensated sum: carries its rounding errors along [Neu74].
fn compensated(numbers: impl Iterator<Item = f64>) -> f64 {
    let (mut total, mut error) = (0.0_f64, 0.0);
    for x in numbers {
        let sum = total + x;
        error += if total.abs() >= x.abs() { (total - sum) + x } else { (x - sum) + total };
        total = sum;
    }
    total + error
}

#[cfg(test)]
mod tests;
