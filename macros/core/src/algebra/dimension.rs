//! Dimensions of expressions, as exponents of Pa.
//!
//! Stretches, literals and what is computed from these alone have none; parameters have those of their units.
//! What is added has one dimension; logarithms, exponentials, arguments of functions and bases of real powers
//! have none.

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Function, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// The exponent of Pa; `None` if it depends on a parameter without a unit.
pub type Dimension = Option<Rational>;

/// Two parts of an expression with inconsistent dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clash {
    /// Two terms of a sum.
    Terms([(Id, Rational); 2]),
    /// Something with a dimension, used as a number without one.
    Argument(Id, Rational),
}

/// Dimensions by the units of the parameters, each computed once.
#[derive(Debug)]
pub struct Dimensions<'a> {
    units: &'a [Option<i64>],
    memo: FxHashMap<Id, Result<Dimension, Clash>>,
}

impl<'a> Dimensions<'a> {
    /// Dimensions from the exponent of Pa in the unit of each parameter, or of the values of a function;
    /// `None` without a unit.
    #[must_use]
    pub fn new(units: &'a [Option<i64>]) -> Self {
        Self { units, memo: FxHashMap::default() }
    }

    /// The dimension of an expression in stretches and parameters.
    ///
    /// # Errors
    /// The first clash inside it, operands before what they are operands of.
    pub fn of(&mut self, graph: &Graph, id: Id) -> Result<Dimension, Clash> {
        once!(self.memo, id, self.rule(graph, id))
    }

    fn rule(&mut self, graph: &Graph, id: Id) -> Result<Dimension, Clash> {
        match graph.node(id) {
            Node::Parameter(k) | Node::Entry(k) => Ok(self.units[*k].map(Rational::integer)),
            Node::Excess(_, body) | Node::Accurate(_, body) | Node::Sum(_, body) => self.of(graph, *body),
            Node::Apply(function, argument) => {
                if let Function::WholePower(exponent, _) = function {
                    self.without(graph, *exponent)?;
                }
                let number = self.without(graph, *argument)?;
                let Function::Given(k, _) = function else { return Ok(number) };
                Ok(self.units[*k].map(Rational::integer))
            }
            // Zero, of any dimension.
            Node::Linear { constant, terms } if terms.is_empty() && constant.is_zero() => Ok(None),
            Node::Linear { constant, terms } => {
                let number = (!constant.is_zero()).then_some((id, Some(Rational::ZERO)));
                let mut known: Option<(Id, Rational)> = None;
                let mut meet = |(term, dimension): (Id, Dimension)| match (known, dimension) {
                    (Some((first, one)), Some(other)) if one != other => {
                        Err(Clash::Terms([(first, one), (term, other)]))
                    }
                    (_, dimension) => {
                        known = known.or(dimension.map(|dimension| (term, dimension)));
                        Ok(())
                    }
                };
                for &(term, _) in terms {
                    meet((term, self.of(graph, term)?))?;
                }
                number.map_or(Ok(()), meet)?;
                Ok(known.map(|(_, dimension)| dimension))
            }
            Node::Product(factors) => {
                factors.iter().try_fold(Some(Rational::ZERO), |product, &(base, exponent)| {
                    let power = match exponent.real {
                        Some(real) => {
                            self.without(graph, real)?;
                            self.without(graph, base)?
                        }
                        None => self.of(graph, base)?.and_then(|base| base.checked_mul(exponent.rational)),
                    };
                    Ok(product.zip(power).and_then(|(product, power)| product.checked_add(power)))
                })
            }
            _ => Ok(Some(Rational::ZERO)),
        }
    }

    /// Checks that an argument has no dimension, as it must.
    fn without(&mut self, graph: &Graph, argument: Id) -> Result<Dimension, Clash> {
        match self.of(graph, argument)? {
            Some(dimension) if !dimension.is_zero() => Err(Clash::Argument(argument, dimension)),
            _ => Ok(Some(Rational::ZERO)),
        }
    }
}
