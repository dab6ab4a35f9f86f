//! Volumes for which an energy must have a value: inverted, flat and collapsed elements, unless its domain
//! excludes them.

use rustc_hash::FxHashSet;

use super::argument::Argument;
use super::explain::{is_declarable, with_admissible};
use super::finding::Findings;
use super::samples::{CANDIDATES, POSITIVE, draws};
use super::source::Source;
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::interpret::{Point, evaluate};
use crate::printer::rust;
use crate::read::domain::Volume;

/// The stretches of elements that are collapsed to a sheet, a line and a point.
const COLLAPSED: [[f64; 3]; 3] = [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]];

/// Draws of the parameters, some of which are negative: an exponent 1 + β is below zero in a fifth of them,
/// so that all of them miss it once in 10⁶ times.
const DRAWS: usize = 64;

/// Finds volumes of the domain for which the energy has no value.
pub(crate) fn volumes(graph: &mut Graph, samples: &[Point], findings: &mut Findings<'_>) {
    let source = findings.source;
    if let Some(sign) = sign_without_value(graph, source, samples) {
        // An energy undefined at J = 0 is undefined on collapsed elements too and has the same remedy: only
        // the first is reported.
        let mut breaks = |part| has_no_value(graph, source, part, sign, samples);
        if !findings.is_known(&mut breaks) {
            let message = if sign < 0.0 {
                "this has no value where J < 0, in inverted material: declare `domain(J > 0.0)`"
            } else {
                "this has no value where J = 0, in flat material: declare `domain(J > 0.0)`, or \
                 `domain(J != 0.0)` if the energy should treat inverted elements (J < 0) like upright ones"
            };
            findings.add(source.blamed_term(breaks), message);
        }
        return;
    }
    let Some((argument, vanishing)) = without_value(graph, source) else { return };
    if findings.is_known(|part| Argument::is_in(graph, part, argument.of)) {
        return;
    }
    let exponent = argument.exponent.filter(|exponent| exponent.real.is_some());
    let exponent = exponent.map(|exponent| graph.exponent_value(exponent));
    let power = match argument.exponent {
        Some(exponent) => graph.power(argument.of, exponent),
        None => graph.ln(argument.of),
    };
    let part = source.first_operand(|part| Argument::is_in(graph, part, argument.of));
    let place = match vanishing {
        1 => "λ3 = 0, in elements collapsed to a sheet",
        2 => "λ2 = λ3 = 0, in elements collapsed to a line",
        _ => "λ1 = λ2 = λ3 = 0, in elements collapsed to a point",
    };
    let negative = if exponent.is_some() { "its exponent is negative and " } else { "" };
    let admissible = exponent.and_then(|exponent| {
        let condition = format!("{} > 0.0", rust(graph, source.declaration, exponent));
        is_declarable(graph, exponent, &condition)
            .then(|| format!("{}, or ", with_admissible(source, vec![condition])))
    });
    let (power, admissible) = (rust(graph, source.declaration, power), admissible.unwrap_or_default());
    findings.add(
        part,
        format!("`{power}` has no value where {negative}{place}: declare {admissible}`domain(J > 0.0)`"),
    );
}

/// True if the energy needs no further condition on J.
pub(crate) fn has_value(graph: &mut Graph, source: &Source<'_>, samples: &[Point]) -> bool {
    sign_without_value(graph, source, samples).is_none() && without_value(graph, source).is_none()
}

/// A sign of J in the domain with which the energy has no value.
fn sign_without_value(graph: &mut Graph, source: &Source<'_>, samples: &[Point]) -> Option<f64> {
    let signs: &[f64] = match source.volume {
        Volume::Positive => &[],
        Volume::Nonzero => &[-1.0],
        Volume::Any => &[-1.0, 0.0],
    };
    let mut is_short = |&sign: &f64| has_no_value(graph, source, source.energy, sign, samples);
    signs.iter().copied().find(|sign| is_short(sign))
}

/// True if a part has no value at the samples, given J of this sign, inside the domain.
fn has_no_value(graph: &mut Graph, source: &Source<'_>, part: Id, sign: f64, samples: &[Point]) -> bool {
    let known = known(graph, source, part);
    let with_sign = |point: &Point| {
        let [l1, l2, l3] = point.stretches;
        Point { stretches: [l1, l2, sign * l3.abs()], ..point.clone() }
    };
    let is_inside = |point: &Point| source.is_inside(graph, point);
    let mut points = samples.iter().map(with_sign).filter(is_inside).peekable();
    let is_finite = |point: &Point| known.iter().all(|&part| evaluate(graph, part, point).value.is_finite());
    points.peek().is_some() && !points.any(|point| is_finite(&point))
}

/// The largest parts of a part that contain no function, whose domain is not known here.
fn known(graph: &mut Graph, source: &Source<'_>, part: Id) -> Vec<Id> {
    if !source.declaration.has_functions() {
        return vec![part];
    }
    // Operands come before what is made of them.
    let order = graph.reachable(&[part]);
    let mut has_function = FxHashSet::default();
    for &id in &order {
        let of_operands = graph.children(id).iter().any(|child| has_function.contains(child));
        if of_operands || graph.node(id).is_call() {
            has_function.insert(id);
        }
    }
    let mut known: Vec<_> = [part].into_iter().filter(|part| !has_function.contains(part)).collect();
    for id in order.into_iter().filter(|id| has_function.contains(id)) {
        let operands = match graph.node(id).clone() {
            Node::Product(factors) => {
                let powers = factors.into_iter().filter(|(base, _)| !has_function.contains(base));
                powers.map(|(base, exponent)| graph.power(base, exponent)).collect()
            }
            _ => graph.children(id),
        };
        known.extend(operands.into_iter().filter(|operand| !has_function.contains(operand)));
    }
    known.sort_unstable();
    known.dedup();
    known
}

/// A logarithm or power without a value in collapsed elements, such as one of I2 on a line, and how many
/// stretches vanish there.
fn without_value(graph: &mut Graph, source: &Source<'_>) -> Option<(Argument, usize)> {
    if source.volume != Volume::Any {
        return None;
    }
    let known = known(graph, source, source.energy);
    let arguments: Vec<_> = known.iter().flat_map(|&part| Argument::all(graph, part)).collect();
    let arguments = arguments.into_iter();
    let arguments: Vec<_> = arguments
        .map(|argument| (argument, argument.exponent.map(|exponent| graph.exponent_value(exponent))))
        .collect();
    if arguments.is_empty() {
        return None;
    }
    // Of admissible parameters with either sign.
    let points = draws(graph, source, 0x2545_F491_4F6C_DD1D, POSITIVE..CANDIDATES).take(DRAWS);
    let points: Vec<_> = points.collect();
    COLLAPSED.into_iter().find_map(|stretches| {
        let collapsed = |point: &Point| Point { stretches, ..point.clone() };
        let argument = points.iter().map(collapsed).find_map(|point| {
            let value = |id: Id| evaluate(graph, id, &point).value;
            if !source.is_inside(graph, &point) || known.iter().all(|&part| value(part).is_finite()) {
                return None;
            }
            let has_none = |&&(argument, exponent): &&(Argument, Option<Id>)| {
                value(argument.of) == 0.0 && exponent.is_none_or(|exponent| value(exponent) < 0.0)
            };
            arguments.iter().find(has_none).map(|&(argument, _)| argument)
        });
        argument.map(|argument| (argument, stretches.iter().filter(|&&stretch| stretch == 0.0).count()))
    })
}
