//! I1b − 3 and I2b − 3 as sums of squares in the bases of real powers.
//!
//! Isochoric invariants are at least 3, but I1b − 3 as it is written is known to u alone, and is negative at
//! rest as often as not: near rest it has no digit, and a real power of it no value. With a = λ1^(2/3), b and
//! c,
//!
//! ```text
//! J^(2/3) = a b c        I1 = a³ + b³ + c³
//!
//! I1b − 3 = (a³ + b³ + c³ − 3 a b c)/(a b c)
//!         = ½ (1/(b c) + 1/(c a) + 1/(a b)) ((a − b)² + (b − c)² + (c − a)²)
//! ```
//!
//! whose terms are never negative, and as accurate, relative to themselves, as the differences of the
//! stretches are. I2b − 3 is the same in the reciprocal stretches, a = λ1^(−2/3).
//!
//! An expression in them, such as (1 − β) I1b + β I2b − 3 or (I1b − 3)/(Λ² − 3), is found by writing 3 + X
//! for I1b and 3 + Y for I2b and multiplying out: if what is left vanishes with X and Y, it is the sum of
//! squares. [`Node::Excess`] holds it together with the expression as written, which is for readers.
//!
//! # Small constants
//!
//! (I1b − 3 + C²)ⁿ with a small parameter C loses digits too, as I1b − 3 is rounded before C² is added: u/C²
//! of its value near every dilation. Where parameters alone are added to what vanishes at rest, X and Y take
//! its place in arguments of real powers, logarithms and other functions. They do so alone in those of
//! functions that are parameters, which may end at zero or have an infinite slope there. Sums with numbers,
//! such as 1 − (I1b − 3)/Jm, lose few digits unless Jm is small, and stay: stress by invariants needs them as
//! they are written.
//!
//! # At rest
//!
//! X is of second order in the strains. So Xⁿ is twice continuously differentiable for n > 1, not only for n
//! ≥ 2: its stiffness n (n − 1) Xⁿ⁻² X′ X′ + n Xⁿ⁻¹ X″ falls with the strain to the power 2n − 2. At rest
//! itself Xⁿ⁻² may be infinite with X′ = 0, and so the base of a power is kept from zero by the smallest
//! positive number: then the product is 0, as it should be. That needs derivatives of the squares, which
//! vanish where they do: those of I1b − 3 as it is written would leave u, times a power that may be infinite.

use rustc_hash::FxHashMap;

use crate::algebra::expand::expand_products;
use crate::algebra::expr::{Exponent, Function, Graph, Id, Node};
use crate::algebra::increment::substitute_rest;
use crate::algebra::rational::Rational;
use crate::algebra::volume::rewrite;

/// An energy, or a bound of a domain, with the bases of its real powers as sums of squares, if they are
/// recognised as such.
pub fn with_squares(graph: &mut Graph, energy: Id) -> Id {
    Invariants::new(graph).rewritten(graph, energy)
}

/// The energy with I1b − 3 and similar terms as sums of squares also if parameters are added to them in
/// arguments of real powers and functions, and in arguments of functions that are parameters.
pub fn with_squares_in_sums(graph: &mut Graph, energy: Id) -> Id {
    Invariants::new(graph).rewritten_sums(graph, energy)
}

/// True if an expression has such bases or arguments.
pub(crate) fn has_squares(graph: &Graph, id: Id) -> bool {
    graph.contains(id, |node| matches!(node, Node::Excess(..) | Node::Accurate(..)))
}

/// The expression with its sums of squares only, without the forms in which they were written, before it is
/// scheduled.
pub fn squares_alone(graph: &mut Graph, e: Id, memo: &mut FxHashMap<Id, Id>) -> Id {
    rewrite(graph, e, memo, &|graph, id| match *graph.node(id) {
        Node::Excess(value, _) => Some(graph.excess(value, value)),
        Node::Accurate(value, _) => Some(value),
        _ => None,
    })
}

