//! Exponential, logarithm and powers, written once for scalars and lanes.
//!
//! A power is e^(y ln x), and an error of the logarithm is multiplied by y ln x, which reaches 745. So logarithms come
//! with ten more digits than the format has, as an unevaluated sum of two numbers, and one of them serves all
//! powers of a base. There are no tables, since lanes would have to gather from them, and no branch.
//!
//! Coefficients are minimax fits of the series' tails on the stated intervals. The leading terms stay exact, so that the
//! functions are exact where they should be: ln 1 = 0, e⁰ = 1, x⁰ = 1, 1ʸ = 1.
//!
//! \[CW80\] Cody, Waite, *Software Manual for the Elementary Functions*, 1980, for the splitting of ln 2.

use super::Real;
use super::primitive::Primitive;
use super::scalar::Element;

/// ln x as the unevaluated sum of two numbers, |low| ≤ u |high|; ±the largest finite number for x = ∞ and 0.
#[derive(Clone, Copy, Debug)]
pub struct Logarithm<P> {
    high: P,
    low: P,
}

/// ln 2 = HIGH + LOW, and HIGH times an exponent is exact [CW80].
struct Ln2;

impl Ln2 {
    const fn parts(is_single: bool) -> (f64, f64) {
        if is_single {
            (0.693_145_751_953_125, 1.428_606_820_309_417_2e-6)
        } else {
            (6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10)
        }
    }
}

const fn is_single<P: Primitive>() -> bool {
    <P::Format as Element>::UNIT_ROUNDOFF > 1e-10
}

/// Σ cₖ xᵏ by Horner's rule.
#[inline(always)]
fn polynomial<P: Primitive>(x: P, coefficients: &[f64]) -> P {
    let [rest @ .., last] = coefficients else { return P::fill(0.0) };
    rest.iter().rev().fold(P::fill(*last), |sum, &c| sum.mul_add(x, P::fill(c)))
}

/// a + b as a rounded value and its error, for |a| ≥ |b| or a = 0 [Dekker 1971].
#[inline(always)]
fn quick_two_sum<P: Primitive>(a: P, b: P) -> (P, P) {
    let sum = a + b;
    (sum, (a - sum) + b)
}

/// a b as a rounded value and its error, for factors of moderate size.
#[inline(always)]
fn product<P: Primitive>(a: P, b: P) -> (P, P) {
    Real::two_product(a, b)
}

/// (2 artanh s − 2 s − ⅔ s³)/s⁵ as a polynomial in s², for −1/7 ≤ s ≤ 1/5.
#[inline(always)]
fn artanh_tail<P: Primitive>(z: P) -> P {
    const SINGLE: [f64; 4] = [
        0.399_999_935_905_296_43,
        0.285_725_777_434_561_44,
        0.221_517_853_316_112_43,
        0.199_616_369_215_287_23,
    ];
    const DOUBLE: [f64; 8] = [
        0.399_999_999_999_997_29,
        0.285_714_285_715_762_06,
        0.222_222_221_913_459_96,
        0.181_818_215_238_684_41,
        0.153_844_064_974_478_89,
        0.133_411_547_229_024_99,
        0.115_921_324_602_524_08,
        0.125_731_905_122_249_84,
    ];
    if is_single::<P>() { polynomial(z, &SINGLE) } else { polynomial(z, &DOUBLE) }
}

/// (eʳ − 1 − r)/r² as a polynomial, for |r| ≤ ½ ln 2.
#[inline(always)]
fn exponential_tail<P: Primitive>(r: P) -> P {
    const SINGLE: [f64; 5] = [
        0.500_000_009_289_306_6,
        0.166_665_198_515_652_23,
        0.041_666_209_983_332_37,
        0.008_368_813_311_009_207,
        0.001_395_031_273_899_549,
    ];
    const DOUBLE: [f64; 10] = [
        0.500_000_000_000_001_2,
        0.166_666_666_666_666_98,
        0.041_666_666_666_521_98,
        0.008_333_333_333_307_833,
        0.001_388_888_894_559_019_8,
        0.000_198_412_699_163_065_2,
        0.000_024_801_491_192_492_47,
        2.755_721_707_743_804_9e-6,
        2.763_089_745_842_593_8e-7,
        2.511_766_015_978_105_5e-8,
    ];
    if is_single::<P>() { polynomial(r, &SINGLE) } else { polynomial(r, &DOUBLE) }
}

