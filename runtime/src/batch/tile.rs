//! Stages of a tile: by the invariants if possible, by a decomposition elsewhere.
//!
//! Batches lend each tile the memory of a thread. Bodies keep F, shapes at rest and decompositions of their
//! tiles between calls ([`element`](super::element)).

#![expect(non_snake_case, reason = "F as in the literature")]

use super::material::{Arguments, Properties, TileMaterial};
use crate::kernels::Kernels;
use crate::kernels::deformation::{Decompose, Invariants};
use crate::kernels::form::Outputs;
use crate::kernels::rows::{Rows, first_bits};
use crate::kernels::sink::{Layout, Sink, Source};
use crate::kernels::stress::{Stress, StressByInvariants};
use crate::kernels::svd_tile::SvdTile;
use crate::kernels::tangents::{FilterBlocks, Tangents, TangentsByInvariants};
use crate::kernels::workspace::{Scratch, Workspace};
use crate::lanes::Backend;
use crate::material::ResponseKind;
use crate::point::Filter;
use crate::point::invariants::Needed;
use crate::status::Status;

/// Material and settings that all tiles of a call share.
#[derive(Clone, Copy)]
pub(super) struct Call<'a, E> {
    pub(super) material: &'a dyn TileMaterial<E>,
    pub(super) properties: Properties,
    pub(super) filter: Filter,
    pub(super) backend: Backend,
    pub(super) layout: Layout,
    /// True if decompositions are kept for later calls. The invariants are then used for all points of a tile
    /// or for none, so that a decomposition covers all points.
    pub(super) keeps_svd: bool,
}

impl<E: Kernels> Call<'_, E> {
    /// Sink for the points that are not in `served`.
    pub(super) fn sink<'t>(&self, to: &'t mut [E], served: u64) -> Sink<'t, E> {
        Sink { to, layout: self.layout, served }
    }
}

/// A tile of a call that a thread computes in its memory.
pub(super) struct Job<'a, E> {
    pub(super) call: Call<'a, E>,
    pub(super) workspace: &'a mut Workspace<E>,
    /// Number of the first point.
    pub(super) start: usize,
    /// Number of points.
    pub(super) count: usize,
}

impl<'a, E: Kernels> Job<'a, E> {
    /// The tile of points with these deformation gradients.
    pub(super) fn points(self, F: &'a [E]) -> Tile<'a, E> {
        let Self { call, workspace, start, count } = self;
        let Workspace { F: lines, svd, scratch, .. } = workspace;
        let F = Source::new(call.backend, call.layout, F, lines);
        Tile { call, start, count, F, outputs: Outputs::Points, svd, is_decomposed: false, scratch }
    }
}

/// A tile of points, or of elements with their shapes at rest, and its memory.
pub(super) struct Tile<'t, E> {
    pub(super) call: Call<'t, E>,
    /// Number of the first point.
    pub(super) start: usize,
    /// Number of points.
    pub(super) count: usize,
    pub(super) F: Source<'t, E, 9>,
    pub(super) outputs: Outputs<'t, E>,
    pub(super) svd: &'t mut SvdTile<E>,
    /// True if [`svd`](Self::svd) is the decomposition of F.
    pub(super) is_decomposed: bool,
    pub(super) scratch: &'t mut Scratch<E>,
}

