//! A tile of linear tetrahedra: the stages of a batch with the memory between them kept, for solvers that
//! come back.
//!
//! One decomposition of each element serves the energy, the gradient and the stiffness. For an energy of I1,
//! I2 and J alone there is none, unless a filter asks for one or an element is outside of what the invariants
//! serve: then all elements of the tile are decomposed.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::material::{Arguments, Properties, TileMaterial};
use super::rest::{RestShapes, by_elements};
use super::sink::{Lines, Sink};
use super::stage::{
    Decompose, Deform, Forces, Invariants, Judge, Respond, RespondByInvariants, Stages, StiffnessForm,
    StressByInvariants,
};
use super::svd_tile::SvdTile;
use super::tetrahedra::set_edges;
use super::tile::{Rows, first_bits};
use super::workspace::Workspace;
use crate::lanes::Backend;
use crate::mesh::RestShape;
use crate::point::matrix::to_matrix;
use crate::point::{Filter, Matrix3};
use crate::status::Status;

pub(crate) use super::tile::TILE;

/// Up to [`TILE`] elements of one material.
#[derive(Clone, Debug)]
pub(crate) struct ElementTile {
    backend: Backend,
    /// Index of the first element among those of the material.
    start: usize,
    count: usize,
    rest: RestShapes,
    volumes: [f64; TILE],
    F: Lines<f64, 9>,
    /// The decomposition of F; `None` while the invariants serve all elements.
    points: Option<Box<SvdTile<f64>>>,
}

impl ElementTile {
    /// Elements of which the first is number `start` of the material's.
    pub(crate) fn new(backend: Backend, start: usize, shapes: impl Iterator<Item = RestShape>) -> Self {
        let mut volumes = [0.0; TILE];
        let mut count = 0;
        let rest = RestShapes::new(shapes.inspect(|shape| {
            volumes[count] = shape.volume;
            count += 1;
        }));
        Self { backend, start, count, rest, volumes, F: Lines::zero(), points: None }
    }

    /// F of an element, as evaluated last.
    pub(crate) fn deformation_gradient(&self, lane: usize) -> Matrix3<f64> {
        to_matrix(self.F.get(lane))
    }

    /// Evaluates energies, J; `corners` are the positions of each element's nodes.
    pub(crate) fn evaluate(
        &mut self,
        material: &dyn TileMaterial<f64>,
        corners: impl Iterator<Item = [[f64; 3]; 4]>,
        energies: &mut [f64],
    ) -> Status<u64> {
        let Self { backend, start, count, ref rest, F: ref mut edges, .. } = *self;
        for (lane, corners) in corners.enumerate() {
            set_edges(edges, lane, corners);
        }
        f64::deform(backend, Deform { edges, rest: rest.source(), count });
        f64::with_workspace(|Workspace { invariants, energies: densities, .. }| {
            let is_served = material.properties().has_energy_by_invariants
                && self
                    .serves(material, invariants, |at| material.tile_energies_by_invariants(at, densities));
            let status = if is_served {
                self.points = None;
                Status::default()
            } else {
                let points = decompose(&mut self.points, backend, &self.F, count, material);
                material.tile_energies(arguments(backend, start, count, &points.stretches), densities)
            };
            for ((energy, density), volume) in energies.iter_mut().zip(densities.0[0]).zip(self.volumes) {
                *energy = volume * density;
            }
            status
        })
    }

    /// Gradients of the energies evaluated last, N, 12 components each.
    pub(crate) fn gradients(
        &mut self,
        material: &dyn TileMaterial<f64>,
        gradients: &mut [f64],
    ) -> Status<u64> {
        f64::with_workspace(|Workspace { invariants, gradients: principal, line, .. }| {
            if self.points.is_none()
                && self
                    .serves(material, invariants, |at| material.tile_gradients_by_invariants(at, principal))
            {
                let kernel = StressByInvariants {
                    F: self.F.source(),
                    gradients: principal,
                    has_second_invariant: material.properties().has_second_invariant,
                    rest: self.rest.source(),
                    count: self.count,
                    line,
                    to: by_elements(gradients),
                };
                if f64::forces_by_invariants(self.backend, kernel) == first_bits(self.count) {
                    return Status::default();
                }
            }
            let Self { backend, start, count, ref rest, ref F, ref mut points, .. } = *self;
            let points = decomposed(points, backend, F, count, material);
            let refused =
                material.tile_gradients(arguments(backend, start, count, &points.stretches), principal);
            let (gradients, to) = (&principal.0, by_elements(gradients));
            let kernel = Forces { points, gradients, rest: rest.source(), count, line, to };
            refused | f64::forces(backend, kernel)
        })
    }

