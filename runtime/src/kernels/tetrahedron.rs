//! One tetrahedron, or one node of it, on any real number: all stages of a tile in one function, for recorded
//! programs.

#![expect(non_snake_case, reason = "F, P, U, V, Ds, K as in the literature")]

use super::form::{FullStiffness, Output, cap_twist, gradient_is_finite, put_gradient};
use crate::lanes::{Mask, Real, Truth, stage};
use crate::material::{Blocks, PAIRS, Response, ResponseKind};
use crate::point::invariants::invariants_for;
use crate::point::invariants::tangent::{TermSet, Terms, with_term_set};
use crate::point::matrix::{dot, symmetric, three, transpose};
use crate::point::{Filter, Matrix3, Point, Tangent, entries_are_finite, evaluate, multiply};
use crate::status::Status;

/// Gradient of the energy of a linear tetrahedron, N: coordinate a of node i at 3i+a; its stiffness,
/// filtered as requested, N/m: row and column as the gradient; and their status.
pub(crate) type DenseTetrahedron<R> = ([R; 12], [R; 144], Status<<R as Real>::Mask>);

/// The gradient in the position of one node, N, the block of the stiffness between the node and itself,
/// N/m, and their status.
pub(crate) type DenseVertex<R> = ([R; 3], Matrix3<R>, Status<<R as Real>::Mask>);

/// Gradient and filtered stiffness of a tetrahedron with its nodes at these positions.
///
/// `rest` is Dm⁻¹ row by row and the volume at rest; the columns of Dm are the edges from node 0.
pub fn evaluate_tetrahedron<R: Real>(
    material: &impl Response<R>,
    nodes: [[R; 3]; 4],
    rest: [R; 10],
    filter: Filter,
) -> DenseTetrahedron<R> {
    let F = stage!(R, "deformation_gradient", (nodes, rest) => {
        let Ds = three!(a => three!(k => nodes[k + 1][a] - nodes[0][a]));
        let [a, b, c, d, e, f, g, h, i, _] = rest;
        multiply(&Ds, &[[a, b, c], [d, e, f], [g, h, i]])
    });
    if filter != Filter::None || !material.has_invariants() {
        return by_decomposition(material, &F, &rest, filter);
    }
    let terms = material.curvature_by_invariants().terms(material.has_second_invariant());
    let (served, by_invariants) = with_term_set!(terms, Set => by_invariants::<R, Set>(material, &F, &rest));
    if !(!served).any() {
        return by_invariants;
    }
    let other = by_decomposition(material, &F, &rest, filter);
    let (gradient, stiffness, status) = other;
    (
        std::array::from_fn(|k| R::select(served, by_invariants.0[k], gradient[k])),
        std::array::from_fn(|k| R::select(served, by_invariants.1[k], stiffness[k])),
        status & !served,
    )
}

fn by_decomposition<R: Real>(
    material: &impl Response<R>,
    F: &Matrix3<R>,
    rest: &[R; 10],
    filter: Filter,
) -> DenseTetrahedron<R> {
    let Point { stress, tangent: Tangent { U, V, blocks }, status, .. } = capped(material, F, filter);
    let (Blocks { hessian, flip, twist, .. }, rest) = (blocks, *rest);
    let (gradient, Truth(is_finite)) = stage!(R, "gradient_of_stress", (stress, rest) => {
        let mut gradient = [R::splat(0.0); 12];
        put_gradient(&stress, &rest, &mut gradient);
        (gradient, Truth(gradient_is_finite(&stress, &rest)))
    });
    let Truth(stays_finite) = stage!(R, "stiffness_stays_finite", (hessian, flip, twist, rest) => {
        Truth(!FullStiffness::prepare(&mut map(hessian, flip, twist), &rest, false).nonfinite)
    });
    let stiffness = stage!(R, "stiffness_in_frames", (U, V, hessian, flip, twist, rest) => {
        let mut stiffness = [R::splat(0.0); 144];
        FullStiffness::put_all(&Tangent { U, V, blocks: map(hessian, flip, twist) }, &rest, &mut stiffness);
        stiffness
    });
    let nonfinite = !(is_finite & stays_finite);
    (gradient, stiffness, status | Status { nonfinite, ..Status::clean() })
}

