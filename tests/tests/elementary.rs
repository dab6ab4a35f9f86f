//! Elementary functions of every back end against 192 bits, in units in the last place:
//! `cargo test -p piola-tests --test elementary -- --nocapture` prints the worst errors and where they are.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::f64::consts::{FRAC_PI_4, LN_2, SQRT_2};

use piola::__private::random::Random;
use piola::Real;
use piola::lanes::Scalar;
use piola_tests::energies::Format;
use piola_tests::multiprecision::Multiprecision;
use piola_tests::ways::{Binary, by_every_way};

/// Arguments of each function and region.
const SAMPLES: usize = 6144;

type Exact = Multiprecision<3>;

/// Declares functions of x, or of x and y, by their methods.
macro_rules! functions {
    (($x:ident, $y:ident) $($Function:ident $method:ident $arguments:tt,)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        enum Function {
            $($Function,)*
        }

        use Function::{$($Function,)*};

        const ALL: &[Function] = &[$($Function,)*];

        impl Binary for Function {
            #[inline(always)]
            fn of<R: Real>(self, $x: R, $y: R) -> R {
                match self {
                    $($Function => $x.$method $arguments,)*
                }
            }
        }
    };
}

functions! {
    (x, y)
    Exp exp(), Ln ln(), Powf powf(y), Cbrt cbrt(), Sqrt sqrt(), ReciprocalSqrt reciprocal_sqrt(),
    ExpM1 exp_m1(), Ln1p ln_1p(), Sinh sinh(), Cosh cosh(), Tanh tanh(), Asinh asinh(),
    Sin sin(), Cos cos(), Atan atan(), Erf erf(), Softplus softplus(), Sigmoid sigmoid(),
}

impl Function {
    /// To some 180 bits.
    fn exact(self, x: f64, y: f64) -> Exact {
        let (x, y) = (Exact::splat(x), Exact::splat(y));
        match self {
            ReciprocalSqrt => Exact::splat(1.0) / x.sqrt(),
            function => function.of(x, y),
        }
    }

    /// True if `Real` promises digits at x.
    fn promises<E: Format>(self, x: f64) -> bool {
        match self {
            ReciprocalSqrt => x >= E::MIN_POSITIVE,
            Ln1p => x > -1.0,
            Sin | Cos => x.abs() <= last_exact_turn::<E>(),
            Sinh | Cosh | ExpM1 | Softplus | Sigmoid => x.abs() < 1e6,
            _ => true,
        }
    }

    /// True if the argument is that of an exponential, for which logarithms in range are wide.
    fn is_exponential(self) -> bool {
        matches!(self, Exp | ExpM1 | Sinh | Cosh | Tanh | Softplus | Sigmoid)
    }

