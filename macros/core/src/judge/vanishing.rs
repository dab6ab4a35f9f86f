//! Denominators and the arguments of logarithms, roots and real powers: they must stay away from zero, at
//! rest and wherever the domain reaches.

use super::argument::Argument;
use super::finding::{Findings, Remedy, Vanishing, Violation};
use super::samples::{CANDIDATES, POSITIVE, candidates, is_negative, is_zero};
use super::source::{Source, at_rest};
use super::volume::has_value;
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::interpret::{Estimate, Memo, Point, evaluate, evaluate_with};
use crate::read::resolve::isochoric;

/// Paths away from rest, by ln λ: uniaxial and equibiaxial stretching and shear at constant volume, and one,
/// two and three stretches that grow or shrink together.
const PATHS: [[f64; 3]; 9] = [
    [1.0, -0.5, -0.5],
    [0.5, 0.5, -1.0],
    [1.0, 0.0, -1.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [1.0, 1.0, 1.0],
    [0.0, 0.0, -1.0],
    [0.0, -1.0, -1.0],
    [-1.0, -1.0, -1.0],
];

/// Points of each path, the last of which is at a stretch of 10 or 1/10.
const STEPS: usize = 8;

/// Draws of the parameters: enough that limits such as one of I1, which is at least 3, are seen from both
/// sides.
const DRAWS: usize = 12;

/// Attempts from one draw to the next, over more decades each, as long as all parameters are positive.
const STRIDE: usize = POSITIVE / DRAWS;

/// Finds powers that are not whole of expressions that vanish at rest: rounding gives these either sign
/// nearby, and such powers have no value for a negative one.
pub(crate) fn powers_at_rest(graph: &mut Graph, samples: &[Point], findings: &mut Findings<'_>) {
    let source = findings.source;
    let vanishes =
        |graph: &Graph, of: Id| samples.iter().all(|point| is_zero(evaluate(graph, of, &at_rest(point))));
    let found = Argument::all(graph, source.energy).into_iter().find_map(|argument| {
        let is_excess = matches!(graph.node(argument.of), Node::Excess(..));
        let exponent = argument.real_exponent().filter(|_| !is_excess && vanishes(graph, argument.of))?;
        Some((argument.of, exponent))
    });
    let Some((of, exponent)) = found else { return };
    let power = graph.power(of, exponent);
    let holds = |part| {
        let mut arguments = Argument::all(graph, part).into_iter();
        arguments.any(|argument| argument.real_exponent().is_some() && argument.of == of)
    };
    findings.add(source.first_operand(holds), Violation::PowerAtRest { power });
}

/// Finds arguments that vanish inside the domain, away from rest.
pub(crate) fn limits(graph: &mut Graph, samples: &[Point], findings: &mut Findings<'_>) {
    let source = findings.source;
    let Some(argument) = vanishing(graph, source) else { return };
    let holds = |part| Argument::is_in(graph, part, argument.of);
    if !findings.is_known(holds) {
        let has_value = has_value(graph, source, samples);
        let holds = |part| Argument::is_in(graph, part, argument.of);
        findings.add(source.first_operand(holds), Violation::Vanishing { argument, has_value });
    }
}

/// An argument that vanishes inside the domain, and what would help.
pub(crate) fn vanishing(graph: &mut Graph, source: &Source<'_>) -> Option<Vanishing> {
    let draws = draws(graph, source);
    let of = vanishing_in(graph, source, source.energy, &draws)?;
    let isochoric = isochoric(source.declaration, graph);
    let remedy =
        if !source.invariants().is_empty() && vanishing_in(graph, source, isochoric, &draws).is_none() {
            Remedy::Isochoric
        } else if draws.iter().any(|point| evaluate(graph, of, &at_rest(point)).value > 0.0) {
            Remedy::Positive
        } else {
            Remedy::Negative
        };
    Some(Vanishing { of, remedy })
}

fn vanishing_in(graph: &Graph, source: &Source<'_>, energy: Id, draws: &[Point]) -> Option<Id> {
    // The domain of functions is not known here.
    if source.declaration.has_functions() {
        return None;
    }
    let arguments = Argument::all(graph, energy);
    let found = arguments.into_iter().find(|argument| {
        // No condition of a domain is on each entry of a list.
        !is_positive(graph, argument.of)
            && !argument.depends_on(graph, |node| matches!(node, Node::Entry(_)))
            && draws.iter().any(|point| changes_sign(graph, source, argument.of, point))
    });
    found.map(|argument| argument.of)
}

/// Points with parameters of a few decades.
fn draws(graph: &Graph, source: &Source<'_>) -> Vec<Point> {
    let attempts = (0..POSITIVE).step_by(STRIDE).chain(0..CANDIDATES);
    let points = candidates(source, 0xD1B5_4A32_D192_ED03, attempts);
    points.filter(|point| source.is_good_at_rest(graph, point)).take(DRAWS).collect()
}

/// Whether the form of an expression shows that it is positive for positive stretches.
fn is_positive(graph: &Graph, id: Id) -> bool {
    match graph.node(id) {
        Node::Stretch(_) | Node::Exp(_) => true,
        Node::Elementary(function, _) => function.is_positive(),
        Node::Linear { constant, terms } => {
            !constant.is_negative()
                && terms.iter().all(|&(term, c)| !c.is_negative() && is_positive(graph, term))
                && !graph.is_zero(id)
        }
        Node::Product(factors) => factors.iter().all(|&(base, _)| is_positive(graph, base)),
        _ => false,
    }
}

/// Whether an expression changes its sign on one of the [`PATHS`], with the parameters of the point, before
/// the domain ends.
fn changes_sign(graph: &Graph, source: &Source<'_>, id: Id, point: &Point) -> bool {
    let sign = evaluate(graph, id, &at_rest(point)).value.signum();
    PATHS.into_iter().any(|path| {
        for step in 1..=STEPS {
            let length = step as f64 / STEPS as f64 * std::f64::consts::LN_10;
            let point = Point { stretches: path.map(|exponent| (length * exponent).exp()), ..point.clone() };
            let mut memo = Memo::default();
            let mut value = |id| evaluate_with(graph, id, &point, &mut memo);
            let is_inside = source.bounds.iter().all(|&bound| value(bound).value > 0.0);
            let Estimate { value, magnitude } = value(id);
            if !is_inside || !value.is_finite() {
                return false;
            }
            if is_negative(Estimate { value: sign * value, magnitude }) {
                return true;
            }
        }
        false
    })
}