/// The nodes by which isochoric invariants are recognised.
struct Invariants {
    volume: Id,
    both: [Isochoric; 2],
}

/// I1b = J^(−2/3) I1, or I2b = J^(−4/3) I2.
struct Isochoric {
    /// I1 or I2.
    invariant: Id,
    /// The exponent of J.
    exponent: Rational,
    /// I1b − 3 or I2b − 3.
    excess: Id,
}

impl Invariants {
    fn new(graph: &mut Graph) -> Self {
        let [first, second, volume] = graph.invariants();
        let both = [(first, -2), (second, -4)].map(|(invariant, numerator)| {
            let exponent = Rational::new(numerator, 3).unwrap_or(Rational::ONE);
            let isochoric =
                graph.product(&[(volume, Exponent::rational(exponent)), (invariant, Exponent::ONE)]);
            let plain = graph.linear(Rational::integer(-3), &[(isochoric, Rational::ONE)]);
            let value = squares_of_differences(graph, if numerator == -2 { 2 } else { -2 });
            Isochoric { invariant, exponent, excess: graph.excess(value, plain) }
        });
        Self { volume, both }
    }

    /// An expression with the bases of its real powers replaced.
    fn rewritten(&self, graph: &mut Graph, e: Id) -> Id {
        rewrite(graph, e, &mut FxHashMap::default(), &|graph, id| {
            self.powers(graph, id, Self::squares, Self::rewritten)
        })
    }

    /// A product with the bases of its real powers replaced, and other bases rewritten.
    fn powers(
        &self,
        graph: &mut Graph,
        id: Id,
        replaced: fn(&Self, &mut Graph, Id) -> Option<Id>,
        rewritten: fn(&Self, &mut Graph, Id) -> Id,
    ) -> Option<Id> {
        let Node::Product(mut factors) = graph.node(id).clone() else { return None };
        let is_real = |exponent: Exponent| exponent.as_integer().is_none();
        if !factors.iter().any(|&(_, exponent)| is_real(exponent)) {
            return None;
        }
        for (base, exponent) in &mut factors {
            let new = if is_real(*exponent) { replaced(self, graph, *base) } else { None };
            *base = new.unwrap_or_else(|| rewritten(self, graph, *base));
        }
        Some(graph.product(&factors))
    }

    /// An expression with the sums in its arguments replaced.
    fn rewritten_sums(&self, graph: &mut Graph, e: Id) -> Id {
        rewrite(graph, e, &mut FxHashMap::default(), &|graph, id| match graph.node(id).clone() {
            Node::Product(_) => self.powers(graph, id, Self::sum, Self::rewritten_sums),
            Node::Apply(function @ Function::Given(..), a) => {
                let (others, squares) = self.split(graph, a)?;
                let sum = if graph.is_zero(others) { squares } else { accurate(graph, a, others, squares) };
                Some(graph.apply(function, sum))
            }
            Node::Apply(function @ (Function::Ln | Function::Exp | Function::Elementary(_)), a) => {
                self.sum(graph, a).map(|a| graph.apply(function, a))
            }
            // What is a sum of squares already.
            Node::Excess(..) => Some(id),
            _ => None,
        })
    }

    /// An expression as parameters and a combination of X and Y, if it is such a sum.
    fn sum(&self, graph: &mut Graph, e: Id) -> Option<Id> {
        let (others, squares) = self.split(graph, e)?;
        (!graph.is_zero(others)).then(|| accurate(graph, e, others, squares))
    }

