//! Energies typed at run time compared with compiled ones, the same declarations.

#![expect(non_snake_case, reason = "F as in the literature")]

use std::hint::black_box;

use piola::batch::{Batch, Layout};
use piola::material::{Declared, MaterialError};
use piola::point::{Filter, evaluate, evaluate_stress};
use piola::{Inversion, Material};
use piola_declare::Energy;
use piola_materials::{CATALOGUE, DECLARATIONS, Entry, Visitor};
use piola_speed::{Arrays, Effort, IN_CACHE, Task, deformation_gradients, time_in_turns};

use super::{cell, vectors};
use crate::markdown::{header, row};

const NAMES: [&str; 5] = ["st_venant_kirchhoff", "neo_hookean", "ogden", "gent", "arruda_boyce"];
const POINTS: usize = 64;

/// P, and P with dP/dF, f64: in cache on the back ends with vectors, and point by point.
pub(crate) fn table(effort: Effort) -> Result<String, MaterialError> {
    let mut table = header(&["energy", "kernel", "instructions"], &["compiled", "typed", "typed / compiled"]);
    for entry in CATALOGUE.iter().filter(|entry| NAMES.contains(&entry.name)) {
        let values = entry.typical();
        let declaration = DECLARATIONS.iter().find(|known| known.name == entry.name);
        let source = declaration.map_or("", |declaration| declaration.source);
        let energy = Energy::from_rust(source).expect("a declaration of the catalogue");
        let typed = energy.material(&values, Inversion::Refuse)?;
        let compiled = entry.material(&values, Inversion::Refuse)?;
        for backend in vectors() {
            for task in [Task::Stresses, Task::Tangents] {
                let batches = [Batch::new(&*compiled), Batch::new(&typed)];
                let [compiled, typed] = batches.map(|batch| batch.with_backend(backend));
                let mut arrays = [(); 2].map(|()| Arrays::new(task, Layout::Lines, IN_CACHE));
                let [first, second] = &mut arrays;
                compare(
                    &mut table,
                    [entry.name, task.name(), backend.name()],
                    (effort, IN_CACHE),
                    [&mut || first.run(&compiled), &mut || second.run(&typed)],
                );
            }
        }
        entry.visit(&values, Inversion::Refuse, PointByPoint { effort, entry, typed, table: &mut table })?;
    }
    Ok(table)
}

/// One point after the other, without lanes.
struct PointByPoint<'a, M> {
    effort: Effort,
    entry: &'a Entry,
    typed: M,
    table: &'a mut String,
}

impl<T: Material> Visitor for PointByPoint<'_, T> {
    type Output = ();

    fn visit<M: Declared + 'static>(self, compiled: M) {
        let Self { effort, entry, typed, table } = self;
        let gradients: Vec<_> = deformation_gradients().take(POINTS).collect();
        compare(
            table,
            [entry.name, "evaluate_stress", "a point"],
            (effort, POINTS),
            [
                &mut || gradients.iter().for_each(|F| _ = black_box(evaluate_stress(&compiled, F))),
                &mut || gradients.iter().for_each(|F| _ = black_box(evaluate_stress(&typed, F))),
            ],
        );
        compare(
            table,
            [entry.name, "evaluate", "a point"],
            (effort, POINTS),
            [
                &mut || gradients.iter().for_each(|F| _ = black_box(evaluate(&compiled, F, Filter::None))),
                &mut || gradients.iter().for_each(|F| _ = black_box(evaluate(&typed, F, Filter::None))),
            ],
        );
    }
}

/// Adds a row: the times of calls with the compiled and with the typed energy, in turns.
fn compare(
    table: &mut String,
    labels: [&str; 3],
    (effort, points): (Effort, usize),
    mut calls: [&mut dyn FnMut(); 2],
) {
    let times = time_in_turns(effort, points, &mut calls);
    let mut cells = labels.map(str::to_owned).to_vec();
    cells.extend([cell(times[0]), cell(times[1]), format!("{:.2}", times[1].least / times[0].least)]);
    row(table, &cells);
}
