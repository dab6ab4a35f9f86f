//! Real powers of I1b − 3 and similar terms: the stiffness at rest must be finite.
//!
//! The stiffness of (I1b − 3)ⁿ goes with the strain to the power 2n − 2 (see [`excess`]): it is infinite at
//! rest for n < 1. Roots may still occur where a sum is smooth, as in ln(1 − √X) + √X = −X/2 − …, so the
//! stiffness itself is judged, at strains that are many orders of magnitude apart.
//!
//! [`excess`]: crate::algebra::excess

use super::argument::Argument;
use super::explain::{is_declarable, with_admissible};
use super::finding::Findings;
use super::samples::{CANDIDATES, POSITIVE, draws};
use super::source::Source;
use crate::algebra::excess::has_squares;
use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::interpret::{Memo, Point, evaluate, evaluate_with};
use crate::algebra::rational::Rational;
use crate::printer::rust;

/// Draws of positive parameters, of which about 0.4 have an exponent below 1 if that is not excluded.
const DRAWS: usize = 24;

/// Draws of parameters of either sign: an exponent n + 1 is between 0 and 1 in a tenth of them, so that all
/// miss it once in 10⁶ times.
const DRAWS_OF_EITHER_SIGN: usize = 128;

/// A direction of strain that changes I1b and I2b.
const DIRECTION: [f64; 3] = [1.0, -0.25, -0.75];

/// A strain, and one far below it.
const STRAINS: [f64; 2] = [1e-6, 1e-14];

/// The ratio of their stiffnesses that shows growth: that of an exponent of 0.99.
const GROWTH: f64 = 1.4;

/// Finds an energy whose stiffness grows without bound towards rest, given the second derivatives.
pub(crate) fn roughness(graph: &mut Graph, hessian: &[Id], findings: &mut Findings<'_>) {
    let source = findings.source;
    if !has_squares(graph, source.energy) {
        return;
    }
    let powers = powers(graph, source.energy);
    let values: Vec<_> = powers.iter().map(|&(_, exponent)| graph.exponent_value(exponent)).collect();
    let stiffness = |point: &Point, strain: f64| {
        let stretches = DIRECTION.map(|direction| 1.0 + strain * direction);
        let (point, mut memo) = (Point { stretches, ..point.clone() }, Memo::default());
        let entries = hessian.iter().map(|&entry| evaluate_with(graph, entry, &point, &mut memo).value.abs());
        entries
            .fold(0.0, |largest: f64, entry| if entry > largest || entry.is_nan() { entry } else { largest })
    };
    let mut grows = false;
    let mut is_rough = vec![false; powers.len()];
    // Parameters are positive in the first ones, where conditions allow it.
    let positive = draws(graph, source, 0x9FB2_1C65_1E98_DF25, 0..CANDIDATES).take(DRAWS);
    let either = draws(graph, source, 0x5851_F42D_4C95_7F2D, POSITIVE..CANDIDATES);
    let either = either.take(DRAWS_OF_EITHER_SIGN).map(|point| (point, false));
    for (point, is_positive) in positive.map(|point| (point, true)).chain(either) {
        let is_below_one = |&k: &usize| evaluate(graph, values[k], &point).value < 1.0;
        let below_one: Vec<_> = (0..powers.len()).filter(is_below_one).collect();
        // The others have been judged with positive parameters.
        if !is_positive && !below_one.iter().any(|&k| powers[k].1.real.is_some()) {
            continue;
        }
        let [near, far] = STRAINS.map(|strain| stiffness(&point, strain));
        let has_value = !near.is_nan() && !far.is_nan();
        // A base may have no value for negative parameters.
        if if has_value { far > GROWTH * near } else { is_positive } {
            grows = true;
            below_one.into_iter().for_each(|k| is_rough[k] = true);
        }
    }
    if !grows {
        return;
    }
    let rough = powers.iter().zip(is_rough).filter(|(_, is_rough)| *is_rough).map(|(&power, _)| power);
    let (real, fractions): (Vec<_>, Vec<_>) = rough.partition(|(_, exponent)| exponent.real.is_some());
    // A root next to them may be smooth with its neighbours.
    let rough = if real.is_empty() { fractions } else { real };
    let holds = |part| {
        let is_meant = |of: &Argument| {
            rough.first().is_some_and(|&(base, exponent)| of.of == base && of.exponent == Some(exponent))
        };
        Argument::all(graph, part).iter().any(is_meant)
    };
    let part = source.first_operand(holds);
    let remedy = above_one(graph, source, &rough);
    findings.add(
        part,
        format!(
            "the stiffness of this is infinite at rest, as that of a power of `I1b - 3.0` is for an exponent below 1: {remedy}"
        ),
    );
}

/// The remedy that the exponents of powers are above 1.
fn above_one(graph: &mut Graph, source: &Source<'_>, powers: &[(Id, Exponent)]) -> String {
    let conditions = powers.iter().map(|&(_, exponent)| is_above_one(graph, source, exponent));
    let conditions: Vec<String> = conditions.collect::<Option<_>>().unwrap_or_default();
    if conditions.is_empty() {
        return "take a power above 1".to_owned();
    }
    let firsts = (0..conditions.len()).filter(|&k| !conditions[..k].contains(&conditions[k]));
    let conditions = firsts.map(|k| conditions[k].clone()).collect();
    format!("declare {}", with_admissible(source, conditions))
}

/// The condition that an exponent is above 1, if it can be declared: of `2.0 * n + 1.0` it is `n > 0.0`.
fn is_above_one(graph: &mut Graph, source: &Source<'_>, exponent: Exponent) -> Option<String> {
    let mut varying = exponent.real?;
    let mut limit = Rational::ONE.checked_add(exponent.rational.negated())?;
    let mut side = '>';
    if let Node::Linear { constant, terms } = graph.node(varying)
        && let (true, &[(term, factor)]) = (constant.is_zero(), &terms[..])
    {
        limit = limit.checked_mul(factor.checked_powi(-1)?)?;
        side = if factor.is_negative() { '<' } else { '>' };
        varying = term;
    }
    let limit = graph.constant(limit);
    let [varying_text, limit] = [varying, limit].map(|id| rust(graph, source.declaration, id));
    let condition = format!("{varying_text} {side} {limit}");
    is_declarable(graph, varying, &condition).then_some(condition)
}

/// The powers of sums of squares that are not whole, each with its base.
fn powers(graph: &Graph, energy: Id) -> Vec<(Id, Exponent)> {
    let arguments = Argument::all(graph, energy).into_iter();
    let of_squares = arguments.filter(|argument| matches!(graph.node(argument.of), Node::Excess(..)));
    of_squares.filter_map(|argument| Some((argument.of, argument.real_exponent()?))).collect()
}
