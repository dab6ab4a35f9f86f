//! What denominators, logarithms, roots and real powers are of: numbers that stay clear of zero, at rest and wherever the
//! domain reaches.

use quote::ToTokens;

use super::{
    CANDIDATES, Mistakes, NOISE, Random, Written, at_rest, candidate, has_value, in_place, invariants,
    isochoric, positive_domain,
};
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::hash::HashMap;
use crate::algebra::interpret::{Point, Value, evaluate, evaluate_with};
use crate::printer::source::source;

/// Ways away from rest, by ln λ: uniaxial and equibiaxial stretching and shear at constant volume, and all there is of one, two
/// and three stretches that grow or shrink together.
const WAYS: [[f64; 3]; 9] = [
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

/// Points of each way, the last of which is at a stretch of 10 or 1/10.
const STEPS: usize = 8;

/// Draws of the parameters that are tried: so many that limits such as that of I1, which is beyond 3, are on either side.
const DRAWS: usize = 12;

/// Attempts from one to the next of them, which are over more decades, as long as all are positive.
const STRIDE: usize = CANDIDATES / 20 / DRAWS;

/// Something that has a value only where another is not zero.
#[derive(Clone, Copy)]
pub(super) struct Argument {
    pub(super) of: Id,
    /// `None` for a logarithm.
    pub(super) exponent: Option<Exponent>,
}

impl Argument {
    /// Those of an expression that depend on the stretches.
    pub(super) fn all(graph: &Graph, id: Id) -> Vec<Self> {
        let mut found = Vec::new();
        for id in graph.reachable(&[id]) {
            match graph.node(id) {
                Node::Ln(of) => found.push(Self { of: *of, exponent: None }),
                Node::Product(factors) => found.extend(
                    factors
                        .iter()
                        .filter(|(_, exponent)| exponent.as_integer().is_none_or(|n| n < 0))
                        .map(|&(of, exponent)| Self { of, exponent: Some(exponent) }),
                ),
                _ => {}
            }
        }
        found.retain(|argument| argument.depends_on(graph, |node| matches!(node, Node::Stretch(_))));
        found
    }

    /// Whether an expression is one of those of a part.
    pub(super) fn is_in(graph: &Graph, part: Id, of: Id) -> bool {
        Self::all(graph, part).iter().any(|argument| argument.of == of)
    }

    fn depends_on(&self, graph: &Graph, is: impl Fn(&Node) -> bool) -> bool {
        graph.reachable(&[self.of]).into_iter().any(|id| is(graph.node(id)))
    }

    /// Whether it is a real power, a root among them.
    fn is_real_power(&self) -> bool {
        self.exponent.is_some_and(|exponent| exponent.as_integer().is_none())
    }
}

/// Beside rest, rounding leaves what vanishes there of either sign, and powers that are not whole have no value for one of them.
pub(super) fn powers(
    graph: &mut Graph,
    written: &Written<'_>,
    samples: &[Point],
    mistakes: &mut Mistakes<'_>,
) {
    let vanishes = |graph: &Graph, of: Id| {
        samples.iter().all(|point| {
            let Value { value, magnitude } = evaluate(graph, of, &at_rest(point));
            value.abs() <= NOISE * magnitude
        })
    };
    let arguments = Argument::all(graph, written.energy);
    let found =
        arguments.into_iter().find(|argument| argument.is_real_power() && vanishes(graph, argument.of));
    let Some(Argument { of, exponent: Some(exponent) }) = found else { return };
    let power = graph.power(of, exponent);
    let message = format!(
        "`{}` is of what vanishes at rest and is negative beside it, if only by rounding, where no power but a whole one has a \
         value: write a whole power, such as `.powi(2)`, or one of what stays positive, such as \
         `(1.0 + b * (I1b - 3.0)).powf(n)`",
        source(graph, written.declaration, power)
    );
    let is_it = |part| {
        Argument::all(graph, part).iter().any(|argument| argument.is_real_power() && argument.of == of)
    };
    mistakes.report(written, written.holder(is_it), message);
}

/// What would do to something that vanishes inside the domain.
pub(super) enum Remedy {
    /// I1b, I2b in the places of I1, I2.
    Isochoric,
    /// This as a condition of the domain.
    Limit(String),
}

/// What vanishes within the domain, away from rest, is a limit of it, or wants other invariants.
pub(super) fn limits(
    graph: &mut Graph,
    written: &Written<'_>,
    samples: &[Point],
    mistakes: &mut Mistakes<'_>,
) {
    let Some((of, remedy)) = vanishing(graph, written) else { return };
    if mistakes.is_known(|part| Argument::is_in(graph, part, of)) {
        return;
    }
    let declaration = written.declaration;
    let names = invariants(declaration);
    let remedy = match remedy {
        Remedy::Isochoric => {
            let is = if names.len() == 1 { "is" } else { "are" };
            format!("write {}, which {is} at least 3 wherever J > 0", in_place(&names))
        }
        Remedy::Limit(limit) => {
            let domain = if has_value(graph, written, samples) {
                let conditions = declaration.options.domain.iter().map(|it| it.to_token_stream().to_string());
                let conditions: Vec<_> = conditions.chain([limit]).collect();
                format!("`domain({})`", conditions.join(", "))
            } else {
                positive_domain(declaration, &[limit])
            };
            let is_parameter = |id| matches!(graph.node(id), Node::Parameter(_));
            let has_parameters = graph.reachable(&[of]).into_iter().any(is_parameter);
            let or = if has_parameters { ", or limit the parameters by `admissible(…)`" } else { "" };
            format!("declare {domain}{or}")
        }
    };
    let text = source(graph, declaration, of);
    let message = format!("`{text}` vanishes inside the domain, and there this has no value: {remedy}");
    mistakes.report(written, written.holder(|part| Argument::is_in(graph, part, of)), message);
}

/// What vanishes inside the domain and must not, and what would do.
pub(super) fn vanishing(graph: &mut Graph, written: &Written<'_>) -> Option<(Id, Remedy)> {
    let draws = draws(graph, written);
    let of = vanishing_in(graph, written, written.energy, &draws)?;
    let isochoric = isochoric(graph, written);
    if !invariants(written.declaration).is_empty()
        && vanishing_in(graph, written, isochoric, &draws).is_none()
    {
        return Some((of, Remedy::Isochoric));
    }
    let is_positive_at_rest = draws.iter().any(|point| evaluate(graph, of, &at_rest(point)).value > 0.0);
    let side = if is_positive_at_rest { '>' } else { '<' };
    let limit = format!("{} {side} 0.0", source(graph, written.declaration, of));
    Some((of, Remedy::Limit(limit)))
}

fn vanishing_in(graph: &Graph, written: &Written<'_>, energy: Id, draws: &[Point]) -> Option<Id> {
    // What functions are defined for is their own affair.
    if written.declaration.has_functions() {
        return None;
    }
    let arguments = Argument::all(graph, energy);
    let found = arguments.into_iter().find(|argument| {
        // No condition of a domain is on each entry of a list.
        !is_positive(graph, argument.of)
            && !argument.depends_on(graph, |node| matches!(node, Node::Entry(_)))
            && draws.iter().any(|point| changes_sign(graph, written, argument.of, point))
    });
    found.map(|argument| argument.of)
}

/// Parameters of a few decades.
fn draws(graph: &Graph, written: &Written<'_>) -> Vec<Point> {
    let mut random = Random(0xD1B5_4A32_D192_ED03);
    let draw = |attempt| candidate(written.declaration, &mut random, attempt, written.volume);
    let attempts = (0..CANDIDATES / 20).step_by(STRIDE).chain(0..CANDIDATES);
    attempts.map(draw).filter(|point| is_good(graph, written, point)).take(DRAWS).collect()
}

/// Parameters with which the energy has a value at rest. Further stretches are not asked: that they have none may be the mistake.
pub(super) fn is_good(graph: &Graph, written: &Written<'_>, point: &Point) -> bool {
    let value = |id| evaluate(graph, id, &at_rest(point)).value;
    written.admissible.iter().chain(written.bounds).all(|&id| value(id) > 0.0)
        && value(written.energy).is_finite()
}

/// Whether it is seen by its form that an expression is positive for positive stretches.
fn is_positive(graph: &Graph, id: Id) -> bool {
    match graph.node(id) {
        Node::Stretch(_) | Node::Exp(_) => true,
        Node::Linear { constant, terms } => {
            !constant.is_negative()
                && terms.iter().all(|&(term, c)| !c.is_negative() && is_positive(graph, term))
                && !graph.is_zero(id)
        }
        Node::Product(factors) => factors.iter().all(|&(base, _)| is_positive(graph, base)),
        _ => false,
    }
}

/// Whether it does so on one of the [`WAYS`], with the parameters of the point, before the domain ends.
fn changes_sign(graph: &Graph, written: &Written<'_>, id: Id, point: &Point) -> bool {
    let sign = evaluate(graph, id, &at_rest(point)).value.signum();
    WAYS.into_iter().any(|way| {
        for step in 1..=STEPS {
            let length = step as f64 / STEPS as f64 * std::f64::consts::LN_10;
            let point = Point { stretches: way.map(|exponent| (length * exponent).exp()), ..point.clone() };
            let mut memo = HashMap::default();
            let mut value = |id| evaluate_with(graph, id, &point, &mut memo);
            let is_inside = written.bounds.iter().all(|&bound| value(bound).value > 0.0);
            let Value { value, magnitude } = value(id);
            if !is_inside || !value.is_finite() {
                return false;
            }
            if sign * value < -NOISE * magnitude {
                return true;
            }
        }
        false
    })
}
