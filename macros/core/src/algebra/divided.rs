//! Divided differences φ[a, b] = (φ(a) − φ(b))/(a − b) without cancellation.
//!
//! Divided differences of whole powers and of simple fractions are sums and products of powers; that of a
//! real power is a node of its own, as are those of other functions, for which the runtime has kernels.

use crate::algebra::expr::{Elementary, Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// The largest q for which x^(p/q) is computed as the p-th power of a q-th root. The rounding error of the
/// root enters the power p-fold, so that for larger p a real power is more accurate.
pub const LARGEST_ROOT: i128 = 6;

/// The divided difference φ\[a, b\].
pub fn quotient(graph: &mut Graph, function: Function, a: Id, b: Id) -> Id {
    let function = match function {
        Function::Power(exponent) => return power_quotient(graph, a, b, exponent),
        Function::Elementary(Elementary::ExpM1) => Function::Exp,
        function => function,
    };
    graph.leaf(Node::Quotient(function, a, b))
}

/// The divided difference (a^r − b^r)/(a − b).
fn power_quotient(graph: &mut Graph, a: Id, b: Id, exponent: Exponent) -> Id {
    let Exponent { real, rational } = exponent;
    if real.is_some() || rational.denominator() > LARGEST_ROOT {
        return graph.leaf(Node::Quotient(Function::Power(exponent), a, b));
    }
    match rational.as_integer() {
        Some(0) => graph.integer(0),
        Some(1) => graph.integer(1),
        Some(n @ ..0) => reciprocal_quotient(graph, a, b, -n),
        // a²ᵐ − b²ᵐ = (aᵐ − bᵐ)(aᵐ + bᵐ)
        Some(n) if n % 2 == 0 => {
            let half = power_quotient(graph, a, b, Exponent::integer(n / 2));
            let (left, right) = (graph.powi(a, n / 2), graph.powi(b, n / 2));
            let sum = graph.add(left, right);
            graph.mul(half, sum)
        }
        // aⁿ⁺¹ − bⁿ⁺¹ = (aⁿ − bⁿ) a + bⁿ (a − b)
        Some(n) => {
            let lower = power_quotient(graph, a, b, Exponent::integer(n - 1));
            let (left, right) = (graph.mul(lower, a), graph.powi(b, n - 1));
            graph.add(left, right)
        }
        // With s = a^(1/q) and t = b^(1/q): (sᵖ − tᵖ)/(s − t) over (s^q − t^q)/(s − t).
        None => {
            let part = |n: i128| i64::try_from(n).ok().map(Exponent::integer);
            let root = Rational::new(1, rational.denominator()).map(Exponent::rational);
            let (Some(p), Some(q), Some(root)) =
                (part(rational.numerator()), part(rational.denominator()), root)
            else {
                return graph.leaf(Node::Quotient(Function::Power(exponent), a, b));
            };
            let (s, t) = (graph.power(a, root), graph.power(b, root));
            let (numerator, denominator) = (power_quotient(graph, s, t, p), power_quotient(graph, s, t, q));
            graph.div(numerator, denominator)
        }
    }
}

/// (a⁻ⁿ − b⁻ⁿ)/(a − b) = −p q (pⁿ − qⁿ)/(p − q) with p = 1/a, q = 1/b, whose terms are of the size of the
/// result.
fn reciprocal_quotient(graph: &mut Graph, a: Id, b: Id, n: i64) -> Id {
    let (p, q) = (graph.powi(a, -1), graph.powi(b, -1));
    let positive = power_quotient(graph, p, q, Exponent::integer(n));
    let quotient = graph.product_of(&[p, q, positive]);
    graph.neg(quotient)
}
