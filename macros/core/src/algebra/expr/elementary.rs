//! Elementary functions besides ln, exp and powers: their names and values.

use std::f64::consts::FRAC_2_SQRT_PI;

/// An elementary function with a kernel of its own, and one for its divided difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[expect(missing_docs, reason = "each is named like the method of `f64`")]
pub enum Elementary {
    Asinh,
    Atan,
    Cos,
    Cosh,
    Erf,
    ExpM1,
    Ln1p,
    /// σ(x) = 1/(1 + e⁻ˣ).
    Sigmoid,
    Sin,
    Sinh,
    /// ln(1 + eˣ).
    Softplus,
    Tanh,
}

/// A function, its name, φ(x) and φ′(x).
type Row = (Elementary, &'static str, fn(f64) -> f64, fn(f64) -> f64);

/// The functions in the order of their declaration.
const TABLE: [Row; 12] = [
    (Elementary::Asinh, "asinh", f64::asinh, |x| 1.0 / x.hypot(1.0)),
    (Elementary::Atan, "atan", f64::atan, |x| 1.0 / (1.0 + x * x)),
    (Elementary::Cos, "cos", f64::cos, |x| -x.sin()),
    (Elementary::Cosh, "cosh", f64::cosh, f64::sinh),
    (Elementary::Erf, "erf", erf, |x| FRAC_2_SQRT_PI * (-x * x).exp()),
    (Elementary::ExpM1, "exp_m1", f64::exp_m1, f64::exp),
    (Elementary::Ln1p, "ln_1p", f64::ln_1p, |x| 1.0 / (1.0 + x)),
    (Elementary::Sigmoid, "sigmoid", sigmoid, |x| sigmoid(x) * sigmoid(-x)),
    (Elementary::Sin, "sin", f64::sin, f64::cos),
    (Elementary::Sinh, "sinh", f64::sinh, f64::cosh),
    (Elementary::Softplus, "softplus", |x| x.max(0.0) + (-x.abs()).exp().ln_1p(), sigmoid),
    (Elementary::Tanh, "tanh", f64::tanh, |x| 1.0 / x.cosh().powi(2)),
];

impl Elementary {
    /// The names of all of them.
    pub(crate) fn names() -> impl Iterator<Item = &'static str> {
        TABLE.into_iter().map(|(_, name, ..)| name)
    }

    /// Its name as a method, in declarations and of `Real`.
    #[must_use]
    pub fn name(self) -> &'static str {
        TABLE[self as usize].1
    }

    /// The function of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        TABLE.into_iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// Its value at zero if that is a whole number.
    pub(crate) fn at_zero(self) -> Option<i64> {
        let value = self.value(0.0);
        (value.fract() == 0.0).then_some(value as i64)
    }

    /// True if its values are positive.
    pub(crate) fn is_positive(self) -> bool {
        matches!(self, Self::Cosh | Self::Sigmoid | Self::Softplus)
    }

    /// φ(x) in `f64`.
    pub(crate) fn value(self, x: f64) -> f64 {
        TABLE[self as usize].2(x)
    }

    /// φ′(x) in `f64`.
    pub(crate) fn slope(self, x: f64) -> f64 {
        TABLE[self as usize].3(x)
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
    FRAC_2_SQRT_PI * (-x * x).exp() * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_the_values() {
        for (function, ..) in TABLE {
            assert_eq!(TABLE[function as usize].0, function);
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