    /// The parameters, without numbers, and the combination of X and Y whose sum an expression is, if it is
    /// one.
    fn split(&self, graph: &mut Graph, e: Id) -> Option<(Id, Id)> {
        let shifted = self.shifted(graph, e);
        let expanded = expand_products(graph, shifted);
        if expanded == e || !has_squares(graph, expanded) {
            return None;
        }
        let terms = match graph.node(expanded).clone() {
            Node::Linear { constant, terms } if constant.is_zero() => terms,
            Node::Linear { .. } => return None,
            _ => vec![(expanded, Rational::ONE)],
        };
        let (terms, others): (Vec<_>, Vec<_>) =
            terms.into_iter().partition(|&(term, _)| has_squares(graph, term));
        let is_stretch = |node: &Node| matches!(node, Node::Stretch(_));
        if others.iter().any(|&(term, _)| graph.contains(term, is_stretch)) {
            return None;
        }
        let squares = self.collected(graph, &terms)?;
        let others = graph.linear(Rational::ZERO, &others);
        // As it is written, (a − b)² has more digits.
        let written = substitute_rest(graph, e);
        let [one, other] = [written, others].map(|id| graph.reachable(&[id]).len());
        let others = if one <= other { written } else { others };
        // (3n − I1b)/(3n − 3) is 1 − X/(3n − 3).
        let has_number = !graph.is_zero(others) && graph.as_constant(others).is_some();
        (!has_number).then_some((others, squares))
    }

    /// An expression as a sum of squares, if it is one.
    fn squares(&self, graph: &mut Graph, base: Id) -> Option<Id> {
        let shifted = self.shifted(graph, base);
        let expanded = expand_products(graph, shifted);
        if expanded == base || !has_squares(graph, expanded) {
            return None;
        }
        let at_rest = substitute_rest(graph, expanded);
        if !graph.is_zero(at_rest) {
            return None;
        }
        let collected = match graph.node(expanded).clone() {
            Node::Linear { terms, .. } => self.collected(graph, &terms),
            _ => None,
        };
        let collected = collected.unwrap_or(expanded);
        let value = rewrite(graph, collected, &mut FxHashMap::default(), &excess_alone);
        Some(graph.excess(value, base))
    }

    /// X − β X + β Y as (1 − β) X + β Y, in which nothing cancels; `None` for expressions that are not linear
    /// in X and Y.
    fn collected(&self, graph: &mut Graph, terms: &[(Id, Rational)]) -> Option<Id> {
        let mut factors = [0, 1].map(|k: usize| (self.both[k].excess, Vec::new()));
        for &(term, coefficient) in terms {
            let has = |&mut (excess, _): &mut (Id, Vec<_>)| graph.reachable(&[term]).contains(&excess);
            let (excess, of) = factors.iter_mut().find_map(|each| has(&mut *each).then_some(each))?;
            let factor = graph.div(term, *excess);
            if has_squares(graph, factor) {
                return None;
            }
            of.push((factor, coefficient));
        }
        let products = factors.map(|(excess, of)| {
            let factor = graph.linear(Rational::ZERO, &of);
            graph.mul(factor, excess)
        });
        Some(graph.sum_of(&products))
    }

    /// The expression with I1b replaced by 3 + X and I2b by 3 + Y.
    fn shifted(&self, graph: &mut Graph, e: Id) -> Id {
        rewrite(graph, e, &mut FxHashMap::default(), &|graph, id| {
            let Node::Product(factors) = graph.node(id).clone() else { return None };
            for &Isochoric { invariant, exponent, excess } in &self.both {
                let of = |base: Id| factors.iter().find(|factor| factor.0 == base).map(|factor| factor.1);
                let (Some(n), Some(volume)) = (of(invariant).and_then(Exponent::as_integer), of(self.volume))
                else {
                    continue;
                };
                if n < 1 || Some(volume) != exponent.checked_mul(Rational::integer(n)).map(Exponent::rational)
                {
                    continue;
                }
                let others = factors.iter().filter(|factor| factor.0 != invariant && factor.0 != self.volume);
                let mut others: Vec<_> = others.map(|&(base, e)| (self.shifted(graph, base), e)).collect();
                let isochoric = graph.linear(Rational::integer(3), &[(excess, Rational::ONE)]);
                others.push((isochoric, Exponent::integer(n)));
                return Some(graph.product(&others));
            }
            None
        })
    }
}

