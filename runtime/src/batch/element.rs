//! A tile of linear tetrahedra whose memory is kept between calls, for solvers that come back.
//!
//! This is the interface between `piola` and `piola-bodies`: it may change with every version. Other codes
//! evaluate elements by [`Batch::stiffnesses_at`](super::Batch::stiffnesses_at).
//!
//! One decomposition of each element is used for the energy, the gradient and the stiffness. For an energy of
//! I1, I2 and J alone there is none, unless a filter requires one or an element is outside of the range of
//! the invariants: then all elements of the tile are decomposed.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::REST;
use super::material::TileMaterial;
use super::tetrahedra::set_edges;
use super::tile::{Call, Tile};
use crate::kernels::Kernels;
use crate::kernels::deformation::Deform;
use crate::kernels::form::Outputs;
use crate::kernels::sink::{Layout, Lines};
use crate::kernels::svd_tile::SvdTile;
use crate::kernels::workspace::Workspace;
use crate::lanes::Backend;
use crate::point::matrix::to_matrix;
use crate::point::{Filter, Matrix3, stretches_in_range, svd};
use crate::status::{Status, Survey};

pub use crate::kernels::form::MAX_STIFFNESS_RATIO;
pub use crate::kernels::rows::TILE;

/// Counts of the elements of a tile, of which the first has the index `start`.
#[must_use]
pub fn survey(status: Status<u64>, start: usize) -> Survey {
    Survey::of(status, start)
}

/// Up to [`TILE`] elements of one material.
#[derive(Clone, Debug)]
pub struct Elements {
    backend: Backend,
    /// Index of the first element among those of the material.
    start: usize,
    count: usize,
    /// Dm⁻¹ row by row and the volume of each.
    rest: Lines<f64, 10>,
    F: Lines<f64, 9>,
    /// Decomposition of F; `None` if the invariants are used for all elements.
    svd: Option<Box<SvdTile<f64>>>,
}

impl Elements {
    /// Elements of which the first is number `start` of the material's, with the rest shape of each: Dm⁻¹ row
    /// by row, 1/m, and the volume, m³.
    ///
    /// # Panics
    /// For more than [`TILE`] elements.
    pub fn new(start: usize, shapes: impl Iterator<Item = [f64; REST]>) -> Self {
        let (mut rest, mut count) = (Lines::zero(), 0);
        for shape in shapes {
            for (k, number) in shape.into_iter().enumerate() {
                rest.set(count, k, number);
            }
            count += 1;
        }
        let backend = Backend::best();
        Self { backend, start, count, rest, F: Lines::zero(), svd: None }
    }

    /// F of an element, as evaluated last.
    #[must_use]
    pub fn deformation_gradient(&self, lane: usize) -> Matrix3<f64> {
        to_matrix(self.F.get(lane))
    }

    /// True if the stretches of an element, as evaluated last, are finite and far enough from the ends of the
    /// range.
    #[must_use]
    pub fn is_in_range(&self, lane: usize) -> bool {
        stretches_in_range(svd(&self.deformation_gradient(lane)).stretches)
    }

    /// Evaluates energies, J; `corners` are the positions of each element's nodes.
    pub fn evaluate(
        &mut self,
        material: &dyn TileMaterial<f64>,
        corners: impl Iterator<Item = [[f64; 3]; 4]>,
        energies: &mut [f64],
    ) -> Status<u64> {
        for (lane, corners) in corners.enumerate() {
            set_edges(&mut self.F, lane, corners);
        }
        let Self { backend, count, ref rest, F: ref mut edges, .. } = *self;
        f64::deform(backend, Deform { edges, rest: rest.source(), count });
        let energies = &mut energies[..count];
        let status = self.run(material, Filter::None, |tile| {
            tile.is_decomposed = false;
            tile.energies(energies)
        });
        for (lane, energy) in energies.iter_mut().enumerate() {
            let [.., volume] = self.rest.get(lane);
            *energy *= volume;
        }
        status
    }

    /// Gradients of the energies evaluated last, N, 12 components each.
    pub fn gradients(&mut self, material: &dyn TileMaterial<f64>, gradients: &mut [f64]) -> Status<u64> {
        self.run(material, Filter::None, |tile| tile.stresses(gradients))
    }

    /// Gradients, N, and filtered stiffnesses as the blocks of node pairs, N/m, 90 entries each.
    pub fn stiffnesses(
        &mut self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        gradients: &mut [f64],
        stiffnesses: &mut [f64],
    ) -> Status<u64> {
        self.run(material, filter, |tile| tile.tangents(gradients, stiffnesses, None))
    }

    /// Runs stages, and keeps the decomposition if there is one.
    fn run(
        &mut self,
        material: &dyn TileMaterial<f64>,
        filter: Filter,
        stages: impl FnOnce(&mut Tile<'_, f64>) -> Status<u64>,
    ) -> Status<u64> {
        let Self { backend, start, count, ref rest, ref F, svd: ref mut kept } = *self;
        let call = Call {
            material,
            properties: material.properties(),
            filter,
            backend,
            layout: Layout::Points,
            keeps_svd: true,
        };
        f64::with_workspace(|Workspace { svd: spare, scratch, .. }| {
            let (F, outputs) = (F.source(), Outputs::ElementsByBlocks(rest.source()));
            let is_decomposed = kept.is_some();
            let svd = kept.as_deref_mut().unwrap_or(&mut *spare);
            let mut tile = Tile { call, start, count, F, outputs, svd, is_decomposed, scratch };
            let status = stages(&mut tile);
            match tile.is_decomposed {
                true => _ = kept.get_or_insert_with(|| Box::new(*spare)),
                false => *kept = None,
            }
            status
        })
    }
}
