//! Dual numbers x + x′ε, ε² = 0: arithmetic on them differentiates any program exactly \[Clifford73\].
//!
//! They are independent of the material's own derivatives: `energy`, run with them, is an oracle for the
//! gradient, and `gradient` one for the Hessian. Values are those of `f64`, bit for bit, so that a program
//! takes the same way.
//!
//! | operation | derivative |
//! |---|---|
//! | x + y, x − y | x′ ± y′ |
//! | x y | x′ y + x y′ |
//! | x / y | (x′ − (x/y) y′) / y |
//! | a function of one number | its own at x, times x′: the list below |
//! | xʳ | r xʳ⁻¹ x′ + xʳ ln x r′ |
//! | ln(x/y) | x′/x − y′/y |
//! | \|x\|, max, min, select | that of what is taken |
//!
//! If a derivative does not exist, such as that of max(x, x), it is the derivative of the second argument:
//! rules avoid such points.
//!
//! \[Clifford73\] Clifford, *Preliminary sketch of biquaternions*, 1873.

use std::f64::consts::FRAC_2_SQRT_PI;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::lanes::Real;

/// A number and its derivative along a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual {
    pub(super) value: f64,
    pub(super) slope: f64,
}

/// A dual number with its logarithm, from which all its powers are made.
#[derive(Clone, Copy, Debug)]
pub(super) struct DualLogarithm {
    of: Dual,
    logarithm: <f64 as Real>::Logarithm,
}

impl Dual {
    /// Stretches as dual numbers, of which stretch k changes at the rate 1.
    pub(super) fn along(stretches: [f64; 3], k: usize) -> [Self; 3] {
        std::array::from_fn(|i| Self { value: stretches[i], slope: if i == k { 1.0 } else { 0.0 } })
    }
}

/// Operators by their derivatives, from both operands and the value.
macro_rules! operators {
    ($($Operator:ident $method:ident |$x:ident, $y:ident, $value:ident| $slope:expr,)*) => {$(
        impl $Operator for Dual {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let ($x, $y, value) = (self, other, self.value.$method(other.value));
                let $value = value;
                Self { value, slope: $slope }
            }
        }
    )*};
}

