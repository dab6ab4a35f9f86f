//! Denominators and the arguments of logarithms, roots and real powers: they must stay away from zero, at
//! rest and everywhere in the domain.

use quote::ToTokens;

use super::argument::Argument;
use super::explain::{in_place, is_cut, positive_domain};
use super::finding::Findings;
use super::samples::{CANDIDATES, POSITIVE, candidates, is_negative, is_zero};
use super::source::{Source, at_rest};
use super::volume::has_value;
use crate::algebra::expr::{Elementary, Function, Graph, Id, Node};
use crate::algebra::interpret::{Estimate, Memo, Point, evaluate, evaluate_with};
use crate::printer::rust;
use crate::read::resolve::isochoric;
use crate::read::spelling::list;

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

/// An expression that must not vanish inside the domain but does.
#[derive(Clone, Copy)]
pub(crate) struct Vanishing {
    of: Id,
    /// The comparison with zero, `>` or `<`, that keeps it from that as a condition of the domain; `None` if
    /// I1b, I2b in the places of I1, I2 do.
    pub(crate) side: Option<char>,
}

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
    let holds = |part| {
        let mut arguments = Argument::all(graph, part).into_iter();
        arguments.any(|argument| argument.real_exponent().is_some() && argument.of == of)
    };
    let part = source.first_operand(holds);
    let power = graph.power(of, exponent);
    let message = format!(
        "the base of `{}` vanishes at rest and is negative nearby, where only whole powers have a value: {}, or a \
         whole power, such as {}, or the power of a base that stays positive, such as \
         `(1.0 + b * (I1b - 3.0)).powf(n)`",
        rust(graph, source.declaration, power),
        match &source.invariants()[..] {
            [] => "write a power of `I1b - 3.0`, which is never negative".to_owned(),
            names => format!("write {}, since `I1b - 3.0` is never negative", in_place(names)),
        },
        if exponent.real.is_some() && !source.notation.is_formula() {
            "`.powi(2)` or `.powi(n)` with `n: u32`"
        } else {
            "`.powi(2)`"
        },
    );
    findings.add(part, message);
}

/// Finds arguments that vanish inside the domain, away from rest.
pub(crate) fn limits(graph: &mut Graph, samples: &[Point], findings: &mut Findings<'_>) {
    let source = findings.source;
    let arguments = vanishing(graph, source);
    let Some(first) = arguments.first() else { return };
    let holds = |part| Argument::is_in(graph, part, first.of);
    if findings.is_known(holds) {
        return;
    }
    let part = source.first_operand(holds);
    let conditions = conditions(graph, source, &arguments);
    let remedy = if conditions.is_empty() {
        let names = source.invariants();
        let is = if names.len() == 1 { "is" } else { "are" };
        format!("write {}, which {is} at least 3 wherever J > 0", in_place(&names))
    } else {
        let domain = if has_value(graph, source, samples) {
            let declared = source.declaration.options.domain.iter();
            let declared = declared.map(|condition| condition.to_token_stream().to_string());
            let conditions: Vec<_> = declared.chain(conditions).collect();
            format!("`domain({})`", conditions.join(", "))
        } else {
            positive_domain(source, conditions)
        };
        let is_parameter = |&id: &Id| matches!(graph.node(id), Node::Parameter(_));
        let all: Vec<_> = arguments.iter().map(|argument| argument.of).collect();
        let has_parameters = graph.reachable(&all).iter().any(is_parameter);
        let or = if has_parameters { ", or limit the parameters by `admissible(…)`" } else { "" };
        match is_cut(&domain) {
            true => "limit the domain by conditions under which it does not".to_owned(),
            false => format!("declare {domain}{or}"),
        }
    };
    let texts = arguments.iter().map(|argument| rust(graph, source.declaration, argument.of));
    let texts: Vec<_> = texts.collect();
    let (vanish, these) = if texts.len() == 1 { ("vanishes", "this") } else { ("vanish", "the energy") };
    let message =
        format!("{} {vanish} inside the domain, and there {these} has no value: {remedy}", list(&texts));
    findings.add(part, message);
}

/// The conditions that arguments do not vanish; none if isochoric invariants keep them from it.
pub(crate) fn conditions(graph: &mut Graph, source: &Source<'_>, arguments: &[Vanishing]) -> Vec<String> {
    let condition = |&Vanishing { of, side }: &Vanishing| {
        let side = side?;
        let zero = format!("{side} 0.0");
        // Beyond their first zero, these are positive again.
        let (of, limit) = match *graph.node(of) {
            Node::Apply(Function::Elementary(Elementary::Sin), a) if side == '>' => (a, "< PI"),
            Node::Apply(Function::Elementary(Elementary::Cos), a) if side == '>' => (a, "< PI / 2.0"),
            _ => (of, &*zero),
        };
        Some(format!("{} {limit}", rust(graph, source.declaration, of)))
    };
    arguments.iter().filter_map(condition).collect()
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
                return vec![Vanishing { of, side: None }];
            }
        }
        let at_rest = |graph: &Graph, id, point: &Point| evaluate(graph, id, &at_rest(point)).value;
        let (side, bound) = match draws.iter().any(|point| at_rest(graph, of, point) > 0.0) {
            true => ('>', of),
            false => ('<', graph.neg(of)),
        };
        if found.iter().any(|before| before.of == of) {
            break;
        }
        found.push(Vanishing { of, side: Some(side) });
        bounds.push(bound);
        draws.retain(|point| at_rest(graph, bound, point) > 0.0);
    }
    found
}

/// An argument of an energy that vanishes inside a domain.
fn vanishing_in(graph: &Graph, bounds: &[Id], energy: Id, draws: &[Point]) -> Option<Id> {
    // The values of functions are not known here.
    if bounds.iter().any(|&bound| graph.contains(bound, Node::is_call)) {
        return None;
    }
    let arguments = Argument::all(graph, energy);
    let found = arguments.into_iter().find(|argument| {
        // No condition of a domain is on each entry of a list.
        !is_positive(graph, argument.of)
            && !graph.contains(argument.of, |node| matches!(node, Node::Entry(_)) || node.is_call())
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
        Node::Stretch(_) | Node::Apply(Function::Exp, _) => true,
        Node::Apply(Function::Elementary(function), _) => function.is_positive(),
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
