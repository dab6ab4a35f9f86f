//! Expressions for tests of the calculus: one for each of its rules.

use crate::algebra::expr::{Exponent, Graph, Id, Node};
use crate::algebra::rational::Rational;

/// Writes an expression in x, y, z.
type Build = fn(&mut Graph, [Id; 3]) -> Id;

/// Smooth for positive stretches, each depending on y.
const EXPRESSIONS: [(&str, Build); 7] = [
    ("x y z", |g, [x, y, z]| g.product_of(&[x, y, z])),
    ("ln(x y z)/x", |g, [x, y, z]| {
        let j = g.product_of(&[x, y, z]);
        let ln = g.ln(j);
        g.div(ln, x)
    }),
    ("y exp(x y)", |g, [x, y, _]| {
        let product = g.mul(x, y);
        let exp = g.exp(product);
        g.mul(exp, y)
    }),
    ("z y⁻³", |g, [_, y, z]| {
        let power = g.powi(y, -3);
        g.mul(power, z)
    }),
    ("(x + y)⁴", |g, [x, y, _]| {
        let sum = g.add(x, y);
        g.powi(sum, 4)
    }),
    ("y^(−2/3)", |g, [_, y, _]| g.power(y, Exponent::rational(Rational::new(-2, 3).unwrap()))),
    ("x y^α", |g, [x, y, _]| {
        let alpha = g.leaf(Node::Float(1.7f64.to_bits()));
        let exponent = g.exponent(alpha);
        let power = g.power(y, exponent);
        g.mul(power, x)
    }),
];

/// The name of each expression, and the expression in a graph of its own.
pub(crate) fn expressions() -> impl Iterator<Item = (&'static str, Graph, Id)> {
    EXPRESSIONS.into_iter().map(|(name, build)| {
        let mut graph = Graph::default();
        let stretches = [0, 1, 2].map(|i| graph.stretch(i));
        let e = build(&mut graph, stretches);
        (name, graph, e)
    })
}
