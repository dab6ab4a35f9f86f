//! Kernels from edges to deformation gradients, and from these to frames, stretches and invariants.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::rows::{Rows, first_bits, for_each_group};
use super::sink::{Lines, Source};
use super::svd_tile::SvdTile;
use crate::lanes::{Kernel, Lanes, Mask, Scalar};
use crate::point::invariants::{Needed, invariants, with_needed};
use crate::point::matrix::{to_matrix, to_row_major};
use crate::point::multiply;
use crate::point::svd::{along_axes, may_have_axis, unaligned, unaligned_signed_by_determinant};

/// Lanes of points that are decomposed in turns; the bits of a point do not depend on the others.
#[cfg(not(unoptimised))]
type InTurns<R> = <R as Lanes>::Interleaved;
/// Lanes of points that are decomposed one after the other. Without optimisation every intermediate result
/// has its own place on the stack, and a thread has 2 MiB.
#[cfg(unoptimised)]
type InTurns<R> = R;

/// Decomposes the points of a tile on these lanes, except for exact axes.
macro_rules! decompose {
    ($R:ty, $F:ident, $count:ident, $served:ident, $is_signed:ident, $points:ident) => {
        if $is_signed {
            for_each_group!($R, $count, but $served, |at| {
                $points.set(at, &unaligned_signed_by_determinant(&to_matrix($F.get_all::<$R>(at))));
            });
        } else {
            for_each_group!($R, $count, but $served, |at| {
                $points.set(at, &unaligned(&to_matrix($F.get_all::<$R>(at))));
            });
        }
    };
}

/// Kernel from the deformation gradients of a tile to frames and stretches.
pub(crate) struct Decompose<'a, E> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) count: usize,
    /// Points whose decomposition nothing reads, as bits.
    pub(crate) served: u64,
    /// True if the sign of det F decides about the domain.
    pub(crate) is_signed: bool,
    pub(crate) points: &'a mut SvdTile<E>,
}

impl<E: Scalar> Kernel<E> for Decompose<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Self { F, count, served, is_signed, points } = self;
        if count <= R::LANES {
            decompose!(R, F, count, served, is_signed, points);
        } else {
            decompose!(InTurns<R>, F, count, served, is_signed, points);
        }
        // Apart from the loops above, which need all registers.
        for_each_group!(R, count, but served, |at| {
            let F = to_matrix(F.get_all::<R>(at));
            if may_have_axis(&F).any() {
                points.set(at, &along_axes(&F, points.get(at)));
            }
        });
    }
}

/// Kernel from the deformation gradients of a tile to I1, I2, J.
pub(crate) struct Invariants<'a, E> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) count: usize,
    pub(crate) needed: Needed,
    pub(crate) invariants: &'a mut Rows<E, 3>,
}

impl<E: Scalar> Kernel<E> for Invariants<'_, E> {
    /// The points in range.
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let Self { F, count, needed, invariants: to } = self;
        let mut in_range = 0;
        with_needed!(needed, needed => {
            for_each_group!(R, count, |at| {
                let (numbers, is_in_range) = invariants(&to_matrix(F.get_all::<R>(at)), needed);
                to.set_all(at, numbers);
                in_range |= R::bits(is_in_range) << at;
            });
        });
        in_range & first_bits(count)
    }
}

/// Kernel from the edges of a tile's tetrahedra to their deformation gradients, in place: F = Ds Dm⁻¹.
pub(crate) struct Deform<'a, E> {
    /// Ds: row a, column k is coordinate a of node k + 1 less that of node 0.
    pub(crate) edges: &'a mut Lines<E, 9>,
    pub(crate) rest: Source<'a, E, 10>,
    pub(crate) count: usize,
}

impl<E: Scalar> Kernel<E> for Deform<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Self { edges, rest, count } = self;
        for_each_group!(R, count, |at| {
            let Ds = to_matrix(edges.source().get_all::<R>(at));
            let [a, b, c, d, e, f, g, h, i, _] = rest.get_all::<R>(at);
            edges.set_all(at, to_row_major(multiply(&Ds, &[[a, b, c], [d, e, f], [g, h, i]])));
        });
    }
}
