//! Stages of a tile that take no decomposition: invariants, and stresses and tangents from them.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use super::form::{FormByInvariants, gradient_is_finite, put_all, put_gradient};
use super::sink::{Line, Sink, Source};
use super::tile::{Rows, first_bits, for_each_group};
use crate::lanes::{Backend, Kernel, Lanes, Mask, Scalar};
use crate::material::Curvature;
use crate::point::invariants::tangent::Terms;
use crate::point::invariants::{invariants, stress_by_invariants};
use crate::point::matrix::{to_matrix, to_row_major};
use crate::point::{Matrix3, entries_are_finite};

/// Kernel from the deformation gradients of a tile to I1, I2, J.
pub(super) struct Invariants<'a, E> {
    pub(super) F: Source<'a, E, 9>,
    pub(super) count: usize,
    pub(super) has_second_invariant: bool,
    pub(super) invariants: &'a mut Rows<E, 3>,
}

impl<E: Scalar> Kernel<E> for Invariants<'_, E> {
    /// The points in range.
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let Self { F, count, has_second_invariant, invariants: to } = self;
        let mut in_range = 0;
        if has_second_invariant {
            for_each_group!(R, count, |at| {
                let (numbers, is_in_range) = invariants(&to_matrix(F.get_all::<R>(at)), true);
                to.set_all(at, numbers);
                in_range |= R::bits(is_in_range) << at;
            });
        } else {
            for_each_group!(R, count, |at| {
                let (numbers, is_in_range) = invariants(&to_matrix(F.get_all::<R>(at)), false);
                to.set_all(at, numbers);
                in_range |= R::bits(is_in_range) << at;
            });
        }
        in_range & first_bits(count)
    }
}

/// Kernel from F and W1, W2, WJ to P, or to the gradients of elements, N, if there are shapes at rest.
pub(super) struct StressByInvariants<'a, E, const REST: usize> {
    pub(super) F: Source<'a, E, 9>,
    pub(super) gradients: &'a Rows<E, 3>,
    pub(super) has_second_invariant: bool,
    pub(super) rest: Source<'a, E, REST>,
    pub(super) count: usize,
    pub(super) line: &'a mut Line<E>,
    pub(super) to: Sink<'a, E>,
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
            let stress = stress_by_invariants::<R, HAS_SECOND>(&F, gradients.get_all(at));
            let stays_finite = put_stress(&stress, &rest.get_all(at), &mut to, line, at);
            finish_stress::<R, REST>(&mut to, line, at, count);
            finite |= R::bits(entries_are_finite(&stress) & stays_finite) << at;
        });
        finite & first_bits(count)
    }
}

/// Runs a kernel with or without terms in I2.
pub(super) fn stress_of<E: Scalar, const REST: usize>(
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
fn put_stress<R: Lanes, const REST: usize>(
    stress: &Matrix3<R>,
    rest: &[R; REST],
    to: &mut Sink<'_, R::Scalar>,
    line: &mut Line<R::Scalar>,
    at: usize,
) -> R::Mask {
    if REST == 0 {
        put_all(to_row_major(*stress), to.place::<R, 9>(line, at));
        return R::Mask::splat(true);
    }
    let mut shape = [R::splat(0.0); 10];
    shape[..REST].copy_from_slice(rest);
    put_gradient(stress, &shape, to.place::<R, 12>(line, at));
    gradient_is_finite(stress, &shape)
}

/// Brings what [`put_stress`] has put to the slice.
#[inline(always)]
fn finish_stress<R: Lanes, const REST: usize>(
    to: &mut Sink<'_, R::Scalar>,
    line: &Line<R::Scalar>,
    at: usize,
    count: usize,
) {
    if REST == 0 {
        to.finish::<R, 9>(line, at, count);
    } else {
        to.finish::<R, 12>(line, at, count);
    }
}

/// Output for the stresses and tangents of a tile by invariants, or for its gradients and stiffnesses.
pub(super) struct RespondByInvariants<'a, E, const REST: usize> {
    pub(super) F: Source<'a, E, 9>,
    pub(super) invariants: &'a Rows<E, 3>,
    pub(super) derivatives: &'a Rows<E, 9>,
    pub(super) has_second_invariant: bool,
    pub(super) curvature: Curvature,
    pub(super) rest: Source<'a, E, REST>,
    pub(super) count: usize,
    pub(super) line: &'a mut Line<E>,
    pub(super) short_line: &'a mut Line<E>,
    /// P, or the gradient if there is a shape at rest.
    pub(super) first: Sink<'a, E>,
    pub(super) second: Sink<'a, E>,
}

/// [`RespondByInvariants`] with an output of a form.
struct ShapedByInvariants<
    'a,
    E,
    Form,
    const HAS_SECOND: bool,
    const HAS_ALL: bool,
    const REST: usize,
    const N: usize,
>(RespondByInvariants<'a, E, REST>, Form);

impl<E, Form, const HAS_SECOND: bool, const HAS_ALL: bool, const REST: usize, const N: usize> Kernel<E>
    for ShapedByInvariants<'_, E, Form, HAS_SECOND, HAS_ALL, REST, N>
where
    E: Scalar,
    Form: FormByInvariants<REST, N>,
{
    /// The points that keep their digits and stay in range.
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let RespondByInvariants {
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
            let largest = Form::put_all_by_invariants(&terms, &rest, second.place::<R, N>(line, at));
            let stress = terms.stress();
            let keeps_digits = terms.keeps_digits(largest) & Form::stays_finite(terms.bound(), &rest);
            let stays_finite = put_stress(&stress, &rest, &mut first, short_line, at);
            served |= R::bits(keeps_digits & stays_finite) << at;
            // Where no register holds anything any more: the transposes need them all.
            second.finish::<R, N>(line, at, count);
            finish_stress::<R, REST>(&mut first, short_line, at, count);
        });
        served & first_bits(count)
    }
}

/// Runs a kernel for a form, with or without terms in I2.
pub(super) fn shape_by_invariants<E, F, const REST: usize, const N: usize>(
    backend: Backend,
    kernel: RespondByInvariants<'_, E, REST>,
    form: F,
) -> u64
where
    E: Scalar,
    F: FormByInvariants<REST, N>,
{
    let has_second = kernel.has_second_invariant;
    match (has_second, kernel.curvature.has_all(has_second)) {
        (true, true) => backend.run(ShapedByInvariants::<_, _, true, true, REST, N>(kernel, form)),
        (true, false) => backend.run(ShapedByInvariants::<_, _, true, false, REST, N>(kernel, form)),
        (false, true) => backend.run(ShapedByInvariants::<_, _, false, true, REST, N>(kernel, form)),
        (false, false) => backend.run(ShapedByInvariants::<_, _, false, false, REST, N>(kernel, form)),
    }
}
