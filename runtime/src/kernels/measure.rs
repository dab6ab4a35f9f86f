//! The stages of a batch that make other measures of stress, compiled once for each format and back end.

use super::form::Components;
use super::rows::{Row, Rows, first_bits, for_each_group, from_rows};
use super::sink::{LineBuffer, Sink};
use super::svd_tile::SvdTile;
use crate::lanes::{Kernel, Lanes, Scalar};
use crate::point::matrix::three;
use crate::point::measures::Measure;
use crate::point::stretches_in_range;
use crate::status::Status;

/// Kernel from frames and ψi to a stress, Pa.
pub(crate) struct MeasuredStress<'a, E> {
    pub(crate) measure: Measure,
    pub(crate) points: &'a SvdTile<E>,
    /// ψi in the first three rows.
    pub(crate) gradients: &'a [Row<E>],
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

impl<E: Scalar> Kernel<E> for MeasuredStress<'_, E> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { measure, points, gradients, count, line, mut to } = self;
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
            let svd = points.get::<R>(at);
            let stress = measure.stress(&svd, three!(k => R::load(&gradients[k][at..])));
            let mut sum = R::splat(0.0);
            let place = to.place::<R, 6>(line, at);
            for k in 0..6 {
                sum = stress[k].mul_add(R::splat(0.0), sum);
                place.put(k, stress[k]);
            }
            to.finish::<R, 6>(line, at, count);
            let is_finite = stretches_in_range(svd.stretches) & sum.is_finite();
            status.nonfinite |= R::bits(!is_finite) << at;
        });
        status & first_bits(count)
    }
}

/// Kernel from frames and blocks to a tangent, Pa.
pub(crate) struct MeasuredTangent<'a, E> {
    pub(crate) measure: Measure,
    pub(crate) points: &'a SvdTile<E>,
    pub(crate) blocks: &'a Rows<E, 15>,
    pub(crate) count: usize,
    pub(crate) line: &'a mut LineBuffer<E>,
    pub(crate) to: Sink<'a, E>,
}

impl<E: Scalar> Kernel<E> for MeasuredTangent<'_, E> {
    type Output = Status<u64>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Status<u64> {
        let Self { measure, points, blocks, count, line, mut to } = self;
        let mut status = Status::default();
        for_each_group!(R, count, |at| {
            let tangent = measure.tangent(&points.get::<R>(at), &from_rows(blocks.get_all(at)));
            let mut sum = R::splat(0.0);
            let place = to.place::<R, 36>(line, at);
            for row in 0..6 {
                for column in 0..6 {
                    sum = tangent[row][column].mul_add(R::splat(0.0), sum);
                    place.put(6 * row + column, tangent[row][column]);
                }
            }
            to.finish::<R, 36>(line, at, count);
            status.nonfinite |= R::bits(!sum.is_finite()) << at;
        });
        status & first_bits(count)
    }
}
