//! All kernels, energies, formats and filters.

use std::fmt::Write;

use piola::batch::{Batch, Kernels, Layout};
use piola::lanes::Backend;
use piola::point::Filter;
use piola_speed::{Arrays, Decompositions, Effort, IN_CACHE, Task, Times, materials, time};

use super::measure::in_cache as measure_in_cache;

/// `least (median)`.
pub(crate) fn cell(Times { least, median }: Times) -> String {
    format!("{least:.1} ({median:.1})")
}

/// A row of a table.
pub(crate) fn row(table: &mut String, cells: &[String]) {
    // Writing to a string cannot fail.
    let _ = writeln!(table, "| {} |", cells.join(" | "));
}

/// The first two rows of a table.
pub(crate) fn header(titles: &[&str]) -> String {
    format!("| {} |\n|{}\n", titles.join(" | "), "---|".repeat(titles.len()))
}

pub(crate) fn in_cache<E: Kernels>(effort: Effort, backend: Backend) -> String {
    let materials = materials::<E>();
    let mut titles = vec!["kernel".to_owned()];
    for (name, _) in &materials {
        titles.extend([format!("{name}, in lines"), format!("{name}, by points")]);
    }
    let mut table = header(&titles.iter().map(String::as_str).collect::<Vec<_>>());
    let mut decompositions = Decompositions::<E>::new();
    for (name, is_signed) in [("svd", false), ("svd_signed_by_determinant", true)] {
        let times = time(effort, IN_CACHE, || decompositions.run(backend, is_signed));
        row(&mut table, &[name.to_owned(), cell(times)]);
    }
    for task in Task::ALL {
        for &filter in task.filters() {
            let mut cells = vec![task.label(filter)];
            for (_, energy) in &materials {
                let batch = Batch::new(&**energy).with_backend(backend).with_filter(filter);
                for layout in [Layout::Lines, Layout::Points] {
                    cells.push(cell(measure_in_cache(effort, task, layout, &batch)));
                }
            }
            row(&mut table, &cells);
        }
    }
    table
}

/// Calls of few points, for each of which a call costs more than in a full tile.
pub(crate) fn few_points(effort: Effort) -> String {
    let materials = materials::<f64>();
    let mut titles = vec!["points of a call".to_owned()];
    for (name, _) in &materials {
        titles.extend([Task::Stresses, Task::Tangents].map(|task| format!("{name}, {}", task.name())));
        titles.push(format!("{name}, {}", Task::Tangents.label(Filter::Clamp)));
    }
    let mut table = header(&titles.iter().map(String::as_str).collect::<Vec<_>>());
    for count in [1, 4, 8, 27, 64, IN_CACHE] {
        let mut cells = vec![count.to_string()];
        for (_, energy) in &materials {
            for (task, filter) in [
                (Task::Stresses, Filter::None),
                (Task::Tangents, Filter::None),
                (Task::Tangents, Filter::Clamp),
            ] {
                let batch = Batch::new(&**energy).with_filter(filter);
                let mut arrays = Arrays::new(task, Layout::Points, count);
                cells.push(cell(time(effort, count, || arrays.run(&batch))));
            }
        }
        row(&mut table, &cells);
    }
    table
}
