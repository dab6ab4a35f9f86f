//! The tiles of a call, one after the other or shared among threads.

use std::ops::Range;

use super::tile::{Call, Job};
use crate::kernels::Kernels;
use crate::kernels::rows::TILE;
use crate::status::{Status, StatusCell, Survey};

/// Tiles that one thread takes without a further division: enough to pay for handing them over.
const GRAIN: usize = 8;

/// Points of a call, and its slices, each with its number of components per point.
pub(super) struct Work<'a, E, const I: usize, const O: usize> {
    pub(super) call: Call<'a, E>,
    pub(super) points: Range<usize>,
    pub(super) inputs: [(&'a [E], usize); I],
    pub(super) outputs: [(&'a mut [E], usize); O],
    /// One for each point, or none at all.
    pub(super) statuses: &'a [StatusCell],
}

impl<E: Kernels, const I: usize, const O: usize> Work<'_, E, I, O> {
    /// Splits off the first `tiles` tiles, or all that are left if there are fewer.
    #[inline]
    fn split_off(&mut self, tiles: usize) -> Self {
        let end = self.points.end.min(self.points.start + tiles * TILE);
        let points = self.points.start..end;
        self.points.start = end;
        let inputs = self.inputs.each_mut().map(|(slice, numbers)| {
            let first = slice.split_off(..points.len() * *numbers);
            (first.unwrap_or_default(), *numbers)
        });
        let outputs = self.outputs.each_mut().map(|(slice, numbers)| {
            let first = slice.split_off_mut(..points.len() * *numbers);
            (first.unwrap_or_default(), *numbers)
        });
        let statuses = self.statuses.split_off(..self.statuses.len().min(points.len()));
        Self { call: self.call, points, inputs, outputs, statuses: statuses.unwrap_or_default() }
    }
}

/// Runs `body` for each tile of the points and adds up its statuses, in the order of the points.
pub(super) fn for_each_tile<E: Kernels, const I: usize, const O: usize>(
    mut work: Work<'_, E, I, O>,
    threads: bool,
    body: &(impl for<'t> Fn(Job<'t, E>, [&'t [E]; I], [&'t mut [E]; O]) -> Status<u64> + Sync),
) -> Survey {
    let tiles = work.points.len().div_ceil(TILE);
    if threads && tiles > GRAIN {
        let first = work.split_off(tiles / 2);
        let (first, later) =
            rayon::join(|| for_each_tile(first, threads, body), || for_each_tile(work, threads, body));
        return first + later;
    }
    E::with_workspace(|workspace| {
        let mut survey = Survey::default();
        while !work.points.is_empty() {
            let Work { call, points, inputs, outputs, statuses } = work.split_off(1);
            let job = Job { call, workspace: &mut *workspace, start: points.start, count: points.len() };
            let status = body(job, inputs.map(|(slice, _)| slice), outputs.map(|(slice, _)| slice));
            for (point, to) in statuses.iter().enumerate() {
                to.set(status.of_point(point));
            }
            if status != Status::default() {
                survey = survey + Survey::of(status, points.start);
            }
        }
        survey
    })
}
