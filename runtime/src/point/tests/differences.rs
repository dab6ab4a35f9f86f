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
