//! Double-double numbers, only as much as the oracles of this module need \[Dekker 1971\].

/// The unevaluated sum of two doubles: about 106 bits.
#[derive(Clone, Copy)]
pub(super) struct Twice(pub(super) f64, pub(super) f64);

impl Twice {
    pub(super) fn of(value: f64) -> Self {
        Self(value, 0.0)
    }

    pub(super) fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        let part = sum - self.0;
        let error = (self.0 - (sum - part)) + (other.0 - part) + self.1 + other.1;
        let high = sum + error;
        Self(high, error - (high - sum))
    }

    pub(super) fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let error = f64::mul_add(self.0, other.0, -product) + self.0 * other.1 + self.1 * other.0;
        let high = product + error;
        Self(high, error - (high - product))
    }

    pub(super) fn sum(terms: impl IntoIterator<Item = Self>) -> Self {
        terms.into_iter().fold(Self(0.0, 0.0), Self::add)
    }
}
