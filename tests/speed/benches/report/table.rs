//! Times of single points and batches, as the columns that other codes are compared by.
//!
//! Each energy has a table with a row for each way to ask and a column for each result, so that the figures
//! of another code can stand beside it: F = I + 0.3 X with entries of X uniform in [−1, 1) and det F > 0.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use std::hint::black_box;

use piola::batch::{Batch, Kernels, Layout};
use piola::lanes::Backend;
use piola::material::Declared;
use piola::point::{Filter, Matrix3, evaluate_dense, evaluate_stress};
use piola_materials::{NeoHookean, StVenantKirchhoff};
use piola_speed::{
    Arrays, Decompositions, Effort, IN_CACHE, LAMBDA, MU, Task, Times, deformation_gradients, ogden,
    processor, time,
};

use crate::Outcome;
use crate::markdown::table;

mod typed;

/// Results: the title of a column, the task, and the filter.
const COLUMNS: [(&str, Task, Filter); 5] = [
    ("P", Task::Stresses, Filter::None),
    ("P + dP/dF 81", Task::Tangents, Filter::None),
    ("+ PSD", Task::Tangents, Filter::Clamp),
    ("f + K 144", Task::Stiffnesses, Filter::None),
    ("+ PSD", Task::Stiffnesses, Filter::Clamp),
];

/// Prints all tables in Markdown, each as soon as it is measured.
pub(crate) fn print(effort: Effort, commit: Option<&str>) -> Outcome<()> {
    println!("# Nanoseconds a point, one thread\n");
    println!("Processor: {}. Commit: {}.\n", processor(), commit.unwrap_or("unknown"));
    println!(
        "Least of {} repeats and, in parentheses, the median. {IN_CACHE} points, unless a row says otherwise, the \
         same arrays again and again. PSD: filtered with `Filter::Clamp`.\n",
        effort.repeats
    );
    println!("## Singular value decomposition, in lines\n\n{}", decompositions(effort));
    print_energy("neo-Hooke", &NeoHookean::new(MU, LAMBDA)?, effort);
    print_energy("Saint Venant–Kirchhoff", &StVenantKirchhoff::new(MU, LAMBDA)?, effort);
    print_energy("Ogden with three terms", &ogden(), effort);
    println!("## Energies typed at run time\n\n{}", typed::of_energies(effort)?);
    Ok(())
}

fn print_energy<M: Declared + 'static>(name: &str, material: &M, effort: Effort) {
    let mut rows = Vec::new();
    for backend in vectors() {
        for (layout, order) in [(Layout::Points, "point by point"), (Layout::Lines, "in lines")] {
            let label = |format| format!("{order}, {format}, {backend}");
            let double = Batch::<f64>::new(material).with_backend(backend);
            let single = Batch::<f32>::new(material).with_backend(backend);
            rows.push(batch(label("f64"), &double, layout, IN_CACHE, effort));
            rows.push(batch(label("f32"), &single, layout, IN_CACHE, effort));
        }
    }
    for points in [1, 8, 64] {
        let label = format!("a batch of {points}, f64, {}", Backend::best());
        rows.push(batch::<f64>(label, &Batch::new(material), Layout::Points, points, effort));
    }
    // One point a call, with the 81 entries written out.
    let stress = each_point(effort, |F| _ = black_box(evaluate_stress(material, F)));
    let tangents = [Filter::None, Filter::Clamp]
        .map(|filter| each_point(effort, |F| _ = black_box(evaluate_dense(material, F, filter))));
    rows.push(one_a_call("`evaluate_stress`, `evaluate_dense`", Some(stress), tangents));
    println!("## {name}\n\n{}", table(&["how"], &COLUMNS.map(|(title, ..)| title), rows));
}

/// Back ends with vector registers; the portable one where there is no other.
fn vectors() -> impl Iterator<Item = Backend> {
    Backend::available().filter(|&backend| backend != Backend::portable() || backend == Backend::best())
}

fn batch<E: Kernels>(
    label: String,
    batch: &Batch<'_, E>,
    layout: Layout,
    points: usize,
    effort: Effort,
) -> Vec<String> {
    let mut cells = vec![label];
    cells.extend(COLUMNS.map(|(_, task, filter)| {
        let mut arrays = Arrays::new(task, layout, points);
        let batch = batch.with_filter(filter);
        cell(time(effort, points, || arrays.run(&batch)))
    }));
    cells
}

/// A row with the first three columns.
fn one_a_call(label: &str, stress: Option<Times>, tangents: [Times; 2]) -> Vec<String> {
    let mut cells = vec![format!("{label}, f64"), stress.map_or("–".to_owned(), cell)];
    cells.extend(tangents.map(cell));
    cells.resize(1 + COLUMNS.len(), "–".to_owned());
    cells
}

fn each_point(effort: Effort, mut call: impl FnMut(&Matrix3<f64>)) -> Times {
    let gradients: Vec<_> = deformation_gradients().take(IN_CACHE).collect();
    time(effort, IN_CACHE, || gradients.iter().for_each(&mut call))
}

fn decompositions(effort: Effort) -> String {
    let rows = vectors()
        .flat_map(|backend| [decomposition::<f64>(backend, effort), decomposition::<f32>(backend, effort)]);
    table(&["how"], &["`svd`", "`svd_signed_by_determinant`"], rows)
}

fn decomposition<E: Kernels>(backend: Backend, effort: Effort) -> Vec<String> {
    let mut points = Decompositions::<E>::default();
    let mut cells = vec![format!("{}, {backend}", std::any::type_name::<E>())];
    cells.extend(
        [false, true].map(|is_signed| cell(time(effort, IN_CACHE, || points.run(backend, is_signed)))),
    );
    cells
}

/// `least (median)`.
fn cell(Times { least, median }: Times) -> String {
    format!("{least:.1} ({median:.1})")
}
