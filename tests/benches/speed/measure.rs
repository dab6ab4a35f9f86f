//! One configuration at a time.

use piola::batch::{Batch, Kernels, Layout};
use piola::point::Matrix3;
use piola_speed::{Arrays, Effort, IN_CACHE, Task, Times, deformation_gradients, time, time_in_turns};

/// Deformation gradients of [`Arrays`], as matrices.
pub(crate) fn matrices(count: usize) -> Vec<Matrix3<f64>> {
    let rows = |[a, b, c, d, e, f, g, h, i]: [f64; 9]| [[a, b, c], [d, e, f], [g, h, i]];
    deformation_gradients().take(count).map(rows).collect()
}

/// The same arrays again and again.
pub(crate) fn in_cache<E: Kernels>(
    effort: Effort,
    task: Task,
    layout: Layout,
    batch: &Batch<'_, E>,
) -> Times {
    let mut arrays = Arrays::new(task, layout, IN_CACHE);
    time(effort, IN_CACHE, || arrays.run(batch))
}

/// Both in turns: the first, the second.
pub(crate) fn side_by_side<E: Kernels>(
    effort: Effort,
    task: Task,
    batches: [&Batch<'_, E>; 2],
) -> [Times; 2] {
    let [mut first, mut second] = batches.map(|_| Arrays::new(task, Layout::Lines, IN_CACHE));
    time_in_turns(effort, IN_CACHE, [&mut || first.run(batches[0]), &mut || second.run(batches[1])])
}
