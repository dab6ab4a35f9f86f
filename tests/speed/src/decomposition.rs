//! The singular value decomposition alone, on lanes.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::hint::black_box;

use piola::lanes::{Backend, Kernel, Lanes, Scalar};
use piola::point::{Matrix3, Svd, svd, svd_signed_by_determinant};

use super::IN_CACHE;
use super::arrays::Aligned;
use super::task::deformation_gradients;

/// [`IN_CACHE`] deformation gradients and room for their frames and stretches.
#[derive(Debug)]
pub struct Decompositions<E> {
    F: Aligned<E>,
    svd: Aligned<E>,
}

/// Distance from a number of a point to the next one. More than points: rows as far apart as a power of two
/// would compete for the same places of the innermost cache.
const ROW: usize = IN_CACHE + 16;

/// The points of [`Arrays`](super::Arrays).
impl<E: Scalar> Default for Decompositions<E> {
    fn default() -> Self {
        let mut F = Aligned::new(9 * ROW);
        for (point, gradient) in deformation_gradients().take(IN_CACHE).enumerate() {
            for (k, &number) in gradient.as_flattened().iter().enumerate() {
                F[k * ROW + point] = E::splat(number);
            }
        }
        Self { F, svd: Aligned::new(21 * ROW) }
    }
}

impl<E: Scalar> Decompositions<E> {
    /// Decomposes all, with [`svd_signed_by_determinant`] or [`svd()`].
    pub fn run(&mut self, backend: Backend, is_signed: bool) {
        if is_signed {
            backend.run(Decompose::<E, true>(&self.F, &mut self.svd));
        } else {
            backend.run(Decompose::<E, false>(&self.F, &mut self.svd));
        }
        black_box(&self.svd);
    }
}

struct Decompose<'a, E, const IS_SIGNED: bool>(&'a [E], &'a mut [E]);

impl<E: Scalar, const IS_SIGNED: bool> Kernel<E> for Decompose<'_, E, IS_SIGNED> {
    type Output = ();

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) {
        let Self(from, to) = self;
        let mut at = 0;
        while at < IN_CACHE {
            decompose::<R::Interleaved, IS_SIGNED>(&from[at..], &mut to[at..]);
            at += R::Interleaved::LANES;
        }
    }
}

#[inline(always)]
fn decompose<R: Lanes, const IS_SIGNED: bool>(from: &[R::Scalar], to: &mut [R::Scalar]) {
    let mut F: Matrix3<R> = [[R::splat(0.0); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            F[i][j] = R::load(&from[(3 * i + j) * ROW..]);
        }
    }
    let Svd { U, stretches, V } = if IS_SIGNED { svd_signed_by_determinant(&F) } else { svd(&F) };
    for i in 0..3 {
        for j in 0..3 {
            U[i][j].store(&mut to[(3 * i + j) * ROW..]);
            V[i][j].store(&mut to[(9 + 3 * i + j) * ROW..]);
        }
        stretches[i].store(&mut to[(18 + i) * ROW..]);
    }
}
