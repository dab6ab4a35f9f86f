//! Tiles: 64 points, component by component, small enough to stay in the innermost cache.
//!
//! Between the stages of a batch, number k of a tile's points is a row of its own, so that lanes load it as
//! it is. A tile that is not full is padded with arbitrary values: no lane depends on another.

use crate::lanes::{Lanes, Scalar};
use crate::material::Blocks;

/// Points of a tile. As many as an integer has bits, so that a truth value of each is one integer.
pub const TILE: usize = 64;

/// Places of a row, more than points: rows as far apart as a power of two would compete for the same places
/// of the innermost cache, and loads would wait for stores to addresses that only look the same.
pub(crate) const ROW: usize = 80;

/// One component of each point of a tile.
pub(crate) type Row<E> = [E; ROW];

/// Rows of a tile: N components of each of its points.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Rows<E, const N: usize>(pub(crate) [Row<E>; N]);

impl<E: Scalar, const N: usize> Rows<E, N> {
    pub(crate) fn zero() -> Self {
        Self([[E::default(); ROW]; N])
    }

    /// Component k of the points from `at` on.
    #[inline(always)]
    pub(crate) fn get<R: Lanes<Scalar = E>>(&self, k: usize, at: usize) -> R {
        R::load(&self.0[k][at..])
    }

    /// All components of the points from `at` on.
    #[inline(always)]
    pub(crate) fn get_all<R: Lanes<Scalar = E>>(&self, at: usize) -> [R; N] {
        let mut numbers = [R::splat(0.0); N];
        for k in 0..N {
            numbers[k] = self.get(k, at);
        }
        numbers
    }

    #[inline(always)]
    pub(crate) fn set<R: Lanes<Scalar = E>>(&mut self, k: usize, at: usize, value: R) {
        value.store(&mut self.0[k][at..]);
    }

    #[inline(always)]
    pub(crate) fn set_all<R: Lanes<Scalar = E>>(&mut self, at: usize, values: [R; N]) {
        for k in 0..N {
            self.set(k, at, values[k]);
        }
    }
}

/// Runs a block for each group of lanes of a tile that holds one of the first points, `at` being the first of
/// the group.
///
/// A macro and no function with a closure: a long closure is a function of its own to the compiler, and not
/// compiled for the instructions of a back end unless it chooses to inline it.
macro_rules! for_each_group {
    ($R:ty, $count:expr, |$at:ident| $body:block) => {
        let mut $at = 0;
        while $at < $count {
            // Always true, since the lanes of every back end divide the tile; said for the bounds checks'
            // sake.
            if $at + <$R as $crate::lanes::Lanes>::LANES <= $crate::kernels::rows::TILE $body
            $at += <$R as $crate::lanes::Lanes>::LANES;
        }
    };
    // Without groups all of whose points are in `served`, as bits.
    ($R:ty, $count:expr, but $served:expr, |$at:ident| $body:block) => {
        $crate::kernels::rows::for_each_group!($R, $count, |$at| {
            let lanes = $crate::kernels::rows::first_bits(<$R as $crate::lanes::Lanes>::LANES);
            if $served == 0 || (!$served >> $at) & lanes != 0 $body
        })
    };
}
pub(crate) use for_each_group;

/// The lowest `count` bits.
#[inline]
pub(crate) fn first_bits(count: usize) -> u64 {
    if count >= 64 { u64::MAX } else { (1 << count) - 1 }
}

#[inline(always)]
pub(crate) fn to_rows<R: Copy>(blocks: &Blocks<R>) -> [R; 15] {
    let [p1, p2, p3] = blocks.gradient;
    let [h11, h22, h33, h12, h13, h23] = blocks.hessian;
    let ([f12, f13, f23], [t12, t13, t23]) = (blocks.flip, blocks.twist);
    [p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23]
}

#[inline(always)]
pub(crate) fn from_rows<R: Copy>(rows: [R; 15]) -> Blocks<R> {
    let [p1, p2, p3, h11, h22, h33, h12, h13, h23, f12, f13, f23, t12, t13, t23] = rows;
    Blocks {
        gradient: [p1, p2, p3],
        hessian: [h11, h22, h33, h12, h13, h23],
        flip: [f12, f13, f23],
        twist: [t12, t13, t23],
    }
}
