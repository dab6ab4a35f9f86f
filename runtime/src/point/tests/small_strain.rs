//! Stress from the displacement gradient, against higher precision that shares no formula with it.
//!
//! Saint Venant–Kirchhoff's P = F (2μ E + λ tr E) is a polynomial in H and judged in about 106 bits. The test
//! `small_strain` of `piola-tests` judges all energies in 320 bits.

use super::*;
use crate::point::twice::Twice;

const MU: f64 = 1.0;
const LAMBDA: f64 = 1.5;

/// P = F (2μ E + λ tr E I), E = (H + Hᵀ + HᵀH)/2, rounded at the end.
fn saint_venant_kirchhoff(H: &Matrix3<f64>) -> Matrix3<f64> {
    let h = |i: usize, j: usize| Twice::of(H[i][j]);
    let twice_E =
        |i: usize, j: usize| Twice::sum((0..3).map(|k| h(k, i).mul(h(k, j))).chain([h(i, j), h(j, i)]));
    let trace = Twice::sum((0..3).map(|k| twice_E(k, k))).mul(Twice::of(LAMBDA / 2.0));
    let S = |i: usize, j: usize| {
        let shear = twice_E(i, j).mul(Twice::of(MU));
        if i == j { shear.add(trace) } else { shear }
    };
    std::array::from_fn(|i| {
        std::array::from_fn(|j| Twice::sum((0..3).map(|k| h(i, k).mul(S(k, j))).chain([S(i, j)])).0)
    })
}

fn plus_identity(H: &Matrix3<f64>) -> Matrix3<f64> {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { 1.0 + H[i][j] } else { H[i][j] }))
}

/// ‖dP/dF‖, the largest magnitude of its eigenvalues.
fn stiffness(H: &Matrix3<f64>) -> f64 {
    let dP_dF = evaluate(&SaintVenantKirchhoff, &plus_identity(H), Filter::None).tangent.to_matrix();
    let matrix = nalgebra::SMatrix::<f64, 9, 9>::from_fn(|i, j| dP_dF[i][j]);
    matrix.symmetric_eigenvalues().iter().fold(0.0, |largest: f64, e| largest.max(e.abs()))
}

/// R − I for a rotation by an angle about a random axis: sin θ K + 2 sin²(θ/2) K².
fn rotation_from_rest(random: &mut Random, angle: f64) -> Matrix3<f64> {
    let axis: [f64; 3] = std::array::from_fn(|_| random.uniform(-1.0, 1.0));
    let [x, y, z] = axis.map(|x| x / norm(&axis));
    let K = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
    let versine = 2.0 * (angle / 2.0).sin().powi(2);
    moved(&K.map(|row| row.map(|x| x * angle.sin())), versine, &product(&K, &K))
}

/// Displacement gradients with strains of a given size: none, as much, and much more rotation; full,
/// uniaxial, equal and nearly equal strains.
fn displacement_gradients(random: &mut Random, strain: f64) -> Vec<Matrix3<f64>> {
    let frame = random.rotation();
    let mut all = vec![random.matrix().map(|row| row.map(|x| x * strain))];
    for d in
        [[1.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 1.0, -0.5], [1.0, 1.0 + 1e-7, 1.0 - 1e-7], [1.0, 1e-9, 0.0]]
    {
        let scaled = framed(&frame, d.map(|d| strain * d), &frame);
        for angle in [0.0, strain, strain.sqrt(), 0.2] {
            // R (I + U) − I = (R − I) + U + (R − I) U.
            let turn = rotation_from_rest(random, angle.min(0.2));
            all.push(moved(&moved(&turn, 1.0, &scaled), 1.0, &product(&turn, &scaled)));
        }
    }
    all
}

/// The Frobenius norm, of which no square underflows.
fn size(A: &Matrix3<f64>) -> f64 {
    let largest = A.iter().flatten().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    largest * norm(A.map(|row| row.map(|x| x / largest)).iter().flatten())
}

