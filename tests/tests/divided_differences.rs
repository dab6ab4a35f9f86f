//! Divided differences φ[a, b] of elementary functions on every back end, against the definition in 154
//! digits: errors in units of u (|φ[a, b]| + |a ∂φ/∂a| + |b ∂φ/∂b|).
//!
//! `cargo test -p piola-tests --test divided_differences -- --nocapture` prints the worst.

#![expect(clippy::print_stdout, reason = "a table to show")]

use piola::__private as quotients;
use piola::Real;
use piola::lanes::Scalar;
use piola_tests::energies::Format;
use piola_tests::multiprecision::Multiprecision;
use piola_tests::quotients::gaps;
use piola_tests::random::polynomial::Function::{
    self, Asinh, Atan, Cos, Cosh, Erf, ExpM1, Ln1p, Sigmoid, Sin, Sinh, Softplus, Tanh,
};
use piola_tests::ways::{Binary, by_every_way};

/// 512 bits: erfc of the largest argument takes 210 of them, the smallest gap 100, and a step 130.
type Exact = Multiprecision<8>;

/// Arguments from those whose squares vanish compared with 1 to those at which exponentials overflow.
const ALL: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 8.0, 20.0, 60.0, 300.0, 705.0];
/// For even functions: the definition itself has no digits at 1e-200.
const OF_EVEN: &[f64] = &[1e-20, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 8.0, 20.0, 60.0, 300.0, 705.0];
const OF_ERF: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 5.0, 8.0, 11.0];
const OF_ATAN: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 0.999, 1.0, 1.6, 3.0, 8.0, 1e5, 1e10, 1e30];
const OF_LOGARITHMS: &[f64] =
    &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 0.999, 1.0, 1.6, 3.0, 8.0, 1e5, 1e10, 1e30, 1e150, 1e300];

/// Functions with magnitudes of the smaller argument.
const SUBJECTS: [(Function, &[f64]); 12] = [
    (ExpM1, ALL),
    (Ln1p, OF_LOGARITHMS),
    (Sinh, ALL),
    (Cosh, OF_EVEN),
    (Tanh, ALL),
    (Asinh, OF_LOGARITHMS),
    (Sin, ALL),
    (Cos, OF_EVEN),
    (Atan, OF_ATAN),
    (Erf, OF_ERF),
    (Softplus, ALL),
    (Sigmoid, ALL),
];

/// φ[a, b].
#[derive(Clone, Copy)]
struct DividedDifference(Function);

impl Binary for DividedDifference {
    #[inline(always)]
    fn of<R: Real>(self, a: R, b: R) -> R {
        match self.0 {
            ExpM1 => quotients::exp_m1_quotient(a, b),
            Ln1p => quotients::ln_1p_quotient(a, b),
            Sinh => quotients::sinh_quotient(a, b),
            Cosh => quotients::cosh_quotient(a, b),
            Tanh => quotients::tanh_quotient(a, b),
            Asinh => quotients::asinh_quotient(a, b),
            Sin => quotients::sin_quotient(a, b),
            Cos => quotients::cos_quotient(a, b),
            Atan => quotients::atan_quotient(a, b),
            Erf => quotients::erf_quotient(a, b),
            Softplus => quotients::softplus_quotient(a, b),
            Sigmoid => quotients::sigmoid_quotient(a, b),
            other => panic!("{other:?} is not among the subjects"),
        }
    }
}

/// Every fifth of the pairs whose numbers differ by every gap, relative or absolute, on either side of 0, in
/// either order.
fn pairs<E: Format>(function: Function, sizes: &[f64]) -> Vec<(E, E)> {
    let mut pairs = Vec::new();
    for gap in gaps() {
        for &size in sizes {
            let far = size * (1.0 + gap);
            for (a, b) in
                [(far, size), (size + gap, size), (size, size - gap), (far, -size), (gap, 0.0), (size, -gap)]
            {
                pairs.extend([(a, b), (-b, -a), (b, a)]);
            }
        }
    }
    let inside = |x: E| x.is_finite() && (function != Ln1p || x.widen() > -1.0);
    let is_judged = |a: E, b: E| inside(a) && inside(b) && (a.widen() != 0.0 || b.widen() != 0.0);
    pairs
        .into_iter()
        .map(|(a, b)| (E::splat(a), E::splat(b)))
        .filter(|&(a, b)| is_judged(a, b))
        .step_by(5)
        .collect()
}

/// φ[a, b] and its scale, or `None` where it is out of the range of E.
fn exact<E: Format>(function: Function, a: f64, b: f64) -> Option<(Exact, Exact)> {
    let number = Exact::splat;
    let size = number(a.abs().max(b.abs()).max(1e-30));
    // A function of two equal numbers is that of two which differ by 10⁻³⁰.
    let nudge = if a == b { size * number(1e-30) } else { number(0.0) };
    let step = size * number(1e-40);
    let quotient = |a: Exact, b: Exact| (function.of(a) - function.of(b)) / (a - b);
    let (far, near) = (number(a) + nudge, number(b));
    let value = quotient(far, near);
    let by_first = number(a) * (quotient(far + step, near) - value) / step;
    let by_second = number(b) * (quotient(far, near - step) - value) / step;
    let magnitude = value.abs().to_f64();
    let in_range = magnitude >= E::MIN_POSITIVE && magnitude <= E::LARGEST;
    in_range.then(|| (value, value.abs() + by_first.abs() + by_second.abs()))
}

/// Prints the worst errors of each function and back end; a function that fails does not hide another.
#[track_caller]
fn judge<E: Scalar + Format>() {
    let mut failures = Vec::new();
    for (function, sizes) in SUBJECTS {
        let expected = |(a, b): (E, E)| Some(((a, b), exact::<E>(function, a.widen(), b.widen())?));
        let (pairs, expected): (Vec<_>, Vec<_>) =
            pairs::<E>(function, sizes).into_iter().filter_map(expected).unzip();
        for (name, values) in by_every_way(DividedDifference(function), &pairs) {
            let (mut worst, mut place) = (0.0, pairs[0]);
            for ((&found, &(value, scale)), &pair) in values.iter().zip(&expected).zip(&pairs) {
                let found = found.widen();
                let error = if found.is_finite() {
                    ((Exact::splat(found) - value) / scale).abs().to_f64() / E::UNIT_ROUNDOFF
                } else {
                    f64::INFINITY
                };
                if error > worst {
                    (worst, place) = (error, pair);
                }
            }
            let line = format!("{} {:8} {name:9} {worst:6.2} at {place:?}", E::NAME, function.name());
            println!("{line}");
            if worst > 10.0 {
                failures.push(line);
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn doubles_keep_their_digits_at_every_gap() {
    judge::<f64>();
}

#[test]
fn floats_keep_their_digits_at_every_gap() {
    judge::<f32>();
}
