//! What must be reached, beside what is.
//!
//! The goals are absolute times of a Zen 5 core at 4.2 GHz with AVX-512; on other machines they only orient.
//! Those of streaming are times that the same run has measured.

use piola::batch::{Batch, Layout, Stages};
use piola::lanes::Backend;
use piola::point::Filter;
use piola_speed::{Arrays, Decompositions, Effort, IN_CACHE, STREAMING, Task, Times, materials, time};

use super::measure::{in_cache, streaming};
use super::tables::{cell, header, row};

/// How much longer streaming may take than the slower of computing in cache and moving the numbers.
const STREAMING_SLACK: f64 = 1.3;

/// Why a Zen 5 core misses some goals, as far as profiles and listings of the kernels tell.
pub(crate) const REASONS: &str = "\
Where a goal is missed, on the machine of the README: the core ran at 3.7 GHz (a chain of additions), the goals are for 4.2. \
Tangents: for 8 points 570 multiplications and additions, at two a cycle 285 cycles; 430 were measured, since products of \
the right singular vectors do not fit into 32 registers and are loaded as operands, and 170 registers are stored. Ogden: \
the divided differences of powers take 10 ns of them. Points: a transpose in registers takes 24 shuffles for 64 numbers, \
9 ns for 81 entries at one shuffle a cycle, as on Zen 4. Streaming: the stores of a tile come in a burst after its \
decomposition and not beside it. The paper's method is as fast as it is because it is given the decomposition of this \
library; with that of nalgebra, which is shown beside it, it takes a fifth longer.
";

/// Figures, goals, times and whether they are within the goals, measured with the best back end.
pub(crate) fn table(effort: Effort, streaming_effort: Effort) -> String {
    let mut table = header(&["figure", "format", "goal", "in lines", "met", "by points"]);
    decomposition::<f64>(effort, 24.0, &mut table);
    decomposition::<f32>(effort, 10.0, &mut table);
    for (task, filter, goals) in [
        (Task::Stresses, Filter::None, [7.0, 7.0, 50.0]),
        (Task::Tangents, Filter::None, [16.0, 12.0, 80.0]),
        (Task::StiffnessesAt, Filter::None, [40.0, 36.0, 100.0]),
        (Task::Tangents, Filter::Clamp, [45.0, 46.0, 56.0]),
        (Task::Stiffnesses, Filter::Clamp, [50.0, 51.0, 60.0]),
        (Task::PackedStiffnesses, Filter::Clamp, [50.0, 51.0, 60.0]),
    ] {
        kernel::<f64>(effort, task, filter, goals, &mut table);
    }
    few(effort, 8, [36.0, 32.0, 120.0], &mut table);
    kernel::<f32>(effort, Task::Tangents, Filter::None, [16.0, 17.0, 21.0], &mut table);
    product(effort, 3.0, &mut table);
    for task in [Task::Tangents, Task::Stiffnesses] {
        streamed::<f64>(effort, streaming_effort, task, &mut table);
        streamed::<f32>(effort, streaming_effort, task, &mut table);
    }
    table
}

fn decomposition<E: Stages>(effort: Effort, goal: f64, table: &mut String) {
    let mut decompositions = Decompositions::<E>::new();
    let times = time(effort, IN_CACHE, || decompositions.run(Backend::best(), false));
    judged::<E>(table, "svd", goal, Some(times), None);
}

fn kernel<E: Stages>(effort: Effort, task: Task, filter: Filter, goals: [f64; 3], table: &mut String) {
    for ((name, energy), goal) in materials::<E>().iter().zip(goals) {
        let batch = Batch::new(&**energy).with_filter(filter);
        let [lines, points] =
            [Layout::Lines, Layout::Points].map(|layout| in_cache(effort, task, layout, &batch));
        let figure = format!("{}, {name}", task.label(filter));
        judged::<E>(table, &figure, goal, Some(lines), Some(points));
    }
}

/// Tangents of a call of few points.
fn few(effort: Effort, points: usize, goals: [f64; 3], table: &mut String) {
    for ((name, energy), goal) in materials::<f64>().iter().zip(goals) {
        let mut arrays = Arrays::new(Task::Tangents, Layout::Points, points);
        let times = time(effort, points, || arrays.run(&Batch::new(&**energy)));
        judged::<f64>(table, &format!("tangents, {points} points a call, {name}"), goal, None, Some(times));
    }
}

fn product(effort: Effort, goal: f64, table: &mut String) {
    let [(_, energy), ..] = materials::<f64>();
    let batch = Batch::new(&*energy);
    let [lines, points] =
        [Layout::Lines, Layout::Points].map(|layout| in_cache(effort, Task::Products, layout, &batch));
    judged::<f64>(table, "products", goal, Some(lines), Some(points));
}

/// The better way to store; the goal is [`STREAMING_SLACK`] times the larger of the time in cache and that of
/// moving.
fn streamed<E: Stages>(effort: Effort, streaming_effort: Effort, task: Task, table: &mut String) {
    let mut arrays = Arrays::<E>::new(task, Layout::Lines, STREAMING);
    for (name, energy) in &materials::<E>() {
        let computed = in_cache(effort, task, Layout::Lines, &Batch::new(&**energy));
        let found = streaming(streaming_effort, &mut arrays, &**energy, Filter::None);
        let goal = STREAMING_SLACK * computed.least.max(found.traffic.least);
        judged::<E>(table, &format!("streaming {}, {name}", task.name()), goal, Some(found.best()), None);
    }
}

/// A row; the times in lines are judged, or, if there are none, those by points.
fn judged<E: Stages>(
    table: &mut String,
    figure: &str,
    goal: f64,
    lines: Option<Times>,
    points: Option<Times>,
) {
    let Some(Times { least, .. }) = lines.or(points) else { return };
    let met = if least <= goal { "yes" } else { "no" };
    let of = |times: Option<Times>| times.map_or_else(String::new, cell);
    row(
        table,
        &[
            figure.to_owned(),
            std::any::type_name::<E>().to_owned(),
            format!("{goal:.1}"),
            of(lines),
            format!("{met}, {:.2}×", least / goal),
            of(points),
        ],
    );
}
