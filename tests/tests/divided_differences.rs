//! Divided differences φ[a, b] of elementary functions on every back end, against the definition in 154
//! digits: errors in units of u (|φ[a, b]| + |a ∂φ/∂a| + |b ∂φ/∂b|).
//!
//! `cargo test -p piola-tests --test divided_differences -- --nocapture` prints the worst; with
//! `PIOLA_SAMPLES=1` of all pairs.

#![expect(clippy::print_stdout, reason = "a table to show")]

use piola::__private as quotients;
use piola::Real;
use piola::lanes::{Backend, Kernel, Lanes, Scalar};
use piola_tests::bits::Precision;
use piola_tests::multiprecision::Multiprecision;
use piola_tests::quotients::gaps;

/// 512 bits: erfc of the largest argument takes 210 of them, the smallest gap 100, and a step 130.
type Exact = Multiprecision<8>;

/// A function of one argument, with its divided difference.
trait Subject: Copy {
    const NAME: &'static str;
    /// Magnitudes of the smaller argument.
    const SIZES: &'static [f64];
    fn value<R: Real>(x: R) -> R;
    fn quotient<R: Real>(a: R, b: R) -> R;
    /// True if the function has a value at x.
    fn is_inside(_x: f64) -> bool {
        true
    }
}

/// Arguments from those whose squares vanish compared with 1 to those at which exponentials overflow.
const ALL: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 8.0, 20.0, 60.0, 300.0, 705.0];
/// For even functions: the definition itself has no digits at 1e-200.
const OF_EVEN: &[f64] = &[1e-20, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 8.0, 20.0, 60.0, 300.0, 705.0];
const OF_ERF: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 1.0, 1.6, 3.0, 5.0, 8.0, 11.0];
const OF_ATAN: &[f64] = &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 0.999, 1.0, 1.6, 3.0, 8.0, 1e5, 1e10, 1e30];
const OF_LOGARITHMS: &[f64] =
    &[1e-200, 1e-8, 0.01, 0.1, 0.3, 0.7, 0.999, 1.0, 1.6, 3.0, 8.0, 1e5, 1e10, 1e30, 1e150, 1e300];

macro_rules! subjects {
    ($($Name:ident $value:ident $quotient:ident $sizes:ident $(above $limit:literal)?,)*) => {
        $(
            #[derive(Clone, Copy, Default)]
            struct $Name;

            impl Subject for $Name {
                const NAME: &'static str = stringify!($value);
                const SIZES: &'static [f64] = $sizes;

                #[inline(always)]
                fn value<R: Real>(x: R) -> R {
                    x.$value()
                }

                #[inline(always)]
                fn quotient<R: Real>(a: R, b: R) -> R {
                    quotients::$quotient(a, b)
                }

                $(
                    fn is_inside(x: f64) -> bool {
                        x > $limit
                    }
                )?
            }
        )*

        /// All functions, so that one that fails does not hide another.
        #[track_caller]
        fn judge_all<E: Scalar + Precision>() {
            let failures = [$(judge::<$Name, E>()),*].concat();
            assert!(failures.is_empty(), "\n{}", failures.join("\n"));
        }
    };
}

subjects! {
    ExpM1 exp_m1 exp_m1_quotient ALL,
    Ln1p ln_1p ln_1p_quotient OF_LOGARITHMS above -1.0,
    Sinh sinh sinh_quotient ALL,
    Cosh cosh cosh_quotient OF_EVEN,
    Tanh tanh tanh_quotient ALL,
    Asinh asinh asinh_quotient OF_LOGARITHMS,
    Sin sin sin_quotient ALL,
    Cos cos cos_quotient OF_EVEN,
    Atan atan atan_quotient OF_ATAN,
    Erf erf erf_quotient OF_ERF,
    Softplus softplus softplus_quotient ALL,
    Sigmoid sigmoid sigmoid_quotient ALL,
}

/// Every fifth of these pairs is judged, or all where `PIOLA_SAMPLES` is set.
fn stride() -> usize {
    if std::env::var_os("PIOLA_SAMPLES").is_some() { 1 } else { 5 }
}

