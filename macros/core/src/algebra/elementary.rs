//! Elementary functions besides ln, exp and powers: their derivatives, divided differences and values.
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

use crate::algebra::expr::{Elementary, Exponent, Graph, Id, Node};
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
                let exponential = graph.exp(exponent);
                let factor = graph.leaf(Node::Float(std::f64::consts::FRAC_2_SQRT_PI.to_bits()));
                graph.mul(factor, exponential)
            }
            Self::ExpM1 => graph.exp(a),
            Self::Ln1p => {
                let sum = graph.linear(Rational::ONE, &[(a, Rational::ONE)]);
                graph.powi(sum, -1)
            }
        }
    }

    /// The divided difference φ\[a, b\].
    pub fn quotient(self, graph: &mut Graph, a: Id, b: Id) -> Id {
        graph.leaf(match self {
            Self::ExpM1 => Node::ExpQuotient(a, b),
            _ => Node::ElementaryQuotient(self, a, b),
        })
    }

    /// φ(x) in `f64`.
    pub(crate) fn value(self, x: f64) -> f64 {
        match self {
            Self::Asinh => x.asinh(),
            Self::Atan => x.atan(),
            Self::Cos => x.cos(),
            Self::Cosh => x.cosh(),
            Self::Erf => erf(x),
            Self::ExpM1 => x.exp_m1(),
            Self::Ln1p => x.ln_1p(),
            Self::Sigmoid => sigmoid(x),
            Self::Sin => x.sin(),
            Self::Sinh => x.sinh(),
            Self::Softplus => x.max(0.0) + (-x.abs()).exp().ln_1p(),
            Self::Tanh => x.tanh(),
        }
    }

    /// φ′(x) in `f64`.
    pub(crate) fn slope(self, x: f64) -> f64 {
        match self {
            Self::Asinh => 1.0 / x.hypot(1.0),
            Self::Atan => 1.0 / (1.0 + x * x),
            Self::Cos => -x.sin(),
            Self::Cosh => x.sinh(),
            Self::Erf => std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp(),
            Self::ExpM1 => x.exp(),
            Self::Ln1p => 1.0 / (1.0 + x),
            Self::Sigmoid => sigmoid(x) * sigmoid(-x),
            Self::Sin => x.cos(),
            Self::Sinh => x.cosh(),
            Self::Softplus => sigmoid(x),
            Self::Tanh => 1.0 / x.cosh().powi(2),
        }
    }

    /// φ\[a, b\] in `f64`: the plain one if little cancels, else the mean of φ′ over the interval by Gauss's
    /// rule with three points, whose error is below 10⁻¹⁶ for |a − b| ≤ 10⁻³.
    pub(crate) fn quotient_value(self, a: f64, b: f64) -> f64 {
        if (a - b).abs() > 1e-3 {
            return (self.value(a) - self.value(b)) / (a - b);
        }
        let (middle, reach) = (0.5 * (a + b), 0.5 * (a - b) * 0.6f64.sqrt());
        let ends = self.slope(middle - reach) + self.slope(middle + reach);
        (5.0 * ends + 8.0 * self.slope(middle)) / 18.0
    }
}

fn one_and_square(graph: &mut Graph, a: Id) -> Id {
    let square = graph.powi(a, 2);
    graph.linear(Rational::ONE, &[(square, Rational::ONE)])
}

fn sigmoid(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

/// erf x by its series 2/√π e^(−x²) Σ 2ᵏ x^(2k+1)/(2k + 1)!!, whose terms are of one sign.
fn erf(x: f64) -> f64 {
    // 1 − erf 6 is 2·10⁻¹⁷.
    if x.is_nan() || x.abs() > 6.0 {
        return x.signum();
    }
    let (mut term, mut sum) = (x, x);
    let mut odd = 1.0;
    while term.abs() > 1e-17 * sum.abs() {
        odd += 2.0;
        term *= 2.0 * x * x / odd;
        sum += term;
    }
    std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp() * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_the_values() {
        for function in Elementary::ALL {
            for x in [-0.7, 0.0, 0.3, 2.5] {
                let h = 1e-5;
                let difference = (function.value(x + h) - function.value(x - h)) / (2.0 * h);
                // The h² term, times a third derivative of at most 13, and rounding over h.
                let found = function.slope(x);
                assert!((found - difference).abs() < 1e-9 * (1.0 + found.abs()), "{function:?} at {x}");
                for gap in [2e-3, 1e-3, 1e-6, 0.0] {
                    let quotient = function.quotient_value(x + gap, x);
                    let middle = function.slope(x + 0.5 * gap);
                    // Again a third derivative, at most 74, over 24, and rounding over the gap.
                    assert!((quotient - middle).abs() < 4.0 * gap * gap + 1e-11, "{function:?}: {x}, {gap}");
                }
            }
        }
    }

    #[test]
    fn the_error_function_has_its_known_values() {
        // Abramowitz, Stegun, *Handbook of mathematical functions*, table 7.1.
        for (x, expected) in [(0.5, 0.520_499_877_8), (1.0, 0.842_700_792_9), (2.0, 0.995_322_265_0)] {
            assert!((erf(x) - expected).abs() < 1e-10, "{x}");
        }
    }
}
