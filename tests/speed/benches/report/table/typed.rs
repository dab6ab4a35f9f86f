//! Energies typed at run time compared with compiled ones, the same declarations.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::hint::black_box;

use piola::batch::{Batch, Layout};
use piola::material::{Declared, MaterialError};
use piola::point::{Filter, evaluate, evaluate_stress};
use piola::{Inversion, Material};
use piola_materials::{Entry, Visitor};
use piola_speed::{Arrays, Effort, IN_CACHE, Task, deformation_gradients, time_in_turns};
use piola_tests::energies::find;

use super::{cell, vectors};
use crate::markdown::table;

const NAMES: [&str; 5] = ["st_venant_kirchhoff", "neo_hookean", "ogden", "gent", "arruda_boyce"];

/// P, and P with dP/dF, f64: in cache on the back ends with vectors, and point by point.
pub(crate) fn of_energies(effort: Effort) -> Result<String, MaterialError> {
    let mut rows = Vec::new();
    for energy in NAMES.map(|name| find(name).expect("an energy of the catalogue")) {
        let (values, entry) = (energy.typical(), energy.compiled.expect("an energy of this build"));
        let typed = energy.energy.material(&values, Inversion::Refuse)?;
        let compiled = entry.material(&values, Inversion::Refuse)?;
        for backend in vectors() {
            for task in [Task::Stresses, Task::Tangents] {
                let batches = [Batch::new(&*compiled), Batch::new(&typed)];
                let [compiled, typed] = batches.map(|batch| batch.with_backend(backend));
                let mut arrays = [(); 2].map(|()| Arrays::new(task, Layout::Lines, IN_CACHE));
                let [first, second] = &mut arrays;
                let labels = [entry.name, task.name(), backend.name()];
                rows.push(compare(effort, labels, || first.run(&compiled), || second.run(&typed)));
            }
        }
        rows.extend(entry.visit(&values, Inversion::Refuse, PointByPoint { effort, entry, typed })?);
    }
    let titles = ["compiled", "typed", "typed / compiled"];
    Ok(table(&["energy", "kernel", "instructions"], &titles, rows))
}

/// One point after the other, without lanes.
struct PointByPoint<'a, M> {
    effort: Effort,
    entry: &'a Entry,
    typed: M,
}

impl<T: Material> Visitor for PointByPoint<'_, T> {
    type Output = [Vec<String>; 2];

    fn visit<M: Declared + 'static>(self, compiled: M) -> [Vec<String>; 2] {
        let Self { effort, entry, typed } = self;
        let F: Vec<_> = deformation_gradients().take(IN_CACHE).collect();
        [
            compare(
                effort,
                [entry.name, "evaluate_stress", "a point"],
                || F.iter().for_each(|F| _ = black_box(evaluate_stress(&compiled, F))),
                || F.iter().for_each(|F| _ = black_box(evaluate_stress(&typed, F))),
            ),
            compare(
                effort,
                [entry.name, "evaluate", "a point"],
                || F.iter().for_each(|F| _ = black_box(evaluate(&compiled, F, Filter::None))),
                || F.iter().for_each(|F| _ = black_box(evaluate(&typed, F, Filter::None))),
            ),
        ]
    }
}

/// A row: the times of calls with the compiled and with the typed energy, each of [`IN_CACHE`] points, in
/// turns.
fn compare(
    effort: Effort,
    labels: [&str; 3],
    mut compiled: impl FnMut(),
    mut typed: impl FnMut(),
) -> Vec<String> {
    let times = time_in_turns(effort, IN_CACHE, &mut [&mut compiled, &mut typed]);
    let mut cells = labels.map(str::to_owned).to_vec();
    cells.extend([cell(times[0]), cell(times[1]), format!("{:.2}", times[1].least / times[0].least)]);
    cells
}
