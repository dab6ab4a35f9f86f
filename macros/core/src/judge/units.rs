//! Check that the units of the parameters make ψ an energy density, in Pa.

use super::finding::{Finding, Violation};
use super::source::Source;
use crate::algebra::dimension::Dimensions;
use crate::algebra::expr::Graph;
use crate::algebra::rational::Rational;

/// Checks that ψ is in Pa, where the units of its parameters are known. A declaration without units is not
/// checked.
pub(crate) fn units(graph: &Graph, source: &Source<'_>) -> Option<Finding> {
    if !source.declaration.has_units() {
        return None;
    }
    let units = source.declaration.pascals();
    let mut dimensions = Dimensions::new(&units);
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
