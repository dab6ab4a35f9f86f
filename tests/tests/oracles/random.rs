//! The oracle of random energies, and its calculus.

use piola::Real;
use piola_tests::random::expression::{Invariant, invariant, whole};
use piola_tests::random::generator::Declaration;
use piola_tests::random::oracle::{Expected, Point, at_stretches};
use piola_tests::random::polynomial::{CUBIC, Function, Polynomial, real_power, whole_power};
use piola_tests::random::quantity::Number;

#[test]
fn values_are_those_of_a_formula_done_by_hand() {
    // ψ = I1²: ψi = 4 I1 λi, ψij = 8 λi λj + 4 I1 δij, D∓ = 4 I1 for both.
    let terms = vec![whole(invariant(Invariant::I1), 2)];
    let (parameters, words) = (Vec::new(), Vec::new());
    let declaration = Declaration { parameters, terms, is_positive: false, words, is_fitted: false };
    let Point { energy, gradient, hessian, flip, twist, .. } = at_stretches(&declaration, [2.0, 1.0, 1.0]);
    let check = |found: &[Expected], expected: &[f64]| {
        for (found, expected) in found.iter().zip(expected) {
            let error = (found.value - Number::splat(*expected)).to_f64().abs();
            // What moving the stretches by 2⁻⁷⁰ changes, at slopes below 10⁴.
            assert!(error <= 1e4 * 2f64.powi(-70), "{found:?} for {expected}");
        }
    };
    check(&[energy], &[36.0]);
    check(&gradient, &[48.0, 24.0, 24.0]);
    check(&hessian, &[56.0, 32.0, 32.0, 16.0, 16.0, 8.0]);
    check(&flip, &[24.0; 3]);
    check(&twist, &[24.0; 3]);
}

/// Each coefficient is the slope of the one before.
#[track_caller]
fn check(taylor: impl Fn(f64) -> [f64; 4], x: f64, what: &str) {
    let h = 1e-5;
    let [before, at, after] = [x - h, x, x + h].map(&taylor);
    for k in 0..3 {
        let slope = (after[k] - before[k]) / (2.0 * h) / (k as f64 + 1.0);
        // The h² term, times derivatives of at most 10³, and rounding over h.
        assert!(
            (slope - at[k + 1]).abs() < 1e-6 * (1.0 + slope.abs()),
            "{what} at {x}: {k}, {slope}, {at:?}"
        );
    }
}

#[test]
fn coefficients_are_derivatives_over_factorials() {
    for &function in Function::ALL {
        for x in [0.3, 1.7] {
            check(|x| function.taylor(x), x, function.name());
        }
        if !matches!(function, Function::Ln | Function::Sqrt) {
            check(|x| function.taylor(x), -0.6, function.name());
        }
    }
    for n in -4..5 {
        check(|x| whole_power(x, n), 1.3, "whole power");
        check(|x| whole_power(x, n), -0.7, "whole power");
    }
    check(|x| real_power(x, 2.3), 0.4, "real power");
    assert_eq!(whole_power(0.0, 2), [0.0, 0.0, 1.0, 0.0]);
}

#[test]
fn products_and_compositions_are_those_of_polynomials() {
    let [x, y, z] =
        [(0, 2.0), (1, 3.0), (2, 5.0)].map(|(k, value)| Polynomial::<f64, CUBIC>::stretch(k, value));
    let product = x * x * y * z;
    assert_eq!(product.derivative(&[]), 60.0);
    assert_eq!(product.derivative(&[0, 0]), 30.0);
    assert_eq!(product.derivative(&[0, 1, 2]), 4.0);
    assert_eq!(product.derivative(&[1, 1]), 0.0);
    let sum = x + y * z;
    let cube = sum.compose(whole_power(17.0, 3));
    assert_eq!(cube.0, (sum * sum * sum).0);
}
