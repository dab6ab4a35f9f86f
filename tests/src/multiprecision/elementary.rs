//! Roots, exponential and logarithm, each from a few multiplications and the `f64` function as a start.

use piola::Real;

use super::{Kind, Multiprecision};

impl<const LIMBS: usize> Multiprecision<LIMBS> {
    /// self^(−1/n) for self > 0, and 1/self of either sign for n = 1; else NaN.
    ///
    /// Newton's iteration r ← r + r (1 − self rⁿ)/n doubles the digits in every step.
    pub(super) fn inverse_root(self, n: u32) -> Self {
        if self.kind != Kind::Finite || (self.negative && n > 1) {
            return Self::NOT_A_NUMBER;
        }
        // self = a 2^(n e), so that the start fits an f64 whatever the exponent.
        let e = self.exponent.div_euclid(i64::from(n));
        let a = Self { negative: false, ..self }.scaled(-e * i64::from(n));
        let one = Self::splat(1.0);
        let mut root = Self::splat(a.to_f64().powf(-1.0 / f64::from(n)));
        let mut bits = 50;
        // The last step only removes the rounding of the one before it.
        while bits < 2 * 64 * LIMBS {
            let power = (0..n).fold(a, |power, _| power * root);
            root = root + (root * (one - power)).divided_by(n);
            bits *= 2;
        }
        Self { negative: self.negative, ..root.scaled(-e) }
    }

    /// e^self, with a relative error of (1 + |self|) units.
    pub(super) fn exponential(self) -> Self {
        let one = Self::splat(1.0);
        match self.kind {
            Kind::NotANumber => return self,
            Kind::Zero => return one,
            Kind::Finite => {}
        }
        // Far outside, even the exponent of the result would not fit.
        if self.exponent > 60 {
            return if self.negative { Self::ZERO } else { Self::NOT_A_NUMBER };
        }
        // y = e^(|self|/2^m) − 1 by its series, then e^(2x) − 1 = y (2 + y): small numbers keep their
        // relative accuracy.
        let doublings = (self.exponent + 12).max(0);
        let x = self.abs().scaled(-doublings);
        let mut terms = 2;
        let mut bits = 12 * terms;
        while bits < 64 * LIMBS as u32 {
            terms += 1;
            bits += 12 + terms.ilog2();
        }
        let mut sum = one;
        for k in (2..=terms).rev() {
            sum = one + (x * sum).divided_by(k);
        }
        let mut y = x * sum;
        for _ in 0..doublings {
            y = y * (y + one + one);
        }
        let exponential = y + one;
        if self.negative { one / exponential } else { exponential }
    }

    /// ln self, with an absolute error of (1 + |ln self|) units; NaN for self ≤ 0.
    ///
    /// With y0 ≈ ln self from `f64`, ln self = y0 + ln z for z = self e^(−y0) and ln z = 2 artanh w for
    /// w = (z − 1)/(z + 1).
    pub(super) fn natural_logarithm(self) -> Self {
        if self.kind != Kind::Finite || self.negative {
            return Self::NOT_A_NUMBER;
        }
        let start = self.leading().ln() + self.exponent as f64 * std::f64::consts::LN_2;
        let start = Self::splat(start);
        let one = Self::splat(1.0);
        let z = self * (-start).exponential();
        let w = (z - one) / (z + one);
        let w2 = w * w;
        let (mut sum, mut power) = (Self::ZERO, w);
        let mut k = 1;
        while power.kind == Kind::Finite && power.exponent > w.exponent - 64 * LIMBS as i64 {
            sum = sum + power.divided_by(k);
            power = power * w2;
            k += 2;
        }
        start + sum + sum
    }
}