    /// Where one formula takes over from another.
    fn switches(self) -> &'static [f64] {
        match self {
            Ln1p => &[SQRT_2 - 1.0, 1.0 / SQRT_2 - 1.0, 1.0, -0.75, -0.999],
            Asinh => &[1.0, 9.5e-7, 3.9e-3, 5.4e8, 3.3e4, 0.35],
            Atan => &[SQRT_2 - 1.0, SQRT_2 + 1.0, 1.0],
            Erf => &[1.0, 3.5, 6.0],
            _ => &[],
        }
    }

    /// What `Real` promises, in units in the last place.
    fn bound(self) -> f64 {
        match self {
            Sqrt => 0.5,
            ReciprocalSqrt => 2.0,
            _ => 1.5,
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Region {
    /// Stretches and exponents of rubber.
    Ordinary,
    /// Every magnitude of argument and result, subnormal ones included.
    Wide,
    /// Where a reduction of the argument changes, and where the result is close to 1, overflow or underflow.
    Critical,
}

const EXPONENTS: [f64; 8] = [0.3, 4.7, -3.3, 12.6, -2.0, 0.5, 1.3, -1.0 / 3.0];

/// The number nearest to `value`, or one of the next ones.
fn near<E: Format>(value: f64, random: &mut Random) -> E {
    let steps = random.below(9) as f64 - 4.0;
    E::splat(value + value * steps * 2.0 * E::UNIT_ROUNDOFF)
}

/// A finite pattern of bits that is positive.
fn positive<E: Format>(random: &mut Random) -> E {
    loop {
        let x = E::from_bits(random.bits()).abs();
        if x.is_finite() && E::splat(0.0).less(x) {
            return x;
        }
    }
}

/// A power of two that is normal, or 2ⁿ within `range`.
fn power_of_two<E: Format>(random: &mut Random) -> f64 {
    let range = -E::MIN_POSITIVE.log2() as usize;
    2f64.powi(random.below(2 * range - 1) as i32 - range as i32)
}

/// A number close to 1, by any power of two down to the last bit.
fn close_to_one<E: Format>(random: &mut Random) -> E {
    let gap = random.uniform(-1.0, 1.0) * 2f64.powi(-(random.below(54) as i32));
    E::splat((1.0 + gap).max(0.01))
}

/// A natural logarithm that a number of the format may have, a little beyond both ends included.
fn logarithm_in_range<E: Format>(random: &mut Random) -> f64 {
    let (low, high) = (E::SMALLEST.ln() - 1.5, E::LARGEST.ln() + 0.5);
    match random.below(4) {
        0 => low + random.uniform(0.0, 3.0),
        1 => high - random.uniform(0.0, 3.0),
        2 => E::MIN_POSITIVE.ln() + random.uniform(-1.0, 1.0),
        _ => random.uniform(low, high),
    }
}

/// One pair of arguments; what takes one argument ignores the second.
fn draw<E: Format>(function: Function, region: Region, random: &mut Random) -> (E, E) {
    let ignored = E::splat(1.0);
    match (function, region) {
        (Exp, Region::Ordinary) => (E::splat(random.uniform(-20.0, 20.0)), ignored),
        (_, Region::Wide) if function.is_exponential() => {
            let tiny = random.uniform(-1.0, 1.0) * power_of_two::<E>(random).min(1.0);
            let wide = logarithm_in_range::<E>(random);
            (E::splat(if random.once_in(2) { tiny } else { wide }), ignored)
        }
        (_, Region::Critical) if function.is_exponential() && (function == Exp || random.once_in(2)) => {
            // Halfway between multiples of ln 2 the next multiple is taken.
            let halves = (logarithm_in_range::<E>(random) / LN_2 * 2.0).round();
            (near(halves * LN_2 / 2.0, random), ignored)
        }
        (Powf, Region::Ordinary) => {
            (E::splat(random.uniform(0.05, 20.0)), E::splat(EXPONENTS[random.below(EXPONENTS.len())]))
        }
        (Powf, Region::Wide) => {
            let x: E = positive(random);
            (x, E::splat(logarithm_in_range::<E>(random) / x.widen().ln()))
        }
        (Powf, Region::Critical) => {
            let x = match random.below(4) {
                0 => close_to_one(random),
                1 => near([SQRT_2, 1.0 / SQRT_2][random.below(2)], random),
                2 => E::splat(random.uniform(0.7, 1.5)),
                _ => critical(random),
            };
            let whole = E::splat(random.below(41) as f64 - 20.0);
            let extreme = E::splat(logarithm_in_range::<E>(random) / x.widen().ln());
            (x, if random.once_in(8) || !extreme.is_finite() { whole } else { extreme })
        }
        (ExpM1 | Ln1p | Sinh | Cosh | Tanh | Asinh | Sin | Cos | Atan | Erf | Softplus | Sigmoid, region) => {
            (draw_signed(function, region, random), ignored)
        }
        (_, Region::Ordinary) => (E::splat(random.uniform(0.05, 20.0)), ignored),
        (_, Region::Wide) => (positive(random), ignored),
        (Cbrt, Region::Critical) if random.once_in(2) => {
            let root = random.below(200_000) as f64;
            (near(root * root * root, random), ignored)
        }
        (Ln, Region::Critical) if random.once_in(2) => (close_to_one(random), ignored),
        (_, Region::Critical) => (critical(random), ignored),
    }
}

/// The largest argument for which `Real` promises the digits of sin and cos.
fn last_exact_turn<E: Format>() -> f64 {
    if E::UNIT_ROUNDOFF < 1e-10 { 1.6e6 } else { 1600.0 }
}

/// An argument of a function that takes either sign.
fn draw_signed<E: Format>(function: Function, region: Region, random: &mut Random) -> E {
    let sign = if random.once_in(2) { 1.0 } else { -1.0 };
    let switches = function.switches();
    match (function, region) {
        (Ln1p, Region::Ordinary) => E::splat(random.uniform(-0.95, 20.0)),
        (_, Region::Ordinary) => E::splat(random.uniform(-20.0, 20.0)),
        (Ln1p, Region::Wide) if random.once_in(2) => positive(random),
        (Ln1p, Region::Wide) => {
            E::splat(-1.0 + random.uniform(0.0, 1.0) * 2f64.powi(-(random.below(30) as i32)))
        }
        (Sin | Cos, Region::Wide) => {
            // Evenly on the scale of logarithms, and evenly.
            let end = last_exact_turn::<E>();
            let magnitude = if random.once_in(2) {
                end * 2f64.powf(-random.uniform(0.0, 60.0))
            } else {
                random.uniform(0.0, end)
            };
            E::splat(sign * magnitude)
        }
        (Sin | Cos, Region::Critical) => {
            // Multiples of π/4: zeros of the function and of its derivative, and where the quadrant changes.
            let turns = last_exact_turn::<E>() / FRAC_PI_4;
            let few = if random.once_in(2) { 40.0 } else { turns };
            near(sign * random.uniform(0.0, few).floor() * FRAC_PI_4, random)
        }
        (_, Region::Critical) if !switches.is_empty() && random.once_in(2) => {
            let switch = switches[random.below(switches.len())];
            let beside = switch * (1.0 + random.uniform(-1.0, 1.0) * 2f64.powi(-(random.below(50) as i32)));
            E::splat(if matches!(function, Ln1p) { beside.max(-0.9999) } else { sign * beside })
        }
        (Ln1p, Region::Critical) => E::splat(random.uniform(-0.6, 1.5)),
        (Asinh, Region::Critical) => E::splat(sign * 2f64.powf(random.uniform(-30.0, 40.0))),
        (Atan | Erf, Region::Critical) => E::splat(sign * 2f64.powf(random.uniform(-10.0, 4.0))),
        (_, Region::Critical) => E::splat(random.uniform(-2.0, 2.0)),
        (_, Region::Wide) => {
            let x: E = positive(random);
            E::splat(sign * x.widen())
        }
    }
}

/// A boundary between two reductions, times a power of two.
fn critical<E: Format>(random: &mut Random) -> E {
    let boundary = [0.75, 1.0, 1.5, SQRT_2, 5.0 / 3.0][random.below(5)];
    near(boundary * power_of_two::<E>(random), random)
}

/// |found − exact| in units in the last place of the exact value; ∞ counts as the power of two after the largest number.
fn error<E: Format>(found: E, exact: Exact) -> f64 {
    let found = found.widen();
    if found.is_nan() || !exact.is_finite() {
        return f64::INFINITY;
    }
    let last_unit = |magnitude: f64| {
        let power = f64::from_bits(magnitude.to_bits() & f64::INFINITY.to_bits());
        (power * (2.0 * E::UNIT_ROUNDOFF)).max(E::SMALLEST)
    };
    let end = Exact::splat(E::LARGEST) + Exact::splat(last_unit(E::LARGEST));
    let found_magnitude = if found.is_infinite() { end } else { Exact::splat(found.abs()) };
    let exact_magnitude = exact.abs().min(end);
    if found != 0.0 && exact.to_f64().is_sign_negative() != found.is_sign_negative() {
        return f64::INFINITY;
    }
    let unit = last_unit(exact_magnitude.to_f64().min(E::LARGEST));
    ((found_magnitude - exact_magnitude) / Exact::splat(unit)).abs().to_f64()
}

#[track_caller]
fn judge<E: Scalar + Format>() {
    let mut failures = Vec::new();
    for &function in ALL {
        for region in [Region::Ordinary, Region::Wide, Region::Critical] {
            let mut random = Random::new(5);
            let arguments: Vec<(E, E)> = std::iter::repeat_with(|| draw::<E>(function, region, &mut random))
                .filter(|(x, _)| function.promises::<E>(x.widen()))
                .take(SAMPLES)
                .collect();
            let exact: Vec<_> = arguments.iter().map(|(x, y)| function.exact(x.widen(), y.widen())).collect();
            for (name, values) in by_every_way(function, &arguments) {
                let errors = values.iter().zip(&exact).map(|(&found, &exact)| error(found, exact));
                let (worst, (x, y)) = errors
                    .zip(&arguments)
                    .max_by(|(a, _), (b, _)| a.total_cmp(b))
                    .expect("there are samples");
                let line = format!(
                    "{} {:15} {:9} {name:9} {worst:8.3} at {x:e}, {y:e}",
                    E::NAME,
                    format!("{function:?}"),
                    format!("{region:?}"),
                    x = x.widen(),
                    y = y.widen(),
                );
                println!("{line}");
                if worst > function.bound() {
                    failures.push(line);
                }
            }
        }
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

#[test]
fn doubles_are_within_the_promised_units() {
    judge::<f64>();
}

#[test]
fn floats_are_within_the_promised_units() {
    judge::<f32>();
}

/// sin and cos of numbers beyond those for which digits are promised.
fn judge_large_turns<E: Scalar + Format>(largest: f64) {
    let mut random = Random::new(7);
    let arguments: Vec<(E, E)> = (0..SAMPLES)
        .map(|_| {
            let scale = 2f64.powf(random.uniform(0.0, largest.log2()));
            (
                E::splat(if random.once_in(4) { positive::<E>(&mut random).widen() } else { scale }),
                E::splat(1.0),
            )
        })
        .collect();
    for function in [Sin, Cos] {
        for (name, values) in by_every_way(function, &arguments) {
            for (value, (x, _)) in values.into_iter().zip(&arguments) {
                let (value, x) = (value.widen(), x.widen());
                assert!(value.abs() <= 1.0, "{function:?} {x:e} is {value} by {name}");
                if x <= largest {
                    let distance = (function.exact(x, 1.0) - Exact::splat(value)).abs().to_f64();
                    let bound = 4.0 * E::UNIT_ROUNDOFF * (x + 1.0);
                    assert!(distance <= bound, "{function:?} {x:e} errs by {distance:e} by {name}");
                }
            }
        }
    }
}

#[test]
fn sine_and_cosine_of_large_numbers_are_those_of_a_neighbour() {
    judge_large_turns::<f64>(2f64.powi(50));
    judge_large_turns::<f32>(2f64.powi(21));
}

/// Values at 0, ±∞ and NaN, with the sign of a zero.
fn judge_special<E: Scalar + Format>() {
    let (infinity, nan) = (f64::INFINITY, f64::NAN);
    let half_pi = E::splat(std::f64::consts::FRAC_PI_2).widen();
    let ln_2 = E::splat(LN_2).widen();
    for (function, at_zero, at_minus_zero, at_infinity, at_minus_infinity) in [
        (ExpM1, 0.0, -0.0, infinity, -1.0),
        (Ln1p, 0.0, -0.0, infinity, nan),
        (Sinh, 0.0, -0.0, infinity, -infinity),
        (Cosh, 1.0, 1.0, infinity, infinity),
        (Tanh, 0.0, -0.0, 1.0, -1.0),
        (Asinh, 0.0, -0.0, infinity, -infinity),
        (Sin, 0.0, -0.0, nan, nan),
        (Cos, 1.0, 1.0, nan, nan),
        (Atan, 0.0, -0.0, half_pi, -half_pi),
        (Erf, 0.0, -0.0, 1.0, -1.0),
        (Softplus, ln_2, ln_2, infinity, 0.0),
        (Sigmoid, 0.5, 0.5, 1.0, 0.0),
    ] {
        let cases = [
            (0.0, at_zero),
            (-0.0, at_minus_zero),
            (infinity, at_infinity),
            (-infinity, at_minus_infinity),
            (nan, nan),
            (-1.0, -infinity),
        ];
        // The last one is about one function.
        let cases = &cases[..if function == Ln1p { 6 } else { 5 }];
        let arguments: Vec<_> = cases.iter().map(|&(x, _)| (E::splat(x), E::splat(1.0))).collect();
        for (name, values) in by_every_way(function, &arguments) {
            for (value, (x, expected)) in values.into_iter().zip(cases) {
                let value = value.widen();
                let same = value.is_nan() && expected.is_nan() || value.to_bits() == expected.to_bits();
                assert!(same, "{function:?} {x} is {value} and not {expected} by {name}");
            }
        }
    }
}

#[test]
fn values_at_zero_and_infinity_are_exact() {
    judge_special::<f64>();
    judge_special::<f32>();
}

fn judge_parity<E: Scalar + Format>() {
    let mut random = Random::new(11);
    for function in [Sinh, Tanh, Asinh, Sin, Atan, Erf, Cosh, Cos] {
        let sign = if matches!(function, Cosh | Cos) { 1.0 } else { -1.0 };
        for region in [Region::Ordinary, Region::Wide, Region::Critical] {
            let arguments: Vec<(E, E)> =
                std::iter::repeat_with(|| draw(function, region, &mut random)).take(512).collect();
            let opposite: Vec<_> = arguments.iter().map(|&(x, y)| (-x, y)).collect();
            let ways = by_every_way(function, &arguments).zip(by_every_way(function, &opposite));
            for ((name, values), (_, mirrored)) in ways {
                for ((value, mirrored), (x, _)) in values.into_iter().zip(mirrored).zip(&arguments) {
                    let (value, expected) = (value.widen(), sign * mirrored.widen());
                    assert_eq!(value.to_bits(), expected.to_bits(), "{function:?} {x:?} by {name}");
                }
            }
        }
    }
}

#[test]
fn odd_and_even_functions_are_so_to_the_last_bit() {
    judge_parity::<f64>();
    judge_parity::<f32>();
}
