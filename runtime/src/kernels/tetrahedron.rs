//! One tetrahedron on any real number: all stages of a tile in one function, for recorded programs.

#![expect(non_snake_case, reason = "F, U, V, Ds as in the literature")]

use super::form::{FullStiffness, Output, gradient_is_finite, put_gradient};
use crate::lanes::{Mask, Real};
use crate::material::Response;
use crate::point::invariants::invariants;
use crate::point::invariants::tangent::Terms;
use crate::point::matrix::three;
use crate::point::{Filter, Matrix3, Point, evaluate, multiply};
use crate::status::Status;

/// Gradient and stiffness of a linear tetrahedron.
pub struct DenseTetrahedron<R: Real> {
    /// The gradient of its energy, N: coordinate a of node i at 3i+a.
    pub gradient: [R; 12],
    /// Its stiffness, filtered as requested, N/m: row and column as the gradient.
    pub stiffness: [R; 144],
    /// Status of the results: valid or not, and filtered or not.
    pub status: Status<R::Mask>,
}

/// Gradient and filtered stiffness of a tetrahedron with its nodes at these positions.
///
/// `rest` is Dm⁻¹ row by row and the volume at rest; the columns of Dm are the edges from node 0.
pub fn evaluate_tetrahedron<R: Real>(
    material: &impl Response<R>,
    nodes: [[R; 3]; 4],
    rest: [R; 10],
    filter: Filter,
) -> DenseTetrahedron<R> {
    let Ds = three!(a => three!(k => nodes[k + 1][a] - nodes[0][a]));
    let [a, b, c, d, e, f, g, h, i, _] = rest;
    let F = multiply(&Ds, &[[a, b, c], [d, e, f], [g, h, i]]);
    if filter != Filter::None || !material.has_invariants() {
        return by_decomposition(material, &F, &rest, filter);
    }
    let has_second = material.has_second_invariant();
    let (served, by_invariants) = match (has_second, material.curvature_by_invariants().has_all(has_second)) {
        (true, true) => by_invariants::<R, true, true>(material, &F, &rest),
        (true, false) => by_invariants::<R, true, false>(material, &F, &rest),
        (false, true) => by_invariants::<R, false, true>(material, &F, &rest),
        (false, false) => by_invariants::<R, false, false>(material, &F, &rest),
    };
    if !(!served).any() {
        return by_invariants;
    }
    let other = by_decomposition(material, &F, &rest, filter);
    let (one, status) = (&by_invariants, other.status & !served);
    DenseTetrahedron {
        gradient: std::array::from_fn(|k| R::select(served, one.gradient[k], other.gradient[k])),
        stiffness: std::array::from_fn(|k| R::select(served, one.stiffness[k], other.stiffness[k])),
        status,
    }
}

fn by_decomposition<R: Real>(
    material: &impl Response<R>,
    F: &Matrix3<R>,
    rest: &[R; 10],
    filter: Filter,
) -> DenseTetrahedron<R> {
    let Point { stress, mut tangent, status, .. } = evaluate(material, F, filter);
    let nonfinite = !gradient_is_finite(&stress, rest);
    let status = status | Status { nonfinite, ..Status::clean() };
    let status = status | FullStiffness::prepare(&mut tangent.blocks, rest, material.has_pole());
    let mut at = DenseTetrahedron::zero(status);
    put_gradient(&stress, rest, &mut at.gradient);
    FullStiffness::put_all(&tangent, rest, &mut at.stiffness);
    at
}

/// Tetrahedron by invariants, with a mask of the lanes for which it is valid; other lanes are meaningless.
fn by_invariants<R: Real, const HAS_SECOND: bool, const HAS_ALL: bool>(
    material: &impl Response<R>,
    F: &Matrix3<R>,
    rest: &[R; 10],
) -> (R::Mask, DenseTetrahedron<R>) {
    let (invariants, is_in_range) = invariants(F, HAS_SECOND);
    let derivatives = material.derivatives_by_invariants(invariants);
    let terms = Terms::<R, HAS_SECOND, HAS_ALL>::new(F, invariants, &derivatives);
    let mut at = DenseTetrahedron::zero(Status::clean());
    let largest = FullStiffness::put_all_by_invariants(&terms, rest, &mut at.stiffness);
    put_gradient(&terms.stress(), rest, &mut at.gradient);
    let stays_finite =
        FullStiffness::stays_finite(terms.bound(), rest) & gradient_is_finite(&terms.stress(), rest);
    let served =
        is_in_range & material.admits_invariants(invariants) & terms.keeps_digits(largest) & stays_finite;
    (served, at)
}

impl<R: Real> DenseTetrahedron<R> {
    fn zero(status: Status<R::Mask>) -> Self {
        let zero = R::splat(0.0);
        Self { gradient: [zero; 12], stiffness: [zero; 144], status }
    }
}
