//! Elementary functions of every back end against 192 bits, in units in the last place:
//! `cargo test -p piola-tests --test elementary -- --nocapture` prints the worst errors and where they are.
//!
//! `PIOLA_SAMPLES` multiplies the number of arguments, for a longer search.

#![expect(clippy::print_stdout, reason = "a table to show")]

use std::f64::consts::{LN_2, SQRT_2};

use piola::Real;
use piola::lanes::{Backend, Kernel, Lanes, Scalar};
use piola::random::Random;
use piola_tests::bits::Precision;
use piola_tests::multiprecision::Multiprecision;

/// Arguments of each function and region.
const SAMPLES: usize = 6144;

type Exact = Multiprecision<3>;

/// A function of one argument, or of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Function {
    Exp,
    Ln,
    Powf,
    Cbrt,
    Sqrt,
    ReciprocalSqrt,
    RoughSqrt,
}

use Function::{Cbrt, Exp, Ln, Powf, ReciprocalSqrt, RoughSqrt, Sqrt};

impl Function {
    const ALL: [Self; 7] = [Exp, Ln, Powf, Cbrt, Sqrt, ReciprocalSqrt, RoughSqrt];

    #[inline(always)]
    fn of<R: Real>(self, x: R, y: R) -> R {
        match self {
            Exp => x.exp(),
            Ln => x.ln(),
            Powf => x.powf(y),
            Cbrt => x.cbrt(),
            Sqrt => x.sqrt(),
            ReciprocalSqrt => x.reciprocal_sqrt(),
            RoughSqrt => x.rough_sqrt(),
        }
    }

    /// To some 180 bits.
    fn exact(self, x: f64, y: f64) -> Exact {
        let (x, y) = (Exact::splat(x), Exact::splat(y));
        match self {
            ReciprocalSqrt => Exact::splat(1.0) / x.sqrt(),
            RoughSqrt => x.sqrt(),
            function => function.of(x, y),
        }
    }

    /// Whether `Real` promises digits at x > 0.
    fn promises(self, x: f64, min_positive: f64) -> bool {
        !matches!(self, ReciprocalSqrt | RoughSqrt) || x >= min_positive
    }

    /// What `Real` promises, in units in the last place.
    fn bound<E: Precision>(self) -> f64 {
        match self {
            Exp | Ln | Powf | Cbrt => 1.5,
            Sqrt => 0.5,
            ReciprocalSqrt => 2.0,
            // A relative error ε is less than ε/u units.
            RoughSqrt => 2f64.powi(-12) / E::UNIT_ROUNDOFF,
        }
    }
}

/// Where arguments come from.
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
fn near<E: Precision>(value: f64, random: &mut Random) -> E {
    let steps = random.below(9) as f64 - 4.0;
    E::splat(value + value * steps * 2.0 * E::UNIT_ROUNDOFF)
}

/// A finite pattern of bits that is positive.
fn positive<E: Precision>(random: &mut Random) -> E {
    loop {
        let x = E::from_bits(random.bits()).abs();
        if x.is_finite() && E::splat(0.0).less(x) {
            return x;
        }
    }
}

/// A power of two that is normal, or 2ⁿ within `range`.
fn power_of_two<E: Precision>(random: &mut Random) -> f64 {
    let range = -E::MIN_POSITIVE.log2() as usize;
    2f64.powi(random.below(2 * range - 1) as i32 - range as i32)
}

/// A number close to 1, by any power of two down to the last bit.
fn close_to_one<E: Precision>(random: &mut Random) -> E {
    let gap = random.uniform(-1.0, 1.0) * 2f64.powi(-(random.below(54) as i32));
    E::splat((1.0 + gap).max(0.01))
}

/// A natural logarithm that a number of the format may have, a little beyond both ends included.
fn logarithm_in_range<E: Precision>(random: &mut Random) -> f64 {
    let (low, high) = (E::SMALLEST.ln() - 1.5, E::LARGEST.ln() + 0.5);
    match random.below(4) {
        0 => low + random.uniform(0.0, 3.0),
        1 => high - random.uniform(0.0, 3.0),
        2 => E::MIN_POSITIVE.ln() + random.uniform(-1.0, 1.0),
        _ => random.uniform(low, high),
    }
}