    /// Gradients, N, and filtered stiffnesses as the blocks of node pairs, N/m, 90 entries each.
    pub(crate) fn stiffnesses(
        &mut self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        stiffnesses: &mut [f64],
    ) -> Status<u64> {
        if filter == Filter::None && self.stiffnesses_by_invariants(material, gradients, stiffnesses) {
            return Status::default();
        }
        self.respond(material, filter, gradients, StiffnessForm::Blocks, by_elements(stiffnesses))
    }

    /// Gradients and unfiltered stiffnesses by invariants. Returns whether these serve all elements; else the
    /// outputs mean nothing.
    fn stiffnesses_by_invariants(
        &self,
        material: &dyn TileMaterial<f64>,
        gradients: &mut [f64],
        stiffnesses: &mut [f64],
    ) -> bool {
        let Properties { has_invariants, has_second_invariant, curvature, .. } = material.properties();
        f64::with_workspace(|Workspace { invariants, derivatives, line, short_line, .. }| {
            let is_served = has_invariants
                && self.serves(material, invariants, |at| {
                    material.tile_derivatives_by_invariants(at, derivatives)
                });
            let kernel = RespondByInvariants {
                F: self.F.source(),
                invariants,
                derivatives,
                has_second_invariant,
                curvature,
                rest: self.rest.source(),
                count: self.count,
                line,
                short_line,
                first: by_elements(gradients),
                second: by_elements(stiffnesses),
            };
            is_served
                && f64::stiffness_by_invariants(self.backend, StiffnessForm::Blocks, kernel)
                    == first_bits(self.count)
        })
    }

    fn respond(
        &mut self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        form: StiffnessForm,
        stiffnesses: Sink<'_, f64>,
    ) -> Status<u64> {
        let Self { backend, start, count, ref rest, ref F, ref mut points, .. } = *self;
        let points = decomposed(points, backend, F, count, material);
        let has_pole = material.properties().has_pole;
        f64::with_workspace(|Workspace { blocks, line, .. }| {
            let refused = material.tile_blocks(arguments(backend, start, count, &points.stretches), blocks);
            let judged = f64::judge(backend, Judge { points, blocks, count, filter, has_pole });
            let (blocks, rest) = (&*blocks, rest.source());
            let to = by_elements(gradients);
            let kernel = Forces { points, gradients: &blocks.0, rest, count, line, to };
            let forced = f64::forces(backend, kernel);
            let kernel = Respond { points, blocks, rest, count, has_pole, line, to: stiffnesses };
            f64::stiffness(backend, form, kernel) | forced | judged | refused
        })
    }

    /// Computes the invariants, and with them a response of the material. Returns whether both are good for
    /// all elements.
    fn serves(
        &self,
        material: &dyn TileMaterial<f64>,
        invariants: &mut Rows<f64, 3>,
        respond: impl FnOnce(Arguments<'_, f64>) -> Status<u64>,
    ) -> bool {
        let Self { backend, start, count, ref F, .. } = *self;
        let has_second_invariant = material.properties().has_second_invariant;
        let kernel = Invariants { F: F.source(), count, has_second_invariant, invariants };
        let in_range = f64::invariants(backend, kernel);
        if in_range != first_bits(count) {
            return false;
        }
        let status = respond(arguments(backend, start, count, invariants));
        status.refused | status.nonfinite == 0
    }
}

/// The decomposition, made unless there is one.
fn decomposed<'a>(
    points: &'a mut Option<Box<SvdTile<f64>>>,
    backend: Backend,
    F: &Lines<f64, 9>,
    count: usize,
    material: &dyn TileMaterial<f64>,
) -> &'a SvdTile<f64> {
    match points {
        Some(points) => points,
        points => decompose(points, backend, F, count, material),
    }
}

/// The decomposition, made anew.
fn decompose<'a>(
    points: &'a mut Option<Box<SvdTile<f64>>>,
    backend: Backend,
    F: &Lines<f64, 9>,
    count: usize,
    material: &dyn TileMaterial<f64>,
) -> &'a SvdTile<f64> {
    let points = points.get_or_insert_with(|| Box::new(SvdTile::new()));
    let is_signed = material.properties().ends_at_zero_volume;
    f64::decompose(backend, Decompose { F: F.source(), count, is_signed, points });
    points
}

fn arguments(backend: Backend, start: usize, count: usize, rows: &Rows<f64, 3>) -> Arguments<'_, f64> {
    Arguments { backend, start, count, rows }
}
