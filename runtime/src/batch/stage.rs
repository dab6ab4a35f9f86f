//! The stages of a batch that know no material, compiled once for each format and back end.
//!
//! Between them and the material's stage a tile's numbers lie in [`Rows`]: frames and stretches, then the
//! fifteen numbers of the energy. Each stage keeps few enough numbers alive for the registers.

#![expect(non_snake_case, reason = "F, U, V, P as in the literature")]

use std::cell::Cell;

#[cfg(feature = "bodies")]
use super::form::BlockStiffness;
use super::form::{
    FullStiffness, FullTangent, MatrixForm, Output, OutputByInvariants, PackedStiffness, PackedTangent,
    gradient_is_finite, put_all, put_gradient,
};
use super::material::{from_rows, to_rows};
use super::measure::{MeasuredStress, MeasuredTangent};
use super::rows::{Row, Rows, first_bits, for_each_group};
use super::sink::{Line, Lines, Sink, Source};
use super::svd_tile::SvdTile;
use super::workspace::Workspace;
use crate::lanes::{Backend, Kernel, Lanes, Mask, Scalar};
use crate::material::Curvature;
use crate::point::invariants::tangent::Terms;
use crate::point::invariants::{invariants, stress_by_invariants};
use crate::point::matrix::{three, to_matrix, to_row_major};
use crate::point::svd::{along_axes, may_have_axis, unaligned, unaligned_signed_by_determinant};
use crate::point::{
    Filter, Matrix3, Svd, Tangent, entries_are_finite, judge, multiply, stress, stress_is_finite,
};
use crate::status::Status;

/// Lanes of points that are decomposed in turns; the bits of a point do not depend on the others.
#[cfg(not(unoptimised))]
type InTurns<R> = <R as Lanes>::Interleaved;
/// Without optimisation every intermediate result has its own place on the stack, and a thread has 2 MiB.
#[cfg(unoptimised)]
type InTurns<R> = R;

/// Decomposes the points of a tile on these lanes, but for exact axes.
macro_rules! decompose {
    ($R:ty, $F:ident, $count:ident, $is_signed:ident, $points:ident) => {
        if $is_signed {
            for_each_group!($R, $count, |at| {
                $points.set(at, &unaligned_signed_by_determinant(&to_matrix($F.get_all::<$R>(at))));
            });
        } else {
            for_each_group!($R, $count, |at| {
                $points.set(at, &unaligned(&to_matrix($F.get_all::<$R>(at))));
            });
        }
    };
}

/// Kernel from the deformation gradients of a tile to frames and stretches.
pub(super) struct Decompose<'a, E> {
    pub(super) F: Source<'a, E, 9>,
    pub(super) count: usize,
    /// Whether the sign of det F decides over the domain.
    pub(super) is_signed: bool,
    pub(super) points: &'a mut SvdTile<E>,
}

impl<E: Scalar> Kernel<E> for Decompose<'_, E> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Self { F, count, is_signed, points } = self;
        if count <= R::LANES {
            decompose!(R, F, count, is_signed, points);
        } else {
            decompose!(InTurns<R>, F, count, is_signed, points);
        }
        // Apart from the loops above, which need all registers.
        for_each_group!(R, count, |at| {
            let F = to_matrix(F.get_all::<R>(at));
            if may_have_axis(&F).any() {
                points.set(at, &along_axes(&F, points.get(at)));
            }
        });
    }
}

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
fn stress_of<E: Scalar, const REST: usize>(backend: Backend, kernel: StressByInvariants<'_, E, REST>) -> u64 {
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

/// Kernel from the edges of a tile's tetrahedra to their deformation gradients, in place: F = Ds Dm⁻¹.
pub(super) struct Deform<'a, E> {
    /// Ds: row a, column k is coordinate a of node k + 1 less that of node 0.
    pub(super) edges: &'a mut Lines<E, 9>,
    pub(super) rest: Source<'a, E, 10>,
    pub(super) count: usize,
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

/// Kernel from frames and ψi to P, Pa, or to the gradients of elements, N, if there are shapes at rest.
pub(super) struct Stress<'a, E, const REST: usize> {
    pub(super) points: &'a SvdTile<E>,
    /// ψi in the first three rows.
    pub(super) gradients: &'a [Row<E>],
    pub(super) rest: Source<'a, E, REST>,
    pub(super) count: usize,
    pub(super) line: &'a mut Line<E>,
    pub(super) to: Sink<'a, E>,
}

impl<E: Scalar> Kernel<E> for Stress<'_, E, 10> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { points, gradients, rest, count, line, mut to } = self;
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
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
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
            let svd = points.get::<R>(at);
            let stress = stress(&svd, three!(k => R::load(&gradients[k][at..])));
            status.nonfinite |= R::bits(!stress_is_finite(svd.stretches, &stress)) << at;
            put_all(to_row_major(stress), to.place::<R, 9>(line, at));
            to.finish::<R, 9>(line, at, count);
        });
        status & first_bits(count)
    }
}

