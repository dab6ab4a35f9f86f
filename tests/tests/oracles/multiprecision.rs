//! Known constants, and identities that no single mistake leaves intact.

use piola::Real;
use piola_tests::multiprecision::Multiprecision;
use piola_tests::random::polynomial::Function;

type Number = Multiprecision<6>;

fn number(value: f64) -> Number {
    Number::splat(value)
}

/// A constant from its decimal digits: `units.fraction`.
fn decimal(text: &str) -> Number {
    let ten = number(10.0);
    let places = text.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let digits = text.bytes().filter(u8::is_ascii_digit);
    let whole = digits.fold(number(0.0), |value, digit| value * ten + number(f64::from(digit - b'0')));
    (0..places).fold(whole, |value, _| value / ten)
}

/// Within `units` of the type's unit roundoff, relative to the expected value.
#[track_caller]
fn close(found: Number, expected: Number, units: f64) {
    let error = ((found - expected) / expected).abs().to_f64() / Number::UNIT_ROUNDOFF;
    assert!(error <= units, "{found:?} instead of {expected:?}: {error} units");
}

/// The constants below have 116 digits, one more than 384 bits hold; their own rounding is a unit at most.
const UNITS: f64 = 2.0;

const E: &str = "2.7182818284590452353602874713526624977572470936999595749669676277240766303535475945713821785251664274274663919320031";
const LN_2: &str = "0.69314718055994530941723212145817656807550013436025525412068000949339362196969471560586332699641868754200148102057068573";
const LN_10: &str = "2.3025850929940456840179914546843642076011014886287729760333279009675726096773524802359972050895982983419677840422862";
const SQRT_2: &str = "1.4142135623730950488016887242096980785696718753769480731766797379907324784621070388503875343276415727350138462309123";
const CBRT_2: &str = "1.2599210498948731647672106072782283505702514647015079800819751121552996765139594837293965624362550941543102560356157";

#[test]
fn known_constants() {
    close(number(1.0).exp(), decimal(E), UNITS);
    close(number(2.0).ln(), decimal(LN_2), UNITS);
    close(number(10.0).ln(), decimal(LN_10), UNITS);
    close(number(2.0).sqrt(), decimal(SQRT_2), UNITS);
    close(number(2.0).cbrt(), decimal(CBRT_2), UNITS);
    close(number(2.0).powf(number(1.0) / number(3.0)), decimal(CBRT_2), UNITS);
}

/// Functions, arguments, and values with 125 digits from mpmath 1.3.
const VALUES: &str = include_str!("../../reference/functions.txt");

#[test]
fn known_values() {
    for line in VALUES.lines() {
        let words: Vec<_> = line.split(' ').collect();
        let [name, x, digits] = words[..] else { panic!("not three words: {line}") };
        let function = Function::ALL.iter().find(|function| function.name() == name).expect("a function");
        let x: f64 = x.parse().expect("a number");
        let (sign, digits) = digits.strip_prefix('-').map_or((1.0, digits), |digits| (-1.0, digits));
        let expected = number(sign) * decimal(digits);
        // The reduction of x for sin and cos, and the 1 that ln(1 + x) adds, are absolute errors.
        let condition = (1.0 + x.abs()) * (1.0 + 1.0 / expected.to_f64().abs());
        close(function.of(number(x)), expected, UNITS * condition);
    }
}

#[test]
fn functions_of_small_numbers_keep_their_digits() {
    let x = number(2f64.powi(-150));
    let one = number(1.0);
    // The next term of each series is less than 2⁻²⁹⁹ of the first.
    let next = 2f64.powi(-299) / Number::UNIT_ROUNDOFF;
    let (square, half) = (x * x / number(2.0), x / number(2.0));
    close(x.exp_m1(), x + square, next);
    close((-x).exp_m1(), square - x, next);
    close(x.ln_1p(), x - square, next);
    close((-x).ln_1p(), -x - square, next);
    close(x.cosh() - one, square, 2f64.powi(301)); // digits that 1 takes
    for odd in [Number::sinh, Number::tanh, Number::asinh, Number::sin, Number::atan] {
        close(odd(x), x, next);
        close(odd(-x), -x, next);
    }
    close(x.erf(), x / one.atan().sqrt(), next);
    close(x.sigmoid(), (one + half) / number(2.0), UNITS * 2.0);
    for vanishing in [Number::exp_m1, Number::ln_1p, Number::sinh, Number::sin, Number::atan, Number::erf] {
        assert_eq!(vanishing(number(0.0)).to_f64(), 0.0);
    }
}

