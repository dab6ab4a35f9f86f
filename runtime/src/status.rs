//! Status of the evaluation of a point, and counts of the statuses of many.
//!
//! The four flags of [`Status`] are the only vocabulary, in four containers: `Status` for a point,
//! `Status<R::Mask>` for points on lanes, `Status<u64>` with a bit for each point of a tile, and
//! [`StatusCell`], one atomic byte for a point of a batch, which any thread may write. A [`Survey`] counts
//! flags over many points and names the first point that is refused or nonfinite; surveys can be added.

use std::iter::Sum;
use std::ops::{Add, BitAnd, BitOr};
use std::sync::atomic::{AtomicU8, Ordering};

use crate::lanes::{Mask, Numbers, Real, Replace};

/// Status of an evaluation: a truth value of each kind for one point, or a mask of each for several points.
///
/// A `Status` is that of one point; `Status<R::Mask>` is that of the points on the lanes of a real type.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Status<M = bool> {
    /// The deformation lies outside the domain of the energy, and the results are meaningless.
    pub refused: M,
    /// λ2 + λ3 is at a pole of the twist, and the tangent has a bounded value instead of an infinite one.
    ///
    /// The computed sum is below [`pole_floor`](crate::quotient::pole_floor), which is of the size of the
    /// roundings of F and of its decomposition: if the stretches are opposite, these decide.
    pub bounded: M,
    /// The deformation gradient or a result is infinite or NaN, or a stretch or the tangent comes within a
    /// factor 16 of it.
    pub nonfinite: M,
    /// The filter met a negative eigenvalue and changed the tangent.
    pub filtered: M,
}

impl Status {
    /// True if the results are valid: neither refused nor infinite nor NaN.
    #[must_use]
    pub fn is_clean(self) -> bool {
        !self.refused && !self.nonfinite
    }
}

impl<M: Mask> Status<M> {
    /// A status with nothing to report of any point.
    #[inline(always)]
    pub(crate) fn clean() -> Self {
        let no = M::splat(false);
        Self { refused: no, bounded: no, nonfinite: no, filtered: no }
    }
}

impl<R: Real> Numbers<R> for Status<R::Mask> {
    fn map(self, to: &mut impl Replace<R>) -> Self {
        let [refused, bounded, nonfinite, filtered] =
            [self.refused, self.bounded, self.nonfinite, self.filtered].map(|bit| to.truth(bit));
        Self { refused, bounded, nonfinite, filtered }
    }
}

/// Union of two statuses: all flags of either.
impl<M: BitOr<Output = M>> BitOr for Status<M> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self {
            refused: self.refused | other.refused,
            bounded: self.bounded | other.bounded,
            nonfinite: self.nonfinite | other.nonfinite,
            filtered: self.filtered | other.filtered,
        }
    }
}

/// The status where a mask is set, clean elsewhere.
impl<M: BitAnd<Output = M> + Copy> BitAnd<M> for Status<M> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, mask: M) -> Self {
        Self {
            refused: self.refused & mask,
            bounded: self.bounded & mask,
            nonfinite: self.nonfinite & mask,
            filtered: self.filtered & mask,
        }
    }
}

/// Statuses of up to 64 points, a bit for each.
#[cfg(feature = "batch")]
impl Status<u64> {
    /// The status of one of the points.
    #[must_use]
    pub(crate) fn of_point(self, point: usize) -> Status {
        let bit = |bits: u64| bits >> point & 1 == 1;
        Status {
            refused: bit(self.refused),
            bounded: bit(self.bounded),
            nonfinite: bit(self.nonfinite),
            filtered: bit(self.filtered),
        }
    }
}

/// Status of a point of a batch, which any thread may write.
///
/// One byte, which may belong to another language: bit 0 means refused, 1 bounded, 2 nonfinite, 3 filtered.
#[derive(Debug, Default)]
#[repr(transparent)]
pub struct StatusCell(AtomicU8);

impl StatusCell {
    /// The status that was written last; clean before.
    #[must_use]
    pub fn get(&self) -> Status {
        let bits = self.0.load(Ordering::Relaxed);
        let bit = |k: u8| bits >> k & 1 == 1;
        Status { refused: bit(0), bounded: bit(1), nonfinite: bit(2), filtered: bit(3) }
    }

    /// Replaces the status.
    pub fn set(&self, status: Status) {
        let Status { refused, bounded, nonfinite, filtered } = status;
        let flags = [refused, bounded, nonfinite, filtered].into_iter().enumerate();
        let bits = flags.fold(0, |bits, (k, flag)| bits | u8::from(flag) << k);
        self.0.store(bits, Ordering::Relaxed);
    }
}

/// Counts of the statuses of many points.
///
/// Surveys of different points are added by `+` and [`Iterator::sum`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Survey {
    /// Number of points outside the domain of the energy.
    pub refused: usize,
    /// Number of points at a pole of the tangent, which got a bounded value.
    pub bounded: usize,
    /// Number of points with an infinite or NaN deformation or result, or one within a factor 16 of it.
    pub nonfinite: usize,
    /// Number of points where the filter changed the tangent.
    pub filtered: usize,
    /// Index of the first point that is refused or not finite.
    pub first: Option<usize>,
}

impl Survey {
    /// Counts the points of a tile, whose first is number `start`.
    #[cfg(feature = "batch")]
    pub(crate) fn of(status: Status<u64>, start: usize) -> Self {
        let count = |bits: u64| bits.count_ones() as usize;
        let meaningless = status.refused | status.nonfinite;
        Self {
            refused: count(status.refused),
            bounded: count(status.bounded),
            nonfinite: count(status.nonfinite),
            filtered: count(status.filtered),
            first: (meaningless != 0).then(|| start + meaningless.trailing_zeros() as usize),
        }
    }

    /// True if the results of every point are valid.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.refused == 0 && self.nonfinite == 0
    }
}

impl Add for Survey {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            refused: self.refused + other.refused,
            bounded: self.bounded + other.bounded,
            nonfinite: self.nonfinite + other.nonfinite,
            filtered: self.filtered + other.filtered,
            first: self.first.into_iter().chain(other.first).min(),
        }
    }
}

impl Sum for Survey {
    fn sum<I: Iterator<Item = Self>>(surveys: I) -> Self {
        surveys.fold(Self::default(), Add::add)
    }
}
