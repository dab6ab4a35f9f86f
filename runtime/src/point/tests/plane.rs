//! Plane strain and plane stress against P and dP/dF in space, and formulas.
//!
//! The test `plane` of `piola-tests` judges differences of stresses and the status, for the catalogue.

use super::*;
use crate::convert::to_nalgebra;
use crate::hand_written::ExtendedNeoHookean;
use crate::point::plane::{Matrix2, PlanePoint, in_space, plane_strain, plane_stress, plane_svd};

/// Stretches in the plane: apart, equal, at rest, nearly equal, large, small, and two that are inverted.
const IN_PLANE: [[f64; 2]; 9] = [
    [1.7, 0.6],
    [1.3, 1.3],
    [1.0, 1.0],
    [1.2, 1.2 - 1e-9],
    [4.0, 3.0],
    [0.5, 0.4],
    [0.7, 0.7],
    [1.2, -0.5],
    [0.9, -0.9 + 1e-3],
];

/// Error of stresses and tangents in units of u M: two decompositions, exact for an F that differs by 20 u
/// λ1, and four factors from their frames.
const ROUNDING: f64 = 100.0;

fn with_plane_stretches(random: &mut Random, [a, b]: [f64; 2]) -> Matrix2<f64> {
    let ((s, c), (t, d)) = (random.uniform(-4.0, 4.0).sin_cos(), random.uniform(-4.0, 4.0).sin_cos());
    [[a * c * d + b * s * t, a * c * t - b * s * d], [a * s * d - b * c * t, a * s * t + b * c * d]]
}

/// Places of the entries in the plane among the nine.
const PLACES: [usize; 4] = [0, 1, 3, 4];

/// The entries in the plane of dP/dF in space, with entry 33 condensed where it is free.
fn condensed(dP_dF: &[[f64; 9]; 9], is_free: bool) -> [[f64; 4]; 4] {
    PLACES.map(|row| {
        PLACES.map(|column| {
            let through = if is_free { dP_dF[row][8] * dP_dF[8][column] / dP_dF[8][8] } else { 0.0 };
            dP_dF[row][column] - through
        })
    })
}

/// Checks a point against that in space.
#[track_caller]
fn check_in_space(material: &impl Material, F: &Matrix2<f64>, found: &PlanePoint<f64>, is_free: bool) {
    assert!(found.status.is_clean(), "{:?} at {F:?}", found.status);
    let space = evaluate(material, &in_space(F, found.out_of_plane_stretch), Filter::None);
    let dP_dF = space.tangent.to_matrix();
    // A condensed entry is a difference of entries magnified by ψ13/ψ33 at most twice.
    let magnified = if is_free { 1.0 + norm(&dP_dF[8]) / dP_dF[8][8] } else { 1.0 };
    let M = norm(dP_dF.iter().flatten()) * magnified * magnified;
    let [l1, ..] = space.stretches;
    let limit = ROUNDING * f64::EPSILON * M * l1;
    let P = &space.stress;
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let error = (found.stress[i][j] - P[i][j]).abs();
        assert!(error <= limit, "P: {error:e} above {limit:e} at {F:?}");
    }
    let error = (found.out_of_plane_stress - P[2][2]).abs();
    assert!(error <= limit, "P33: {error:e} above {limit:e} at {F:?}");
    // The second derivatives of these energies change by less than 50 M for a unit of F, but by M/|λ1 + λ2|
    // next to the pole of a twist. Both decompositions are those of an F that differs by 20 u.
    let [a, b] = plane_svd(F).stretches;
    let limit_of_tangent = 0.4 * (1.0 / (a + b)).max(50.0) * limit;
    let error = difference(&found.tangent.to_matrix(), &condensed(&dP_dF, is_free));
    assert!(error <= limit_of_tangent, "dP/dF: {error:e} above {limit_of_tangent:e} at {F:?}");
    // dP33 = 0, or no dλ3 at all.
    let slope = PLACES.map(|place| if is_free { -dP_dF[8][place] / dP_dF[8][8] } else { 0.0 });
    for (found, expected) in found.out_of_plane_slope.as_flattened().iter().zip(slope) {
        let limit = if is_free { limit_of_tangent / dP_dF[8][8] } else { 0.0 };
        assert!((found - expected).abs() <= limit, "dλ3/dF: {found:e} instead of {expected:e} at {F:?}");
    }
    let energy = evaluate_energy(material, &in_space(F, found.out_of_plane_stretch)).energy;
    assert!((found.energy - energy).abs() <= limit, "ψ at {F:?}");
}

#[test]
fn points_are_those_in_space_with_the_free_component_condensed() {
    fn of(material: &impl Material, plane: &[[f64; 2]]) {
        let mut random = Random::new(92);
        for _ in 0..20 {
            for &stretches in plane {
                let F = with_plane_stretches(&mut random, stretches);
                check_in_space(material, &F, &plane_strain(material, &F, Filter::None), false);
                check_in_space(material, &F, &plane_stress(material, &F, Filter::None), true);
            }
        }
    }
    of(&NeoHookean, &IN_PLANE[..7]);
    // Beyond the middle the sides of these have no equilibrium.
    of(&SaintVenantKirchhoff, &IN_PLANE[..4]);
    of(&RotatedLinear, &IN_PLANE[..4]);
    of(&ExtendedNeoHookean { epsilon: 0.3 }, &IN_PLANE);
}