/// Pairs whose numbers differ by every gap, relative or absolute, on either side of 0, in either order.
fn pairs<S: Subject, E: Precision>() -> Vec<(E, E)> {
    let mut pairs = Vec::new();
    for gap in gaps() {
        for &size in S::SIZES {
            let far = size * (1.0 + gap);
            for (a, b) in
                [(far, size), (size + gap, size), (size, size - gap), (far, -size), (gap, 0.0), (size, -gap)]
            {
                pairs.extend([(a, b), (-b, -a), (b, a)]);
            }
        }
    }
    let inside = |x: E| x.is_finite() && S::is_inside(x.widen());
    let is_judged = |a: E, b: E| inside(a) && inside(b) && (a.widen() != 0.0 || b.widen() != 0.0);
    pairs
        .into_iter()
        .map(|(a, b)| (E::splat(a), E::splat(b)))
        .filter(|&(a, b)| is_judged(a, b))
        .step_by(stride())
        .collect()
}

/// φ[a, b] and its scale, or `None` where it is out of the range of E.
fn exact<S: Subject, E: Precision>(a: f64, b: f64) -> Option<(Exact, Exact)> {
    let number = Exact::splat;
    let size = number(a.abs().max(b.abs()).max(1e-30));
    // A function of two equal numbers is that of two which differ by 10⁻³⁰.
    let nudge = if a == b { size * number(1e-30) } else { number(0.0) };
    let step = size * number(1e-40);
    let quotient = |a: Exact, b: Exact| (S::value(a) - S::value(b)) / (a - b);
    let (far, near) = (number(a) + nudge, number(b));
    let value = quotient(far, near);
    let by_first = number(a) * (quotient(far + step, near) - value) / step;
    let by_second = number(b) * (quotient(far, near - step) - value) / step;
    let magnitude = value.abs().to_f64();
    let in_range = magnitude >= E::MIN_POSITIVE && magnitude <= E::LARGEST;
    in_range.then(|| (value, value.abs() + by_first.abs() + by_second.abs()))
}

/// A divided difference of many pairs.
struct Apply<'a, S, E>(S, &'a [(E, E)]);

impl<S: Subject, E: Scalar> Kernel<E> for Apply<'_, S, E> {
    type Output = Vec<E>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Vec<E> {
        let (a, b): (Vec<E>, Vec<E>) = self.1.iter().copied().unzip();
        let mut values = vec![E::default(); a.len()];
        for start in (0..a.len()).step_by(R::LANES) {
            S::quotient(R::load(&a[start..]), R::load(&b[start..])).store(&mut values[start..]);
        }
        values
    }
}

/// Prints the worst error of each back end, and returns the lines of those that are too large.
fn judge<S: Subject + Default, E: Scalar + Precision>() -> Vec<String> {
    let (pairs, expected): (Vec<_>, Vec<_>) = pairs::<S, E>()
        .into_iter()
        .filter_map(|(a, b)| Some(((a, b), exact::<S, E>(a.widen(), b.widen())?)))
        .unzip();
    // Whole blocks of lanes.
    let mut padded = pairs.clone();
    padded.resize(pairs.len().next_multiple_of(64), pairs[0]);
    let mut failures = Vec::new();
    for way in Backend::available().map(Some).chain([None]) {
        let kernel = Apply(S::default(), &padded[..]);
        let values = match way {
            Some(backend) => backend.run(kernel),
            None => kernel.run::<E>(),
        };
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
        let name = way.map_or("scalar", Backend::name);
        let line = format!("{} {:8} {name:9} {worst:6.2} at {:?}", E::NAME, S::NAME, place);
        println!("{line}");
        if worst > 10.0 {
            failures.push(line);
        }
    }
    failures
}

#[test]
fn doubles_keep_their_digits_at_every_gap() {
    judge_all::<f64>();
}

#[test]
fn floats_keep_their_digits_at_every_gap() {
    judge_all::<f32>();
}
