//! Elements that are collapsed to a sheet, a line or a point, where an energy without a condition on J has a value too.

use quote::ToTokens;

use super::arguments::{Argument, is_good};
use super::{CANDIDATES, Mistakes, Random, Written, candidate};
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::interpret::{Point, evaluate};
use crate::printer::source::source;
use crate::read::domain::Volume;

/// Stretches of such elements, and what they are.
const COLLAPSED: [([f64; 3], &str); 3] = [
    ([1.0, 1.0, 0.0], "λ3 = 0, in what is collapsed to a sheet"),
    ([1.0, 0.0, 0.0], "λ2 = λ3 = 0, in what is collapsed to a line"),
    ([0.0, 0.0, 0.0], "λ1 = λ2 = λ3 = 0, in what is collapsed to a point"),
];

/// Draws of the parameters, some of which are negative: an exponent 1 + β is below zero in a fifth of them, and in none of so many
/// once in 10⁶ times.
const DRAWS: usize = 64;

/// Logarithms, denominators and negative powers of what vanishes there, such as I2 on a line, have no value.
pub(super) fn collapsed(graph: &mut Graph, written: &Written<'_>, mistakes: &mut Mistakes<'_>) {
    let Some((argument, place)) = without_value(graph, written) else { return };
    if mistakes.is_known(|part| Argument::is_in(graph, part, argument.of)) {
        return;
    }
    let real = argument.exponent.filter(|exponent| exponent.real.is_some());
    let real = real.map(|exponent| graph.exponent_value(exponent));
    let power = match argument.exponent {
        Some(exponent) => graph.power(argument.of, exponent),
        None => graph.ln(argument.of),
    };
    let negative = if real.is_some() { "its exponent is negative and " } else { "" };
    let admissible = real.and_then(|exponent| admissible(graph, written, exponent)).unwrap_or_default();
    let message = format!(
        "`{}` has no value where {negative}{place}: declare {admissible}`domain(J > 0.0)`",
        source(graph, written.declaration, power)
    );
    mistakes.report(written, written.holder(|part| Argument::is_in(graph, part, argument.of)), message);
}

/// That the exponent is positive, beside what the declaration says; conditions on parameters have no sums.
fn admissible(graph: &mut Graph, written: &Written<'_>, exponent: Id) -> Option<String> {
    let declaration = written.declaration;
    if graph.reachable(&[exponent]).into_iter().any(|id| matches!(graph.node(id), Node::Sum(..))) {
        return None;
    }
    let mut conditions: Vec<_> = declaration
        .options
        .admissible
        .iter()
        .map(|condition| condition.to_token_stream().to_string().replace(" [", "["))
        .collect();
    conditions.push(format!("{} > 0.0", source(graph, declaration, exponent)));
    Some(format!("`admissible({})`, or ", conditions.join(", ")))
}

/// What leaves the energy without a value, and where.
pub(super) fn without_value(graph: &mut Graph, written: &Written<'_>) -> Option<(Argument, &'static str)> {
    // What functions are defined for is their own affair.
    if written.volume != Volume::Any || written.declaration.has_functions() {
        return None;
    }
    let arguments = Argument::all(graph, written.energy).into_iter();
    let arguments: Vec<_> = arguments
        .map(|argument| (argument, argument.exponent.map(|exponent| graph.exponent_value(exponent))))
        .collect();
    if arguments.is_empty() {
        return None;
    }
    let points = draws(graph, written);
    COLLAPSED.into_iter().find_map(|(stretches, place)| {
        let collapsed = |point: &Point| Point { stretches, ..point.clone() };
        let argument = points.iter().map(collapsed).find_map(|point| {
            let value = |id: Id| evaluate(graph, id, &point).value;
            let is_inside = written.bounds.iter().all(|&bound| value(bound) > 0.0);
            if !is_inside || value(written.energy).is_finite() {
                return None;
            }
            let has_none = |&&(argument, exponent): &&(Argument, Option<Id>)| {
                value(argument.of) == 0.0 && exponent.is_none_or(|exponent| value(exponent) < 0.0)
            };
            arguments.iter().find(has_none).map(|&(argument, _)| argument)
        });
        argument.map(|argument| (argument, place))
    })
}

/// Admissible parameters of either sign. The entries of a list are equal, so that a condition holds for each of them as it does
/// for their sum.
fn draws(graph: &Graph, written: &Written<'_>) -> Vec<Point> {
    let mut random = Random(0x2545_F491_4F6C_DD1D);
    let draw = |attempt| {
        let mut point = candidate(written.declaration, &mut random, attempt, written.volume);
        for entries in &mut point.parameters {
            if let Some(&first) = entries.first() {
                entries.fill(first);
            }
        }
        point
    };
    let attempts = CANDIDATES / 20..CANDIDATES;
    attempts.map(draw).filter(|point| is_good(graph, written, point)).take(DRAWS).collect()
}
