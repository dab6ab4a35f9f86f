//! Derivatives of elementary functions besides ln, exp and powers.
//!
//! | φ | φ′ |
//! |---|---|
//! | sin, cos | cos, −sin |
//! | sinh, cosh | cosh, sinh |
//! | tanh x | 4 σ(2x) σ(−2x) |
//! | σ(x) = 1/(1 + e⁻ˣ) | σ(x) σ(−x) |
//! | softplus x = ln(1 + eˣ) | σ(x) |
//! | asinh x, atan x | 1/√(1 + x²), 1/(1 + x²) |
//! | erf x | 2/√π e^(−x²) |
//! | exp_m1 x = eˣ − 1, ln_1p x = ln(1 + x) | eˣ, 1/(1 + x) |
//!
//! The derivative of tanh is not 1 − tanh², which has no correct digit where tanh is nearly 1, and that of
//! the sigmoid not σ (1 − σ) for the same reason.

use crate::algebra::expr::{Elementary, Exponent, Function, Graph, Id, Node};
use crate::algebra::rational::Rational;

impl Elementary {
    /// The derivative φ′(a).
    pub fn derivative(self, graph: &mut Graph, a: Id) -> Id {
        match self {
            Self::Sin => graph.elementary(Self::Cos, a),
            Self::Cos => {
                let sine = graph.elementary(Self::Sin, a);
                graph.neg(sine)
            }
            Self::Sinh => graph.elementary(Self::Cosh, a),
            Self::Cosh => graph.elementary(Self::Sinh, a),
            Self::Tanh => {
                let twice = graph.scale(a, Rational::integer(2));
                let slope = Self::Sigmoid.derivative(graph, twice);
                graph.scale(slope, Rational::integer(4))
            }
            Self::Sigmoid => {
                let mirrored = graph.neg(a);
                let factors = [a, mirrored].map(|x| graph.elementary(Self::Sigmoid, x));
                graph.product_of(&factors)
            }
            Self::Softplus => graph.elementary(Self::Sigmoid, a),
            Self::Asinh => {
                let sum = one_and_square(graph, a);
                graph.power(sum, Rational::new(-1, 2).map_or(Exponent::ONE, Exponent::rational))
            }
            Self::Atan => {
                let sum = one_and_square(graph, a);
                graph.powi(sum, -1)
            }
            Self::Erf => {
                let square = graph.powi(a, 2);
                let exponent = graph.neg(square);
                let exponential = graph.apply(Function::Exp, exponent);
                let factor = graph.leaf(Node::Float(std::f64::consts::FRAC_2_SQRT_PI.to_bits()));
                graph.mul(factor, exponential)
            }
            Self::ExpM1 => graph.apply(Function::Exp, a),
            Self::Ln1p => {
                let sum = graph.linear(Rational::ONE, &[(a, Rational::ONE)]);
                graph.powi(sum, -1)
            }
        }
    }
}

fn one_and_square(graph: &mut Graph, a: Id) -> Id {
    let square = graph.powi(a, 2);
    graph.linear(Rational::ONE, &[(square, Rational::ONE)])
}
