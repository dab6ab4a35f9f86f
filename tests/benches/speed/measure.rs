//! One configuration at a time.

use piola::batch::{Batch, Layout, Stages, TileMaterial};
use piola::lanes::Backend;
use piola::point::{Filter, Matrix3};
use piola_speed::{
    Arrays, Effort, IN_CACHE, STREAMING, Task, Times, deformation_gradients, time, time_in_turns,
};

/// Deformation gradients of [`Arrays`], as matrices.
pub(crate) fn matrices(count: usize) -> Vec<Matrix3<f64>> {
    let rows = |[a, b, c, d, e, f, g, h, i]: [f64; 9]| [[a, b, c], [d, e, f], [g, h, i]];
    deformation_gradients().take(count).map(rows).collect()
}

/// The same arrays again and again.
pub(crate) fn in_cache<E: Stages>(effort: Effort, task: Task, layout: Layout, batch: &Batch<'_, E>) -> Times {
    let mut arrays = Arrays::new(task, layout, IN_CACHE);
    time(effort, IN_CACHE, || arrays.run(batch))
}

/// What moving the numbers takes, and the task, with ordinary stores and with stores past the caches.
#[derive(Clone, Copy)]
pub(crate) struct Streamed {
    pub(crate) traffic: Times,
    pub(crate) stored: Times,
    pub(crate) non_temporal: Times,
}

impl Streamed {
    /// The better of the two ways to store.
    pub(crate) fn best(&self) -> Times {
        if self.stored.least < self.non_temporal.least { self.stored } else { self.non_temporal }
    }
}

/// Once through more points than any cache holds, in lines.
pub(crate) fn streaming<E: Stages>(
    effort: Effort,
    arrays: &mut Arrays<E>,
    energy: &dyn TileMaterial<E>,
    filter: Filter,
) -> Streamed {
    let batch = Batch::new(energy).with_filter(filter);
    let streaming = batch.with_streams(true);
    let traffic = traffic(effort, arrays);
    let stored = time(effort, STREAMING, || arrays.run(&batch));
    let non_temporal = time(effort, STREAMING, || arrays.run(&streaming));
    Streamed { traffic, stored, non_temporal }
}

/// The faster of ordinary stores and stores past the caches.
fn traffic<E: Stages>(effort: Effort, arrays: &mut Arrays<E>) -> Times {
    let backend = Backend::best();
    let stored = time(effort, STREAMING, || arrays.move_only(backend, false));
    let non_temporal = time(effort, STREAMING, || arrays.move_only(backend, true));
    if stored.least < non_temporal.least { stored } else { non_temporal }
}

/// Both in turns: the first, the second.
pub(crate) fn side_by_side<E: Stages>(effort: Effort, task: Task, batches: [&Batch<'_, E>; 2]) -> [Times; 2] {
    let [mut first, mut second] = batches.map(|_| Arrays::new(task, Layout::Lines, IN_CACHE));
    time_in_turns(effort, IN_CACHE, [&mut || first.run(batches[0]), &mut || second.run(batches[1])])
}
