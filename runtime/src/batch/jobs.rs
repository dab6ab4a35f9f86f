//! The tiles of a call, one after the other or shared among threads.

use super::stage::Stages;
use super::tile::TILE;
use super::workspace::Workspace;
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
    /// The first `tiles` tiles, and the rest.
    fn split(self, tiles: usize) -> (Self, Self) {
        let mut later_inputs = [(&[][..], 0); I];
        let inputs = std::array::from_fn(|k| {
            let (slice, numbers) = self.inputs[k];
            let (first, later) = slice.split_at(slice.len().min(tiles * TILE * numbers));
            later_inputs[k] = (later, numbers);
            (first, numbers)
        });
        let mut later_outputs = std::array::from_fn(|_| (&mut [][..], 0));
        let mut places = later_outputs.iter_mut();
        let outputs = self.outputs.map(|(slice, numbers)| {
            let length = slice.len().min(tiles * TILE * numbers);
            let (first, later) = slice.split_at_mut(length);
            if let Some(place) = places.next() {
                *place = (later, numbers);
            }
            (first, numbers)
        });
        let length = self.statuses.len().min(tiles * TILE);
        let (statuses, later_statuses) = self.statuses.split_at(length);
        (
            Self { inputs, outputs, statuses },
            Self { inputs: later_inputs, outputs: later_outputs, statuses: later_statuses },
        )
    }
}

/// A tile of a call.
pub(super) struct Tile<'a, E, const I: usize, const O: usize> {
    pub(super) workspace: &'a mut Workspace<E>,
    /// Number of the first point.
    pub(super) start: usize,
    /// How many points.
    pub(super) count: usize,
    pub(super) inputs: [&'a [E]; I],
    pub(super) outputs: [&'a mut [E]; O],
}

/// Runs `body` for each tile of the points and adds up its statuses, in the order of the points.
pub(super) fn for_each_tile<E: Stages, const I: usize, const O: usize>(
    work: Work<'_, E, I, O>,
    points: std::ops::Range<usize>,
    threads: bool,
    body: &(impl Fn(Tile<'_, E, I, O>) -> Status<u64> + Sync),
) -> Survey {
    let tiles = points.len().div_ceil(TILE);
    if threads && tiles > GRAIN {
        let half = tiles / 2;
        let middle = points.start + half * TILE;
        let (first, later) = work.split(half);
        let (first, later) = rayon::join(
            || for_each_tile(first, points.start..middle, threads, body),
            || for_each_tile(later, middle..points.end, threads, body),
        );
        return first + later;
    }
    E::with_workspace(|workspace| one_after_the_other(work, points, workspace, body))
}

fn one_after_the_other<E: Scalar, const I: usize, const O: usize>(
    work: Work<'_, E, I, O>,
    points: std::ops::Range<usize>,
    workspace: &mut Workspace<E>,
    body: &impl Fn(Tile<'_, E, I, O>) -> Status<u64>,
) -> Survey {
    let mut survey = Survey::default();
    let statuses = work.statuses;
    let mut rest = Work { statuses: &[], ..work };
    for start in points.clone().step_by(TILE) {
        let (tile, later) = rest.split(1);
        rest = later;
        let status = body(Tile {
            workspace,
            start,
            count: TILE.min(points.end - start),
            inputs: tile.inputs.map(|(slice, _)| slice),
            outputs: tile.outputs.map(|(slice, _)| slice),
        });
        if !statuses.is_empty() {
            for (point, to) in statuses[start - points.start..].iter().take(TILE).enumerate() {
                to.set(status.of_point(point));
            }
        }
        if status != Status::default() {
            survey = survey + Survey::of(status, start);
        }
    }
    survey
}
