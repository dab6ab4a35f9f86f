//! Frames and stretches of a tile's deformation gradients, between decomposition and response.

#![expect(non_snake_case, reason = "U, V as in the literature")]

use super::rows::Rows;
use crate::lanes::{Lanes, Scalar};
use crate::point::Svd;
use crate::point::matrix::{to_matrix, to_row_major};

/// Frames and stretches of a tile's deformation gradients.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SvdTile<E> {
    pub(crate) U: Rows<E, 9>,
    pub(crate) stretches: Rows<E, 3>,
    pub(crate) V: Rows<E, 9>,
}

impl<E: Scalar> SvdTile<E> {
    pub(crate) fn new() -> Self {
        Self { U: Rows::zero(), stretches: Rows::zero(), V: Rows::zero() }
    }

    #[inline(always)]
    pub(crate) fn get<R: Lanes<Scalar = E>>(&self, at: usize) -> Svd<R> {
        Svd {
            U: to_matrix(self.U.get_all(at)),
            stretches: self.stretches.get_all(at),
            V: to_matrix(self.V.get_all(at)),
        }
    }

    #[inline(always)]
    pub(crate) fn set<R: Lanes<Scalar = E>>(&mut self, at: usize, svd: &Svd<R>) {
        self.U.set_all(at, to_row_major(svd.U));
        self.stretches.set_all(at, svd.stretches);
        self.V.set_all(at, to_row_major(svd.V));
    }
}
