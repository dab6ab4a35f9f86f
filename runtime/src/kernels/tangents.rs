//! Kernels of tangents, and of the stiffnesses of elements.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use super::form::{Output, OutputByInvariants};
use super::rows::{Rows, first_bits, for_each_group, from_rows, to_rows};
use super::sink::{LineBuffer, Sink, Source};
use super::stress::{At, FirstOutput};
use super::svd_tile::SvdTile;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::material::Curvature;
use crate::point::invariants::tangent::Terms;
use crate::point::matrix::to_matrix;
use crate::point::{Filter, Svd, Tangent, judge};
use crate::status::Status;

/// Kernel that filters the blocks of a tile in place, and returns the status of its points.
pub(crate) struct FilterBlocks<'a, E> {
    pub(crate) points: &'a SvdTile<E>,
    pub(crate) blocks: &'a mut Rows<E, 15>,
    pub(crate) count: usize,
    pub(crate) filter: Filter,
    pub(crate) has_pole: bool,
}

impl<E: Scalar> Kernel<E> for FilterBlocks<'_, E> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { points, blocks, count, filter, has_pole } = self;
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
            let stretches = points.stretches.get_all::<R>(at);
            let (filtered, judged) = judge(stretches, &from_rows(blocks.get_all(at)), has_pole, filter);
            if filter != Filter::None {
                blocks.set_all(at, to_rows(&filtered));
            }
            status.bounded |= R::bits(judged.bounded) << at;
            status.nonfinite |= R::bits(judged.nonfinite) << at;
            status.filtered |= R::bits(judged.filtered) << at;
        });
        status & first_bits(count)
    }
}

/// Frames and judged blocks of a tile, with the output for its tangents or stiffnesses.
pub(crate) struct Tangents<'a, E, const REST: usize> {
    pub(crate) points: &'a SvdTile<E>,
    pub(crate) blocks: &'a Rows<E, 15>,
    pub(crate) rest: Source<'a, E, REST>,
    pub(crate) count: usize,
    pub(crate) has_pole: bool,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

/// [`Tangents`] with an output of a form.
pub(crate) struct Shaped<'a, E, F, const REST: usize, const N: usize>(
    pub(crate) Tangents<'a, E, REST>,
    pub(crate) F,
);

impl<E, F, const REST: usize, const N: usize> Kernel<E> for Shaped<'_, E, F, REST, N>
where
    E: Scalar,
    F: Output<REST, N>,
{
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Tangents { points, blocks, rest, count, has_pole, line, mut to } = self.0;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let Svd { U, V, .. } = points.get::<R>(at);
            let mut blocks = from_rows(blocks.get_all(at));
            let rest = rest.get_all(at);
            let prepared = F::prepare(&mut blocks, &rest, has_pole);
            status.bounded |= R::bits(prepared.bounded) << at;
            status.nonfinite |= R::bits(prepared.nonfinite) << at;
            F::put_all(&Tangent { U, V, blocks }, &rest, to.place::<R, N>(line, at));
            to.finish::<R, N>(line, at, count);
        });
        status & first_bits(count)
    }
}

/// Output for the stresses and tangents of a tile by invariants, or for its gradients and stiffnesses.
pub(crate) struct TangentsByInvariants<'a, E, const REST: usize> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) invariants: &'a Rows<E, 3>,
    pub(crate) derivatives: &'a Rows<E, 9>,
    pub(crate) has_second_invariant: bool,
    pub(crate) curvature: Curvature,
    pub(crate) rest: Source<'a, E, REST>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) short_line: &'a mut LineBuffer<E>,
    /// P, or the gradient if there is a shape at rest.
    pub(crate) first: Sink<'a, E>,
    pub(crate) second: Sink<'a, E>,
}

/// [`TangentsByInvariants`] with an output of a form.
struct ShapedByInvariants<
    'a,
    E,
    M,
    const HAS_SECOND: bool,
    const HAS_ALL: bool,
    const REST: usize,
    const N: usize,
>(TangentsByInvariants<'a, E, REST>, M);

impl<E, M, const HAS_SECOND: bool, const HAS_ALL: bool, const REST: usize, const N: usize> Kernel<E>
    for ShapedByInvariants<'_, E, M, HAS_SECOND, HAS_ALL, REST, N>
where
    E: Scalar,
    M: OutputByInvariants<REST, N>,
    At<REST>: FirstOutput<REST>,
{
    /// The points that keep their digits and stay in range.
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let TangentsByInvariants {
            F,
            invariants,
            derivatives,
            rest,
            count,
            line,
            short_line,
            mut first,
            mut second,
            ..
        } = self.0;
        let mut served = 0;
        for_each_group!(R, count, |at| {
            let (F, invariants) = (to_matrix(F.get_all::<R>(at)), invariants.get_all(at));
            let terms = Terms::<R, HAS_SECOND, HAS_ALL>::new(&F, invariants, &derivatives.get_all(at));
            let rest = rest.get_all(at);
            // The larger output first: what P needs of the registers stays in few.
            let largest = M::put_all_by_invariants(&terms, &rest, second.place::<R, N>(line, at));
            let stress = terms.stress();
            let keeps_digits = terms.keeps_digits(largest) & M::stays_finite(terms.bound(), &rest);
            At::<REST>::put(&stress, &rest, &mut first, short_line, at);
            let stays_finite = At::<REST>::stays_finite(&stress, &rest);
            served |= R::bits(keeps_digits & stays_finite) << at;
            // Where no register holds anything any more: the transposes need them all.
            second.finish::<R, N>(line, at, count);
            At::<REST>::finish::<R>(&mut first, short_line, at, count);
        });
        served & first_bits(count)
    }
}

/// Runs a kernel for a form, with or without terms in I2.
///
/// Each of the four kernels pays: with those of all terms instead, tangents of Saint Venant–Kirchhoff take
/// 14 % more instructions, and those of energies in I1 and J 27 %.
pub(crate) fn shape_by_invariants<E, F, const REST: usize, const N: usize>(
    backend: Backend,
    kernel: TangentsByInvariants<'_, E, REST>,
    form: F,
) -> u64
where
    E: Scalar,
    F: OutputByInvariants<REST, N>,
    At<REST>: FirstOutput<REST>,
{
    let has_second = kernel.has_second_invariant;
    match (has_second, kernel.curvature.has_all(has_second)) {
        (true, true) => backend.run(ShapedByInvariants::<_, _, true, true, REST, N>(kernel, form)),
        (true, false) => backend.run(ShapedByInvariants::<_, _, true, false, REST, N>(kernel, form)),
        (false, true) => backend.run(ShapedByInvariants::<_, _, false, true, REST, N>(kernel, form)),
        (false, false) => backend.run(ShapedByInvariants::<_, _, false, false, REST, N>(kernel, form)),
    }
}
