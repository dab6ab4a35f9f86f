//! A tile of linear tetrahedra: the stages of a batch with the memory between them kept, for solvers that come back.
//!
//! One decomposition of each element serves the energy, the gradient and the stiffness.

use super::energy::{Energy, TileOf, Verdict};
use super::operator::StiffnessFactors;
use super::sink::{Layout, Lines, Sink, Source};
use super::stage::{Decompose, Deform, Forces, Judge, Points, Respond, Stages, StiffnessForm};
use super::workspace::Workspace;
use crate::lanes::Backend;
use crate::mesh::RestShape;
use crate::point::Filter;

pub(crate) use super::stage::Marks;
pub(crate) use super::tile::TILE;

/// Up to [`TILE`] elements of one material.
#[derive(Clone, Debug)]
pub(crate) struct ElementTile {
    backend: Backend,
    count: usize,
    rest: RestShapes,
    volumes: [f64; TILE],
    points: Points<f64>,
}

impl ElementTile {
    pub(crate) fn new(backend: Backend, shapes: impl Iterator<Item = RestShape>) -> Self {
        let mut volumes = [0.0; TILE];
        let mut count = 0;
        let rest = RestShapes::new(shapes.inspect(|shape| {
            volumes[count] = shape.volume;
            count += 1;
        }));
        Self { backend, count, rest, volumes, points: Points::new() }
    }

    /// λ1, λ2, λ3 of an element, as evaluated last.
    pub(crate) fn stretches(&self, lane: usize) -> [f64; 3] {
        let rows = &self.points.stretches.0;
        [rows[0][lane], rows[1][lane], rows[2][lane]]
    }

    /// Decomposes F and evaluates energies, J; `corners` are the positions of each element's nodes.
    pub(crate) fn evaluate(
        &mut self,
        energy: &dyn Energy<f64>,
        corners: impl Iterator<Item = [[f64; 3]; 4]>,
        energies: &mut [f64],
    ) -> Verdict {
        let Self { backend, count, ref rest, ref mut points, .. } = *self;
        let is_signed = energy.ends_at_zero_volume();
        f64::with_workspace(|Workspace { F: edges, .. }| {
            for (lane, corners) in corners.enumerate() {
                set_edges(edges, lane, corners);
            }
            f64::deform(backend, Deform { edges, rest: rest.source(), count });
            f64::decompose(backend, Decompose { F: edges.source(), count, is_signed, points });
        });
        f64::with_workspace(|Workspace { energies: densities, .. }| {
            let verdict = energy.energies(self.stretched(), densities);
            for ((energy, density), volume) in energies.iter_mut().zip(densities.0[0]).zip(self.volumes) {
                *energy = volume * density;
            }
            verdict
        })
    }

    /// Gradients of the energies evaluated last, N, 12 numbers each.
    pub(crate) fn gradients(&self, energy: &dyn Energy<f64>, gradients: &mut [f64]) -> Marks {
        f64::with_workspace(|Workspace { gradients: principal, line, .. }| {
            let refused = energy.gradients(self.stretched(), principal);
            let kernel = Forces {
                points: &self.points,
                gradients: &principal.0,
                rest: self.rest.source(),
                count: self.count,
                line,
                to: by_elements(gradients),
            };
            Marks { refused, ..f64::forces(self.backend, kernel) }
        })
    }

    /// Gradients, and filtered stiffnesses as the blocks of node pairs, N/m, 90 numbers each.
    pub(crate) fn stiffnesses(
        &self,
        energy: &dyn Energy<f64>,
        filter: Filter,
        gradients: &mut [f64],
        stiffnesses: &mut [f64],
    ) -> Marks {
        self.respond(energy, filter, gradients, StiffnessForm::Blocks, by_elements(stiffnesses))
    }

    /// Gradients, and filtered stiffnesses as what they are made of.
    pub(crate) fn factored_stiffnesses(
        &self,
        energy: &dyn Energy<f64>,
        filter: Filter,
        gradients: &mut [f64],
        factors: &mut StiffnessFactors,
    ) -> Marks {
        self.respond(energy, filter, gradients, StiffnessForm::Factored, factors.sink())
    }

    fn respond(
        &self,
        energy: &dyn Energy<f64>,
        filter: Filter,
        gradients: &mut [f64],
        form: StiffnessForm,
        stiffnesses: Sink<'_, f64>,
    ) -> Marks {
        let Self { backend, count, rest, points, .. } = self;
        let (has_pole, count) = (energy.has_pole(), *count);
        f64::with_workspace(|Workspace { blocks, line, .. }| {
            let refused = energy.blocks(self.stretched(), blocks);
            let judged = f64::judge(*backend, Judge { points, blocks, count, filter, has_pole });
            let (blocks, rest) = (&*blocks, rest.source());
            let to = by_elements(gradients);
            let kernel = Forces { points, gradients: &blocks.0, rest, count, line, to };
            let forced = f64::forces(*backend, kernel);
            let kernel = Respond { points, blocks, rest, count, has_pole, line, to: stiffnesses };
            let marks = f64::stiffness(*backend, form, kernel).or(forced).or(judged);
            Marks { refused, ..marks }
        })
    }

    fn stretched(&self) -> TileOf<'_, f64> {
        TileOf { backend: self.backend, start: 0, count: self.count, arguments: &self.points.stretches }
    }
}

/// The shapes at rest of a tile's elements.
#[derive(Clone, Debug)]
pub(crate) struct RestShapes(Lines<f64, 10>);

impl RestShapes {
    pub(crate) fn new(shapes: impl Iterator<Item = RestShape>) -> Self {
        let mut lines = Lines::zero();
        for (lane, shape) in shapes.enumerate() {
            let numbers = shape.inverse.as_flattened().iter().chain([&shape.volume]);
            for (k, &number) in numbers.enumerate() {
                lines.set(lane, k, number);
            }
        }
        Self(lines)
    }

    pub(super) fn source(&self) -> Source<'_, f64, 10> {
        self.0.source()
    }
}

/// Stores Ds: row a, column k is coordinate a of corner k + 1 less that of corner 0.
#[inline]
pub(super) fn set_edges(edges: &mut Lines<f64, 9>, lane: usize, [x0, x1, x2, x3]: [[f64; 3]; 4]) {
    for a in 0..3 {
        edges.set(lane, 3 * a, x1[a] - x0[a]);
        edges.set(lane, 3 * a + 1, x2[a] - x0[a]);
        edges.set(lane, 3 * a + 2, x3[a] - x0[a]);
    }
}

pub(super) fn by_elements(to: &mut [f64]) -> Sink<'_, f64> {
    Sink { to, layout: Layout::Points, non_temporal: None }
}
