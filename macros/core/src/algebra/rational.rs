//! Exact fractions, in which all numbers of a declaration are kept until code is emitted.

use std::fmt;

/// A fraction in lowest terms with a positive denominator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

impl Rational {
    /// The fraction 0.
    pub const ZERO: Self = Self::integer(0);
    /// The fraction 1.
    pub const ONE: Self = Self::integer(1);

    /// A whole number.
    #[must_use]
    pub const fn integer(value: i64) -> Self {
        Self { numerator: value as i128, denominator: 1 }
    }

    /// A fraction; `None` if the denominator is zero or a part leaves 128 bits.
    #[must_use]
    pub fn new(numerator: i128, denominator: i128) -> Option<Self> {
        if denominator == 0 || numerator == i128::MIN || denominator == i128::MIN {
            return None;
        }
        if denominator == 1 {
            return Some(Self { numerator, denominator });
        }
        let divisor = gcd(numerator.abs(), denominator.abs()) * denominator.signum();
        Some(Self { numerator: numerator / divisor, denominator: denominator / divisor })
    }

    /// The exact value of a decimal literal such as `0.25` or `1e-3`, without suffix or underscores.
    pub(crate) fn from_decimal(digits: &str) -> Option<Self> {
        let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (digits, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let numerator = format!("{whole}{fraction}").parse::<i128>().ok()?;
        let exponent = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
        let scale = 10i128.checked_pow(exponent.unsigned_abs())?;
        if exponent < 0 { Self::new(numerator, scale) } else { Self::new(numerator.checked_mul(scale)?, 1) }
    }

    /// The whole number it is, if it is one.
    pub(crate) fn as_integer(self) -> Option<i64> {
        (self.denominator == 1).then(|| i64::try_from(self.numerator).ok()).flatten()
    }

    /// Numerator, carrying the sign.
    #[must_use]
    pub fn numerator(self) -> i128 {
        self.numerator
    }

    /// Denominator, positive.
    #[must_use]
    pub fn denominator(self) -> i128 {
        self.denominator
    }

    /// The nearest `f64` if both parts fit 53 bits, else one within two units in the last place.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        // Conversions from 128 bits take several times as long.
        match (i64::try_from(self.numerator), i64::try_from(self.denominator)) {
            (Ok(numerator), Ok(denominator)) => numerator as f64 / denominator as f64,
            _ => self.numerator as f64 / self.denominator as f64,
        }
    }

    /// The sum, unless it leaves 128 bits.
    #[must_use]
    pub fn checked_add(self, other: Self) -> Option<Self> {
        let left = self.numerator.checked_mul(other.denominator)?;
        let right = other.numerator.checked_mul(self.denominator)?;
        Self::new(left.checked_add(right)?, self.denominator.checked_mul(other.denominator)?)
    }

    /// The product, unless it leaves 128 bits.
    #[must_use]
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        Self::new(
            self.numerator.checked_mul(other.numerator)?,
            self.denominator.checked_mul(other.denominator)?,
        )
    }

    /// Whole power; `None` for a negative power of zero.
    pub(crate) fn checked_powi(self, exponent: i64) -> Option<Self> {
        let magnitude = u32::try_from(exponent.unsigned_abs()).ok()?;
        let numerator = self.numerator.checked_pow(magnitude)?;
        let denominator = self.denominator.checked_pow(magnitude)?;
        if exponent < 0 { Self::new(denominator, numerator) } else { Self::new(numerator, denominator) }
    }

    /// The negative of the fraction.
    pub(crate) fn negated(self) -> Self {
        Self { numerator: -self.numerator, ..self }
    }

    /// The absolute value of the fraction.
    #[must_use]
    pub fn magnitude(self) -> Self {
        if self.is_negative() { self.negated() } else { self }
    }

    /// True if it is 0.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// True if it is less than 0.
    #[must_use]
    pub fn is_negative(self) -> bool {
        self.numerator < 0
    }
}

/// The greatest common divisor of two numbers that are not negative.
pub(crate) fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.numerator)?;
        if self.denominator != 1 {
            write!(f, "/{}", self.denominator)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_exact() {
        let check = |digits: &str, expected: &str| {
            assert_eq!(Rational::from_decimal(digits).map(|r| r.to_string()).as_deref(), Some(expected));
        };
        check("0.25", "1/4");
        check("12", "12");
        check("1e-3", "1/1000");
        check("2.5E2", "250");
        check("3.", "3");
        assert_eq!(Rational::from_decimal("1e-300"), None);
    }

    #[test]
    fn arithmetic_reduces_and_reports_overflow() {
        let third = Rational::new(2, -6).unwrap();
        assert_eq!(third.to_string(), "-1/3");
        assert_eq!(third.checked_add(third.negated()), Some(Rational::ZERO));
        assert_eq!(third.checked_powi(-2), Some(Rational::integer(9)));
        assert_eq!(Rational::integer(i64::MAX).checked_powi(3), None);
        assert_eq!(Rational::ZERO.checked_powi(-1), None);
    }
}
