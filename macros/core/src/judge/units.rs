//! Check that the units of the parameters make ψ an energy density, in Pa.

use super::explain::QUOTABLE;
use super::finding::Finding;
use super::source::Source;
use crate::algebra::dimension::{Clash, Dimensions};
use crate::algebra::expr::{Graph, Id, Node};
use crate::algebra::rational::Rational;
use crate::printer::rust;
use crate::read::parse::Parameter;
use crate::read::unit::Unit;

/// Checks that ψ is in Pa, where the units of its parameters are known. A declaration without units is not
/// checked.
pub(crate) fn units(graph: &mut Graph, source: &Source<'_>) -> Option<Finding> {
    if !source.declaration.has_units() {
        return None;
    }
    let parameters = source.declaration.parameters.iter();
    let pascals: Vec<_> = parameters.map(|parameter| parameter.unit().map(|unit| unit as i64)).collect();
    let mut dimensions = Dimensions::new(&pascals);
    match dimensions.of(graph, source.energy) {
        Ok(None | Some(Rational::ONE)) => None,
        Ok(Some(dimension)) => {
            let (unit, advice) = (in_unit(dimension), advice(source));
            let message = format!("this energy is {unit}, but an energy density is in Pa: {advice}");
            Some(Finding::new(source.blamed_term(|_| false), message))
        }
        Err(clash) => {
            let part = source.blamed_operand(|part| dimensions.of(graph, part).is_err());
            Some(Finding::new(part, clash_message(graph, source, clash)))
        }
    }
}

fn clash_message(graph: &mut Graph, source: &Source<'_>, clash: Clash) -> String {
    let advice = advice(source);
    match clash {
        Clash::Terms(terms) => {
            let [one, other] = terms.map(|(term, dimension)| with_unit(graph, source, term, dimension));
            let other = other.trim_end_matches(',');
            format!("{one} is added to {other}, but terms of a sum have one unit: {advice}")
        }
        Clash::Argument(argument, dimension) => format!(
            "{} stands where only a number without unit can, in a logarithm, an exponential, an exponent, a \
             power with a parameter as exponent, or a function: divide it by a parameter of the same unit; \
             or {advice}",
            with_unit(graph, source, argument, dimension)
        ),
    }
}

/// Advice on how to state units, and how not to.
fn advice(source: &Source<'_>) -> &'static str {
    source.notation.either(
        "correct the energy, or the units that end the documentation of its parameters, as in \
         `/// Shear modulus, Pa.` and `/// Exponent, dimensionless.`; if a number in the energy has a \
         unit, make it a parameter, or leave the units out",
        "correct the energy, or the units of the values; if a number in the energy has a unit, make it a parameter, \
         or give the values without units",
    )
}

/// A quoted term with its unit: `c1 * l1`, in Pa.
fn with_unit(graph: &mut Graph, source: &Source<'_>, term: Id, dimension: Rational) -> String {
    let is_number = matches!(graph.node(term), Node::Linear { .. }) && dimension.is_zero();
    let text = rust(graph, source.declaration, term);
    match is_number || text.len() > QUOTABLE {
        true if dimension.is_zero() => "a number without unit".to_owned(),
        true => format!("a term {}", in_unit(dimension)),
        false => format!("`{text}`, {},", in_unit(dimension)),
    }
}

/// A unit with its preposition.
fn in_unit(dimension: Rational) -> String {
    match dimension {
        Rational::ONE => "in Pa".to_owned(),
        _ if dimension.is_zero() => "without unit".to_owned(),
        _ if dimension.denominator() == 1 => format!("in Pa^{}", dimension.numerator()),
        _ => format!("in Pa^({}/{})", dimension.numerator(), dimension.denominator()),
    }
}

/// The unit of each parameter: the one that is stated, or else the only one with which ψ can be in Pa.
/// Without stated units nothing is inferred.
pub(crate) fn units_of_parameters(graph: &Graph, source: &Source<'_>) -> Vec<Option<Unit>> {
    let mut units: Vec<_> = source.declaration.parameters.iter().map(Parameter::unit).collect();
    if !source.declaration.has_units() {
        return units;
    }
    // The second time with the units that were found the first time: the unit of b in a/b implies that of a.
    for k in (0..units.len()).chain(0..units.len()) {
        if units[k].is_none() {
            let mut fitting = Unit::ALL.into_iter().filter(|&unit| {
                let pascals: Vec<_> = (0..units.len())
                    .map(|other| if other == k { Some(unit) } else { units[other] }.map(|unit| unit as i64))
                    .collect();
                matches!(Dimensions::new(&pascals).of(graph, source.energy), Ok(None | Some(Rational::ONE)))
            });
            let unit = fitting.next().filter(|_| fitting.next().is_none());
            units[k] = unit;
        }
    }
    units
}
