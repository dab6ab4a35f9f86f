//! Logarithms and powers of the volume J, and of other products of stretches, by the stretches themselves.
//!
//! J leaves the range of a floating-point format long before the stretches do: at stretches of 10¹³ in `f32`.
//! J^r and its derivatives J^r/λi need not, so
//!
//! ```text
//! (Π λi^e)^r = Π λi^(e r)        ln Π λi^e = Σ e ln λi
//! ```
//!
//! for positive stretches. Differentiating λi^r lowers its exponent instead of dividing the whole by λi
//! afterwards. And as J^(−2/3) overflows where I1 underflows, though their product I1b is 3, real powers are
//! multiplied into sums of products:
//!
//! ```text
//! J^(−2/3) I1 = λ1^(4/3) (λ2λ3)^(−2/3) + λ2^(4/3) (λ3λ1)^(−2/3) + λ3^(4/3) (λ1λ2)^(−2/3)
//! ```
//!
//! Each term of such a sum is a power of an isochoric stretch, and stays one where the exponent is a
//! parameter: a real power costs more than all else in an energy, and two of each stretch would be needed
//! otherwise.
//!
//! ```text
//! J^(−α/3) λ1^α = (λ1^(2/3) λ2^(−1/3) λ3^(−1/3))^α
//! ```
//!
//! An extension takes the factors apart instead: below ε it continues J^(−2/3) and leaves I1 as it is.

use rustc_hash::FxHashMap;

use crate::algebra::expr::{Exponent, Function, Graph, Id, Node, Stretch};
use crate::algebra::rational::Rational;

/// The use of a separated expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Evaluation for positive stretches: real powers go into sums, and ln J stays, which is computed by a
    /// single logarithm if J is in range.
    Evaluation,
    /// Extension: a product of sums and of functions of single stretches.
    Extension,
}

/// The expression with real powers and logarithms of products of stretches separated.
pub fn separate(graph: &mut Graph, e: Id, purpose: Purpose) -> Id {
    rewrite(graph, e, &mut FxHashMap::default(), &|graph, id| match graph.node(id).clone() {
        Node::Apply(Function::Ln, a) => match monomial(graph, a) {
            Some(factors) => logarithm(graph, &factors, purpose),
            // Such as that of an isochoric stretch, whose continued powers may be negative.
            None if purpose == Purpose::Extension => {
                let separated = separate(graph, a, purpose);
                logarithm(graph, &monomial(graph, separated)?, purpose)
            }
            None => None,
        },
        Node::Product(factors) => {
            let mut separated = Vec::new();
            for (base, exponent) in factors {
                match monomial(graph, base) {
                    Some(monomial) => {
                        for (stretch, inner) in monomial {
                            let stretch = graph.stretch(stretch);
                            separated.push((stretch, multiply(graph, inner, exponent)));
                        }
                    }
                    None => separated.push((separate(graph, base, purpose), exponent)),
                }
            }
            if purpose == Purpose::Extension {
                return Some(graph.product(&separated));
            }
            multiply_in(graph, &mut separated);
            Some(product_of_isochoric(graph, &separated))
        }
        _ => None,
    })
}

fn logarithm(graph: &mut Graph, monomial: &[(Stretch, Exponent)], purpose: Purpose) -> Option<Id> {
    let all_equal = monomial.iter().all(|factor| factor.1 == monomial[0].1);
    if purpose == Purpose::Evaluation && monomial.len() == 3 && all_equal {
        let stretches = [0, 1, 2].map(|i| graph.stretch(i));
        let volume = graph.product_of(&stretches);
        let (factor, ln) = (graph.exponent_value(monomial[0].1), graph.ln(volume));
        return Some(graph.mul(factor, ln));
    }
    let mut terms = Vec::new();
    for &(stretch, exponent) in monomial {
        let stretch = graph.stretch(stretch);
        let (factor, ln) = (graph.exponent_value(exponent), graph.ln(stretch));
        terms.push(graph.mul(factor, ln));
    }
    Some(graph.sum_of(&terms))
}

/// The energy with each (J^r − 1)/s, where s is a factor of r and J any product of stretches, as ln J r/s
/// exp\[r ln J, 0\] for |s| < 2⁻¹⁰: it loses no digits there, and is the limit ln J r/s for s = 0. For a
/// large r, J^r is more accurate than the exponential. Derivatives of a sum of such terms need no such form,
/// because s cancels in them.
pub fn with_limits(graph: &mut Graph, energy: Id) -> Id {
    rewrite(graph, energy, &mut FxHashMap::default(), &|graph, id| {
        let Node::Product(factors) = graph.node(id).clone() else { return None };
        let (base, power, factor) = factors.iter().find_map(|&(base, exponent)| {
            let Node::Linear { constant, terms } = graph.node(base) else { return None };
            let &[(power, factor)] = terms.as_slice() else { return None };
            (exponent == Exponent::ONE && factor == constant.negated()).then_some((base, power, factor))
        })?;
        let powers = monomial(graph, power)?;
        let exponent = logarithm(graph, &powers, Purpose::Evaluation)?;
        let inverse = Exponent::integer(-1);
        let divisors = factors.iter().filter(|factor| factor.1 == inverse);
        let (divisor, slope) = divisors.map(|divisor| divisor.0).find_map(|divisor| {
            let (slope, node) = (graph.div(exponent, divisor), graph.node(divisor).clone());
            (!graph.contains(slope, |part| *part == node)).then_some((divisor, slope))
        })?;
        let zero = graph.integer(0);
        let quotient = graph.leaf(Node::Quotient(Function::Exp, exponent, zero));
        let others = graph.product(&[(id, Exponent::ONE), (base, inverse), (divisor, Exponent::ONE)]);
        let product = graph.product_of(&[others, slope, quotient]);
        let (near, square) = (graph.scale(product, factor), graph.powi(divisor, 2));
        let is_near = graph.linear(Rational::new(-1, 1 << 20)?, &[(square, Rational::ONE)]);
        Some(graph.leaf(Node::WhereNegative(is_near, near, id)))
    })
}

