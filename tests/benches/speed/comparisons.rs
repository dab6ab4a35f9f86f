//! Ours beside other ways to the same numbers, timed in turns.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

use piola::Material;
use piola::batch::{Batch, Layout, Stages, TileMaterial};
use piola::lanes::Backend;
use piola_materials::{NeoHookean, StVenantKirchhoff};
use piola_speed::{Arrays, Effort, IN_CACHE, LAMBDA, MU, Task, Times, materials, ogden, time_in_turns};
use piola_tests::baselines::hand_written;

use super::measure::side_by_side;
use super::point_by_point::PointByPoint;
use super::tables::{cell, header, row};

/// Generated code beside energies by hand, through the same batches.
pub(crate) fn hand_written(effort: Effort) -> String {
    let mut table =
        header(&["kernel", "format", "energy", "by hand", "generated", "by hand / generated (goal: ≥ 1)"]);
    for task in [Task::Energies, Task::Stresses, Task::Tangents] {
        hand_written_in::<f64>(effort, task, &mut table);
        hand_written_in::<f32>(effort, task, &mut table);
    }
    table
}

fn hand_written_in<E: Stages>(effort: Effort, task: Task, table: &mut String) {
    let stvk = hand_written::StVenantKirchhoff { mu: MU, lambda: LAMBDA };
    let neo_hookean = hand_written::NeoHookean { mu: MU, lambda: LAMBDA };
    let by_hand: [&dyn TileMaterial<E>; 2] = [&stvk, &neo_hookean];
    for (by_hand, (name, generated)) in by_hand.into_iter().zip(&materials::<E>()) {
        let times = side_by_side(effort, task, [&Batch::new(by_hand), &Batch::new(&**generated)]);
        compare(table, &[task.name(), std::any::type_name::<E>(), name], times);
    }
}

/// P and 81 entries of dP/dF, f64: the paper's method, compiled for the instructions of each back end, beside
/// a batch with the best one.
pub(crate) fn paper(effort: Effort) -> String {
    let titles = ["energy", "compiled for", "decomposition", "[SZLSB11]", "tangents", "factor (goal: ≥ 20)"];
    let mut table = header(&titles);
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
    (name, energy): &(&'static str, Box<dyn TileMaterial<f64>>),
    table: &mut String,
) {
    let mut points = PointByPoint::new();
    let mut arrays = Arrays::new(Task::Tangents, Layout::Lines, IN_CACHE);
    let batch = Batch::new(&**energy);
    for backend in Backend::available() {
        let theirs: &mut dyn FnMut() = &mut || points.run(material, backend);
        let times = time_in_turns(effort, IN_CACHE, [theirs, &mut || arrays.run(&batch)]);
        compare(table, &[name, backend.name(), "piola's"], times);
        let theirs: &mut dyn FnMut() = &mut || points.run_with_library(material, backend);
        let times = time_in_turns(effort, IN_CACHE, [theirs, &mut || arrays.run(&batch)]);
        compare(table, &[name, backend.name(), "nalgebra's"], times);
    }
}

fn compare(table: &mut String, labels: &[&str], [theirs, ours]: [Times; 2]) {
    let mut cells: Vec<String> = labels.iter().map(|label| label.to_string()).collect();
    cells.extend([cell(theirs), cell(ours), format!("{:.2}", theirs.least / ours.least)]);
    row(table, &cells);
}
