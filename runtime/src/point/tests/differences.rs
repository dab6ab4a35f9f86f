//! Slopes: a central difference approaches a right derivative as h², until rounding takes over.

use super::*;
use crate::material::Material;

/// Checks that (f(h) − f(−h))/2h tends to `derivative` as h² does, with a floor of `rounding`/h from the
/// rounding of f.
#[track_caller]
pub(super) fn check_slope<const N: usize>(
    f: impl Fn(f64) -> [f64; N],
    derivative: [f64; N],
    rounding: f64,
    what: &str,
) {
    let error = |h: f64| {
        let (ahead, behind) = (f(h), f(-h));
        let errors: [f64; N] = std::array::from_fn(|k| (ahead[k] - behind[k]) / (2.0 * h) - derivative[k]);
        norm(&errors)
    };
    // The third derivative bounds the error at the first step; each step is a quarter of the last one, so
    // 1/16 is due.
    let mut bound = error(2f64.powi(-7));
    for step in 0..8 {
        let h = 2f64.powi(-9 - 2 * step);
        bound /= 12.0;
        let limit = bound.max(rounding / h);
        assert!(error(h) <= limit, "{what}: error {:e} at h = {h:e}, expected at most {limit:e}", error(h));
    }
}

pub(super) fn flat(A: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|k| A[k / 3][k % 3])
}

fn check_material(material: &impl Material, stretches: [f64; 3], random: &mut Random) {
    let F = with_stretches(random, stretches);
    let dF = random.matrix();
    let point = evaluate(material, &F, Filter::None);
    let power = flat(&point.stress).iter().zip(flat(&dF)).map(|(p, f)| p * f).sum();
    // Both functions are of order 10 here and rounded 20 times or so.
    let rounding = 200.0 * f64::EPSILON;
    let energy = |h: f64| [evaluate_energy(material, &moved(&F, h, &dF)).energy];
    check_slope(energy, [power], rounding, &format!("stress at {stretches:?}"));
    let stress = |h: f64| flat(&evaluate_stress(material, &moved(&F, h, &dF)).stress);
    check_slope(stress, flat(&point.tangent.apply(&dF)), rounding, &format!("tangent at {stretches:?}"));
}

#[test]
fn stress_and_tangent_are_the_derivatives_of_the_energy() {
    let mut random = Random::new(21);
    for _ in 0..10 {
        for stretches in STRETCHES {
            check_material(&SaintVenantKirchhoff, stretches, &mut random);
        }
        for stretches in &STRETCHES[..3] {
            check_material(&NeoHookean, *stretches, &mut random);
        }
        for stretches in &STRETCHES[..5] {
            check_material(&RotatedLinear, *stretches, &mut random);
        }
    }
}

#[test]
fn the_gradient_of_the_decomposition_is_one() {
    let mut random = Random::new(22);
    for stretches in [[1.7, 1.1, 0.6], [1.2, 0.9, -0.5], [2.0, 0.4, 0.0]] {
        let F = with_stretches(&mut random, stretches);
        let dF = random.matrix();
        let svd = svd(&F);
        let SvdGradient { dU, dstretches, dVt, singular } = svd_gradient(&svd, &dF);
        assert!(!singular);

        // dF = dU Λ Vᵀ + U dΛ Vᵀ + U Λ dVᵀ, and both frames remain rotations.
        let weighted = |A: &Matrix3<f64>, d: [f64; 3], Bt: &Matrix3<f64>| {
            product(&A.map(|row| std::array::from_fn(|k| row[k] * d[k])), Bt)
        };
        let Vt = transposed(&svd.V);
        let sum = moved(&weighted(&dU, svd.stretches, &Vt), 1.0, &weighted(&svd.U, dstretches, &Vt));
        let sum = moved(&sum, 1.0, &weighted(&svd.U, svd.stretches, &dVt));
        // The quotients by gaps of at least 0.4 and a dozen products of numbers of order 5.
        assert!(norm(moved(&sum, -1.0, &dF).iter().flatten()) < 200.0 * f64::EPSILON);
        for spin in [product(&transposed(&svd.U), &dU), product(&dVt, &svd.V)] {
            assert!(norm(moved(&spin, 1.0, &transposed(&spin)).iter().flatten()) < 200.0 * f64::EPSILON);
        }

        // The vectors themselves have arbitrary signs; the products uk vkᵀ don't.
        for k in 0..3 {
            let outer = |U: &Matrix3<f64>, Vt: &Matrix3<f64>| {
                std::array::from_fn(|i| std::array::from_fn(|j| U[i][k] * Vt[k][j]))
            };
            let derivative = moved(&outer(&dU, &Vt), 1.0, &outer(&svd.U, &dVt));
            let along = |h: f64| {
                let svd = super::svd(&moved(&F, h, &dF));
                flat(&outer(&svd.U, &transposed(&svd.V)))
            };
            check_slope(along, flat(&derivative), 200.0 * f64::EPSILON, "singular vectors");
        }
        let along = |h: f64| super::svd(&moved(&F, h, &dF)).stretches;
        check_slope(along, dstretches, 200.0 * f64::EPSILON, "stretches");
    }
}

#[test]
fn equal_and_opposite_stretches_have_no_gradient() {
    let mut random = Random::new(23);
    let dF = random.matrix();
    for (stretches, expected) in [
        ([2.0, 2.0, 1.0], true),
        ([2.0, 1.0, 1.0], true),
        ([2.0, 1.0, -1.0], true),
        ([2.0, 0.0, 0.0], true),
        ([0.0, 0.0, 0.0], true),
        ([2.0, 1.0, 0.0], false),
        ([2.0, 2.0 - 1e-12, 1.0], false),
    ] {
        let identity = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let svd = Svd { U: identity, stretches, V: identity };
        assert_eq!(svd_gradient(&svd, &dF).singular, expected, "{stretches:?}");
    }
}