#[test]
fn functions_of_large_numbers_reach_their_limits() {
    let (large, one) = (number(1e30), number(1.0));
    for (function, limit) in
        [(Number::tanh as fn(Number) -> Number, one), (Number::erf, one), (Number::sigmoid, one)]
    {
        close(function(large), limit, UNITS);
    }
    close(large.softplus(), large, UNITS);
    assert_eq!((-large).softplus().to_f64(), 0.0);
    assert_eq!((-large).sigmoid().to_f64(), 0.0);
    close((-large).exp_m1(), -one, UNITS);
    assert!(!large.sin().is_finite() && !(-one - one).ln_1p().is_finite());
}

#[test]
fn arithmetic_inverts_itself() {
    let (a, b) = (decimal(E), -decimal(SQRT_2));
    for (a, b) in [(a, b), (b, a), (a * a, b * b), (number(1e-200), a), (a, number(1e-300) * b)] {
        close(a * b / b, a, 1.0);
        close(a / b * b, a, 1.0);
        close((a + b) * (a - b) + b * b, a * a, 4.0 * (1.0 + (b / a * (b / a)).to_f64().abs()));
        close(a.abs().sqrt() * a.abs().sqrt(), a.abs(), 1.0);
        close(a.cbrt() * a.cbrt() * a.cbrt(), a, 1.0);
    }
}

#[test]
fn subtraction_of_close_numbers_is_exact() {
    let tiny = number(2f64.powi(-300));
    let one = number(1.0);
    assert_eq!(((one + tiny) - one).to_f64(), tiny.to_f64());
    assert_eq!((one - (one - tiny)).to_f64(), tiny.to_f64());
    assert_eq!((one - one).to_f64(), 0.0);
    // Below the last bit of the larger one, the smaller disappears.
    assert_eq!(((one + number(2f64.powi(-500))) - one).to_f64(), 0.0);
}

#[test]
fn exponential_and_logarithm_invert_each_other() {
    for x in [1e-30, 0.1, 0.5, 1.0 - 1e-16, 1.0 + 1e-15, 3.0, 1e10, 1e300] {
        let x = number(x);
        let logarithm = x.ln();
        close(logarithm.exp(), x, 2.0 * (1.0 + logarithm.to_f64().abs()));
        close((number(0.3) * logarithm).exp(), x.powf(number(0.3)), 2.0 * (1.0 + logarithm.to_f64().abs()));
    }
    // ln(1 + t) = t − t²/2 + … keeps its relative accuracy where 1 + t keeps t.
    let t = number(2f64.powi(-150));
    let series = t - t * t / number(2.0) + t * t * t / number(3.0);
    close((number(1.0) + t).ln(), series, 2f64.powi(150));
}

#[test]
fn product_and_error_are_exact() {
    let (a, b) = (decimal(E), decimal(LN_10));
    let (product, error) = a.two_product(b);
    assert!(error.abs().to_f64() <= product.to_f64() * 2f64.powi(-383));
    // The same product in twice the precision.
    let widen = |mut x: Number| {
        let mut wide = Multiprecision::<12>::splat(0.0);
        while x.to_f64() != 0.0 {
            let part = x.to_f64();
            (wide, x) = (wide + Multiprecision::splat(part), x - number(part));
        }
        wide
    };
    let difference = widen(a) * widen(b) - (widen(product) + widen(error));
    assert_eq!(difference.to_f64(), 0.0);
}

#[test]
fn conversion_keeps_every_f64() {
    for x in [0.1, -1.5, f64::MAX, f64::MIN_POSITIVE, 5e-324, -1e-310, 0.0] {
        assert_eq!(number(x).to_f64(), x);
    }
    assert!(number(f64::NAN).to_f64().is_nan());
    assert_eq!((number(f64::MAX) * number(2.0)).to_f64(), f64::INFINITY);
}

#[test]
fn order_signs_and_what_is_not_a_number() {
    let nan = number(1.0) / number(0.0);
    assert!(!nan.is_finite() && !nan.less(number(1.0)) && !number(1.0).less(nan));
    assert_eq!(nan.max(number(2.0)).to_f64(), 2.0);
    assert_eq!(number(2.0).min(nan).to_f64(), 2.0);
    let ascending = [-3.0, -0.5, -1e-300, 0.0, 1e-300, 0.5, 0.75, 3.0];
    for (i, &a) in ascending.iter().enumerate() {
        for (j, &b) in ascending.iter().enumerate() {
            assert_eq!(number(a).less(number(b)), i < j, "{a} < {b}");
            assert_eq!(number(a).max(number(b)).to_f64(), a.max(b));
            assert_eq!(number(a).min(number(b)).to_f64(), a.min(b));
        }
    }
    assert_eq!(number(2.0).copysign(number(-0.0)).to_f64(), -2.0);
    assert!(!number(-1.0).ln().is_finite() && !number(-1.0).sqrt().is_finite());
    let (scale, back) = number(-12.0).power_of_two_scale();
    assert_eq!((scale.to_f64(), back.to_f64()), (0.125, 8.0));
}
