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

use piola::batch::TileMaterial;
use piola::batch::element::TILE;
use piola::point::{Filter, svd};

use super::body::Body;
use super::element::{ElementGroup, Evaluated, StiffnessBlocks, Tetrahedron};
use super::parts::for_each_entry;

/// Energies and gradients of all elements at the positions evaluated last.
#[derive(Clone)]
pub(crate) struct Elastic {
    groups: Vec<ElementGroup>,
}

impl Elastic {
    pub(crate) fn new(body: &Body) -> Self {
        let group = |range: Range<usize>| {
            ElementGroup::new(body.number_in_part(range.start), range.start, &body.elements()[range])
        };
        Self { groups: body.groups().map(|(_, range)| group(range)).collect() }
    }

    pub(crate) fn evaluate(&mut self, body: &Body, positions: &[[f64; 3]]) -> Evaluated {
        self.for_each_group(body, |group, material, elements| group.evaluate(material, elements, positions));
        self.survey()
    }

    /// Evaluates the gradients where the energies were evaluated last.
    pub(crate) fn evaluate_gradients(&mut self, body: &Body) {
        self.for_each_group(body, ElementGroup::evaluate_gradients);
    }

    /// Evaluates each group with its material and elements.
    fn for_each_group(
        &mut self,
        body: &Body,
        evaluate: impl Fn(&mut ElementGroup, &dyn TileMaterial<f64>, &[Tetrahedron]) + Sync,
    ) {
        for_each_entry(&mut self.groups, 1, |_, group| {
            let range = group.range.clone();
            evaluate(group, body.material(range.start), &body.elements()[range]);
        });
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
        self.groups[first..].par_iter_mut().zip(tiles).for_each(|(group, tile)| {
            let range = group.range.clone();
            group.evaluate_stiffnesses(body.material(range.start), &body.elements()[range], filter, tile);
        });
    }

    pub(crate) fn survey(&self) -> Evaluated {
        self.groups.iter().fold(Evaluated::NONE, |sum, ElementGroup { evaluated, .. }| Evaluated {
            survey: sum.survey + evaluated.survey,
            min_det: sum.min_det.min(evaluated.min_det),
        })
    }

    /// The energies of a group's elements, and those of the base.
    fn energies(&self) -> impl Iterator<Item = (f64, f64)> {
        self.groups.iter().flat_map(|group| {
            let energies = group.energies.iter().zip(&group.base).take(group.range.len());
            energies.map(|(&energy, &base)| (energy, base))
        })
    }

    /// Sum of the energies, J.
    pub(crate) fn energy(&self) -> f64 {
        compensated(self.energies().map(|(energy, _)| energy))
    }

    /// Makes the positions evaluated last the base of differences.
    pub(crate) fn set_base(&mut self) {
        self.groups.iter_mut().for_each(|group| group.base = group.energies);
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
        for ((material, elements), group) in body.groups().zip(&self.groups) {
            let stiffness = material.rest_stiffness().abs();
            for (lane, element) in body.elements()[elements].iter().enumerate() {
                let gradient = group.deformation_gradient(lane);
                let square: f64 = gradient.as_flattened().iter().map(|entry| entry * entry).sum();
                let scale = element.shape.volume * stiffness * square.max(1.0);
                noise += scale + group.energies[lane].abs() + group.base[lane].abs();
            }
        }
        2.0 * f64::EPSILON * noise
    }

    /// The principal stretches of each element where the energies were evaluated last.
    pub(crate) fn stretches(&self) -> impl Iterator<Item = [f64; 3]> {
        let lanes =
            self.groups.iter().flat_map(|group| (0..group.range.len()).map(move |lane| (group, lane)));
        lanes.map(|(group, lane)| svd(&group.deformation_gradient(lane)).stretches)
    }

    /// The gradients of each element in the positions of its nodes, N, where they were evaluated last.
    #[cfg(feature = "faer")]
    pub(crate) fn gradients(&self) -> impl Iterator<Item = &[[f64; 3]; 4]> {
        self.groups.iter().flat_map(|group| &group.gradients[..group.range.len()])
    }

    /// Adds the gradient of the energy to `total`, one entry per node.
    pub(crate) fn add_gradient(&self, body: &Body, total: &mut [[f64; 3]]) {
        for group in &self.groups {
            for (element, gradient) in body.elements()[group.range.clone()].iter().zip(&group.gradients) {
                for (&node, g) in element.nodes.iter().zip(gradient) {
                    for c in 0..3 {
                        total[node][c] += g[c];
                    }
                }
            }
        }
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
