//! Powers of each base: those that are needed, and the one that is computed.

use rustc_hash::FxHashMap;

use crate::algebra::divided::LARGEST_ROOT;
use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::{Rational, gcd};

/// The powers of each base that are needed, from which the computed one is chosen.
pub(super) struct Powers {
    /// Common denominator of the simple fractional exponents of a base.
    denominators: FxHashMap<Id, i128>,
    /// The rational part of the exponent of the power that is computed, after true if a quotient reads it.
    representatives: FxHashMap<PowerClass, (bool, Rational)>,
}

/// Powers that follow from each other by multiplication with the base: the base, the real part of the
/// exponent, and the fraction of its rational part.
type PowerClass = (Id, Option<Id>, Rational);

/// The way in which a power is computed.
pub(super) enum Evaluation {
    /// A power of the root of this degree.
    Root(i128),
    /// A multiple of the real power whose exponent has this rational part.
    Real(Rational),
}

impl Powers {
    /// The powers that the nodes read.
    pub(super) fn used_by(graph: &Graph, reachable: &[Id]) -> Self {
        let mut denominators: FxHashMap<Id, i128> = FxHashMap::default();
        let mut representatives: FxHashMap<PowerClass, (bool, Rational)> = FxHashMap::default();
        let mut read = |base, exponent: Exponent, by_quotient| {
            let power = (by_quotient, exponent.rational);
            let computed = representatives.entry(class(base, exponent)).or_insert(power);
            // A quotient reads both powers: computing exactly those leaves no product for it.
            if by_quotient && !computed.0 || by_quotient == computed.0 && is_less(computed.1, power.1) {
                *computed = power;
            }
        };
        for &id in reachable {
            match graph.node(id) {
                Node::Product(factors) => {
                    for &(base, exponent) in factors {
                        if is_simple(exponent) {
                            let common = denominators.entry(base).or_insert(1);
                            let denominator = exponent.rational.denominator();
                            *common *= denominator / gcd(*common, denominator);
                        } else {
                            read(base, exponent, false);
                        }
                    }
                }
                Node::Quotient(Function::Power(exponent), a, b) => {
                    [*a, *b].into_iter().for_each(|base| read(base, *exponent, true));
                }
                _ => {}
            }
        }
        Self { denominators, representatives }
    }

    /// The way in which `base^exponent` is computed.
    pub(super) fn evaluation(&self, base: Id, exponent: Exponent) -> Evaluation {
        let Exponent { rational, .. } = exponent;
        if exponent.as_integer().is_some() {
            Evaluation::Root(1)
        } else if is_simple(exponent) {
            // Roots of one base share a common one unless that is of too high a degree.
            let common = self.denominators.get(&base).copied().filter(|&common| common <= LARGEST_ROOT);
            Evaluation::Root(common.unwrap_or(rational.denominator()))
        } else {
            let computed = self.representatives.get(&class(base, exponent));
            Evaluation::Real(computed.map_or(rational, |&(_, computed)| computed))
        }
    }
}

/// A fraction that is computed by a root.
fn is_simple(exponent: Exponent) -> bool {
    exponent.real.is_none() && exponent.rational.denominator() <= LARGEST_ROOT
}

fn class(base: Id, exponent: Exponent) -> PowerClass {
    let Exponent { real, rational } = exponent;
    let fraction =
        Rational::new(rational.numerator().rem_euclid(rational.denominator()), rational.denominator());
    (base, real, fraction.unwrap_or(Rational::ZERO))
}

fn is_less(a: Rational, b: Rational) -> bool {
    a.checked_add(b.negated()).is_some_and(Rational::is_negative)
}
