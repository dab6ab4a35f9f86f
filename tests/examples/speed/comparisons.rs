//! Ours beside other ways to the same numbers, timed in turns.

use piola::Material;
use piola::batch::{Batch, Energy, Layout};
use piola::lanes::Backend;
use piola_materials::{NeoHookean, StVenantKirchhoff};
use piola_tests::baselines::hand_written;
use piola_tests::speed::{
    Arrays, Effort, IN_CACHE, LAMBDA, MU, PointByPoint, Task, Times, materials, ogden, time, time_in_turns,
};

use super::measure::side_by_side;
use super::tables::{cell, header, row};

/// Generated code beside energies by hand, through the same batches.
pub(crate) fn hand_written(effort: Effort) -> String {
    let mut table = header(&["kernel", "format", "energy", "by hand", "generated", "by hand / generated"]);
    let stvk = hand_written::StVenantKirchhoff { mu: MU, lambda: LAMBDA };
    let neo_hookean = hand_written::NeoHookean { mu: MU, lambda: LAMBDA };
    for task in [Task::Energies, Task::Stresses, Task::Tangents] {
        let by_hand: [&dyn Energy<f64>; 2] = [&stvk, &neo_hookean];
        for (by_hand, (name, generated)) in by_hand.into_iter().zip(&materials::<f64>()) {
            let batches = [&Batch::new(by_hand), &Batch::new(&**generated)];
            let times = side_by_side(effort, task, batches);
            compare(&mut table, &[task.name(), "f64", name], times);
        }
        let by_hand: [&dyn Energy<f32>; 2] = [&stvk, &neo_hookean];
        for (by_hand, (name, generated)) in by_hand.into_iter().zip(&materials::<f32>()) {
            let batches = [&Batch::new(by_hand), &Batch::new(&**generated)];
            let times = side_by_side(effort, task, batches);
            compare(&mut table, &[task.name(), "f32", name], times);
        }
    }
    table
}

/// P and 81 entries of dP/dF, f64: the paper's method compiled for each back end's instructions, of which the fastest counts,
/// beside a batch. The goal is a factor of 20.
pub(crate) fn paper(effort: Effort) -> String {
    let mut table = header(&["energy", "[SZLSB11]", "`tangents`", "factor (goal: ≥ 20)"]);
    let [stvk, neo_hookean, three_terms] = &materials::<f64>();
    let material = StVenantKirchhoff::new(MU, LAMBDA).expect("admissible parameters");
    paper_of(effort, &material, stvk, &mut table);
    let material = NeoHookean::new(MU, LAMBDA).expect("admissible parameters");
    paper_of(effort, &material, neo_hookean, &mut table);
    paper_of(effort, &ogden(), three_terms, &mut table);
    table
}

fn paper_of(
    effort: Effort,
    material: &impl Material,
    (name, energy): &(&'static str, Box<dyn Energy<f64>>),
    table: &mut String,
) {
    let mut points = PointByPoint::new();
    let fastest = Backend::available().min_by(|&one, &other| {
        let mut least = |backend| time(effort, IN_CACHE, || points.run(material, backend)).least;
        least(one).total_cmp(&least(other))
    });
    let fastest = fastest.unwrap_or(Backend::portable());
    let mut arrays = Arrays::new(Task::Tangents, Layout::Lines, IN_CACHE);
    let batch = Batch::new(&**energy);
    let times =
        time_in_turns(effort, IN_CACHE, [&mut || points.run(material, fastest), &mut || arrays.run(&batch)]);
    compare(table, &[name], times);
}

fn compare(table: &mut String, labels: &[&str], [theirs, ours]: [Times; 2]) {
    let mut cells: Vec<String> = labels.iter().map(|label| label.to_string()).collect();
    cells.extend([cell(theirs), cell(ours), format!("{:.2}", theirs.least / ours.least)]);
    row(table, &cells);
}
