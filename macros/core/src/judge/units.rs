//! Check that the units of the parameters make ψ an energy density, in Pa.

use super::finding::{Finding, Violation};
use super::source::Source;
use crate::algebra::dimension::Dimensions;
use crate::algebra::expr::Graph;
use crate::algebra::rational::Rational;
use crate::read::parse::Parameter;
use crate::read::unit::Unit;

/// Checks that ψ is in Pa, where the units of its parameters are known. A declaration without units is not
/// checked.
pub(crate) fn units(graph: &Graph, source: &Source<'_>) -> Option<Finding> {
    if !source.declaration.has_units() {
        return None;
    }
    let parameters = source.declaration.parameters.iter();
    let pascals: Vec<_> = parameters.map(|parameter| parameter.unit().map(Unit::pascals)).collect();
    let mut dimensions = Dimensions::new(&pascals);
    match dimensions.of(graph, source.energy) {
        Ok(None | Some(Rational::ONE)) => None,
        Ok(Some(dimension)) => {
            Some(Finding::new(source.blamed_term(|_| false), Violation::NotInPascals(dimension)))
        }
        Err(clash) => {
            let part = source.blamed_operand(|part| dimensions.of(graph, part).is_err());
            Some(Finding::new(part, Violation::UnitsClash(Box::new(clash))))
        }
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
                    .map(|other| if other == k { Some(unit) } else { units[other] }.map(Unit::pascals))
                    .collect();
                matches!(Dimensions::new(&pascals).of(graph, source.energy), Ok(None | Some(Rational::ONE)))
            });
            let unit = fitting.next().filter(|_| fitting.next().is_none());
            units[k] = unit;
        }
    }
    units
}
