//! Many points, one after the other: in the plane, and from displacement gradients.
//!
//! A [`PointBatch`] computes what lanes side by side would gain nothing from, such as a free stretch, whose
//! search takes another number of steps at each point. Every point has the bits that it has alone; points are
//! shared among threads if asked for, and nothing is allocated.

use super::jobs::{Tile, Work, for_each_tile};
use super::{LengthError, Stages};
use crate::point::Filter;
use crate::status::{Status, StatusCell, Survey};

mod displacement;
mod plane;

/// A material with the settings to evaluate it at many points, one after the other.
#[derive(Debug)]
#[non_exhaustive]
pub struct PointBatch<'a, M: ?Sized> {
    /// The material of all points.
    pub material: &'a M,
    /// Treatment of negative eigenvalues of dP/dF.
    pub filter: Filter,
    /// Whether the points are shared among the threads of rayon's pool.
    pub threads: bool,
    statuses: &'a [StatusCell],
}

impl<M: ?Sized> Copy for PointBatch<'_, M> {}

impl<M: ?Sized> Clone for PointBatch<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<'a, M: ?Sized> PointBatch<'a, M> {
    /// A batch without filter, on one thread.
    #[must_use]
    pub fn new(material: &'a M) -> Self {
        Self { material, filter: Filter::None, threads: false, statuses: &[] }
    }

    /// Sets the filter of dP/dF.
    #[must_use]
    pub fn with_filter(self, filter: Filter) -> Self {
        Self { filter, ..self }
    }

    /// Sets whether the points are shared among the threads of rayon's pool.
    #[must_use]
    pub fn with_threads(self, threads: bool) -> Self {
        Self { threads, ..self }
    }

    /// Writes the status of every point, one entry each, at every call.
    #[must_use]
    pub fn with_statuses(self, statuses: &'a [StatusCell]) -> Self {
        Self { statuses, ..self }
    }

    /// Computes every point of slices, each given with its name and the components it holds for a point.
    fn run<E: Stages, const I: usize, const O: usize>(
        &self,
        inputs: [(&'static str, &[E], usize); I],
        outputs: [(&'static str, &mut [E], usize); O],
        point: impl Fn([&[E]; I], [&mut [E]; O]) -> Status + Sync,
    ) -> Result<Survey, LengthError> {
        let (_, first, components) = inputs[0];
        let points = first.len() / components;
        let lengths = inputs.iter().map(|(name, slice, components)| (*name, slice.len(), *components));
        let lengths =
            lengths.chain(outputs.iter().map(|(name, slice, components)| (*name, slice.len(), *components)));
        let statuses = (!self.statuses.is_empty()).then_some(("statuses", self.statuses.len(), 1));
        let misfit = lengths.chain(statuses).find(|(_, length, components)| *length != points * components);
        if let Some((slice, found, components)) = misfit {
            return Err(LengthError { slice, found, components, points, group: 1 });
        }
        let sizes = (inputs.map(|(_, _, size)| size), std::array::from_fn(|k| outputs[k].2));
        let work = Work {
            inputs: inputs.map(|(_, slice, components)| (slice, components)),
            outputs: outputs.map(|(_, slice, components)| (slice, components)),
            statuses: self.statuses,
        };
        Ok(for_each_tile(work, 0..points, self.threads, &|tile| one_by_one(tile, sizes, &point)))
    }
}

/// The points of a tile, one after the other.
fn one_by_one<E: Stages, const I: usize, const O: usize>(
    tile: Tile<'_, E, I, O>,
    (inputs, outputs): ([usize; I], [usize; O]),
    point: &impl Fn([&[E]; I], [&mut [E]; O]) -> Status,
) -> Status<u64> {
    let Tile { count, inputs: from, outputs: mut to, .. } = tile;
    let mut statuses = Status::<u64>::default();
    for p in 0..count {
        let mut sizes = outputs.iter();
        let to = to.each_mut().map(|slice| {
            let size = sizes.next().copied().unwrap_or_default();
            &mut slice[p * size..][..size]
        });
        let Status { refused, bounded, nonfinite, filtered } =
            point(std::array::from_fn(|k| &from[k][p * inputs[k]..][..inputs[k]]), to);
        statuses.refused |= u64::from(refused) << p;
        statuses.bounded |= u64::from(bounded) << p;
        statuses.nonfinite |= u64::from(nonfinite) << p;
        statuses.filtered |= u64::from(filtered) << p;
    }
    statuses
}