impl<E: Kernels> Tile<'_, E> {
    /// Energies.
    #[inline(always)] // a call per tile is 1 % of a cheap kernel
    pub(super) fn energies(&mut self, energies: &mut [E]) -> Status<u64> {
        let Properties { has_energy_by_invariants, has_second_invariant, curvature, .. } =
            self.call.properties;
        let needed = Needed::of(ResponseKind::EnergyByInvariants, has_second_invariant, curvature);
        let in_range = if has_energy_by_invariants { self.invariants(needed) } else { 0 };
        let served = self.energies_by_invariants(in_range, energies);
        if served == first_bits(self.count) {
            return Status::default();
        }
        self.decompose(served);
        self.energies_by_stretches(served, energies) & !served
    }

    /// Stresses of points, or gradients of elements.
    #[inline(always)] // a call per tile is 1 % of a cheap kernel
    pub(super) fn stresses(&mut self, to: &mut [E]) -> Status<u64> {
        let call = self.call;
        // The decomposition of an earlier call costs nothing.
        let needed = self.needed_for_derivatives();
        let mut served = if self.is_decomposed { 0 } else { self.invariants(needed) };
        if served != 0 {
            let arguments = self.arguments(&self.scratch.invariants);
            let gradients = &mut self.scratch.gradients;
            served &= !call.material.tile_gradients_by_invariants(arguments, gradients).refused;
            let kernel = StressByInvariants {
                F: self.F,
                gradients: &self.scratch.gradients,
                needed,
                outputs: self.outputs,
                count: self.count,
                line: &mut self.scratch.line,
                to: call.sink(to, 0),
            };
            served &= E::stress_by_invariants(call.backend, kernel);
            served = self.accepted(served);
        }
        if served == first_bits(self.count) {
            return Status::default();
        }
        self.decompose(served);
        let refused = self.gradients();
        let Scratch { gradients, line, .. } = &mut *self.scratch;
        let kernel = Stress {
            points: self.svd,
            gradients: &gradients.0,
            outputs: self.outputs,
            count: self.count,
            line,
            to: call.sink(to, served),
        };
        (refused | E::stress(call.backend, kernel)) & !served
    }

    /// Stresses and tangents, or gradients and stiffnesses of elements; energies, too, if there is an output
    /// for them.
    pub(super) fn tangents(
        &mut self,
        first: &mut [E],
        second: &mut [E],
        mut energies: Option<&mut [E]>,
    ) -> Status<u64> {
        let call = self.call;
        let Properties { has_energy_by_invariants, has_second_invariant, curvature, has_pole, .. } =
            call.properties;
        let needed = match energies {
            None => self.needed_for_derivatives(),
            Some(_) => Needed::of(ResponseKind::EnergyByInvariants, has_second_invariant, curvature),
        };
        let mut served = if energies.is_none() || has_energy_by_invariants {
            self.derivatives_by_invariants(needed)
        } else {
            0
        };
        if let Some(energies) = energies.as_deref_mut() {
            served = self.energies_by_invariants(served, energies);
        }
        if served != 0 {
            let Scratch { invariants, derivatives, line, short_line, .. } = &mut *self.scratch;
            let kernel = TangentsByInvariants {
                F: self.F,
                invariants,
                derivatives,
                has_second_invariant,
                curvature,
                outputs: self.outputs,
                count: self.count,
                line,
                short_line,
                first: call.sink(first, 0),
                second: call.sink(second, 0),
            };
            served &= E::tangents_by_invariants(call.backend, kernel);
            served = self.accepted(served);
        }
        if served == first_bits(self.count) {
            return Status::default();
        }
        self.decompose(served);
        let mut status = self.blocks();
        if let Some(energies) = energies {
            status = status | self.energies_by_stretches(served, energies);
        }
        let (points, outputs, count) = (&*self.svd, self.outputs, self.count);
        let Scratch { blocks, line, .. } = &mut *self.scratch;
        let to = call.sink(first, served);
        let kernel = Stress { points, gradients: &blocks.0, outputs, count, line, to };
        let stressed = E::stress(call.backend, kernel);
        let to = call.sink(second, served);
        let kernel = Tangents { points, blocks, outputs, count, has_pole, line, to };
        (E::tangents(call.backend, kernel) | stressed | status) & !served
    }

    /// Decomposes F at the points that are not in `served`, unless that has been done. Elsewhere frames and
    /// stretches may be those of another tile: results computed from them are discarded.
    pub(super) fn decompose(&mut self, served: u64) {
        if !self.is_decomposed {
            let is_signed = self.call.properties.ends_at_zero_volume;
            let kernel = Decompose { F: self.F, count: self.count, served, is_signed, points: self.svd };
            E::decompose(self.call.backend, kernel);
            self.is_decomposed = served == 0;
        }
    }

    /// Gradients of the energy in the stretches of a decomposed tile.
    pub(super) fn gradients(&mut self) -> Status<u64> {
        let arguments = self.arguments(&self.svd.stretches);
        self.call.material.tile_gradients(arguments, &mut self.scratch.gradients)
    }

    /// The filtered blocks of a decomposed tile.
    pub(super) fn blocks(&mut self) -> Status<u64> {
        let Call { material, properties: Properties { has_pole, .. }, filter, backend, .. } = self.call;
        let arguments = self.arguments(&self.svd.stretches);
        let blocks = &mut self.scratch.blocks;
        let refused = material.tile_blocks(arguments, blocks);
        refused
            | E::filter_blocks(
                backend,
                FilterBlocks { points: self.svd, blocks, count: self.count, filter, has_pole },
            )
    }

    /// Invariants that P and dP/dF depend on.
    fn needed_for_derivatives(&self) -> Needed {
        let Properties { has_second_invariant, curvature, .. } = self.call.properties;
        Needed::of(ResponseKind::DerivativesByInvariants, has_second_invariant, curvature)
    }

    /// Computes the invariants if the energy depends on them alone. Returns the points in range: none for any
    /// other energy.
    fn invariants(&mut self, needed: Needed) -> u64 {
        if !self.call.properties.has_invariants {
            return 0;
        }
        let invariants = &mut self.scratch.invariants;
        let kernel = Invariants { F: self.F, count: self.count, needed, invariants };
        let in_range = E::invariants(self.call.backend, kernel);
        self.accepted(in_range)
    }

    /// Computes the derivatives by the invariants if these give the tangents. Returns the points for which
    /// they do.
    fn derivatives_by_invariants(&mut self, needed: Needed) -> u64 {
        // What a filter changes is seen in the principal frames alone.
        if self.call.filter != Filter::None {
            return 0;
        }
        let in_range = self.invariants(needed);
        if in_range == 0 {
            return 0;
        }
        let arguments = self.arguments(&self.scratch.invariants);
        let derivatives = &mut self.scratch.derivatives;
        let status = self.call.material.tile_derivatives_by_invariants(arguments, derivatives);
        self.accepted(in_range & !(status.refused | status.nonfinite))
    }

    /// Computes energies by the invariants. Returns the points for which these are used.
    fn energies_by_invariants(&mut self, in_range: u64, energies: &mut [E]) -> u64 {
        if in_range == 0 {
            return 0;
        }
        let arguments = self.arguments(&self.scratch.invariants);
        let densities = &mut self.scratch.energies;
        let status = self.call.material.tile_energies_by_invariants(arguments, densities);
        energies.copy_from_slice(&densities.0[0][..energies.len()]);
        self.accepted(in_range & !(status.refused | status.nonfinite))
    }

    /// Computes the energies of the points of a decomposed tile that are not in `served`. Returns the status
    /// of all points.
    fn energies_by_stretches(&mut self, served: u64, energies: &mut [E]) -> Status<u64> {
        let arguments = self.arguments(&self.svd.stretches);
        let densities = &mut self.scratch.energies;
        let status = self.call.material.tile_energies(arguments, densities);
        for (point, energy) in energies.iter_mut().enumerate().filter(|(point, _)| served >> point & 1 == 0) {
            *energy = densities.0[0][point];
        }
        status
    }

    /// Points for which the invariants are used, given those for which they can be.
    fn accepted(&self, served: u64) -> u64 {
        if self.call.keeps_svd && served != first_bits(self.count) { 0 } else { served }
    }

    fn arguments<'r>(&self, rows: &'r Rows<E, 3>) -> Arguments<'r, E> {
        let Call { backend, properties: Properties { curvature, has_second_invariant, .. }, .. } = self.call;
        Arguments { backend, start: self.start, count: self.count, curvature, has_second_invariant, rows }
    }
}
