//! Kernels of stresses, and of the gradients of elements.

#![expect(non_snake_case, reason = "F, P as in the literature")]

use super::form::{Elements, Outputs, Points, Site};
use super::rows::{Row, Rows, first_bits, for_each_group};
use super::sink::{LineBuffer, Sink, Source};
use super::svd_tile::SvdTile;
use crate::lanes::{Backend, Kernel, Lanes, Scalar};
use crate::point::invariants::{Needed, gradient_is_in_range, stress_of_gradient, with_needed};
use crate::point::matrix::{three, to_matrix};
use crate::point::{stress, stress_is_finite};
use crate::status::Status;

/// Frames and ψi, from which P, Pa, or the gradients of elements, N, are made.
pub(crate) struct Stress<'a, E> {
    pub(crate) points: &'a SvdTile<E>,
    /// ψi in the first three rows.
    pub(crate) gradients: &'a [Row<E>],
    pub(crate) outputs: Outputs<'a, E>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

/// Runs the kernel for the outputs.
pub(crate) fn run<E: Scalar>(backend: Backend, stress: Stress<'_, E>) -> Status<u64> {
    match stress.outputs {
        Outputs::Points => backend.run(StressAt::<_, Points>(stress, ())),
        Outputs::Elements(shapes) | Outputs::ElementsByBlocks(shapes) => {
            backend.run(StressAt::<_, Elements>(stress, shapes))
        }
    }
}

/// Kernel of [`Stress`], with the shapes at rest.
struct StressAt<'a, E: Scalar, S: Site>(Stress<'a, E>, S::Shapes<'a, E>);

impl<E: Scalar, S: Site> Kernel<E> for StressAt<'_, E, S> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self(Stress { points, gradients, count, line, mut to, .. }, shapes) = self;
        let (served, mut status) = (to.served, Status::default());
        for_each_group!(R, count, but served, |at| {
            let svd = points.get::<R>(at);
            let stress = stress(&svd, three!(k => R::load(&gradients[k][at..])));
            let rest = S::rest(&shapes, at);
            let is_finite = stress_is_finite(svd.stretches, &stress) & S::stays_finite(&stress, &rest);
            status.nonfinite |= R::bits(!is_finite) << at;
            S::put(&stress, &rest, &mut to, line, at);
            S::finish::<R>(&mut to, line, at, count);
        });
        status & first_bits(count)
    }
}

/// F and W1, W2, WJ, from which P, or the gradients of elements, are made without a decomposition.
pub(crate) struct StressByInvariants<'a, E> {
    pub(crate) F: Source<'a, E, 9>,
    pub(crate) gradients: &'a Rows<E, 3>,
    pub(crate) needed: Needed,
    pub(crate) outputs: Outputs<'a, E>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

/// Runs the kernel for the outputs. Returns the points whose result is finite.
pub(crate) fn run_by_invariants<E: Scalar>(backend: Backend, stress: StressByInvariants<'_, E>) -> u64 {
    match stress.outputs {
        Outputs::Points => backend.run(ByInvariantsAt::<_, Points>(stress, ())),
        Outputs::Elements(shapes) | Outputs::ElementsByBlocks(shapes) => {
            backend.run(ByInvariantsAt::<_, Elements>(stress, shapes))
        }
    }
}

/// Kernel of [`StressByInvariants`], with the shapes at rest.
struct ByInvariantsAt<'a, E: Scalar, S: Site>(StressByInvariants<'a, E>, S::Shapes<'a, E>);

impl<E: Scalar, S: Site> Kernel<E> for ByInvariantsAt<'_, E, S> {
    type Output = u64;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> u64 {
        let Self(StressByInvariants { F, gradients, needed, count, line, mut to, .. }, shapes) = self;
        let mut finite = 0;
        with_needed!(needed, needed => {
            for_each_group!(R, count, |at| {
                let gradient = gradients.get_all(at);
                let stress = stress_of_gradient(&to_matrix(F.get_all::<R>(at)), gradient, needed);
                let rest = S::rest(&shapes, at);
                let is_finite = gradient_is_in_range(gradient) & S::stays_finite(&stress, &rest);
                finite |= R::bits(is_finite) << at;
                S::put(&stress, &rest, &mut to, line, at);
                S::finish::<R>(&mut to, line, at, count);
            });
        });
        finite & first_bits(count)
    }
}