/// Worst error of a stress in units of u (‖P‖ + ‖dP/dF‖ ‖H‖) at one size of strain.
fn worst_error<R: Real<Mask = bool> + Into<f64>>(strain: f64) -> f64 {
    let mut random = Random::new(51);
    let mut worst = 0.0f64;
    for _ in 0..20 {
        for H in displacement_gradients(&mut random, strain) {
            let rounded: Matrix3<R> = H.map(|row| row.map(R::splat));
            let H = rounded.map(|row| row.map(Into::into));
            let expected = saint_venant_kirchhoff(&H);
            let scale = size(&expected) + stiffness(&H) * size(&H);
            let from_H = evaluate_stress(&SaintVenantKirchhoff, DisplacementGradient(&rounded));
            let StressPoint { stress, status } = from_H;
            assert_eq!(status, Status::default(), "{H:?}");
            let found = stress.map(|row| row.map(|x| x.into() / scale));
            let expected = expected.map(|row| row.map(|x| x / scale));
            let error = norm(moved(&found, -1.0, &expected).iter().flatten());
            assert!(error.is_finite(), "{H:?}");
            worst = worst.max(error / R::UNIT_ROUNDOFF);
        }
    }
    worst
}

#[track_caller]
fn check<R: Real<Mask = bool> + Into<f64>>(strains: &[f64]) {
    for &strain in strains {
        let worst = worst_error::<R>(strain);
        assert!(worst <= 30.0, "strains of {strain:e}: {worst:.1} u");
    }
}

const STRAINS: [f64; 14] =
    [0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14];

#[test]
fn every_strain_keeps_its_digits() {
    check::<f64>(&STRAINS);
    check::<f64>(&[1e-30, 1e-100, 1e-160, 1e-300]);
    check::<f32>(&STRAINS);
    check::<f32>(&[1e-19, 1e-25, 1e-30]);
}

#[test]
fn nothing_moved_is_free_of_stress() {
    let zero: Matrix3<f64> = [[0.0; 3]; 3];
    let point = evaluate(&NeoHookean, DisplacementGradient(&zero), Filter::Clamp);
    assert_eq!((point.stress, point.status), (zero, Status::default()));
}

/// Both ways hold around ‖H‖ = ½, where one takes over from the other.
#[test]
fn large_displacements_go_through_F() {
    let mut random = Random::new(52);
    for _ in 0..500 {
        let H = random.matrix();
        let size = norm(H.iter().flatten());
        for target in [0.4, 0.5 - 1e-9, 0.5 + 1e-9, 0.6] {
            let H = H.map(|row| row.map(|x| x * target / size));
            let found = evaluate_stress(&SaintVenantKirchhoff, DisplacementGradient(&H)).stress;
            let through_F = evaluate_stress(&SaintVenantKirchhoff, &plus_identity(&H)).stress;
            if target > 0.5 {
                assert_eq!(found, through_F);
            }
            let expected = saint_venant_kirchhoff(&H);
            let error = norm(moved(&found, -1.0, &expected).iter().flatten());
            let stiffness = stiffness(&H);
            let scale = norm(expected.iter().flatten()) + stiffness * target;
            assert!(error <= 30.0 * f64::UNIT_ROUNDOFF * scale, "{error:e} at {H:?}");
        }
    }
}

#[test]
fn stress_and_tangent_come_as_from_their_own_entry_points() {
    let mut random = Random::new(53);
    for size in [1e-12, 0.05, 1.0] {
        let H = random.matrix().map(|row| row.map(|x| x * size));
        let point = evaluate(&RotatedLinear, DisplacementGradient(&H), Filter::Clamp);
        let through_F = evaluate(&RotatedLinear, &plus_identity(&H), Filter::Clamp);
        assert_eq!(point.stress, evaluate_stress(&RotatedLinear, DisplacementGradient(&H)).stress);
        assert_eq!(point.decomposition(), through_F.decomposition());
        assert_eq!((point.tangent, point.status.filtered), (through_F.tangent, through_F.status.filtered));
    }
}

#[test]
fn what_leaves_the_domain_is_refused() {
    let mut H: Matrix3<f64> = [[0.0; 3]; 3];
    H[0][0] = -1.5;
    assert!(evaluate_stress(&NeoHookean, DisplacementGradient(&H)).status.refused);
    assert!(evaluate(&NeoHookean, DisplacementGradient(&H), Filter::None).status.refused);
}