operators! {
    Add add |x, y, _value| x.slope + y.slope,
    Sub sub |x, y, _value| x.slope - y.slope,
    Mul mul |x, y, _value| x.slope * y.value + x.value * y.slope,
    Div div |x, y, value| (x.slope - value * y.slope) / y.value,
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

/// Functions by their derivatives at the value x.
macro_rules! functions {
    ($($method:ident |$x:ident| $derivative:expr,)*) => {$(
        fn $method(self) -> Self {
            let $x = self.value;
            Self { value: Real::$method($x), slope: $derivative * self.slope }
        }
    )*};
}

impl Real for Dual {
    type Mask = bool;
    type Logarithm = DualLogarithm;

    const UNIT_ROUNDOFF: f64 = <f64 as Real>::UNIT_ROUNDOFF;
    const MIN_POSITIVE: f64 = <f64 as Real>::MIN_POSITIVE;

    fn splat(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        Self::splat(value(0))
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        let slope = (self * factor + addend).slope;
        Self { value: Real::mul_add(self.value, factor.value, addend.value), slope }
    }

    functions! {
        sqrt |x| 0.5 / Real::sqrt(x),
        cbrt |x| 1.0 / (3.0 * Real::cbrt(x) * Real::cbrt(x)),
        ln |x| 1.0 / x,
        exp |x| Real::exp(x),
        ln_1p |x| 1.0 / (1.0 + x),
        exp_m1 |x| Real::exp(x),
        sinh |x| Real::cosh(x),
        cosh |x| Real::sinh(x),
        tanh |x| 1.0 / (Real::cosh(x) * Real::cosh(x)),
        asinh |x| 1.0 / Real::sqrt(1.0 + x * x),
        sin |x| Real::cos(x),
        cos |x| -Real::sin(x),
        atan |x| 1.0 / (1.0 + x * x),
        erf |x| FRAC_2_SQRT_PI * Real::exp(-x * x),
        softplus |x| Real::sigmoid(x),
        sigmoid |x| Real::sigmoid(x) * Real::sigmoid(-x),
    }

    fn logarithm(self) -> DualLogarithm {
        DualLogarithm { of: self, logarithm: self.value.logarithm() }
    }

    fn power(DualLogarithm { of, logarithm }: DualLogarithm, exponent: Self) -> Self {
        let value = f64::power(logarithm, exponent.value);
        let by_base = exponent.value * f64::power(logarithm, exponent.value - 1.0) * of.slope;
        // Of a constant exponent, also where ln x is infinite.
        let by_exponent =
            if exponent.slope == 0.0 { 0.0 } else { value * Real::ln(of.value) * exponent.slope };
        Self { value, slope: by_base + by_exponent }
    }

    fn logarithm_of_ratio(a: DualLogarithm, b: DualLogarithm) -> Self {
        Self {
            value: f64::logarithm_of_ratio(a.logarithm, b.logarithm),
            slope: a.of.slope / a.of.value - b.of.slope / b.of.value,
        }
    }

    fn abs(self) -> Self {
        if self.value.is_sign_negative() { -self } else { self }
    }

    fn max(self, other: Self) -> Self {
        if self.value > other.value { self } else { other }
    }

    fn min(self, other: Self) -> Self {
        if self.value < other.value { self } else { other }
    }

    fn copysign(self, sign: Self) -> Self {
        if self.value.is_sign_negative() == sign.value.is_sign_negative() { self } else { -self }
    }

    fn less(self, other: Self) -> bool {
        self.value < other.value
    }

    fn is_finite(self) -> bool {
        self.value.is_finite()
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    fn two_product(self, other: Self) -> (Self, Self) {
        let (value, error) = self.value.two_product(other.value);
        (Self { value, ..self * other }, Self::splat(error))
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        let (scale, back) = self.value.power_of_two_scale();
        (Self::splat(scale), Self::splat(back))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares the slope of f at x with an extrapolated difference quotient.
    #[track_caller]
    fn check(x: f64, f: impl Fn(Dual) -> Dual) {
        let value = |x: f64| f(Dual::splat(x)).value;
        let quotient = |h: f64| (value(x + h) - value(x - h)) / (2.0 * h);
        let h = x.abs() / 512.0;
        // Without its h² and h⁴ terms; h⁶ and rounding over h are left, each below 10⁻¹¹.
        let [whole, half, quarter] = [h, h / 2.0, h / 4.0].map(quotient);
        let [first, second] = [(4.0 * half - whole) / 3.0, (4.0 * quarter - half) / 3.0];
        let expected = (16.0 * second - first) / 15.0;
        let found = f(Dual { value: x, slope: 1.0 }).slope;
        assert!((found - expected).abs() <= 1e-10 * (1.0 + expected.abs()), "{found} for {expected}");
    }

    /// Slopes of functions that declarations contain are compared with generated derivatives by the rule
    /// itself, for `tests/declarations`.
    #[test]
    fn slopes_are_those_of_difference_quotients() {
        let c = Dual::splat;
        for x in [0.3, 1.0, 1.7] {
            check(x, |x| x * x * x - x + c(2.0) / x);
            check(x, |x| (x * x + c(1.0)) / (x + c(3.0)));
            check(x, |x| x.mul_add(x, -x));
            check(x, Real::reciprocal_sqrt);
            check(x, Real::cbrt);
            check(x, |x| x.powf(c(-2.3)));
            check(x, |x| c(1.5).powf(x));
            check(x, |x| x.powf(x));
            check(x, |x| Dual::logarithm_of_ratio((x * x).logarithm(), (x + c(1.0)).logarithm()));
            check(x, |x| (-x).abs() * x.copysign(c(-1.0)));
            check(x, |x| (x * x).max(c(0.01)) + (x * x * x).min(c(100.0)));
            check(x, |x| Dual::select(x.less(c(5.0)), x * x, x));
            check(x, |x| x.two_product(x * x).0);
        }
        check(-0.7, |x| x.abs() * x);
        check(-0.7, Real::cbrt);
    }

    #[test]
    fn whole_powers_have_a_slope_at_zero() {
        let x = Dual { value: 0.0, slope: 2.0 };
        assert_eq!(x.powf(Dual::splat(1.0)).slope, 2.0);
        assert_eq!(x.powf(Dual::splat(3.0)).slope, 0.0);
    }
}
