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

impl<E: Scalar, const REST: usize> Kernel<E> for Stress<'_, E, REST>
where
    At<REST>: FirstOutput<REST>,
{
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { points, gradients, rest, count, line, mut to } = self;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let svd = points.get::<R>(at);
            let stress = stress(&svd, three!(k => R::load(&gradients[k][at..])));
            let rest = rest.get_all(at);
            let is_finite =
                stress_is_finite(svd.stretches, &stress) & At::<REST>::stays_finite(&stress, &rest);
            status.nonfinite |= R::bits(!is_finite) << at;
            At::<REST>::put(&stress, &rest, &mut to, line, at);
            At::<REST>::finish::<R>(&mut to, line, at, count);
        });
        status & first_bits(count)
    }
}

/// Points, or elements with REST components of a shape at rest.
pub(crate) struct At<const REST: usize>;

/// The output that is made from P: P itself at points, the gradient at elements.
pub(crate) trait FirstOutput<const REST: usize> {
    /// True if the output is finite, given that P is.
    fn stays_finite<R: Lanes>(stress: &Matrix3<R>, rest: &[R; REST]) -> R::Mask;

    /// Puts the output into its place; [`FirstOutput::finish`] must follow.
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        rest: &[R; REST],
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    );

    /// Copies the output to the slice.
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize);
}

impl FirstOutput<0> for At<0> {
    #[inline(always)]
    fn stays_finite<R: Lanes>(_: &Matrix3<R>, _: &[R; 0]) -> R::Mask {
        R::Mask::splat(true)
    }

    #[inline(always)]
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        _: &[R; 0],
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    ) {
        to.place::<R, 9>(line, at).put_all(to_row_major(*stress));
    }

    #[inline(always)]
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize) {
        to.finish::<R, 9>(line, at, count);
    }
}

impl FirstOutput<10> for At<10> {
    #[inline(always)]
    fn stays_finite<R: Lanes>(stress: &Matrix3<R>, rest: &[R; 10]) -> R::Mask {
        gradient_is_finite(stress, rest)
    }

    #[inline(always)]
    fn put<R: Lanes>(
        stress: &Matrix3<R>,
        rest: &[R; 10],
        to: &mut Sink<'_, R::Scalar>,
        line: &mut LineBuffer<R::Scalar>,
        at: usize,
    ) {
        put_gradient(stress, rest, to.place::<R, 12>(line, at));
    }

    #[inline(always)]
    fn finish<R: Lanes>(to: &mut Sink<'_, R::Scalar>, line: &LineBuffer<R::Scalar>, at: usize, count: usize) {
        to.finish::<R, 12>(line, at, count);
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

impl<E: Scalar, const HAS_SECOND: bool, const REST: usize> Kernel<E> for StressOf<'_, E, HAS_SECOND, REST>
where
    At<REST>: FirstOutput<REST>,
{
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
            let rest = rest.get_all(at);
            At::<REST>::put(&stress, &rest, &mut to, line, at);
            let stays_finite = At::<REST>::stays_finite(&stress, &rest);
            At::<REST>::finish::<R>(&mut to, line, at, count);
            finite |= R::bits(gradient_is_in_range(gradient) & stays_finite) << at;
        });
        finite & first_bits(count)
    }
}

/// Runs a kernel with or without terms in I2.
pub(crate) fn stress_of<E: Scalar, const REST: usize>(
    backend: Backend,
    kernel: StressByInvariants<'_, E, REST>,
) -> u64
where
    At<REST>: FirstOutput<REST>,
{
    if kernel.has_second_invariant {
        backend.run(StressOf::<_, true, REST>(kernel))
    } else {
        backend.run(StressOf::<_, false, REST>(kernel))
    }
}
