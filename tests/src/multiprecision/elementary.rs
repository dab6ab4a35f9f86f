//! What [`Real`] asks for: roots, exponential and logarithm, each from a few multiplications and the `f64`
//! function as a start, and what is made of them or of a series of its own.

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
        let mut root = Self::splat(a.to_f64().powf(-1.0 / f64::from(n)));
        let mut bits = 50;
        // The last step only removes the rounding of the one before it.
        while bits < 2 * 64 * LIMBS {
            let power = (0..n).fold(a, |power, _| power * root);
            root = root + (root * (Self::ONE - power)).divided_by(n);
            bits *= 2;
        }
        Self { negative: self.negative, ..root.scaled(-e) }
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

    /// The sine of self + quarters · π/2, with an absolute error of (1 + |self|) units.
    ///
    /// NaN beyond 2⁵², where a quotient by π/2 in `f64` no longer tells the quadrant.
    fn sine_after_quarters(self, quarters: i64) -> Self {
        if self.kind == Kind::NotANumber || (self.kind == Kind::Finite && self.exponent > 52) {
            return Self::NOT_A_NUMBER;
        }
        let half_pi = Self::pi().scaled(-1);
        let whole = (self / half_pi).to_f64().round();
        let r = self - Self::splat(whole) * half_pi;
        let quadrant = (whole as i64 + quarters).rem_euclid(4);
        // Both series have terms ± r^k/k!, of odd k or of even k.
        let (mut term, mut k) = if quadrant % 2 == 0 { (r, 1) } else { (Self::ONE, 0) };
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
        let arctangent_of = |n: u32| Self::ONE.divided_by(n).arctangent_series(true);
        arctangent_of(5).scaled(4) - arctangent_of(239).scaled(2)
    }
}

impl<const LIMBS: usize> Real for Multiprecision<LIMBS> {
    type Mask = bool;
    type Logarithm = Self;

    /// 2⁻ⁿ for n = 64 · LIMBS − 8, which is at most 1022.
    const UNIT_ROUNDOFF: f64 = f64::from_bits((1023 + 8 - 64 * LIMBS as u64) << 52);
    const MIN_POSITIVE: f64 = f64::MIN_POSITIVE;

    fn from_fn(value: impl Fn(usize) -> f64) -> Self {
        Self::splat(value(0))
    }

    fn splat(value: f64) -> Self {
        if value == 0.0 {
            return Self { negative: value.is_sign_negative(), ..Self::ZERO };
        }
        if !value.is_finite() {
            return Self::NOT_A_NUMBER;
        }
        let biased = value.to_bits() >> 52 & 0x7ff;
        let fraction = value.to_bits() & ((1 << 52) - 1);
        let significand = if biased == 0 { fraction } else { fraction | 1 << 52 };
        let mut limbs = [0; LIMBS];
        limbs[LIMBS - 1] = significand;
        // significand · 2^(biased − 1075), read as 0.limbs · 2^(… + 64).
        let exponent = biased.max(1) as i64 - 1075 + 64;
        Self::normalized(value < 0.0, exponent, limbs, [0; LIMBS])
    }

    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    fn sqrt(self) -> Self {
        if self.kind == Kind::Zero { self } else { self * self.inverse_root(2) }
    }

    fn cbrt(self) -> Self {
        let root = self.abs().inverse_root(3);
        if self.kind == Kind::Zero { self } else { self * root * root }
    }

    /// e^self, with a relative error of (1 + |self|) units.
    fn exp(self) -> Self {
        // Far outside, even the exponent of the result would not fit.
        if self.kind == Kind::Finite && self.negative && self.exponent > 60 {
            return Self::ZERO;
        }
        let exponential = self.abs().exp_m1() + Self::ONE;
        if self.negative && self.kind == Kind::Finite { Self::ONE / exponential } else { exponential }
    }

