//! Stress at rest, which an energy must not have.

use super::explain::{in_place, is_cut, positive_domain};
use super::finding::Findings;
use super::samples::is_zero;
use super::source::{Source, at_rest};
use super::vanishing::{conditions, vanishing};
use super::volume::has_value;
use crate::algebra::diff::Differentiator;
use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Graph, Id};
use crate::algebra::increment::substitute_rest;
use crate::algebra::interpret::{Estimate, Point, evaluate};
use crate::algebra::simplify::simplify;
use crate::printer::{rust, rust_factor};
use crate::read::domain::Volume;
use crate::read::notation::Notation;
use crate::read::parse::Declaration;
use crate::read::resolve::isochoric;

/// The longest stress, in bytes, to be appended: a longer one is better avoided than balanced.
const APPENDABLE: usize = 200;

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
            findings.add(
                source.blamed_term(breaks),
                "the stress of this is not finite at rest, where λ1 = λ2 = λ3 = 1: divide by \
                 nothing that vanishes there, and take no logarithm of it",
            );
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
    let has_logarithm = has_logarithm(graph, source.energy, stress);
    let is_isochoric_free = !source.invariants().is_empty() && !is_stressed(graph, isochoric);
    let vanishing = vanishing(graph, source);
    let has_value = has_value(graph, source, samples);

    let limits = conditions(graph, source, &vanishing);
    let text = rust(graph, declaration, stress);
    let is_cut_short = is_cut(&text) || limits.iter().any(|limit| is_cut(limit));
    let has_isochoric_limit = vanishing.first().is_some_and(|first| first.side.is_none());
    let domain = if source.volume == Volume::Positive { "" } else { " with `domain(J > 0.0)`" };
    let [l1, l2, l3] = &declaration.stretches;
    let isochoric_stretches = format!("`{l1} / J.cbrt()` for `{l1}`, and so on for `{l2}` and `{l3}`");
    // Where elements are flat, isochoric invariants are beyond limits.
    let is_limited = declaration.options.extend.is_some() && !source.bounds.is_empty();
    let remedy = if text.len() > APPENDABLE || is_cut_short {
        let instead = match is_isochoric_free {
            true => Some(in_place(&source.invariants())),
            false => source.invariants().is_empty().then_some(isochoric_stretches),
        };
        match instead {
            Some(instead) => {
                format!("this leaves stress at rest: write {instead}{domain}, which leaves none")
            }
            None => format!("this leaves stress at rest: remove it by a term in `J.ln()`{domain}"),
        }
    } else {
        let balance = balance(graph, source, stress, has_logarithm, limits, has_value);
        let isochoric = format!("write {}{domain}, which leaves none", in_place(&source.invariants()));
        let remedies = match is_isochoric_free {
            true if has_isochoric_limit => format!("{isochoric} and has a value wherever J > 0"),
            true if vanishing.is_empty() && !is_limited => format!("{balance}; or {isochoric}"),
            _ => balance,
        };
        let or = match names_stretches(source) && !is_limited {
            true => format!("; or write {isochoric_stretches}{domain}, which leaves none"),
            false => String::new(),
        };
        format!("this leaves the stress `{text}` at rest: {remedies}{or}")
    };
    // The stress may be intended, or be that of an incompressible solid.
    let meant = match source.notation {
        Notation::Formula { free_rest: Some(option) } => {
            format!("; or give the option `{option}`, which appends that term")
        }
        Notation::Formula { free_rest: None } => String::new(),
        Notation::Attribute | Notation::Rust => "; or add `prestressed` to the attribute".to_owned(),
    };
    // In an energy of a compressible solid, a slip is likelier than a missing term.
    let is_compressible = !declaration.options.domain.is_empty() || source.is_written_in(&VOLUMETRIC);
    let mistyped = match is_compressible {
        true => " (if the paper's solid is compressible, a factor or a power is mistyped)",
        false => "",
    };
    findings.add(part, format!("{remedy}{meant}{mistyped}"));
}

/// Words of energies that distinguish the change of volume.
const VOLUMETRIC: [&str; 3] = ["J", "I1b", "I2b"];

/// True if an energy is written in stretches, and not in their isochoric parts.
fn names_stretches(source: &Source<'_>) -> bool {
    let names = source.declaration.stretches.each_ref().map(ToString::to_string);
    names.iter().all(|name| source.is_written_in(&[name.as_str()]))
        && !source.is_written_in(&VOLUMETRIC)
        && source.invariants().is_empty()
}

/// A term, ready to paste, that makes the rest state stress-free, and the domain that it needs.
fn balance(
    graph: &mut Graph,
    source: &Source<'_>,
    stress: Id,
    has_logarithm: bool,
    limits: Vec<String>,
    has_value: bool,
) -> String {
    let declaration = source.declaration;
    let term = if rust(graph, declaration, stress).starts_with('-') {
        let negated = graph.neg(stress);
        format!("+ {}", rust_factor(graph, declaration, negated))
    } else {
        format!("- {}", rust_factor(graph, declaration, stress))
    };
    let is_limited = !limits.is_empty();
    let domain = format!(" with {}", positive_domain(source, limits));
    if has_logarithm {
        let domain = if is_limited || !has_value { &domain } else { "" };
        return format!("append `{term} * (J - 1.0)`{domain}, or remove the term in `J.ln()`");
    }
    let logarithm = format!("append `{term} * J.ln()`");
    match source.volume {
        _ if is_limited => format!("{logarithm}{domain}"),
        Volume::Positive => logarithm,
        _ if !has_value => format!("{logarithm}{domain}"),
        Volume::Nonzero => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with the declared one"),
        Volume::Any => format!("{logarithm}{domain}, or `{term} * (J - 1.0)` with any domain"),
    }
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