/// ln x to a relative error of 2⁻⁶³ (`f32`: 2⁻³³); NaN for x < 0.
///
/// x = 2ᵉ m with ¾ ≤ m < 1½ and ln m = 2 artanh s, s = (m − 1)/(m + 1). The terms 2 s and ⅔ s³ are carried with their
/// errors; what is left is below 2⁻¹² of the result and needs none.
#[inline(always)]
pub(super) fn logarithm<P: Primitive>(x: P) -> Logarithm<P> {
    let (one, zero) = (P::fill(1.0), P::fill(0.0));

    // Subnormal numbers are brought among the normal ones first.
    let lift = if is_single::<P>() { 25.0 } else { 54.0 };
    let is_tiny = x.is_less(P::fill(<P::Format as Element>::MIN_POSITIVE));
    let lifted = P::choose(is_tiny, x * P::fill((1u64 << lift as u32) as f64), x);
    let (m, e) = lifted.split();
    let e = e - P::choose(is_tiny, P::fill(lift), zero);

    let f = m - one; // exact
    let (d, d_low) = quick_two_sum(P::fill(2.0), f);
    let reciprocal = one / d;
    let s = f * reciprocal;
    let (sd, sd_low) = product(s, d);
    let s_low = (((f - sd) - sd_low) - s * d_low) * reciprocal;

    let (z, z_low) = product(s, s);
    let z_low = (s + s).mul_add(s_low, z_low);
    let (cube, cube_low) = product(s, z);
    let cube_low = s.mul_add(z_low, s_low.mul_add(z, cube_low));
    const TWO_THIRDS: f64 = 2.0 / 3.0;
    let third = P::fill(TWO_THIRDS);
    let third_low = P::fill(if is_single::<P>() {
        TWO_THIRDS - (TWO_THIRDS as f32) as f64
    } else {
        3.700_743_415_417_188_5e-17
    });
    let (cubic, cubic_low) = product(third, cube);
    let cubic_low = third.mul_add(cube_low, third_low.mul_add(cube, cubic_low));
    let tail = (cube * z) * artanh_tail(z);

    let (ln2_high, ln2_low) = Ln2::parts(is_single::<P>());
    let (high, low) = quick_two_sum(e * P::fill(ln2_high), s + s);
    let (high, more_low) = quick_two_sum(high, cubic);
    let small = e.mul_add(P::fill(ln2_low), tail) + ((s_low + s_low) + cubic_low);
    let (high, low) = quick_two_sum(high, (low + more_low) + small);

    // Finite stand-ins for ∓∞, so that powers need no case of their own: 0 · MAX is 0, y · MAX is out of range.
    let largest = P::fill(<P::Format as Element>::MAX);
    let is_infinite = !x.is_less(P::fill(f64::INFINITY)) & zero.is_less(x);
    let is_positive = zero.is_less(x);
    let high = P::choose(is_infinite, largest, high);
    let low = P::choose(is_infinite | !is_positive, zero, low);
    let is_zero = !is_positive & !x.is_less(zero) & !is_nan(x);
    let outside = P::choose(is_zero, -largest, P::fill(f64::NAN));
    Logarithm { high: P::choose(is_positive, high, outside), low }
}

#[inline(always)]
fn is_nan<P: Primitive>(x: P) -> P::Choice {
    !x.is_less(P::fill(f64::INFINITY)) & !P::fill(0.0).is_less(x)
}

/// ln x.
#[inline(always)]
pub(super) fn ln<P: Primitive>(x: P) -> P {
    let Logarithm { high, low } = logarithm(x);
    let largest = P::fill(<P::Format as Element>::MAX);
    let infinity = P::fill(f64::INFINITY).with_sign(high);
    P::choose(high.magnitude().is_less(largest) | is_nan(high), high + low, infinity)
}

/// e^(high + low) for |low| ≤ u |high|.
///
/// k is the integer nearest to high / ln 2, and r = high − k ln 2 in two parts.
#[inline(always)]
fn exponential<P: Primitive>(high: P, low: P) -> P {
    // Beyond, the result is 0 or ∞ whatever else; as the second operand NaN comes through.
    let (bottom, top) = if is_single::<P>() { (-104.0, 89.0) } else { (-746.0, 710.0) };
    let bounded = P::fill(bottom).larger(P::fill(top).smaller(high));
    let low = P::choose(low.is_finite(), low, P::fill(0.0));

    let rounding = P::fill(<P::Format as Element>::ROUNDING);
    let k = bounded.mul_add(P::fill(std::f64::consts::LOG2_E), rounding) - rounding;
    let (ln2_high, ln2_low) = Ln2::parts(is_single::<P>());
    let reduced = bounded - k * P::fill(ln2_high); // exact
    let tail = k * P::fill(ln2_low);
    let r = reduced - tail;
    let r_low = ((reduced - r) - tail) + low;

    let correction = (r * r).mul_add(exponential_tail(r), r_low);
    (P::fill(1.0) + (r + correction)).scale(k)
}

/// e^x.
#[inline(always)]
pub(super) fn exp<P: Primitive>(x: P) -> P {
    exponential(x, P::fill(0.0))
}

/// x^exponent.
#[inline(always)]
pub(super) fn power<P: Primitive>(logarithm: Logarithm<P>, exponent: P) -> P {
    let (high, low) = product(logarithm.high, exponent);
    exponential(high, logarithm.low.mul_add(exponent, low))
}

/// ∛x = x^⅓, the exponent in two parts.
#[inline(always)]
pub(super) fn cbrt<P: Primitive>(x: P) -> P {
    const THIRD: f64 = 1.0 / 3.0;
    let third_low =
        if is_single::<P>() { THIRD - (THIRD as f32) as f64 } else { 1.850_371_707_708_594_2e-17 };
    let logarithm = logarithm(x.magnitude());
    let (high, low) = product(logarithm.high, P::fill(THIRD));
    let low = logarithm.low.mul_add(P::fill(THIRD), logarithm.high.mul_add(P::fill(third_low), low));
    let root = exponential(high, low);
    root.with_sign(x)
}

/// ln a − ln b.
#[inline(always)]
pub(super) fn logarithm_of_ratio<P: Primitive>(a: Logarithm<P>, b: Logarithm<P>) -> P {
    (a.high - b.high) + (a.low - b.low)
}
