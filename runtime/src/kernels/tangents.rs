//! Kernels of tangents, and of the stiffnesses of elements.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::marker::PhantomData;

use super::form::{BlockStiffness, Elements, FullStiffness, FullTangent, Output, Outputs, Points, Site};
use super::rows::{Rows, first_bits, for_each_group, from_rows, to_rows};
use super::sink::{LineBuffer, Sink, Source};
use super::svd_tile::SvdTile;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::material::Curvature;
use crate::point::invariants::tangent::{TermSet, Terms, with_term_set};
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

/// Frames and judged blocks of a tile, from which its tangents or stiffnesses are made.
pub(crate) struct Tangents<'a, E> {
    pub(crate) points: &'a SvdTile<E>,
    pub(crate) blocks: &'a Rows<E, 15>,
    pub(crate) outputs: Outputs<'a, E>,
    pub(crate) count: usize,
    pub(crate) has_pole: bool,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

/// Runs the kernel for the outputs.
pub(crate) fn run<E: Scalar>(backend: Backend, tangents: Tangents<'_, E>) -> Status<u64> {
    match tangents.outputs {
        Outputs::Points => backend.run(Shaped::<_, Points, _, 81>(tangents, (), FullTangent)),
        Outputs::Elements(shapes) => {
            backend.run(Shaped::<_, Elements, _, 144>(tangents, shapes, FullStiffness))
        }
        Outputs::ElementsByBlocks(shapes) => {
            backend.run(Shaped::<_, Elements, _, 90>(tangents, shapes, BlockStiffness))
        }
    }
}

/// Kernel of [`Tangents`], with the shapes at rest and a form of the output.
struct Shaped<'a, E: Scalar, S: Site, F, const N: usize>(Tangents<'a, E>, S::Shapes<'a, E>, F);

impl<E, S, F, const N: usize> Kernel<E> for Shaped<'_, E, S, F, N>
where
    E: Scalar,
    S: Site,
    F: Output<S, N>,
{
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self(Tangents { points, blocks, count, has_pole, line, mut to, .. }, shapes, _) = self;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let Svd { U, V, .. } = points.get::<R>(at);
            let mut blocks = from_rows(blocks.get_all(at));
            let rest = S::rest(&shapes, at);
            let prepared = F::prepare(&mut blocks, &rest, has_pole);
            status.bounded |= R::bits(prepared.bounded) << at;
            status.nonfinite |= R::bits(prepared.nonfinite) << at;
            F::put_all(&Tangent { U, V, blocks }, &rest, to.place::<R, N>(line, at));
            to.finish::<R, N>(line, at, count);
        });
        status & first_bits(count)
    }
}

/// F, invariants and derivatives of a tile, from which its stresses and tangents, or gradients and
/// stiffnesses, are made without a decomposition.
pub(crate) struct TangentsByInvariants<'a, E> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) invariants: &'a Rows<E, 3>,
    pub(crate) derivatives: &'a Rows<E, 9>,
    pub(crate) has_second_invariant: bool,
    pub(crate) curvature: Curvature,
    pub(crate) outputs: Outputs<'a, E>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) short_line: &'a mut LineBuffer<E>,
    /// P, or the gradient if there is a shape at rest.
    pub(crate) first: Sink<'a, E>,
    pub(crate) second: Sink<'a, E>,
}

/// Runs the kernel for the outputs. Returns the points that keep their digits and stay in range.
pub(crate) fn run_by_invariants<E: Scalar>(backend: Backend, tangents: TangentsByInvariants<'_, E>) -> u64 {
    match tangents.outputs {
        Outputs::Points => with_terms::<_, Points, _, 81>(backend, tangents, (), FullTangent),
        Outputs::Elements(shapes) => {
            with_terms::<_, Elements, _, 144>(backend, tangents, shapes, FullStiffness)
        }
        Outputs::ElementsByBlocks(shapes) => {
            with_terms::<_, Elements, _, 90>(backend, tangents, shapes, BlockStiffness)
        }
    }
}

/// Runs the kernel for the terms that do not vanish.
///
/// Each of the sets pays: with all terms instead, tangents of Saint Venant–Kirchhoff take 14 % more
/// instructions, and those of energies in I1 and J 27 %.
fn with_terms<'a, E, S, M, const N: usize>(
    backend: Backend,
    tangents: TangentsByInvariants<'a, E>,
    shapes: S::Shapes<'a, E>,
    output: M,
) -> u64
where
    E: Scalar,
    S: Site,
    M: Output<S, N>,
{
    let terms = tangents.curvature.terms(tangents.has_second_invariant);
    with_term_set!(terms, Set => {
        backend.run(ByInvariants::<_, S, _, Set, N>(tangents, shapes, output, PhantomData))
    })
}

/// Kernel of [`TangentsByInvariants`], with the shapes at rest and a form of the second output.
struct ByInvariants<'a, E: Scalar, S: Site, M, T, const N: usize>(
    TangentsByInvariants<'a, E>,
    S::Shapes<'a, E>,
    M,
    PhantomData<T>,
);

impl<E, S, M, T, const N: usize> Kernel<E> for ByInvariants<'_, E, S, M, T, N>
where
    E: Scalar,
    S: Site,
    M: Output<S, N>,
    T: TermSet,
{
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let Self(tangents, shapes, ..) = self;
        let TangentsByInvariants { F, invariants, derivatives, count, line, short_line, .. } = tangents;
        let (mut first, mut second) = (tangents.first, tangents.second);
        let mut served = 0;
        for_each_group!(R, count, |at| {
            let (F, invariants) = (to_matrix(F.get_all::<R>(at)), invariants.get_all(at));
            let terms = Terms::<R, T>::new(&F, invariants, &derivatives.get_all(at));
            let rest = S::rest(&shapes, at);
            // The larger output first: what P needs of the registers stays in few.
            let keeps_digits = M::put_all_by_invariants(&terms, &rest, second.place::<R, N>(line, at));
            let stress = terms.stress();
            S::put(&stress, &rest, &mut first, short_line, at);
            let stays_finite = S::stays_finite(&stress, &rest);
            served |= R::bits(keeps_digits & stays_finite) << at;
            // Where no register holds anything any more: the transposes need them all.
            second.finish::<R, N>(line, at, count);
            S::finish::<R>(&mut first, short_line, at, count);
        });
        served & first_bits(count)
    }
}
