//! Roots, exponential and logarithm, each from a few multiplications and the `f64` function as a start, and
//! what is made of them or of a series of its own.

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
        // self = a 2^(n e), so that the start fits an f64 for any exponent.
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
        // Far outside, even the exponent of the result would not fit.
        if self.kind == Kind::Finite && self.negative && self.exponent > 60 {
            return Self::ZERO;
        }
        let exponential = self.abs().exponential_less_one() + one;
        if self.negative && self.kind == Kind::Finite { one / exponential } else { exponential }
    }

    /// e^self − 1, with a relative error of (1 + |self|) units.
    pub(super) fn exponential_less_one(self) -> Self {
        let one = Self::splat(1.0);
        if self.kind != Kind::Finite {
            return self;
        }
        if self.exponent > 60 {
            return if self.negative { -one } else { Self::NOT_A_NUMBER };
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
        if self.negative { -(y / (y + one)) } else { y }
    }

    /// ln self, with an absolute error of (1 + |ln self|) units; NaN for self ≤ 0.
    ///
    /// With y0 ≈ ln self, by the function of `f64` once or twice, ln self = y0 + ln z for z = self e^(−y0),
    /// and ln z = 2 artanh w for w = (z − 1)/(z + 1).
    pub(super) fn natural_logarithm(self) -> Self {
        if self.kind != Kind::Finite || self.negative {
            return Self::NOT_A_NUMBER;
        }
        let rough = |x: Self| Self::splat(x.leading().ln() + x.exponent as f64 * std::f64::consts::LN_2);
        let one = Self::splat(1.0);
        let (mut start, mut z) = (Self::ZERO, self);
        // Of a number such as e^(10¹⁸) the first y0 is wrong by hundreds.
        for _ in 0..4 {
            start = start + rough(z);
            z = self * (-start).exponential();
            let gap = z - one;
            if gap.kind != Kind::Finite || gap.exponent < -16 {
                break;
            }
        }
        let gap = z - one;
        if z.kind != Kind::Finite || gap.kind == Kind::Finite && gap.exponent > -2 {
            return start;
        }
        let w = gap / (z + one);
        start + w.arctangent_series(false).scaled(1)
    }

    /// w ± w³/3 + w⁵/5 ± …: atan w if the signs alternate, else artanh w.
    fn arctangent_series(self, alternating: bool) -> Self {
        let square = if alternating { -(self * self) } else { self * self };
        let (mut sum, mut power) = (Self::ZERO, self);
        let mut k = 1;
        while power.kind == Kind::Finite && power.exponent > self.exponent - 64 * LIMBS as i64 {
            sum = sum + power.divided_by(k);
            power = power * square;
            k += 2;
        }
        sum
    }

    /// ln(1 + self) to a few units; 2⁸ times as many where self is beyond 2⁻⁸.
    pub(super) fn logarithm_of_one_more(self) -> Self {
        let one = Self::splat(1.0);
        if self.kind != Kind::Finite || self.exponent > -8 {
            return if self.kind == Kind::Zero { self } else { (one + self).natural_logarithm() };
        }
        // 2 artanh of x/(2 + x), which is below 2⁻⁸.
        (self / (one + one + self)).arctangent_series(false).scaled(1)
    }

    /// (y + y/(1 + y))/2 for y = e^|self| − 1, in which nothing cancels.
    pub(super) fn hyperbolic_sine(self) -> Self {
        let y = self.abs().exponential_less_one();
        if self.kind == Kind::Zero {
            return self;
        }
        (y + y / (y + Self::splat(1.0))).scaled(-1).copysign(self)
    }

    /// y/(2 + y) for y = e^(2|self|) − 1, and ±1 where that has too many digits.
    pub(super) fn hyperbolic_tangent(self) -> Self {
        let one = Self::splat(1.0);
        match self.kind {
            Kind::Finite if self.exponent > 30 => one.copysign(self),
            Kind::Finite => {
                let y = self.abs().scaled(1).exponential_less_one();
                (y / (y + one + one)).copysign(self)
            }
            Kind::Zero | Kind::NotANumber => self,
        }
    }

    /// ln(1 + a + a²/(1 + √(1 + a²))) for a = |self|.
    pub(super) fn inverse_hyperbolic_sine(self) -> Self {
        let one = Self::splat(1.0);
        let a = self.abs();
        if self.kind == Kind::Zero {
            return self;
        }
        let square = a * a;
        let root = (one + square) * (one + square).inverse_root(2);
        (a + square / (one + root)).logarithm_of_one_more().copysign(self)
    }

    /// The sine of self + quarters · π/2, with an absolute error of (1 + |self|) units.
    ///
    /// NaN beyond 2⁵², where a quotient by π/2 in `f64` no longer tells the quadrant.
    pub(super) fn sine_after_quarters(self, quarters: i64) -> Self {
        if self.kind == Kind::NotANumber || (self.kind == Kind::Finite && self.exponent > 52) {
            return Self::NOT_A_NUMBER;
        }
        let half_pi = Self::pi().scaled(-1);
        let whole = (self / half_pi).to_f64().round();
        let r = self - Self::splat(whole) * half_pi;
        let quadrant = (whole as i64 + quarters).rem_euclid(4);
        let one = Self::splat(1.0);
        // Both series have terms ± r^k/k!, of odd k or of even k.
        let (mut term, mut k) = if quadrant % 2 == 0 { (r, 1) } else { (one, 0) };
        let mut sum = Self::ZERO;
        while term.kind == Kind::Finite
            && (sum.kind == Kind::Zero || term.exponent > sum.exponent - 64 * LIMBS as i64)
        {
            sum = sum + term;
            term = -(term * r * r).divided_by((k + 1) * (k + 2));
            k += 2;
        }
        if quadrant < 2 { sum } else { -sum }
    }

    /// π = 16 atan 1/5 − 4 atan 1/239, Machin's formula.
    fn pi() -> Self {
        let arctangent_of = |n: u32| Self::splat(1.0).divided_by(n).arctangent_series(true);
        arctangent_of(5).scaled(4) - arctangent_of(239).scaled(2)
    }

    /// atan self = 16 atan w, after atan x = 2 atan(x/(1 + √(1 + x²))) four times.
    pub(super) fn arctangent(self) -> Self {
        let one = Self::splat(1.0);
        if self.kind != Kind::Finite {
            return self;
        }
        let w = (0..4).fold(self, |x, _| {
            let square = one + x * x;
            x / (one + square * square.inverse_root(2))
        });
        w.arctangent_series(true).scaled(4)
    }

    /// 2/√π e^(−x²) Σ 2ᵏ x²ᵏ⁺¹/(1·3·…·(2k + 1)), of positive terms only.
    ///
    /// ±1 where erfc is below the last bit.
    pub(super) fn error_function(self) -> Self {
        let one = Self::splat(1.0);
        if self.kind != Kind::Finite {
            return self;
        }
        let square = self * self;
        if square.exponent > 60 || square.to_f64() > 45.0 * LIMBS as f64 {
            return one.copysign(self);
        }
        let (mut term, mut sum, mut k) = (self, Self::ZERO, 1);
        while sum.kind == Kind::Zero || term.exponent > sum.exponent - 64 * LIMBS as i64 {
            sum = sum + term;
            k += 2;
            term = (term * square).scaled(1).divided_by(k);
        }
        (sum * (-square).exponential() * Self::pi().inverse_root(2)).scaled(1)
    }
}
