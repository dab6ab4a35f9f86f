//! The method of the paper beside a batch, timed in turns.
//!
//! \[SZLSB11\] Sin, Zhu, Li, Schroeder, Barbič, *Invertible Isotropic Hyperelasticity using SVD Gradients*,
//! 2011.

use piola::Material;
use piola::batch::{Batch, Layout, TileMaterial};
use piola::lanes::Backend;
use piola_materials::{NeoHookean, StVenantKirchhoff};
use piola_speed::{Arrays, Effort, IN_CACHE, LAMBDA, MU, Task, Times, materials, ogden, time_in_turns};

use super::point_by_point::PointByPoint;
use super::tables::{cell, header, row};

/// P and 81 entries of dP/dF, f64: the paper's method, compiled for the instructions of each back end, beside
/// a batch with the best one.
pub(crate) fn paper(effort: Effort) -> String {
    let titles = ["energy", "compiled for", "decomposition", "[SZLSB11]", "tangents", "factor"];
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
