//! Which powers of each base are needed, and which one of them is computed.

use std::collections::{BTreeMap, HashMap};

use crate::expr::{Exponent, Graph, Id, Node};
use crate::rational::Rational;

/// Which powers of each base are needed, to choose the one that is computed.
pub(super) struct Powers {
    /// Common denominator of the fractional exponents of a base.
    denominators: HashMap<Id, i128>,
    /// The rational part of the exponent of the power that is computed.
    representatives: HashMap<PowerClass, Rational>,
}

/// Powers that follow from each other by multiplication with the base: the base, the real part of the exponent, and the
/// fraction of its rational part.
type PowerClass = (Id, Id, Rational);

impl Powers {
    /// Those that the nodes read.
    pub(super) fn used_by(graph: &Graph, reachable: &[Id]) -> Self {
        let mut denominators: HashMap<Id, i128> = HashMap::new();
        let mut used: BTreeMap<PowerClass, (Vec<Rational>, Vec<Rational>)> = BTreeMap::new();
        for &id in reachable {
            match graph.node(id) {
                Node::Product(factors) => {
                    for &(base, exponent) in factors {
                        match exponent.real {
                            Some(real) => {
                                used.entry(class(base, real, exponent))
                                    .or_default()
                                    .0
                                    .push(exponent.rational);
                            }
                            None => {
                                let common = denominators.entry(base).or_insert(1);
                                *common = least_common_multiple(*common, exponent.rational.denominator());
                            }
                        }
                    }
                }
                // A quotient reads both powers: computing exactly those leaves no product for it.
                Node::PowerQuotient(a, b, exponent) => {
                    for base in [*a, *b] {
                        if let Some(real) = exponent.real {
                            used.entry(class(base, real, *exponent)).or_default().1.push(exponent.rational);
                        }
                    }
                }
                _ => {}
            }
        }
        let largest = |all: &[Rational]| all.iter().copied().reduce(larger);
        let representatives = used
            .into_iter()
            .filter_map(|(key, (plain, quotient))| {
                Some((key, largest(&quotient).or_else(|| largest(&plain))?))
            })
            .collect();
        Self { denominators, representatives }
    }

    /// The rational part of the exponent of the real power from which `base^exponent` follows by multiplication.
    pub(super) fn representative(&self, base: Id, real: Id, exponent: Exponent) -> Rational {
        self.representatives.get(&class(base, real, exponent)).copied().unwrap_or(exponent.rational)
    }

    /// q such that the fractional powers of the base are whole powers of its q-th root.
    pub(super) fn root(&self, base: Id, exponent: Rational) -> i128 {
        self.denominators.get(&base).copied().unwrap_or(exponent.denominator())
    }
}

fn class(base: Id, real: Id, exponent: Exponent) -> PowerClass {
    let Exponent { rational, .. } = exponent;
    let fraction =
        Rational::new(rational.numerator().rem_euclid(rational.denominator()), rational.denominator());
    (base, real, fraction.unwrap_or(Rational::ZERO))
}

fn larger(a: Rational, b: Rational) -> Rational {
    if a.checked_add(b.negated()).is_some_and(Rational::is_negative) { b } else { a }
}

fn least_common_multiple(a: i128, b: i128) -> i128 {
    let gcd = |mut a: i128, mut b: i128| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    a / gcd(a, b) * b
}
