//! Real numbers of any fixed precision, stored in place: the arithmetic of oracles.
//!
//! A [`Real`] is `Copy`, and a quotient's oracle takes ten thousands of powers. Libraries of arbitrary
//! precision keep their digits on the heap and take 200 µs for a power of 100 digits; with a length known to
//! the compiler it takes 10. Only what [`Real`] asks for is here. Rounding is by truncation: every operation
//! of arithmetic, roots included, errs by at most [`Real::UNIT_ROUNDOFF`], which leaves 8 of the bits as a
//! reserve.
//!
//! Exponents have no bounds worth mentioning, so nothing overflows or underflows. There is no infinity: what
//! would be one, such as 1/0, is NaN.
//!
//! Kernels of `piola::quotient` cut their series at the precision of `f64`, and so does every
//! `Material::blocks`. Only `Material::energy` and `Material::gradient` are as precise as their real type.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use piola::Real;

mod elementary;

/// A number with 64·LIMBS bits: sign · 0.limbs · 2^exponent, the most significant limb last, its highest bit
/// set.
#[derive(Clone, Copy)]
pub struct Multiprecision<const LIMBS: usize> {
    kind: Kind,
    negative: bool,
    exponent: i64,
    limbs: [u64; LIMBS],
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Zero,
    Finite,
    NotANumber,
}

impl<const LIMBS: usize> Multiprecision<LIMBS> {
    const ZERO: Self = Self { kind: Kind::Zero, negative: false, exponent: 0, limbs: [0; LIMBS] };
    const NOT_A_NUMBER: Self = Self { kind: Kind::NotANumber, ..Self::ZERO };
    const ONE: Self = {
        let mut limbs = [0; LIMBS];
        limbs[LIMBS - 1] = 1 << 63;
        Self { kind: Kind::Finite, negative: false, exponent: 1, limbs }
    };

    /// The nearest `f64`: infinite where it overflows.
    pub fn to_f64(self) -> f64 {
        match self.kind {
            Kind::Zero => 0.0,
            Kind::NotANumber => f64::NAN,
            Kind::Finite => {
                let exponent = self.exponent.clamp(-2000, 2000) as i32;
                // Two steps, because a power of two at either end of the range is not one factor.
                let half = exponent / 2;
                let magnitude = self.leading() * 2f64.powi(half) * 2f64.powi(exponent - half);
                if self.negative { -magnitude } else { magnitude }
            }
        }
    }

    /// The significand in [1/2, 1] as an `f64`.
    fn leading(self) -> f64 {
        // The conversion rounds to nearest, so that numbers close to 1 give 1.
        self.limbs[LIMBS - 1] as f64 / 2f64.powi(64)
    }

    /// sign · 0.limbs · 2^exponent, after moving the highest bit that is set to the front.
    ///
    /// Bits from below the last limb enter from `below`.
    fn normalized(negative: bool, exponent: i64, limbs: [u64; LIMBS], below: [u64; LIMBS]) -> Self {
        let Some(first) = limbs.iter().rev().chain(below.iter().rev()).position(|&limb| limb != 0) else {
            return Self::ZERO;
        };
        // Limb k of `below` followed by `limbs`.
        let at = |k: isize| match usize::try_from(k) {
            Ok(k) if k < LIMBS => below[k],
            Ok(k) => limbs[k - LIMBS],
            Err(_) => 0,
        };
        let top = (2 * LIMBS - 1 - first) as isize;
        let shift = at(top).leading_zeros();
        let limbs = std::array::from_fn(|k| {
            let k = top - (LIMBS - 1 - k) as isize;
            let (here, under) = (at(k), at(k - 1));
            if shift == 0 { here } else { here << shift | under >> (64 - shift) }
        });
        let exponent = exponent - 64 * first as i64 - i64::from(shift);
        Self { kind: Kind::Finite, negative, exponent, limbs }
    }

    fn compare_magnitudes(self, other: Self) -> Ordering {
        let key = |x: Self| (x.kind != Kind::Zero, x.exponent);
        key(self).cmp(&key(other)).then_with(|| self.limbs.iter().rev().cmp(other.limbs.iter().rev()))
    }

