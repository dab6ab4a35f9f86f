//! Stress and tangent at a point by their entries, for codes that take dP/dF as a 9×9 matrix.

#![expect(non_snake_case, reason = "F as in the literature")]

use super::invariants::invariants_for;
use super::invariants::tangent::{Entries, TermSet, Terms, with_term_set};
use super::{Filter, Matrix3, evaluate};
use crate::lanes::{Mask, Real, Truth, stage};
use crate::material::{Response, ResponseKind};
use crate::status::Status;

/// Stress and tangent at a point, both by their entries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DensePoint<R: Real> {
    /// First Piola stress P, Pa.
    pub stress: Matrix3<R>,
    /// dP/dF, filtered as requested, Pa: row 3i+j for entry (i, j) of P, column 3k+l for entry (k, l) of F.
    /// Exactly symmetric.
    pub tangent: [[R; 9]; 9],
    /// Status of the results: valid or not, and filtered or not.
    pub status: Status<R::Mask>,
}

/// Stress and filtered tangent at F by their entries, as [`evaluate`] and
/// [`to_matrix`](super::Tangent::to_matrix) give them. For an energy of I1, I2 and J alone, without a filter
/// and well inside its domain, no decomposition is computed.
///
/// That takes a fraction of the time (`cargo speed-report --only point`). The frames are then unknown: for
/// products or principal stretches call [`evaluate`]. The [front page](crate) of the crate begins with a
/// program.
#[inline(always)]
#[must_use]
pub fn evaluate_dense<R: Real>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix3<R>,
    filter: Filter,
) -> DensePoint<R> {
    // What a filter changes is seen in the principal frames alone.
    if filter != Filter::None || !material.has_invariants() {
        return by_decomposition(material, F, filter);
    }
    let terms = material.curvature_by_invariants().terms(material.has_second_invariant());
    let (served, mut dense) = with_term_set!(terms, Set => by_invariants::<R, Set>(material, F));
    if (!served).any() {
        let other = by_decomposition(material, F, filter);
        for row in 0..9 {
            let stress = other.stress[row / 3][row % 3];
            dense.stress[row / 3][row % 3] = R::select(served, dense.stress[row / 3][row % 3], stress);
            for column in 0..9 {
                let entry = other.tangent[row][column];
                dense.tangent[row][column] = R::select(served, dense.tangent[row][column], entry);
            }
        }
        dense.status = other.status & !served;
    }
    dense
}

#[inline(always)]
fn by_decomposition<R: Real>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix3<R>,
    filter: Filter,
) -> DensePoint<R> {
    let point = evaluate(material, F, filter);
    DensePoint { stress: point.stress, tangent: point.tangent.to_matrix(), status: point.status }
}

/// Point by invariants, with a mask of the lanes for which it is valid; other lanes are meaningless.
#[inline(always)]
fn by_invariants<R: Real, T: TermSet>(
    material: &(impl Response<R> + ?Sized),
    F: &Matrix3<R>,
) -> (R::Mask, DensePoint<R>) {
    let (invariants, is_in_range) = invariants_for(ResponseKind::DerivativesByInvariants, material, F);
    let derivatives = material.derivatives_by_invariants(invariants);
    let (F, name) = (*F, T::TANGENT);
    let (stress, tangent, Truth(keeps_digits)) = stage!(R, name, (F, invariants, derivatives) => {
        let terms = Terms::<R, T>::new(&F, invariants, &derivatives);
        let mut tangent = [[R::splat(0.0); 9]; 9];
        let keeps_digits = terms.assemble(&Entries, &mut tangent);
        (terms.stress(), tangent, Truth(keeps_digits))
    });
    let served = is_in_range & material.admits_invariants(invariants) & keeps_digits;
    (served, DensePoint { stress, tangent, status: Status::clean() })
}