/// One pair of arguments; what takes one argument ignores the second.
fn draw<E: Precision>(function: Function, region: Region, random: &mut Random) -> (E, E) {
    let ignored = E::splat(1.0);
    match (function, region) {
        (Exp, Region::Ordinary) => (E::splat(random.uniform(-20.0, 20.0)), ignored),
        (Exp, Region::Wide) => {
            let tiny = random.uniform(-1.0, 1.0) * power_of_two::<E>(random).min(1.0);
            let wide = logarithm_in_range::<E>(random);
            (E::splat(if random.once_in(2) { tiny } else { wide }), ignored)
        }
        (Exp, Region::Critical) => {
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

/// A boundary between two reductions, times a power of two.
fn critical<E: Precision>(random: &mut Random) -> E {
    let boundary = [0.75, 1.0, 1.5, SQRT_2, 5.0 / 3.0][random.below(5)];
    near(boundary * power_of_two::<E>(random), random)
}

/// A function at pairs of arguments, as many as there are in whole blocks.
struct Apply<'a, E> {
    function: Function,
    arguments: &'a [(E, E)],
}

impl<E: Scalar> Kernel<E> for Apply<'_, E> {
    type Output = Vec<E>;

    #[inline(always)]
    fn run<R: Lanes<Scalar = E>>(self) -> Vec<E> {
        let (x, y): (Vec<E>, Vec<E>) = self.arguments.iter().copied().unzip();
        let mut values = vec![E::default(); x.len()];
        for start in (0..x.len()).step_by(R::LANES) {
            let (x, y) = (R::load(&x[start..]), R::load(&y[start..]));
            self.function.of(x, y).store(&mut values[start..]);
        }
        values
    }
}

/// How a kernel can be run: by each back end, and one number at a time.
fn ways() -> impl Iterator<Item = Option<Backend>> {
    Backend::available().map(Some).chain([None])
}

fn name(way: Option<Backend>) -> &'static str {
    way.map_or("scalar", Backend::name)
}

fn apply<E: Scalar>(way: Option<Backend>, function: Function, arguments: &[(E, E)]) -> Vec<E> {
    let kernel = Apply { function, arguments };
    match way {
        Some(backend) => backend.run(kernel),
        None => kernel.run::<E>(),
    }
}

/// |found − exact| in units in the last place of the exact value; ∞ counts as the power of two after the largest number.
fn error<E: Precision>(found: E, exact: Exact) -> f64 {
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

fn samples() -> usize {
    let factor = std::env::var("PIOLA_SAMPLES").ok().and_then(|text| text.parse().ok()).unwrap_or(1);
    SAMPLES * factor
}

#[track_caller]
fn judge<E: Scalar + Precision>() {
    let mut failures = Vec::new();
    for function in Function::ALL {
        for region in [Region::Ordinary, Region::Wide, Region::Critical] {
            let mut random = Random::new(5);
            let arguments: Vec<(E, E)> = std::iter::repeat_with(|| draw::<E>(function, region, &mut random))
                .filter(|(x, _)| function.promises(x.widen(), E::MIN_POSITIVE))
                .take(samples())
                .collect();
            let exact: Vec<_> = arguments.iter().map(|(x, y)| function.exact(x.widen(), y.widen())).collect();
            for way in ways() {
                let values = apply(way, function, &arguments);
                let errors = values.iter().zip(&exact).map(|(&found, &exact)| error(found, exact));
                let (worst, (x, y)) = errors
                    .zip(&arguments)
                    .max_by(|(a, _), (b, _)| a.total_cmp(b))
                    .expect("there are samples");
                let line = format!(
                    "{} {:15} {:9} {:9} {worst:8.3} at {x:e}, {y:e}",
                    E::NAME,
                    format!("{function:?}"),
                    format!("{region:?}"),
                    name(way),
                    x = x.widen(),
                    y = y.widen(),
                );
                println!("{line}");
                if worst > function.bound::<E>() {
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
