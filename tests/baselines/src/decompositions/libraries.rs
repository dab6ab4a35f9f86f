//! The decompositions of general libraries, with signs mended afterwards.

#![expect(non_snake_case, reason = "F, U, V as in the literature")]

use std::mem::MaybeUninit;

use ::faer::diag::DiagMut;
use ::faer::dyn_stack::MemStack;
use ::faer::linalg::svd as bidiagonal;
use ::faer::traits::RealField as FaerField;
use ::faer::{MatMut, MatRef, Par, Spec};
use ::nalgebra::{RealField, SVD};
use piola::Real;
use piola::convert::{from_nalgebra, to_nalgebra};
use piola::point::{Matrix3, Svd};

use super::descending;
use crate::matrix::{cofactor, dot, transpose};

/// Decomposition by nalgebra, which takes V from the eigenvectors of FᵀF (tridiagonal QR iteration) and U
/// from a QR decomposition of F V.
///
/// `None` where the iteration does not converge or F is not finite.
#[must_use]
pub fn nalgebra<T: Real<Mask = bool> + RealField + Copy>(F: &Matrix3<T>) -> Option<Svd<T>> {
    const LONGEST_ITERATION: usize = 1000;
    if !is_finite(F) {
        return None;
    }
    // The tolerance of `SVD::new`, which would iterate for ever.
    let tolerance = T::default_epsilon() * <T as Real>::splat(5.0);
    let found = SVD::try_new(to_nalgebra(F), true, true, tolerance, LONGEST_ITERATION)?;
    let (U, Vt) = (found.u?, found.v_t?);
    // Sorted by the lengths of the columns of F V, which a QR decomposition changes by rounding.
    let stretches = descending(found.singular_values.into());
    Some(with_rotations(from_nalgebra(&U), stretches, transpose(&from_nalgebra(&Vt))))
}

/// Decomposition by faer: bidiagonalisation and implicit QR iteration, in scratch memory on the stack.
///
/// `None` where the iteration does not converge or F is not finite.
#[must_use]
pub fn faer<T: Real<Mask = bool> + FaerField>(F: &Matrix3<T>) -> Option<Svd<T>> {
    // What `svd_scratch` asks for at this size is a few KiB.
    const SCRATCH: usize = 16 << 10;
    if !is_finite(F) {
        return None;
    }
    let mut scratch = [MaybeUninit::uninit(); SCRATCH];
    // Columns of U and V lie side by side, as faer prefers: their transposes in rows.
    let (mut Ut, mut Vt, mut stretches) = (*F, *F, F[0]);
    bidiagonal::svd(
        MatRef::from_row_major_slice(F.as_flattened(), 3, 3),
        DiagMut::from_slice_mut(&mut stretches),
        Some(MatMut::from_column_major_slice_mut(Ut.as_flattened_mut(), 3, 3)),
        Some(MatMut::from_column_major_slice_mut(Vt.as_flattened_mut(), 3, 3)),
        Par::Seq,
        MemStack::new(&mut scratch),
        Spec::default(),
    )
    .ok()?;
    Some(with_rotations(transpose(&Ut), stretches, transpose(&Vt)))
}

fn is_finite<R: Real<Mask = bool>>(F: &Matrix3<R>) -> bool {
    F.as_flattened().iter().all(|entry| Real::is_finite(*entry))
}

/// Turns reflections into rotations at the price of the sign of λ3.
#[inline(always)]
fn with_rotations<R: Real<Mask = bool>>(mut U: Matrix3<R>, stretches: [R; 3], mut V: Matrix3<R>) -> Svd<R> {
    let [l1, l2, mut l3] = stretches;
    for frame in [&mut U, &mut V] {
        if dot(frame[0], cofactor(frame)[0]).less(R::splat(0.0)) {
            l3 = -l3;
            for row in frame {
                row[2] = -row[2];
            }
        }
    }
    Svd { U, stretches: [l1, l2, l3], V }
}
