//! Formulas that share named parts: a long part that occurs more than once is written once.

use std::collections::HashMap;

use super::{Notation, Printer, subscript};
use crate::algebra::expr::{Graph, Id};
use crate::read::parse::Declaration;

/// Formulas and the parts that they share.
#[derive(Debug)]
pub struct Formulas {
    /// Names s₁, s₂, … with their formulas, each written with the names before it.
    pub parts: Vec<(String, String)>,
    /// The formulas, in the order of their nodes.
    pub formulas: Vec<String>,
}

/// Nodes as formulas of the stretches.
#[must_use]
pub fn formulas(graph: &mut Graph, declaration: &Declaration, roots: &[Id]) -> Formulas {
    share(Printer::by_stretches(graph, declaration, Notation::Formula), roots)
}

/// Nodes as formulas of I1, I2 and J, for which the three stretches stand.
#[must_use]
pub fn formulas_by_invariants(graph: &Graph, declaration: &Declaration, roots: &[Id]) -> Formulas {
    let names = ["I1", "I2", "J"].map(String::from);
    share(Printer::new(graph, declaration, Notation::Formula, names), roots)
}

/// Longest formula, in characters, that is not divided.
const LONGEST: usize = 120;

/// A part with fewer characters is written wherever it occurs.
const SHORTEST: usize = 12;

fn share(mut printer: Printer<'_>, roots: &[Id]) -> Formulas {
    let formulas: Vec<_> = roots.iter().map(|&root| printer.line(root)).collect();
    if formulas.iter().all(|formula| formula.chars().count() <= LONGEST) {
        return Formulas { parts: Vec::new(), formulas };
    }
    let order = printer.graph.reachable(roots);
    let lists = printer.graph.lists(&order);
    let mut candidates = shared(printer.graph, roots, &order);
    loop {
        printer.named.clear();
        printer.uses.borrow_mut().clear();
        let mut parts = Vec::new();
        for &id in &candidates {
            let text = printer.line(id);
            if text.chars().count() >= SHORTEST {
                let name = name(parts.len() + 1, lists[&id].is_some());
                printer.named.insert(id, name.clone());
                parts.push((name, text));
            }
        }
        let formulas = roots.iter().map(|&root| printer.line(root)).collect();
        // A part that occurs in one place only, because a larger part has a name, is written there.
        let uses = printer.uses.borrow();
        let named = |id: &Id| printer.named.contains_key(id);
        let kept: Vec<_> =
            candidates.iter().copied().filter(|id| named(id) && uses.get(id) > Some(&1)).collect();
        if kept.len() == parts.len() {
            return Formulas { parts, formulas };
        }
        drop(uses);
        candidates = kept;
    }
}

/// The nodes with more than one parent, the innermost first.
fn shared(graph: &Graph, roots: &[Id], order: &[Id]) -> Vec<Id> {
    let mut parents: HashMap<Id, usize> = HashMap::new();
    let children = order.iter().flat_map(|&id| graph.children(id));
    for id in children.chain(roots.iter().copied()) {
        *parents.entry(id).or_default() += 1;
    }
    order.iter().copied().filter(|id| parents[id] > 1).collect()
}

fn name(number: usize, is_entry: bool) -> String {
    let digits: String =
        number.to_string().bytes().map(|digit| subscript(usize::from(digit - b'0'))).collect();
    format!("s{digits}{}", if is_entry { "ₚ" } else { "" })
}
