//! The tiles of a call, one after the other or shared among threads.

use crate::kernels::Kernels;
use crate::kernels::rows::TILE;
use crate::kernels::workspace::Workspace;
use crate::lanes::Scalar;
use crate::status::{Status, StatusCell, Survey};

/// Tiles that one thread takes without a further division: enough to pay for handing them over.
const GRAIN: usize = 8;

/// Slices of a call, each with its number of components per point.
pub(super) struct Work<'a, E, const I: usize, const O: usize> {
    pub(super) inputs: [(&'a [E], usize); I],
    pub(super) outputs: [(&'a mut [E], usize); O],
    /// One for each point, or none at all.
    pub(super) statuses: &'a [StatusCell],
}

impl<'a, E: Scalar, const I: usize, const O: usize> Work<'a, E, I, O> {
    /// Splits off the first `tiles` tiles, or all that are left if there are fewer.
    fn split_off(&mut self, tiles: usize) -> Self {
        let points = tiles * TILE;
        let inputs = self.inputs.each_mut().map(|(slice, numbers)| {
            let first = slice.split_off(..slice.len().min(points * *numbers));
            (first.unwrap_or_default(), *numbers)
        });
        let outputs = self.outputs.each_mut().map(|(slice, numbers)| {
            let first = slice.split_off_mut(..slice.len().min(points * *numbers));
            (first.unwrap_or_default(), *numbers)
        });
        let statuses = self.statuses.split_off(..self.statuses.len().min(points));
        Self { inputs, outputs, statuses: statuses.unwrap_or_default() }
    }
}

/// A tile of a call that a thread computes.
pub(super) struct Job<'a, E> {
    pub(super) workspace: &'a mut Workspace<E>,
    /// Number of the first point.
    pub(super) start: usize,
    /// Number of points.
    pub(super) count: usize,
}

/// Runs `body` for each tile of the points and adds up its statuses, in the order of the points.
pub(super) fn for_each_tile<E: Kernels, const I: usize, const O: usize>(
    mut work: Work<'_, E, I, O>,
    points: std::ops::Range<usize>,
    threads: bool,
    body: &(impl Fn(Job<'_, E>, [&[E]; I], [&mut [E]; O]) -> Status<u64> + Sync),
) -> Survey {
    let tiles = points.len().div_ceil(TILE);
    if threads && tiles > GRAIN {
        let half = tiles / 2;
        let middle = points.start + half * TILE;
        let first = work.split_off(half);
        let (first, later) = rayon::join(
            || for_each_tile(first, points.start..middle, threads, body),
            || for_each_tile(work, middle..points.end, threads, body),
        );
        return first + later;
    }
    E::with_workspace(|workspace| one_after_the_other(work, points, workspace, body))
}

fn one_after_the_other<E: Scalar, const I: usize, const O: usize>(
    mut work: Work<'_, E, I, O>,
    points: std::ops::Range<usize>,
    workspace: &mut Workspace<E>,
    body: &impl Fn(Job<'_, E>, [&[E]; I], [&mut [E]; O]) -> Status<u64>,
) -> Survey {
    let mut survey = Survey::default();
    for start in points.clone().step_by(TILE) {
        let tile = work.split_off(1);
        let status = body(
            Job { workspace, start, count: TILE.min(points.end - start) },
            tile.inputs.map(|(slice, _)| slice),
            tile.outputs.map(|(slice, _)| slice),
        );
        for (point, to) in tile.statuses.iter().enumerate() {
            to.set(status.of_point(point));
        }
        if status != Status::default() {
            survey = survey + Survey::of(status, start);
        }
    }
    survey
}