/// A sum of parameters and a combination of X and Y. As it does not vanish at rest, its derivatives as it is
/// written are as good as those of squares, and take fewer operations.
fn accurate(graph: &mut Graph, written: Id, others: Id, squares: Id) -> Id {
    let sum = graph.add(others, squares);
    let value = rewrite(graph, sum, &mut FxHashMap::default(), &excess_alone);
    graph.accurate(value, written)
}

/// Squares that replace the quantities kept from zero.
fn excess_alone(graph: &mut Graph, id: Id) -> Option<Id> {
    match *graph.node(id) {
        Node::Excess(value, _) => Some(value),
        _ => None,
    }
}

/// ½ (1/(b c) + 1/(c a) + 1/(a b)) ((a − b)² + (b − c)² + (c − a)²) with a = λ1^(n/3) and so on.
fn squares_of_differences(graph: &mut Graph, n: i128) -> Id {
    let power = |n: i128| Rational::new(n, 3).map_or(Exponent::ONE, Exponent::rational);
    let [a, b, c] = [0, 1, 2].map(|i| {
        let stretch = graph.stretch(i);
        graph.power(stretch, power(n))
    });
    let pairs = [(a, b), (b, c), (c, a)];
    let squares = pairs.map(|(x, y)| {
        let difference = graph.sub(x, y);
        graph.powi(difference, 2)
    });
    let reciprocals =
        pairs.map(|(x, y)| graph.product(&[(x, Exponent::integer(-1)), (y, Exponent::integer(-1))]));
    let half = Rational::new(1, 2).unwrap_or(Rational::ONE);
    let (weights, squares) = (graph.sum_of(&reciprocals), graph.sum_of(&squares));
    let product = graph.mul(weights, squares);
    graph.scale(product, half)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::interpret::{Point, evaluate};

    fn isochoric(graph: &mut Graph) -> [Id; 2] {
        Invariants::new(graph).both.map(|Isochoric { excess, .. }| match *graph.node(excess) {
            Node::Excess(_, plain) => graph.linear(Rational::integer(3), &[(plain, Rational::ONE)]),
            _ => excess,
        })
    }

    fn real(graph: &mut Graph, e: Id) -> Id {
        graph.power(e, Exponent::rational(Rational::new(3, 2).unwrap()))
    }

    #[test]
    fn squares_have_the_value_of_what_they_replace() {
        let mut g = Graph::default();
        let beta = g.leaf(Node::Parameter(0));
        let [i1, i2] = isochoric(&mut g);
        let (first, rest) = (g.mul(beta, i2), g.linear(Rational::ONE, &[(beta, Rational::integer(-1))]));
        let second = g.mul(rest, i1);
        let mixed = g.linear(Rational::integer(-3), &[(first, Rational::ONE), (second, Rational::ONE)]);
        let plain = g.linear(Rational::integer(-3), &[(i1, Rational::ONE)]);
        let over = g.div(plain, beta);
        let square = g.powi(i1, 2);
        let squared = g.linear(Rational::integer(-9), &[(square, Rational::ONE)]);
        let point =
            Point { stretches: [1.4, 0.9, 0.6], parameters: vec![vec![0.3]].into(), ..Point::default() };
        for base in [plain, mixed, over, squared] {
            let power = real(&mut g, base);
            let rewritten = with_squares(&mut g, power);
            assert!(has_squares(&g, rewritten));
            let [found, expected] = [rewritten, power].map(|id| evaluate(&g, id, &point).value);
            // Some roundings of a value of about 3, of which 1/10 is left.
            assert!((found - expected).abs() < 1e-14 * expected.abs(), "{found} for {expected}");
        }
    }

    #[test]
    fn squares_stand_beside_parameters() {
        let mut g = Graph::default();
        let [i1, i2] = isochoric(&mut g);
        let (c, d) = (g.leaf(Node::Parameter(0)), g.leaf(Node::Parameter(1)));
        let small = g.powi(c, 2);
        let plain = g.linear(Rational::integer(-3), &[(i1, Rational::ONE), (small, Rational::ONE)]);
        let weighted = g.mul(d, i2);
        let mixed = [(i1, Rational::ONE), (weighted, Rational::ONE), (d, Rational::integer(-3))];
        let mixed = g.linear(Rational::integer(-3), &[&mixed[..], &[(c, Rational::ONE)]].concat());
        let over = g.div(plain, d);
        let point = Point {
            stretches: [1.4, 0.9, 0.6],
            parameters: vec![vec![0.3], vec![0.7]].into(),
            ..Point::default()
        };
        let mut near = point.clone();
        near.stretches = [1.0 + 1e-9, 1.0, 1.0 - 1e-9];
        for sum in [plain, mixed, over] {
            let (power, ln, exp) = (real(&mut g, sum), g.ln(sum), g.apply(Function::Exp, sum));
            for written in [power, ln, exp, g.apply(Function::Given(0, 0), sum)] {
                let rewritten = with_squares_in_sums(&mut g, written);
                assert!(has_squares(&g, rewritten) && !matches!(g.node(rewritten), Node::Accurate(..)));
                if g.node(written).is_call() {
                    continue;
                }
                let [found, expected] = [rewritten, written].map(|id| evaluate(&g, id, &point).value);
                assert!((found - expected).abs() < 1e-14 * (1.0 + expected.abs()), "{found} for {expected}");
            }
        }
        // At rest and near it the square of the parameter is all that there is.
        let power = real(&mut g, plain);
        let rewritten = with_squares_in_sums(&mut g, power);
        let found = evaluate(&g, rewritten, &near).value;
        assert!((found / 0.09f64.powf(1.5) - 1.0).abs() < 1e-15, "{found}");
        let mut memo = FxHashMap::default();
        let emitted = squares_alone(&mut g, rewritten, &mut memo);
        assert!(!has_squares(&g, emitted));
    }

    #[test]
    fn sums_with_numbers_or_stretches_stay_as_they_are() {
        let mut g = Graph::default();
        let [i1, _] = isochoric(&mut g);
        let (n, stretch) = (g.leaf(Node::Parameter(0)), g.stretch(0));
        let plain = g.linear(Rational::integer(-3), &[(i1, Rational::ONE)]);
        let fraction = g.div(plain, n);
        let limited = g.linear(Rational::ONE, &[(fraction, Rational::integer(-1))]);
        // (3n − I1b)/(3n − 3)
        let left = g.linear(Rational::ZERO, &[(n, Rational::integer(3)), (i1, Rational::integer(-1))]);
        let whole = g.linear(Rational::integer(-3), &[(n, Rational::integer(3))]);
        let left = g.div(left, whole);
        let with_stretch = g.linear(Rational::ZERO, &[(plain, Rational::ONE), (stretch, Rational::ONE)]);
        // Alone, it is exact enough for exp.
        let exp = g.apply(Function::Exp, plain);
        assert_eq!(with_squares_in_sums(&mut g, exp), exp);
        for sum in [limited, left, with_stretch] {
            for written in [real(&mut g, sum), g.ln(sum), g.apply(Function::Given(0, 0), sum)] {
                assert_eq!(with_squares_in_sums(&mut g, written), written);
            }
        }
    }

    #[test]
    fn what_does_not_vanish_at_rest_is_left_alone() {
        let mut g = Graph::default();
        let [i1, _] = isochoric(&mut g);
        for constant in [-2, -4, 0] {
            let shifted = g.linear(Rational::integer(constant), &[(i1, Rational::ONE)]);
            let power = real(&mut g, shifted);
            assert_eq!(with_squares(&mut g, power), power, "{constant}");
        }
    }
}
