//! The kernels of a batch in cache: `cargo bench -p piola-tests`, with a part of a name behind `--` for some
//! of them.
//!
//! The example `speed` times the same calls, says nanoseconds per point and compares; this is for one kernel
//! at a time.

use std::fmt;

use divan::Bencher;
use divan::counter::ItemsCount;
use piola::batch::{Batch, Layout, Stages};
use piola::lanes::Backend;
use piola::point::Filter;
use piola_speed::{Arrays, IN_CACHE, Task, materials};

fn main() {
    divan::main();
}

#[divan::bench(types = [f64, f32], args = calls())]
fn batch<E: Stages>(bencher: Bencher<'_, '_>, call: &Call) {
    let Call { task, filter, material, backend } = *call;
    let (_, energy) = &materials::<E>()[material];
    let batch = Batch::new(&**energy).with_backend(backend).with_filter(filter);
    let mut arrays = Arrays::new(task, Layout::Lines, IN_CACHE);
    bencher.counter(ItemsCount::new(IN_CACHE)).bench_local(|| arrays.run(&batch));
}

struct Call {
    task: Task,
    filter: Filter,
    /// Of [`materials`].
    material: usize,
    backend: Backend,
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { task, filter, material, backend } = self;
        write!(f, "{} {} {backend}", task.label(*filter), materials::<f64>()[*material].0)
    }
}

fn calls() -> Vec<Call> {
    let mut calls = Vec::new();
    for task in Task::ALL {
        for &filter in task.filters() {
            for &material in task.materials(&[0, 1, 2]) {
                calls.extend(Backend::available().map(|backend| Call { task, filter, material, backend }));
            }
        }
    }
    calls
}
