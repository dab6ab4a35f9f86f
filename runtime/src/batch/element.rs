//! A tile of linear tetrahedra: the stages of a batch with the memory between them kept, for solvers that
//! come back.
//!
//! One decomposition of each element serves the energy, the gradient and the stiffness.

use super::material::{Arguments, TileMaterial};
use super::operator::StiffnessFactors;
use super::rest::{RestShapes, by_elements};
use super::sink::Sink;
use super::stage::{Decompose, Deform, Forces, Judge, Respond, Stages, StiffnessForm};
use super::svd_tile::SvdTile;
use super::tetrahedra::set_edges;
use super::workspace::Workspace;
use crate::lanes::Backend;
use crate::mesh::RestShape;
use crate::point::Filter;
use crate::status::Status;

pub(crate) use super::tile::TILE;

/// Up to [`TILE`] elements of one material.
#[derive(Clone, Debug)]
pub(crate) struct ElementTile {
    backend: Backend,
    count: usize,
    rest: RestShapes,
    volumes: [f64; TILE],
    points: SvdTile<f64>,
}

impl ElementTile {
    pub(crate) fn new(backend: Backend, shapes: impl Iterator<Item = RestShape>) -> Self {
        let mut volumes = [0.0; TILE];
        let mut count = 0;
        let rest = RestShapes::new(shapes.inspect(|shape| {
            volumes[count] = shape.volume;
            count += 1;
        }));
        Self { backend, count, rest, volumes, points: SvdTile::new() }
    }

    /// λ1, λ2, λ3 of an element, as evaluated last.
    pub(crate) fn stretches(&self, lane: usize) -> [f64; 3] {
        let rows = &self.points.stretches.0;
        [rows[0][lane], rows[1][lane], rows[2][lane]]
    }

    /// Decomposes F and evaluates energies, J; `corners` are the positions of each element's nodes.
    pub(crate) fn evaluate(
        &mut self,
        material: &dyn TileMaterial<f64>,
        corners: impl Iterator<Item = [[f64; 3]; 4]>,
        energies: &mut [f64],
    ) -> Status<u64> {
        let Self { backend, count, ref rest, ref mut points, .. } = *self;
        let is_signed = material.properties().ends_at_zero_volume;
        f64::with_workspace(|Workspace { F: edges, .. }| {
            for (lane, corners) in corners.enumerate() {
                set_edges(edges, lane, corners);
            }
            f64::deform(backend, Deform { edges, rest: rest.source(), count });
            f64::decompose(backend, Decompose { F: edges.source(), count, is_signed, points });
        });
        f64::with_workspace(|Workspace { energies: densities, .. }| {
            let status = material.tile_energies(self.stretched(), densities);
            for ((energy, density), volume) in energies.iter_mut().zip(densities.0[0]).zip(self.volumes) {
                *energy = volume * density;
            }
            status
        })
    }

    /// Gradients of the energies evaluated last, N, 12 components each.
    pub(crate) fn gradients(&self, material: &dyn TileMaterial<f64>, gradients: &mut [f64]) -> Status<u64> {
        f64::with_workspace(|Workspace { gradients: principal, line, .. }| {
            let refused = material.tile_gradients(self.stretched(), principal);
            let kernel = Forces {
                points: &self.points,
                gradients: &principal.0,
                rest: self.rest.source(),
                count: self.count,
                line,
                to: by_elements(gradients),
            };
            refused | f64::forces(self.backend, kernel)
        })
    }

    /// Gradients, N, and filtered stiffnesses as the blocks of node pairs, N/m, 90 entries each.
    pub(crate) fn stiffnesses(
        &self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        stiffnesses: &mut [f64],
    ) -> Status<u64> {
        self.respond(material, filter, gradients, StiffnessForm::Blocks, by_elements(stiffnesses))
    }

    /// Gradients, N, and filtered stiffnesses as their factors U, W, ψij, flips, twists.
    pub(crate) fn factored_stiffnesses(
        &self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        factors: &mut StiffnessFactors,
    ) -> Status<u64> {
        self.respond(material, filter, gradients, StiffnessForm::Factored, factors.sink())
    }

    fn respond(
        &self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        form: StiffnessForm,
        stiffnesses: Sink<'_, f64>,
    ) -> Status<u64> {
        let Self { backend, count, rest, points, .. } = self;
        let (has_pole, count) = (material.properties().has_pole, *count);
        f64::with_workspace(|Workspace { blocks, line, .. }| {
            let refused = material.tile_blocks(self.stretched(), blocks);
            let judged = f64::judge(*backend, Judge { points, blocks, count, filter, has_pole });
            let (blocks, rest) = (&*blocks, rest.source());
            let to = by_elements(gradients);
            let kernel = Forces { points, gradients: &blocks.0, rest, count, line, to };
            let forced = f64::forces(*backend, kernel);
            let kernel = Respond { points, blocks, rest, count, has_pole, line, to: stiffnesses };
            f64::stiffness(*backend, form, kernel) | forced | judged | refused
        })
    }

    fn stretched(&self) -> Arguments<'_, f64> {
        Arguments { backend: self.backend, start: 0, count: self.count, rows: &self.points.stretches }
    }
}