/// Multiplies real powers of stretches into a sum of products of stretches, if there are both among the
/// factors.
fn multiply_in(graph: &mut Graph, factors: &mut Vec<(Id, Exponent)>) {
    let is_power = |graph: &Graph, base| matches!(graph.node(base), Node::Stretch(_));
    if !factors.iter().any(|&(base, exponent)| is_power(graph, base) && exponent.as_integer().is_none()) {
        return;
    }
    let position = factors.iter().position(|&(base, exponent)| {
        exponent == Exponent::ONE
            && matches!(graph.node(base), Node::Linear { constant, terms }
                if constant.is_zero() && terms.iter().all(|&(term, _)| monomial(graph, term).is_some()))
    });
    let Some(position) = position else { return };
    let Node::Linear { terms, .. } = graph.node(factors[position].0).clone() else { return };
    let (powers, mut others): (Vec<_>, Vec<_>) =
        factors.iter().copied().partition(|&(base, _)| is_power(graph, base));
    others.retain(|factor| *factor != factors[position]);
    let mut times_power = |term| {
        let (_, mut factors) = graph.factors(term);
        factors.extend(&powers);
        product_of_isochoric(graph, &factors)
    };
    let terms: Vec<_> = terms.into_iter().map(|(term, c)| (times_power(term), c)).collect();
    others.push((graph.linear(Rational::ZERO, &terms), Exponent::ONE));
    *factors = others;
}

/// The product with the real powers of the three stretches as one power of an isochoric stretch J^(−1/3) λi,
/// if possible.
fn product_of_isochoric(graph: &mut Graph, factors: &[(Id, Exponent)]) -> Id {
    let product = graph.product(factors);
    let (_, factors) = graph.factors(product);
    let stretches = [0, 1, 2].map(|i| graph.stretch(i));
    let real_part =
        |stretch| factors.iter().find(|factor| factor.0 == stretch).and_then(|factor| factor.1.real);
    let [Some(a), Some(b), Some(c)] = stretches.map(real_part) else { return product };
    let mut is_isochoric = |&(_, own, others): &(usize, Id, [Id; 2])| {
        others[0] == others[1] && graph.scale(others[0], Rational::integer(-2)) == own
    };
    let Some((i, _, [other, _])) =
        [(0, a, [b, c]), (1, b, [c, a]), (2, c, [a, b])].into_iter().find(&mut is_isochoric)
    else {
        return product;
    };
    let third = |n| Rational::new(n, 3).map_or(Exponent::ONE, Exponent::rational);
    let base: Vec<_> = (0..3).map(|k| (stretches[k], third(if k == i { 2 } else { -1 }))).collect();
    let exponent = graph.scale(other, Rational::integer(-3));
    let mut joined = vec![(product, Exponent::ONE), (graph.product(&base), graph.exponent(exponent))];
    for (stretch, real) in stretches.into_iter().zip([a, b, c]) {
        let real = graph.neg(real);
        joined.push((stretch, graph.exponent(real)));
    }
    graph.product(&joined)
}

/// The factors of a product of powers of stretches, without coefficient; `None` for anything else.
fn monomial(graph: &Graph, id: Id) -> Option<Vec<(Stretch, Exponent)>> {
    let (coefficient, factors) = graph.factors(id);
    if coefficient != Rational::ONE {
        return None;
    }
    factors
        .into_iter()
        .map(|(base, exponent)| match graph.node(base) {
            Node::Stretch(i) => Some((*i, exponent)),
            _ => None,
        })
        .collect()
}

fn multiply(graph: &mut Graph, a: Exponent, b: Exponent) -> Exponent {
    let (a, b) = (graph.exponent_value(a), graph.exponent_value(b));
    let product = graph.mul(a, b);
    graph.exponent(product)
}

/// The expression with a rule applied from the bottom up, to each node after its operands.
pub fn rebuild(
    graph: &mut Graph,
    id: Id,
    memo: &mut FxHashMap<Id, Id>,
    rule: &mut impl FnMut(&mut Graph, Id) -> Id,
) -> Id {
    once!(memo, id, {
        let mapped = graph.map_children(id, &mut |graph, child| rebuild(graph, child, memo, rule));
        rule(graph, mapped)
    })
}

/// The expression with a rule applied from the top down. The results of the rule are not rewritten again.
pub fn rewrite(
    graph: &mut Graph,
    id: Id,
    memo: &mut FxHashMap<Id, Id>,
    rule: &impl Fn(&mut Graph, Id) -> Option<Id>,
) -> Id {
    once!(
        memo,
        id,
        match rule(graph, id) {
            Some(replaced) => replaced,
            None => graph.map_children(id, &mut |graph, child| rewrite(graph, child, memo, rule)),
        }
    )
}