    /// |self| ± |other| with the given sign, for |self| ≥ |other| > 0.
    fn combine(self, other: Self, subtract: bool, negative: bool) -> Self {
        let distance = self.exponent - other.exponent;
        if distance > 64 * (LIMBS as i64 + 1) {
            return Self { negative, ..self };
        }
        // One limb below the last: where leading bits cancel, the distance is at most 1 and no bit is lost.
        let (whole, bits) = ((distance / 64) as usize, (distance % 64) as u32);
        let shifted = |k: usize| {
            let at = |k: usize| if k < LIMBS { other.limbs[k] } else { 0 };
            let here = if k + whole == 0 { 0 } else { at(k + whole - 1) };
            let over = at(k + whole);
            if bits == 0 { here } else { here >> bits | over << (64 - bits) }
        };
        let mut below = [0; LIMBS];
        let mut limbs = self.limbs;
        let mut carry = false;
        for k in 0..=LIMBS {
            let (a, b) = (if k == 0 { 0 } else { self.limbs[k - 1] }, shifted(k));
            let (sum, first) = if subtract { a.overflowing_sub(b) } else { a.overflowing_add(b) };
            let carried = u64::from(carry);
            let (result, second) =
                if subtract { sum.overflowing_sub(carried) } else { sum.overflowing_add(carried) };
            *(if k == 0 { &mut below[LIMBS - 1] } else { &mut limbs[k - 1] }) = result;
            carry = first | second;
        }
        if carry {
            // A sum that reached the next power of two.
            let limbs = std::array::from_fn(|k| {
                let over = if k + 1 < LIMBS { limbs[k + 1] } else { 1 };
                limbs[k] >> 1 | over << 63
            });
            return Self { kind: Kind::Finite, negative, exponent: self.exponent + 1, limbs };
        }
        Self::normalized(negative, self.exponent, limbs, below)
    }

    /// The product of the limbs: those above and those below the last one that is kept.
    fn multiply_limbs(self, other: Self) -> [[u64; LIMBS]; 2] {
        let mut product = [[0; LIMBS]; 2];
        for i in 0..LIMBS {
            let mut carry = 0;
            for j in 0..LIMBS {
                let k = i + j;
                let place = &mut product[k / LIMBS][k % LIMBS];
                let sum = u128::from(self.limbs[i]) * u128::from(other.limbs[j]) + u128::from(*place) + carry;
                *place = sum as u64;
                carry = sum >> 64;
            }
            product[1][i] = carry as u64;
        }
        product
    }

    /// self / divisor, for a small whole number.
    fn divided_by(self, divisor: u32) -> Self {
        if self.kind != Kind::Finite {
            return self;
        }
        let mut remainder = 0;
        let mut divide = |limb: u64| {
            let dividend = remainder << 64 | u128::from(limb);
            remainder = dividend % u128::from(divisor);
            (dividend / u128::from(divisor)) as u64
        };
        let (mut limbs, mut below) = ([0; LIMBS], [0; LIMBS]);
        for k in (0..LIMBS).rev() {
            limbs[k] = divide(self.limbs[k]);
        }
        below[LIMBS - 1] = divide(0);
        Self::normalized(self.negative, self.exponent, limbs, below)
    }

    /// self · 2^shift.
    fn scaled(self, shift: i64) -> Self {
        if self.kind == Kind::Finite { Self { exponent: self.exponent + shift, ..self } } else { self }
    }
}

impl<const LIMBS: usize> Add for Multiprecision<LIMBS> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        match (self.kind, other.kind) {
            (Kind::NotANumber, _) | (_, Kind::NotANumber) => Self::NOT_A_NUMBER,
            (_, Kind::Zero) => self,
            (Kind::Zero, _) => other,
            (Kind::Finite, Kind::Finite) => {
                let (larger, smaller) = match self.compare_magnitudes(other) {
                    Ordering::Less => (other, self),
                    Ordering::Equal | Ordering::Greater => (self, other),
                };
                larger.combine(smaller, self.negative != other.negative, larger.negative)
            }
        }
    }
}

impl<const LIMBS: usize> Neg for Multiprecision<LIMBS> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { negative: !self.negative, ..self }
    }
}

impl<const LIMBS: usize> Sub for Multiprecision<LIMBS> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const LIMBS: usize> Mul for Multiprecision<LIMBS> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.two_product(other).0
    }
}

impl<const LIMBS: usize> Div for Multiprecision<LIMBS> {
    type Output = Self;

    fn div(self, divisor: Self) -> Self {
        let reciprocal = divisor.inverse_root(1);
        let quotient = self * reciprocal;
        // The residual of the quotient restores what the two roundings took.
        quotient + reciprocal * (self - divisor * quotient)
    }
}

impl<const LIMBS: usize> fmt::Debug for Multiprecision<LIMBS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:e}", self.to_f64())
    }
}
