//! Stress at rest, which an energy must not have.

use super::finding::{Findings, Stressed, Violation};
use super::samples::is_zero;
use super::source::at_rest;
use super::vanishing::vanishing;
use super::volume::has_value;
use crate::algebra::diff::Differentiator;
use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::increment::substitute_rest;
use crate::algebra::interpret::{Estimate, Point, evaluate};
use crate::algebra::simplify::simplify;
use crate::printer::rust;
use crate::read::parse::Declaration;
use crate::read::resolve::isochoric;

/// Finds the stress that keeps ψ1, the gradient, from vanishing at λ = 1.
pub(crate) fn rest(graph: &mut Graph, gradient: Id, samples: &[Point], findings: &mut Findings<'_>) {
    let source = findings.source;
    let declaration = source.declaration;
    let first = |graph: &mut Graph, part| Differentiator::default().by_stretch(graph, part, 0);
    let is_finite = |graph: &Graph, derivative| {
        samples.iter().all(|point| evaluate(graph, derivative, &at_rest(point)).value.is_finite())
    };
    if !is_finite(graph, gradient) {
        let mut breaks = |part| {
            let derivative = first(graph, part);
            !is_finite(graph, derivative)
        };
        // Other stress at rest is seen once this is finite.
        if !findings.is_known(&mut breaks) {
            findings.add(source.blamed_term(breaks), Violation::StressNotFinite);
        }
        return;
    }
    let is_stressed = |graph: &mut Graph, gradient| {
        let stress = substitute_rest(graph, gradient);
        samples.iter().any(|point| {
            let rest = at_rest(point);
            let magnitude = evaluate(graph, gradient, &rest).magnitude;
            // NaN is a mistake too.
            !is_zero(Estimate { value: evaluate(graph, stress, &rest).value, magnitude })
        })
    };
    // Only the constructor has the slopes of functions.
    if declaration.has_functions() || !is_stressed(graph, gradient) {
        return;
    }
    let mut breaks = |part| {
        let derivative = first(graph, part);
        is_stressed(graph, derivative)
    };
    if findings.is_known(&mut breaks) {
        return;
    }
    let part = source.blamed_term(breaks);
    let stress = substitute_rest(graph, gradient);
    let stress = legible(graph, declaration, stress);
    let isochoric = isochoric(declaration, graph);
    let isochoric = first(graph, isochoric);
    let stressed = Stressed {
        stress,
        has_logarithm: has_logarithm(graph, source.energy, stress),
        is_isochoric_free: !source.invariants().is_empty() && !is_stressed(graph, isochoric),
        vanishing: vanishing(graph, source),
        has_value: has_value(graph, source, samples),
    };
    findings.add(part, Violation::Stressed(stressed));
}

/// The shorter one of a sum of products and the form that differentiation leaves.
fn legible(graph: &mut Graph, declaration: &Declaration, e: Id) -> Id {
    let left = simplify(graph, e);
    let expanded = expand_products(graph, left);
    let expanded = simplify(graph, expanded);
    let [length, expanded_length] = [left, expanded].map(|e| rust(graph, declaration, e).len());
    if expanded_length < length { expanded } else { left }
}

/// True if the energy contains the stress times ln J, so that subtracting it would only remove that term.
fn has_logarithm(graph: &mut Graph, energy: Id, stress: Id) -> bool {
    let stretches = [0, 1, 2].map(|i| graph.stretch(i));
    let volume = graph.product_of(&stretches);
    let logarithm = graph.ln(volume);
    let term = graph.mul(stress, logarithm);
    let rest = graph.sub(energy, term);
    let holds = |id| graph.reachable(&[id]).contains(&logarithm);
    holds(energy) && !holds(rest)
}