/// Stress and tangent at F, with twists that a factorisation can resolve.
fn capped<R: Real>(material: &impl Response<R>, F: &Matrix3<R>, filter: Filter) -> Point<R> {
    let mut point = evaluate(material, F, filter);
    if material.has_pole() {
        let Blocks { hessian, flip, twist, .. } = point.tangent.blocks;
        let (twist, Truth(bounded)) = stage!(R, "cap_twist", (hessian, flip, twist) => {
            let mut blocks = map(hessian, flip, twist);
            let is_capped = cap_twist(&mut blocks);
            (blocks.twist, Truth(is_capped))
        });
        point.tangent.blocks.twist = twist;
        point.status = point.status | Status { bounded, ..Status::clean() };
    }
    point
}

/// The map between principal frames, which does not depend on the gradient of the energy.
fn map<R: Real>(hessian: [R; 6], flip: [R; 3], twist: [R; 3]) -> Blocks<R> {
    Blocks { gradient: [R::splat(0.0); 3], hessian, flip, twist }
}

/// Tetrahedron by invariants, with a mask of the lanes for which it is valid; other lanes are meaningless.
fn by_invariants<R: Real, T: TermSet>(
    material: &impl Response<R>,
    F: &Matrix3<R>,
    rest: &[R; 10],
) -> (R::Mask, DenseTetrahedron<R>) {
    let (invariants, is_in_range) = invariants_for(ResponseKind::DerivativesByInvariants, material, F);
    let derivatives = material.derivatives_by_invariants(invariants);
    let (name, F, rest) = (T::STIFFNESS, *F, *rest);
    let (gradient, stiffness, Truth(is_good)) = stage!(R, name, (F, invariants, derivatives, rest) => {
        let terms = Terms::<R, T>::new(&F, invariants, &derivatives);
        let (mut gradient, mut stiffness) = ([R::splat(0.0); 12], [R::splat(0.0); 144]);
        let keeps_digits = FullStiffness::put_all_by_invariants(&terms, &rest, &mut stiffness);
        put_gradient(&terms.stress(), &rest, &mut gradient);
        (gradient, stiffness, Truth(keeps_digits & gradient_is_finite(&terms.stress(), &rest)))
    });
    let served = is_in_range & material.admits_invariants(invariants) & is_good;
    (served, (gradient, stiffness, Status::clean()))
}

/// Gradient and filtered stiffness of one node of a tetrahedron, at the tetrahedron's F.
///
/// `rest` is the gradient g of the node's barycentric coordinate at rest, which is its row of Dm⁻¹, or minus
/// the sum of the rows for node 0; then the volume v at rest.
///
/// With w = Vᵀg the increments of F by a motion of the node along the columns of U are eᵢ ⊗ w in the
/// principal frames, so that K = v U B Uᵀ with
///
/// ```text
/// Bii = ψii wi² + Σ_k≠i aik wk²,     Bij = (ψij + bij) wi wj.
/// ```
pub fn evaluate_vertex<R: Real>(
    material: &impl Response<R>,
    F: &Matrix3<R>,
    rest: [R; 4],
    filter: Filter,
) -> DenseVertex<R> {
    let Point { stress, tangent: Tangent { U, V, blocks }, status, .. } = capped(material, F, filter);
    let gradient = stage!(R, "gradient_of_vertex", (stress, rest) => {
        let [g1, g2, g3, v] = rest;
        three!(a => v * dot(stress[a], [g1, g2, g3]))
    });
    let Blocks { hessian, flip, twist, .. } = blocks;
    let stiffness = stage!(R, "vertex_in_frames", (U, V, hessian, flip, twist, rest) => {
        let ([g1, g2, g3, v], blocks) = (rest, map(hessian, flip, twist));
        let w = three!(k => dot(transpose(&V)[k], [g1, g2, g3]));
        let squares = three!(k => v * (w[k] * w[k]));
        let mut B = three!(i => three!(j => if i == j { hessian[i] * squares[i] } else { R::splat(0.0) }));
        for (pair, (i, j)) in PAIRS.into_iter().enumerate() {
            let (a, b) = blocks.pair_block(pair);
            B[i][i] = a.mul_add(squares[j], B[i][i]);
            B[j][j] = a.mul_add(squares[i], B[j][j]);
            B[i][j] = (hessian[3 + pair] + b) * (v * (w[i] * w[j]));
            B[j][i] = B[i][j];
        }
        let left = multiply(&U, &B);
        symmetric!(i, j => dot(left[i], U[j]))
    });
    let nonfinite = !(entries_are_finite(&[gradient; 3]) & entries_are_finite(&stiffness));
    (gradient, stiffness, status | Status { nonfinite, ..Status::clean() })
}