    /// e^self − 1, with a relative error of (1 + |self|) units.
    fn exp_m1(self) -> Self {
        if self.kind != Kind::Finite {
            return self;
        }
        if self.exponent > 60 {
            return if self.negative { -Self::ONE } else { Self::NOT_A_NUMBER };
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
        let mut sum = Self::ONE;
        for k in (2..=terms).rev() {
            sum = Self::ONE + (x * sum).divided_by(k);
        }
        let mut y = x * sum;
        for _ in 0..doublings {
            y = y * (y + Self::ONE + Self::ONE);
        }
        if self.negative { -(y / (y + Self::ONE)) } else { y }
    }

    /// ln self, with an absolute error of (1 + |ln self|) units; NaN for self ≤ 0.
    ///
    /// With y0 ≈ ln self, by the function of `f64` once or twice, ln self = y0 + ln z for z = self e^(−y0),
    /// and ln z = 2 artanh w for w = (z − 1)/(z + 1).
    fn ln(self) -> Self {
        if self.kind != Kind::Finite || self.negative {
            return Self::NOT_A_NUMBER;
        }
        let rough = |x: Self| Self::splat(x.leading().ln() + x.exponent as f64 * std::f64::consts::LN_2);
        let (mut start, mut z) = (Self::ZERO, self);
        // Of a number such as e^(10¹⁸) the first y0 is wrong by hundreds.
        for _ in 0..4 {
            start = start + rough(z);
            z = self * (-start).exp();
            let gap = z - Self::ONE;
            if gap.kind != Kind::Finite || gap.exponent < -16 {
                break;
            }
        }
        let gap = z - Self::ONE;
        if z.kind != Kind::Finite || gap.kind == Kind::Finite && gap.exponent > -2 {
            return start;
        }
        let w = gap / (z + Self::ONE);
        start + w.arctangent_series(false).scaled(1)
    }

    /// ln(1 + self) to a few units; 2⁸ times as many where self is beyond 2⁻⁸.
    fn ln_1p(self) -> Self {
        if self.kind != Kind::Finite || self.exponent > -8 {
            return if self.kind == Kind::Zero { self } else { (Self::ONE + self).ln() };
        }
        // 2 artanh of x/(2 + x), which is below 2⁻⁸.
        (self / (Self::ONE + Self::ONE + self)).arctangent_series(false).scaled(1)
    }

    /// (y + y/(1 + y))/2 for y = e^|self| − 1, in which nothing cancels.
    fn sinh(self) -> Self {
        let y = self.abs().exp_m1();
        if self.kind == Kind::Zero {
            return self;
        }
        (y + y / (y + Self::ONE)).scaled(-1).copysign(self)
    }

    /// y/(2 + y) for y = e^(2|self|) − 1, and ±1 where that has too many digits.
    fn tanh(self) -> Self {
        match self.kind {
            Kind::Finite if self.exponent > 30 => Self::ONE.copysign(self),
            Kind::Finite => {
                let y = self.abs().scaled(1).exp_m1();
                (y / (y + Self::ONE + Self::ONE)).copysign(self)
            }
            Kind::Zero | Kind::NotANumber => self,
        }
    }

    /// ln(1 + a + a²/(1 + √(1 + a²))) for a = |self|.
    fn asinh(self) -> Self {
        let a = self.abs();
        if self.kind == Kind::Zero {
            return self;
        }
        let square = a * a;
        let root = (Self::ONE + square) * (Self::ONE + square).inverse_root(2);
        (a + square / (Self::ONE + root)).ln_1p().copysign(self)
    }

    /// atan self = 16 atan w, after atan x = 2 atan(x/(1 + √(1 + x²))) four times.
    fn atan(self) -> Self {
        if self.kind != Kind::Finite {
            return self;
        }
        let w = (0..4).fold(self, |x, _| {
            let square = Self::ONE + x * x;
            x / (Self::ONE + square * square.inverse_root(2))
        });
        w.arctangent_series(true).scaled(4)
    }

    /// 2/√π e^(−x²) Σ 2ᵏ x²ᵏ⁺¹/(1·3·…·(2k + 1)), of positive terms only.
    ///
    /// ±1 where erfc is below the last bit.
    fn erf(self) -> Self {
        if self.kind != Kind::Finite {
            return self;
        }
        let square = self * self;
        if square.exponent > 60 || square.to_f64() > 45.0 * LIMBS as f64 {
            return Self::ONE.copysign(self);
        }
        let (mut term, mut sum, mut k) = (self, Self::ZERO, 1);
        while sum.kind == Kind::Zero || term.exponent > sum.exponent - 64 * LIMBS as i64 {
            sum = sum + term;
            k += 2;
            term = (term * square).scaled(1).divided_by(k);
        }
        (sum * (-square).exp() * Self::pi().inverse_root(2)).scaled(1)
    }

    fn cosh(self) -> Self {
        let exponential = self.abs().exp();
        (exponential + exponential.inverse_root(1)).scaled(-1)
    }

    fn sin(self) -> Self {
        self.sine_after_quarters(0)
    }

    fn cos(self) -> Self {
        self.sine_after_quarters(1)
    }

    fn softplus(self) -> Self {
        let positive = if self.negative { Self::ZERO } else { self };
        positive + (-self.abs()).exp().ln_1p()
    }

    fn sigmoid(self) -> Self {
        let exponential = (-self.abs()).exp();
        let numerator = if self.negative { exponential } else { Self::ONE };
        numerator / (Self::ONE + exponential)
    }

    fn logarithm(self) -> Self {
        self.ln()
    }

    fn power(logarithm: Self, exponent: Self) -> Self {
        (exponent * logarithm).exp()
    }

    fn logarithm_of_ratio(a: Self, b: Self) -> Self {
        a - b
    }

    fn abs(self) -> Self {
        Self { negative: false, ..self }
    }

    fn max(self, other: Self) -> Self {
        if self.kind == Kind::NotANumber || self.less(other) { other } else { self }
    }

    fn min(self, other: Self) -> Self {
        if self.kind == Kind::NotANumber || other.less(self) { other } else { self }
    }

    fn copysign(self, sign: Self) -> Self {
        Self { negative: sign.negative, ..self }
    }

    fn less(self, other: Self) -> bool {
        if self.kind == Kind::NotANumber || other.kind == Kind::NotANumber {
            return false;
        }
        let is_negative = |x: Self| x.negative && x.kind == Kind::Finite;
        match (is_negative(self), is_negative(other)) {
            (true, false) => true,
            (false, true) => false,
            (false, false) => self.compare_magnitudes(other).is_lt(),
            (true, true) => self.compare_magnitudes(other).is_gt(),
        }
    }

    fn is_finite(self) -> bool {
        self.kind != Kind::NotANumber
    }

    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    fn two_product(self, other: Self) -> (Self, Self) {
        match (self.kind, other.kind) {
            (Kind::NotANumber, _) | (_, Kind::NotANumber) => (Self::NOT_A_NUMBER, Self::NOT_A_NUMBER),
            (Kind::Zero, _) | (_, Kind::Zero) => (Self::ZERO, Self::ZERO),
            (Kind::Finite, Kind::Finite) => {
                let negative = self.negative != other.negative;
                let exponent = self.exponent + other.exponent;
                let [mut below, limbs] = self.multiply_limbs(other);
                let product = Self::normalized(negative, exponent, limbs, below);
                // One bit of the lower half may have moved up; the rest of it is the exact error.
                if limbs[LIMBS - 1] >> 63 == 0 {
                    below[LIMBS - 1] &= u64::MAX >> 1;
                }
                (product, Self::normalized(negative, exponent - 64 * LIMBS as i64, below, [0; LIMBS]))
            }
        }
    }

    fn power_of_two_scale(self) -> (Self, Self) {
        if self.kind != Kind::Finite {
            return (Self::ONE, Self::ONE);
        }
        (Self::ONE.scaled(1 - self.exponent), Self::ONE.scaled(self.exponent - 1))
    }
}
