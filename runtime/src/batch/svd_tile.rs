//! Frames and stretches of a tile's deformation gradients, between decomposition and response.

#![expect(non_snake_case, reason = "U, V as in the literature")]

use super::rows::Rows;
use crate::lanes::{Lanes, Scalar};
use crate::point::Svd;
use crate::point::matrix::{to_matrix, to_row_major};

/// Frames and stretches of a tile's deformation gradients.
#[derive(Clone, Copy, Debug)]
pub(super) struct SvdTile<E> {
    pub(super) U: Rows<E, 9>,
    pub(super) stretches: Rows<E, 3>,
    pub(super) V: Rows<E, 9>,
}

impl<E: Scalar> SvdTile<E> {
    pub(super) fn new() -> Self {
        Self { U: Rows::zero(), stretches: Rows::zero(), V: Rows::zero() }
    }

    #[inline(always)]
    pub(super) fn get<R: Lanes<Scalar = E>>(&self, at: usize) -> Svd<R> {
        Svd {
            U: to_matrix(self.U.get_all(at)),
            stretches: self.stretches.get_all(at),
            V: to_matrix(self.V.get_all(at)),
        }
    }

    #[inline(always)]
    pub(super) fn set<R: Lanes<Scalar = E>>(&mut self, at: usize, svd: &Svd<R>) {
        self.U.set_all(at, to_row_major(svd.U));
        self.stretches.set_all(at, svd.stretches);
        self.V.set_all(at, to_row_major(svd.V));
    }
}
