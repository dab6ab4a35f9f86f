//! Kernels of stresses, and of the gradients of elements.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use super::form::{Components, gradient_is_finite, put_gradient};
use super::rows::{Row, Rows, first_bits, for_each_group};
use super::sink::{LineBuffer, Sink, Source};
use super::svd_tile::SvdTile;
use crate::lanes::{Backend, Kernel, Lanes, Mask, Scalar};
use crate::point::invariants::{gradient_is_in_range, stress_by_invariants};
use crate::point::matrix::{three, to_matrix, to_row_major};
use crate::point::{Matrix3, stress, stress_is_finite};
use crate::status::Status;

/// Kernel from frames and ψi to P, Pa, or to the gradients of elements, N, if there are shapes at rest.
pub(crate) struct Stress<'a, E, const REST: usize> {
    pub(crate) points: &'a SvdTile<E>,
    /// ψi in the first three rows.
    pub(crate) gradients: &'a [Row<E>],
    pub(crate) rest: Source<'a, E, REST>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

impl<E: Scalar> Kernel<E> for Stress<'_, E, 10> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { points, gradients, rest, count, line, mut to } = self;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let svd = points.get::<R>(at);
            let stress = stress(&svd, three!(k => R::load(&gradients[k][at..])));
            let rest = rest.get_all(at);
            let is_finite = stress_is_finite(svd.stretches, &stress) & gradient_is_finite(&stress, &rest);
            status.nonfinite |= R::bits(!is_finite) << at;
            put_gradient(&stress, &rest, to.place::<R, 12>(line, at));
            to.finish::<R, 12>(line, at, count);
        });
        status & first_bits(count)
    }
}

impl<E: Scalar> Kernel<E> for Stress<'_, E, 0> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { points, gradients, count, line, mut to, .. } = self;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let svd = points.get::<R>(at);
            let stress = stress(&svd, three!(k => R::load(&gradients[k][at..])));
            status.nonfinite |= R::bits(!stress_is_finite(svd.stretches, &stress)) << at;
            to.place::<R, 9>(line, at).put_all(to_row_major(stress));
            to.finish::<R, 9>(line, at, count);
        });
        status & first_bits(count)
    }
}

/// Kernel from F and W1, W2, WJ to P, or to the gradients of elements, N, if there are shapes at rest.
pub(crate) struct StressByInvariants<'a, E, const REST: usize> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) gradients: &'a Rows<E, 3>,
    pub(crate) has_second_invariant: bool,
    pub(crate) rest: Source<'a, E, REST>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

/// [`StressByInvariants`] with or without terms in I2.
struct StressOf<'a, E, const HAS_SECOND: bool, const REST: usize>(StressByInvariants<'a, E, REST>);

impl<E: Scalar, const HAS_SECOND: bool, const REST: usize> Kernel<E> for StressOf<'_, E, HAS_SECOND, REST> {
    /// The points whose result is finite.
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let StressByInvariants { F, gradients, rest, count, line, mut to, .. } = self.0;
        let mut finite = 0;
        for_each_group!(R, count, |at| {
            let F = to_matrix(F.get_all::<R>(at));
            let gradient = gradients.get_all(at);
            let stress = stress_by_invariants::<R, HAS_SECOND>(&F, gradient);
            let stays_finite = put_stress(&stress, &rest.get_all(at), &mut to, line, at);
            finish_stress::<R, REST>(&mut to, line, at, count);
            finite |= R::bits(gradient_is_in_range(gradient) & stays_finite) << at;
        });
        finite & first_bits(count)
    }
}

/// Runs a kernel with or without terms in I2.
pub(crate) fn stress_of<E: Scalar, const REST: usize>(
    backend: Backend,
    kernel: StressByInvariants<'_, E, REST>,
) -> u64 {
    if kernel.has_second_invariant {
        backend.run(StressOf::<_, true, REST>(kernel))
    } else {
        backend.run(StressOf::<_, false, REST>(kernel))
    }
}

/// Puts P, or the gradient if there is a shape at rest, into its place; [`finish_stress`] must follow.
/// Returns where the latter cannot overflow.
#[inline(always)]
pub(crate) fn put_stress<R: Lanes, const REST: usize>(
    stress: &Matrix3<R>,
    rest: &[R; REST],
    to: &mut Sink<'_, R::Scalar>,
    line: &mut LineBuffer<R::Scalar>,
    at: usize,
) -> R::Mask {
    if REST == 0 {
        to.place::<R, 9>(line, at).put_all(to_row_major(*stress));
        return R::Mask::splat(true);
    }
    let mut shape = [R::splat(0.0); 10];
    shape[..REST].copy_from_slice(rest);
    put_gradient(stress, &shape, to.place::<R, 12>(line, at));
    gradient_is_finite(stress, &shape)
}

/// Copies the output of [`put_stress`] to the slice.
#[inline(always)]
pub(crate) fn finish_stress<R: Lanes, const REST: usize>(
    to: &mut Sink<'_, R::Scalar>,
    line: &LineBuffer<R::Scalar>,
    at: usize,
    count: usize,
) {
    if REST == 0 {
        to.finish::<R, 9>(line, at, count);
    } else {
        to.finish::<R, 12>(line, at, count);
    }
}