/// μ/2 (I1 − 3) − μ (J − 1) + K/2 (J − 1)²: P33 is linear in λ3.
#[crate::material(domain(J > 0.0))]
fn Polynomial(
    [l1, l2, l3]: [f64; 3],
    /// Pa.
    mu: f64,
    /// Pa.
    bulk: f64,
) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * (J - 1.0) + bulk / 2.0 * (J - 1.0).powi(2)
}

#[test]
fn nearly_incompressible_sheets_lose_no_digits_of_the_stress() {
    let mut random = Random::new(94);
    for ratio in [1.0, 1e3, 1e6, 1e9] {
        let material = Polynomial::new(1.0, ratio).expect("parameters");
        for [a, b] in [[1.7, 0.6], [1.0, 1.0], [10.0, 7.0], [0.1, 0.07], [1e3, 1e-2], [1e4, 2e3]] {
            let F = with_plane_stretches(&mut random, [a, b]);
            let point = plane_stress(&material, &F, Filter::None);
            assert!(point.status.is_clean());
            // K (J − 1) − μ = −μ t/(a b), so that t and the principal stresses have formulas.
            let [a, b] = plane_svd(&F).stretches;
            let area = a * b;
            let t = area * (ratio + 1.0) / (1.0 + ratio * area * area);
            let error = (point.out_of_plane_stretch - t).abs() / t;
            // A dozen roundings of ψ3 compared with t ψ33, which is no smaller.
            assert!(error <= 8.0 * f64::EPSILON, "t: {error:e} for K = {ratio:e} μ at {a}, {b}");
            for (found, [x, y]) in point.gradient.iter().zip([[a, b], [b, a]]) {
                let expected = x - t / x * t;
                // ψi rounds at its terms, μ x and K (J − 1) y t ≈ μ t²/x, and J by u, which K multiplies: J
                // is the same number in ψ3, which takes that away again up to second order, u² K.
                let size = x + t * t / x + y * t * (1.0 + f64::EPSILON * ratio);
                let error = (found - expected).abs();
                assert!(error <= 16.0 * f64::EPSILON * size, "{error:e} for K = {ratio:e} μ at {a}, {b}");
            }
        }
    }
}

#[test]
fn filters_clamp_the_condensed_eigenvalues() {
    let mut random = Random::new(95);
    let material = ExtendedNeoHookean { epsilon: 0.3 };
    let mut changed = 0;
    for _ in 0..200 {
        let F = std::array::from_fn(|_| std::array::from_fn(|_| random.uniform(-1.0, 1.0)));
        let (plain, clamped) =
            (plane_stress(&material, &F, Filter::None), plane_stress(&material, &F, Filter::Clamp));
        if !plain.status.is_clean() {
            continue;
        }
        let eigen = to_nalgebra(&plain.tangent.to_matrix()).symmetric_eigen();
        let size = eigen.eigenvalues.amax();
        let positive = eigen.eigenvalues.map(|x| x.max(0.0));
        let expected =
            eigen.eigenvectors * nalgebra::Matrix4::from_diagonal(&positive) * eigen.eigenvectors.transpose();
        let found = to_nalgebra(&clamped.tangent.to_matrix());
        assert!((found - expected).norm() <= 100.0 * f64::EPSILON * size);
        let is_indefinite = eigen.eigenvalues.min() < -1e-12 * size;
        assert_eq!(clamped.status.filtered, is_indefinite);
        changed += usize::from(is_indefinite);
    }
    assert!(changed > 10, "{changed}");
}

#[test]
fn what_has_no_equilibrium_or_no_energy_says_so() {
    // Inverted in the plane: J < 0 for every thickness.
    let inverted = [[1.0, 0.0], [0.0, -1.0]];
    for point in [
        plane_strain(&NeoHookean, &inverted, Filter::None),
        plane_stress(&NeoHookean, &inverted, Filter::None),
    ] {
        assert!(point.status.refused && !point.no_equilibrium);
    }
    // Saint Venant–Kirchhoff: t (μ (t² − 1) + λ/2 (Σ λ² − 3)) is positive for all t > 0 in a wide sheet.
    let wide = plane_stress(&SaintVenantKirchhoff, &[[3.0f64, 0.0], [0.0, 3.0]], Filter::None);
    assert!(wide.status.refused && wide.no_equilibrium && wide.stress[0][0].is_nan());
    for bad in [f64::NAN, f64::INFINITY] {
        let F = [[1.0, bad], [0.0, 1.0]];
        assert!(plane_strain(&NeoHookean, &F, Filter::Clamp).status.nonfinite);
        assert!(plane_stress(&NeoHookean, &F, Filter::Clamp).status.nonfinite);
    }
}
