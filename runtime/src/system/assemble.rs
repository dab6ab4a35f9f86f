//! Assembly: from elements to the vectors and the matrix of a body, with the same bits for any number of threads.
//!
//! Parallel assembly usually scatters: each thread adds its elements into shared entries, with atomics or with a
//! colouring of the mesh, and the order in which floating-point numbers are added, hence the last bits of the sum,
//! depends on who comes first. Here it gathers instead, in two stages that need neither:
//!
//! 1. *Elements.* Groups of elements are evaluated in parallel, each element into a place of its own.
//! 2. *Entries.* Each entry of the matrix has a list of the element blocks that add up to it, made once with the
//!    sparsity pattern and sorted by element. Columns are summed in parallel, each entry by one thread in the order
//!    of its list. Nodal vectors and energies are summed by one thread in the order of the elements: that takes
//!    microseconds.
//!
//! Work is divided into groups of fixed size, whatever the number of threads, and no sum crosses a division. A sum
//! therefore depends on the mesh alone. The price is the buffer between the stages, 720 bytes of stiffness for each
//! element, which stays in the cache for the bodies this is made for.
//!
//! Energies near an equilibrium differ by less than the rounding error of their sum. So differences are taken per
//! element and then summed with compensation [Neu74], and [`Elastic::difference_noise`] bounds what is left.
//!
//! [Neu74] Neumaier, *Rundungsfehleranalyse einiger Verfahren zur Summation endlicher Summen*, 1974.

use std::ops::Range;

use rayon::prelude::*;

use super::Body;
use super::element::{Element, Group, Stiffness, Survey, pair};
use super::fill::{NodePairs, fill};
use super::pattern::Pattern;
use crate::batch::Energy;
use crate::batch::element::TILE;
use crate::point::Filter;

/// Energies, gradients and stiffnesses of all elements at the positions evaluated last.
pub(crate) struct Elastic {
    groups: Vec<State>,
    /// The group of each element and its lane there.
    places: Vec<(u32, u32)>,
    /// Energies at the positions before, group by group.
    base: Vec<[f64; TILE]>,
}

/// A group of elements, and what the evaluation before says of it.
struct State {
    group: Group,
    elements: Range<usize>,
    survey: Survey,
}

impl Elastic {
    pub(crate) fn new(body: &Body) -> Self {
        let mut places = Vec::with_capacity(body.elements.len());
        let mut groups = Vec::new();
        for (_, elements) in body.groups() {
            places.extend((0..elements.len() as u32).map(|lane| (groups.len() as u32, lane)));
            let group = Group::new(&body.elements[elements.clone()]);
            groups.push(State { group, elements, survey: Survey::NONE });
        }
        let base = vec![[0.0; TILE]; groups.len()];
        Self { groups, places, base }
    }

    /// Calls `evaluate` for each group of elements, in parallel, and keeps what it says.
    fn for_each_group(
        &mut self,
        body: &Body,
        evaluate: impl Fn(&mut Group, &dyn Energy<f64>, &[Element]) -> Survey + Sync,
    ) {
        self.groups.par_iter_mut().for_each(|State { group, elements, survey }| {
            let material = body.material(elements.start);
            *survey = evaluate(group, material, &body.elements[elements.clone()]);
        });
    }

    /// Evaluates the energies at these positions.
    pub(crate) fn evaluate(&mut self, body: &Body, positions: &[[f64; 3]]) -> Survey {
        self.for_each_group(body, |group, material, elements| group.evaluate(material, elements, positions));
        self.survey()
    }

    /// Evaluates the gradients where the energies were evaluated last.
    pub(crate) fn evaluate_gradients(&mut self, body: &Body) {
        self.for_each_group(body, Group::evaluate_gradients);
    }

    /// Evaluates gradients and filtered stiffnesses where the energies were evaluated last.
    pub(crate) fn evaluate_stiffnesses(&mut self, body: &Body, filter: Filter) -> Survey {
        self.for_each_group(body, |group, material, elements| {
            group.evaluate_stiffnesses(material, elements, filter)
        });
        self.survey()
    }

    /// What the evaluation before says.
    pub(crate) fn survey(&self) -> Survey {
        self.groups.iter().fold(Survey::NONE, |sum, state| sum.and(state.survey))
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
        self.energies().map(|(energy, _)| energy).collect::<Compensated>().value()
    }

    /// Makes the positions evaluated last the base of differences.
    pub(crate) fn set_base(&mut self) {
        for (base, state) in self.base.iter_mut().zip(&self.groups) {
            *base = state.group.energies;
        }
    }

    /// Energy minus that of the base, J.
    pub(crate) fn difference(&self) -> f64 {
        self.energies().map(|(energy, base)| energy - base).collect::<Compensated>().value()
    }

    /// What rounding may contribute to the difference, J.
    ///
    /// An energy density is a sum that cancels at rest; its terms are of the order of the modulus times |F|². Each
    /// is taken to err by 4u, which leaves room for the ten or so operations of an energy.
    pub(crate) fn difference_noise(&self, body: &Body) -> f64 {
        let mut noise = 0.0;
        for ((material, elements), (state, base)) in body.groups().zip(self.groups.iter().zip(&self.base)) {
            let stiffness = material.rest_stiffness().abs();
            for (lane, element) in body.elements[elements].iter().enumerate() {
                let square: f64 = state.group.stretches(lane).iter().map(|stretch| stretch * stretch).sum();
                let scale = element.shape.volume * stiffness * square.max(1.0);
                noise += scale + state.group.energies[lane].abs() + base[lane].abs();
            }
        }
        2.0 * f64::EPSILON * noise
    }

    /// The gradient and stiffness of each element.
    fn derivatives(&self) -> impl Iterator<Item = (&[[f64; 3]; 4], &Stiffness)> {
        self.groups.iter().flat_map(|state| {
            let Group { gradients, stiffnesses, .. } = &state.group;
            gradients.iter().zip(stiffnesses).take(state.elements.len())
        })
    }

    /// Adds the gradient of the energy to `total`, one entry per node.
    pub(crate) fn add_gradient(&self, body: &Body, total: &mut [[f64; 3]]) {
        for (element, (gradient, _)) in body.elements.iter().zip(self.derivatives()) {
            for (&node, g) in element.nodes.iter().zip(gradient) {
                for c in 0..3 {
                    total[node][c] += g[c];
                }
            }
        }
    }

    /// Adds K d to `total` for a displacement d that is zero at most nodes.
    pub(crate) fn add_product(&self, body: &Body, displacement: &[[f64; 3]], total: &mut [[f64; 3]]) {
        for (element, (_, stiffness)) in body.elements.iter().zip(self.derivatives()) {
            for (j, &from) in element.nodes.iter().enumerate() {
                let d = displacement[from];
                if d == [0.0; 3] {
                    continue;
                }
                for (i, &to) in element.nodes.iter().enumerate() {
                    for a in 0..3 {
                        for c in 0..3 {
                            let entry = match i >= j {
                                true => stiffness[pair(i, j)][a][c],
                                false => stiffness[pair(j, i)][c][a],
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
        fill(pattern, self, &diagonal, values);
    }
}

impl NodePairs for Elastic {
    fn block(&self, element: usize, i: usize, j: usize) -> [[f64; 3]; 3] {
        let (group, lane) = self.places[element];
        self.groups[group as usize].group.stiffnesses[lane as usize][pair(i, j)]
    }
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
