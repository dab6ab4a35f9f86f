//! The way of a tile through the stages: by the invariants where they serve, by a decomposition elsewhere.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use super::REST;
use super::form::MatrixForm;
use super::material::{Arguments, Properties, TileMaterial};
use super::sink::{Layout, Sink, Source};
use super::stage::{
    Decompose, Forces, Invariants, Judge, Respond, RespondByInvariants, Stages, StiffnessForm, Stress,
};
use super::svd_tile::SvdTile;
use super::tile::{Rows, first_bits};
use super::workspace::{Rooms, Workspace};
use crate::lanes::{Backend, NonTemporal};
use crate::point::Filter;
use crate::status::Status;

/// Material and settings that all tiles of a call share.
#[derive(Clone, Copy)]
pub(super) struct Call<'a, E> {
    pub(super) material: &'a dyn TileMaterial<E>,
    pub(super) properties: Properties,
    pub(super) filter: Filter,
    pub(super) backend: Backend,
    pub(super) layout: Layout,
    pub(super) streams: bool,
}

impl<E: Stages> Call<'_, E> {
    /// The deformation gradients of a tile, and room for what comes of them.
    pub(super) fn enter<'w>(
        &self,
        workspace: &'w mut Workspace<E>,
        F: &'w [E],
    ) -> (Source<'w, E, 9>, Rooms<'w, E>) {
        let (lines, _, rooms) = workspace.for_elements();
        (Source::new(self.backend, self.layout, F, lines), rooms)
    }

    pub(super) fn decompose(&self, F: Source<'_, E, 9>, count: usize, points: &mut SvdTile<E>) {
        let is_signed = self.properties.ends_at_zero_volume;
        E::decompose(self.backend, Decompose { F, count, is_signed, points });
    }

    /// The invariants of a tile whose energy is one of them. Returns the points in range: none for any other.
    pub(super) fn invariants(&self, F: Source<'_, E, 9>, count: usize, invariants: &mut Rows<E, 3>) -> u64 {
        if !self.properties.has_invariants {
            return 0;
        }
        let has_second_invariant = self.properties.has_second_invariant;
        E::invariants(self.backend, Invariants { F, count, has_second_invariant, invariants })
    }

    /// Derivatives by the invariants, where they give the tangents of a tile. Returns these points.
    pub(super) fn derivatives_by_invariants(
        &self,
        F: Source<'_, E, 9>,
        start: usize,
        count: usize,
        invariants: &mut Rows<E, 3>,
        derivatives: &mut Rows<E, 9>,
    ) -> u64 {
        // What a filter changes is seen in the principal frames alone.
        if self.filter != Filter::None {
            return 0;
        }
        let in_range = self.invariants(F, count, invariants);
        if in_range == 0 {
            return 0;
        }
        let arguments = self.arguments(invariants, start, count);
        let status = self.material.tile_derivatives_by_invariants(arguments, derivatives);
        in_range & !(status.refused | status.nonfinite)
    }

    /// Energies of those points of a tile that the invariants serve, which it returns.
    pub(super) fn energies_by_invariants(
        &self,
        in_range: u64,
        invariants: &Rows<E, 3>,
        start: usize,
        values: &mut Rows<E, 1>,
        energies: &mut [E],
    ) -> u64 {
        if in_range == 0 {
            return 0;
        }
        let arguments = self.arguments(invariants, start, energies.len());
        let status = self.material.tile_energies_by_invariants(arguments, values);
        energies.copy_from_slice(&values.0[0][..energies.len()]);
        in_range & !(status.refused | status.nonfinite)
    }

    /// Energies of the points of a decomposed tile that are not served yet, and the status of all.
    pub(super) fn energies(
        &self,
        points: &SvdTile<E>,
        start: usize,
        served: u64,
        values: &mut Rows<E, 1>,
        energies: &mut [E],
    ) -> Status<u64> {
        let arguments = self.arguments(&points.stretches, start, energies.len());
        let status = self.material.tile_energies(arguments, values);
        for (point, energy) in energies.iter_mut().enumerate().filter(|(point, _)| served >> point & 1 == 0) {
            *energy = values.0[0][point];
        }
        status
    }

    /// Stresses and tangents of a tile, and its energies if they are asked for.
    #[expect(clippy::too_many_arguments, reason = "a tile with its rooms and its outputs")]
    pub(super) fn respond(
        &self,
        form: MatrixForm,
        F: Source<'_, E, 9>,
        start: usize,
        count: usize,
        rooms: Rooms<'_, E>,
        P: &mut [E],
        tangents: &mut [E],
        mut energies: Option<&mut [E]>,
    ) -> Status<u64> {
        let Rooms { points, invariants, derivatives, energies: values, blocks, line, short_line } = rooms;
        let fence = self.fence();
        let mut served = if energies.is_none() || self.properties.has_energy_by_invariants {
            self.derivatives_by_invariants(F, start, count, invariants, derivatives)
        } else {
            0
        };
        if let Some(energies) = energies.as_deref_mut() {
            served = self.energies_by_invariants(served, invariants, start, values, energies);
        }
        if served != 0 {
            let kernel = RespondByInvariants {
                F,
                invariants,
                derivatives,
                has_second_invariant: self.properties.has_second_invariant,
                curvature: self.properties.curvature,
                rest: Source::NONE,
                count,
                line,
                short_line,
                first: self.sink(P, 0),
                second: self.large_sink(tangents, fence.as_ref(), 0),
            };
            served &= E::tangent_by_invariants(self.backend, form, kernel);
        }
        if served == first_bits(count) {
            return Status::default();
        }
        self.decompose(F, count, points);
        let mut status = self.blocks(points, start, count, blocks);
        if let Some(energies) = energies {
            status = status | self.energies(points, start, served, values, energies);
        }
        let kernel = Stress { points, gradients: &blocks.0, count, line, P: self.sink(P, served) };
        let stressed = E::stress(self.backend, kernel);
        let (has_pole, to) = (self.properties.has_pole, self.large_sink(tangents, fence.as_ref(), served));
        let kernel = Respond { points, blocks, rest: Source::NONE, count, has_pole, line, to };
        (E::tangent(self.backend, form, kernel) | stressed | status) & !served
    }

    /// Gradients and stiffnesses of a tile of elements.
    #[expect(clippy::too_many_arguments, reason = "a tile with its rooms and its outputs")]
    pub(super) fn respond_elements(
        &self,
        form: StiffnessForm,
        F: Source<'_, E, 9>,
        rest: Source<'_, E, REST>,
        start: usize,
        count: usize,
        rooms: Rooms<'_, E>,
        gradients: &mut [E],
        stiffnesses: &mut [E],
    ) -> Status<u64> {
        let Rooms { points, invariants, derivatives, blocks, line, short_line, .. } = rooms;
        let fence = self.fence();
        let mut served = self.derivatives_by_invariants(F, start, count, invariants, derivatives);
        if served != 0 {
            let kernel = RespondByInvariants {
                F,
                invariants,
                derivatives,
                has_second_invariant: self.properties.has_second_invariant,
                curvature: self.properties.curvature,
                rest,
                count,
                line,
                short_line,
                first: self.sink(gradients, 0),
                second: self.large_sink(stiffnesses, fence.as_ref(), 0),
            };
            served &= E::stiffness_by_invariants(self.backend, form, kernel);
        }
        if served == first_bits(count) {
            return Status::default();
        }
        self.decompose(F, count, points);
        let judged = self.blocks(points, start, count, blocks);
        let to = self.sink(gradients, served);
        let kernel = Forces { points, gradients: &blocks.0, rest, count, line, to };
        let forced = E::forces(self.backend, kernel);
        let (has_pole, to) = (self.properties.has_pole, self.large_sink(stiffnesses, fence.as_ref(), served));
        let kernel = Respond { points, blocks, rest, count, has_pole, line, to };
        (E::stiffness(self.backend, form, kernel) | forced | judged) & !served
    }

    /// The filtered blocks of a tile.
    pub(super) fn blocks(
        &self,
        points: &SvdTile<E>,
        start: usize,
        count: usize,
        blocks: &mut Rows<E, 15>,
    ) -> Status<u64> {
        let refused = self.material.tile_blocks(self.arguments(&points.stretches, start, count), blocks);
        let has_pole = self.properties.has_pole;
        refused | E::judge(self.backend, Judge { points, blocks, count, filter: self.filter, has_pole })
    }

    pub(super) fn arguments<'t>(&self, rows: &'t Rows<E, 3>, start: usize, count: usize) -> Arguments<'t, E> {
        Arguments { backend: self.backend, start, count, rows }
    }

    /// A sink for the points that are not served yet.
    pub(super) fn sink<'t>(&self, to: &'t mut [E], served: u64) -> Sink<'t, E> {
        Sink { to, layout: self.layout, non_temporal: None, served }
    }

    /// The guard of stores past the caches. A call without them has none: ordinary stores would wait for it.
    pub(super) fn fence(&self) -> Option<NonTemporal> {
        (self.streams && self.layout == Layout::Lines).then(NonTemporal::new)
    }

    /// A sink for outputs that may be larger than the caches, with the [`fence`](Self::fence) of this tile.
    pub(super) fn large_sink<'t>(
        &self,
        to: &'t mut [E],
        fence: Option<&'t NonTemporal>,
        served: u64,
    ) -> Sink<'t, E> {
        Sink { to, layout: self.layout, non_temporal: fence, served }
    }
}
