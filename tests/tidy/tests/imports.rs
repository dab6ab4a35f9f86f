//! Imports point one way between the folders of a crate and between its modules; Cargo checks those between
//! crates.

use std::collections::BTreeMap;

use piola_tidy::imports::{Edge, Graph};
use piola_tidy::{Crate, crates, forbid};

/// Modules of the runtime from the bottom up: each may need those on the floors below.
const RUNTIME: &[&[&str]] = &[
    &["lanes", "message", "no_such_node", "random"],
    &["status"],
    &["quotient"],
    &["material"],
    &["univariate"],
    &["interpreter", "point"],
    &["kernels"],
    &["batch", "contract", "convert"],
    &["dynamic"],
    &["__private"],
];

/// Modules of bodies from the bottom up.
const BODIES: &[&[&str]] = &[&["chained"], &["mesh"], &["system"], &["step"]];

#[test]
fn modules_know_only_those_on_the_floors_below_them() {
    let crates = crates();
    for (name, floors) in [("piola", RUNTIME), ("piola_bodies", BODIES)] {
        let one = crates.iter().find(|one| one.name == name).expect("the crate");
        let floor = |module: usize| {
            let name = &one.modules[module].path[0];
            let floor = floors.iter().position(|floor| floor.contains(&name.as_str()));
            floor.unwrap_or_else(|| panic!("this file does not say on which floor `{name}` stands"))
        };
        let mut edges = Graph::new(one).edges_of_folders();
        edges.retain(|edge| floor(edge.from) <= floor(edge.to));
        forbid(&format!("paths in {name} that do not point downwards"), &lines(one, &edges));
    }
}

#[test]
fn no_folders_of_a_crate_need_each_other() {
    no_circles(|graph| graph.circles_of_folders());
}

#[test]
fn no_modules_of_a_crate_need_each_other() {
    no_circles(|graph| graph.circles());
}

#[track_caller]
fn no_circles(circles: fn(&Graph<'_>) -> Vec<Vec<Edge>>) {
    let mut found = Vec::new();
    for one in crates() {
        for circle in circles(&Graph::new(&one)) {
            found.push(format!("in {}:\n{}", one.name, lines(&one, &circle).join("\n")));
        }
    }
    forbid("circles of imports", &found);
}

/// A line for each pair of modules, with the first path between them.
fn lines(one: &Crate, edges: &[Edge]) -> Vec<String> {
    let pairs: BTreeMap<_, _> = edges.iter().rev().map(|edge| ((edge.from, edge.to), edge)).collect();
    let line = |edge: &Edge| {
        let (from, to) = (&one.modules[edge.from], &one.modules[edge.to]);
        format!("  {from} → {to}: {} at {}:{}", edge.written, from.file.display(), edge.line)
    };
    pairs.into_values().map(line).collect()
}
