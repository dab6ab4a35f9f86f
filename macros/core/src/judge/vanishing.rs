//! Denominators and the arguments of logarithms, roots and real powers: they must stay away from zero, at
//! rest and everywhere in the domain.

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
    let arguments = vanishing(graph, source);
    let Some(first) = arguments.first() else { return };
    let holds = |part| Argument::is_in(graph, part, first.of);
    if !findings.is_known(holds) {
        let part = source.first_operand(holds);
        let has_value = has_value(graph, source, samples);
        findings.add(part, Violation::Vanishing { arguments, has_value });
    }
}

/// The arguments that vanish inside the domain, each under the conditions on those before it, with a
/// correction.
pub(crate) fn vanishing(graph: &mut Graph, source: &Source<'_>) -> Vec<Vanishing> {
    let mut draws = draws(graph, source);
    let mut bounds = source.bounds.to_vec();
    let mut found: Vec<Vanishing> = Vec::new();
    while let Some(of) = vanishing_in(graph, &bounds, source.energy, &draws) {
        if found.is_empty() && !source.invariants().is_empty() {
            let isochoric = isochoric(source.declaration, graph);
            if vanishing_in(graph, &bounds, isochoric, &draws).is_none() {
                return vec![Vanishing { of, remedy: Remedy::Isochoric }];
            }
        }
        let at_rest = |graph: &Graph, id, point: &Point| evaluate(graph, id, &at_rest(point)).value;
        let (remedy, bound) = match draws.iter().any(|point| at_rest(graph, of, point) > 0.0) {
            true => (Remedy::Positive, of),
            false => (Remedy::Negative, graph.neg(of)),
        };
        if found.iter().any(|before| before.of == of) {
            break;
        }
        found.push(Vanishing { of, remedy });
        bounds.push(bound);
        draws.retain(|point| at_rest(graph, bound, point) > 0.0);
    }
    found
}

/// An argument of an energy that vanishes inside a domain.
fn vanishing_in(graph: &Graph, bounds: &[Id], energy: Id, draws: &[Point]) -> Option<Id> {
    // The values of functions are not known here.
    if bounds.iter().any(|&bound| graph.contains(bound, |node| matches!(node, Node::Function(..)))) {
        return None;
    }
    let arguments = Argument::all(graph, energy);
    let found = arguments.into_iter().find(|argument| {
        // No condition of a domain is on each entry of a list.
        !is_positive(graph, argument.of)
            && !graph.contains(argument.of, |node| matches!(node, Node::Entry(_) | Node::Function(..)))
            && draws.iter().any(|point| changes_sign(graph, bounds, argument.of, point))
    });
    found.map(|argument| argument.of)
}

/// Points with parameters of a few decades.
fn draws(graph: &Graph, source: &Source<'_>) -> Vec<Point> {
    let attempts = (0..POSITIVE).step_by(STRIDE).chain(0..CANDIDATES);
    let points = candidates(source, 0xD1B5_4A32_D192_ED03, attempts);
    points.filter(|point| source.is_good_at_rest(graph, point)).take(DRAWS).collect()
}

/// True if the form of an expression shows that it is positive for positive stretches.
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

/// True if an expression changes its sign on one of the [`PATHS`], with the parameters of the point, before
/// the domain ends.
fn changes_sign(graph: &Graph, bounds: &[Id], id: Id, point: &Point) -> bool {
    let sign = evaluate(graph, id, &at_rest(point)).value.signum();
    PATHS.into_iter().any(|path| {
        for step in 1..=STEPS {
            let length = step as f64 / STEPS as f64 * std::f64::consts::LN_10;
            let point = Point { stretches: path.map(|exponent| (length * exponent).exp()), ..point.clone() };
            let mut memo = Memo::default();
            let mut value = |id| evaluate_with(graph, id, &point, &mut memo);
            let is_inside = bounds.iter().all(|&bound| value(bound).value > 0.0);
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