/// Kernel that filters the blocks of a tile in place, and returns the status of its points.
pub(super) struct Judge<'a, E> {
    pub(super) points: &'a SvdTile<E>,
    pub(super) blocks: &'a mut Rows<E, 15>,
    pub(super) count: usize,
    pub(super) filter: Filter,
    pub(super) has_pole: bool,
}

impl<E: Scalar> Kernel<E> for Judge<'_, E> {
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
pub(super) struct Respond<'a, E, const REST: usize> {
    pub(super) points: &'a SvdTile<E>,
    pub(super) blocks: &'a Rows<E, 15>,
    pub(super) rest: Source<'a, E, REST>,
    pub(super) count: usize,
    pub(super) has_pole: bool,
    pub(super) line: &'a mut Line<E>,
    pub(super) to: Sink<'a, E>,
}

/// [`Respond`] with an output of a form.
struct Shaped<'a, E, F, const REST: usize, const N: usize>(Respond<'a, E, REST>, F);

impl<E, F, const REST: usize, const N: usize> Kernel<E> for Shaped<'_, E, F, REST, N>
where
    E: Scalar,
    F: Output<REST, N>,
{
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Respond { points, blocks, rest, count, has_pole, line, mut to } = self.0;
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
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
    M,
    const HAS_SECOND: bool,
    const HAS_ALL: bool,
    const REST: usize,
    const N: usize,
>(RespondByInvariants<'a, E, REST>, M);

impl<E, M, const HAS_SECOND: bool, const HAS_ALL: bool, const REST: usize, const N: usize> Kernel<E>
    for ShapedByInvariants<'_, E, M, HAS_SECOND, HAS_ALL, REST, N>
where
    E: Scalar,
    M: OutputByInvariants<REST, N>,
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
            let largest = M::put_all_by_invariants(&terms, &rest, second.place::<R, N>(line, at));
            let stress = terms.stress();
            let keeps_digits = terms.keeps_digits(largest) & M::stays_finite(terms.bound(), &rest);
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
///
/// Each of the four kernels pays: with those of all terms instead, tangents of Saint Venant–Kirchhoff take
/// 14 % more instructions, and those of energies in I1 and J 27 %.
fn shape_by_invariants<E, F, const REST: usize, const N: usize>(
    backend: Backend,
    kernel: RespondByInvariants<'_, E, REST>,
    form: F,
) -> u64
where
    E: Scalar,
    F: OutputByInvariants<REST, N>,
{
    let has_second = kernel.has_second_invariant;
    match (has_second, kernel.curvature.has_all(has_second)) {
        (true, true) => backend.run(ShapedByInvariants::<_, _, true, true, REST, N>(kernel, form)),
        (true, false) => backend.run(ShapedByInvariants::<_, _, true, false, REST, N>(kernel, form)),
        (false, true) => backend.run(ShapedByInvariants::<_, _, false, true, REST, N>(kernel, form)),
        (false, false) => backend.run(ShapedByInvariants::<_, _, false, false, REST, N>(kernel, form)),
    }
}

/// The second output of an element's response.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StiffnessForm {
    Matrix(MatrixForm),
    #[cfg(feature = "bodies")]
    Blocks,
}

/// Last stages of a tile: P and dP/dF of points without shapes at rest, gradients and stiffnesses of elements
/// with REST components of a shape at rest each.
#[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
pub trait Outputs<const REST: usize>: Scalar {
    /// Form of the second output.
    #[doc(hidden)]
    type Form: Copy;
    #[doc(hidden)]
    fn stress(backend: Backend, kernel: Stress<'_, Self, REST>) -> Status<u64>;
    /// The points served.
    #[doc(hidden)]
    fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, REST>) -> u64;
    #[doc(hidden)]
    fn respond(backend: Backend, form: Self::Form, kernel: Respond<'_, Self, REST>) -> Status<u64>;
    /// The points served.
    #[doc(hidden)]
    fn respond_by_invariants(
        backend: Backend,
        form: Self::Form,
        kernel: RespondByInvariants<'_, Self, REST>,
    ) -> u64;
}

/// The kernels above for one format: no function is generic, so that each is compiled once, here. With the
/// feature `f32` there are those of `f32`, too.
#[diagnostic::on_unimplemented(
    message = "there are no batches of `{Self}`",
    note = "those of `f32` come with the feature `f32` of the crate `piola`; those of `f64` with `batch`"
)]
#[expect(private_interfaces, reason = "sealed: only this crate can name what the functions take")]
pub trait Stages: Outputs<0, Form = MatrixForm> + Outputs<10, Form = StiffnessForm> {
    #[doc(hidden)]
    fn decompose(backend: Backend, kernel: Decompose<'_, Self>);
    #[doc(hidden)]
    fn deform(backend: Backend, kernel: Deform<'_, Self>);
    #[doc(hidden)]
    fn invariants(backend: Backend, kernel: Invariants<'_, Self>) -> u64;
    #[doc(hidden)]
    fn judge(backend: Backend, kernel: Judge<'_, Self>) -> Status<u64>;
    #[doc(hidden)]
    fn measured_stress(backend: Backend, kernel: MeasuredStress<'_, Self>) -> Status<u64>;
    #[doc(hidden)]
    fn measured_tangent(backend: Backend, kernel: MeasuredTangent<'_, Self>) -> Status<u64>;
    /// Lends this thread's workspace; allocates one where it is lent already, or none was before.
    #[doc(hidden)]
    fn with_workspace<T>(body: impl FnOnce(&mut Workspace<Self>) -> T) -> T;
}

macro_rules! stages {
    ($($Number:ident)*) => {$(
        #[expect(private_interfaces, reason = "as in the trait")]
        impl Outputs<0> for $Number {
            type Form = MatrixForm;

            fn stress(backend: Backend, kernel: Stress<'_, Self, 0>) -> Status<u64> {
                backend.run(kernel)
            }

            fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, 0>) -> u64 {
                stress_of(backend, kernel)
            }

            fn respond(backend: Backend, form: MatrixForm, kernel: Respond<'_, Self, 0>) -> Status<u64> {
                match form {
                    MatrixForm::Full => backend.run(Shaped(kernel, FullTangent)),
                    MatrixForm::Packed => backend.run(Shaped(kernel, PackedTangent)),
                }
            }

            fn respond_by_invariants(
                backend: Backend,
                form: MatrixForm,
                kernel: RespondByInvariants<'_, Self, 0>,
            ) -> u64 {
                match form {
                    MatrixForm::Full => shape_by_invariants(backend, kernel, FullTangent),
                    MatrixForm::Packed => shape_by_invariants(backend, kernel, PackedTangent),
                }
            }
        }

        #[expect(private_interfaces, reason = "as in the trait")]
        impl Outputs<10> for $Number {
            type Form = StiffnessForm;

            fn stress(backend: Backend, kernel: Stress<'_, Self, 10>) -> Status<u64> {
                backend.run(kernel)
            }

            fn stress_by_invariants(backend: Backend, kernel: StressByInvariants<'_, Self, 10>) -> u64 {
                stress_of(backend, kernel)
            }

            fn respond(backend: Backend, form: StiffnessForm, kernel: Respond<'_, Self, 10>) -> Status<u64> {
                match form {
                    StiffnessForm::Matrix(MatrixForm::Full) => backend.run(Shaped(kernel, FullStiffness)),
                    StiffnessForm::Matrix(MatrixForm::Packed) => backend.run(Shaped(kernel, PackedStiffness)),
                    #[cfg(feature = "bodies")]
                    StiffnessForm::Blocks => backend.run(Shaped(kernel, BlockStiffness)),
                }
            }

            fn respond_by_invariants(
                backend: Backend,
                form: StiffnessForm,
                kernel: RespondByInvariants<'_, Self, 10>,
            ) -> u64 {
                match form {
                    StiffnessForm::Matrix(MatrixForm::Full) => {
                        shape_by_invariants(backend, kernel, FullStiffness)
                    }
                    StiffnessForm::Matrix(MatrixForm::Packed) => {
                        shape_by_invariants(backend, kernel, PackedStiffness)
                    }
                    #[cfg(feature = "bodies")]
                    StiffnessForm::Blocks => shape_by_invariants(backend, kernel, BlockStiffness),
                }
            }
        }

        #[expect(private_interfaces, reason = "as in the trait")]
        impl Stages for $Number {
            fn decompose(backend: Backend, kernel: Decompose<'_, Self>) {
                backend.run(kernel);
            }

            fn deform(backend: Backend, kernel: Deform<'_, Self>) {
                backend.run(kernel);
            }

            fn invariants(backend: Backend, kernel: Invariants<'_, Self>) -> u64 {
                backend.run(kernel)
            }

            fn judge(backend: Backend, kernel: Judge<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

            fn measured_stress(backend: Backend, kernel: MeasuredStress<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

            fn measured_tangent(backend: Backend, kernel: MeasuredTangent<'_, Self>) -> Status<u64> {
                backend.run(kernel)
            }

            fn with_workspace<T>(body: impl FnOnce(&mut Workspace<Self>) -> T) -> T {
                thread_local!(static SPARE: Cell<Option<Box<Workspace<$Number>>>> = const { Cell::new(None) });
                // At the end of a thread there is no keeping any more.
                let spare = SPARE.try_with(Cell::take).ok().flatten();
                let mut workspace = spare.unwrap_or_else(Workspace::new);
                let result = body(&mut workspace);
                let _ = SPARE.try_with(|spare| spare.set(Some(workspace)));
                result
            }
        }
    )*};
}
stages!(f64);
// Not compiled a second time for the unit tests, which need those of `f64` only.
#[cfg(all(feature = "f32", not(test)))]
stages!(f32);
