//! Powers with a whole exponent that is known at run time, and their divided differences.

use crate::lanes::Real;

/// Derivative by x of the given order k of xⁿ, n (n − 1) … (n − k + 1) xⁿ⁻ᵏ: zero for k > n, and exact at x =
/// 0.
#[inline(always)]
pub fn whole_power<R: Real>(x: R, n: u32, order: u32) -> R {
    let Some(exponent) = n.checked_sub(order) else { return R::splat(0.0) };
    R::splat(falling(n, order)) * power(x, exponent)
}

/// Divided difference of the derivative of the given order k of xⁿ, between a and b: n (n − 1) … (n − k + 1)
/// Σ aᵐ⁻¹⁻ʲ bʲ with m = n − k and j from 0 to m − 1.
///
/// The sum h(m) is built from the highest bit of m on, with h(2 j) = h(j) (aʲ + bʲ) and h(j + 1) = h(j) a +
/// bʲ: nothing is subtracted, and no gap is divided by.
#[inline(always)]
pub fn whole_power_quotient<R: Real>([a, b]: [R; 2], n: u32, order: u32) -> R {
    let exponent = n.saturating_sub(order);
    let mut sum = R::splat(0.0);
    let mut powers = [R::splat(1.0); 2];
    for shift in (0..u32::BITS - exponent.leading_zeros()).rev() {
        let [a_power, b_power] = powers;
        sum = sum * (a_power + b_power);
        let squares = [a_power * a_power, b_power * b_power];
        powers = squares;
        if exponent >> shift & 1 == 1 {
            sum = sum.mul_add(a, squares[1]);
            powers = [squares[0] * a, squares[1] * b];
        }
    }
    R::splat(falling(n, order)) * sum
}

/// xⁿ by repeated squaring.
#[inline(always)]
fn power<R: Real>(x: R, n: u32) -> R {
    let (mut result, mut square, mut rest) = (R::splat(1.0), x, n);
    loop {
        if rest & 1 == 1 {
            result = result * square;
        }
        rest >>= 1;
        if rest == 0 {
            return result;
        }
        square = square * square;
    }
}

/// n (n − 1) … (n − order + 1).
#[inline(always)]
fn falling(n: u32, order: u32) -> f64 {
    (0..order).map(|k| f64::from(n) - f64::from(k)).product()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Integers, of which all powers here are exact.
    #[test]
    fn powers_of_small_integers_are_exact() {
        for x in [-3i64, -1, 0, 1, 2, 5] {
            for n in 0..12u32 {
                let slope = |n: u32| if n == 0 { 0 } else { i64::from(n) * x.pow(n - 1) };
                let curvature = if n == 0 { 0 } else { i64::from(n) * slope(n - 1) };
                let expected = [x.pow(n), slope(n), curvature];
                let found = [0, 1, 2].map(|order| whole_power(x as f64, n, order));
                assert_eq!(found, expected.map(|value| value as f64), "{x}, {n}");
            }
        }
    }

    #[test]
    fn quotients_of_small_integers_are_exact() {
        for (a, b) in [(3i64, 1i64), (2, -1), (0, 4), (-2, -3), (5, -5)] {
            for n in 0..10u32 {
                let slope = |x: i64| if n == 0 { 0 } else { i64::from(n) * x.pow(n - 1) };
                let expected = [(a.pow(n) - b.pow(n)) / (a - b), (slope(a) - slope(b)) / (a - b)];
                let found = [0, 1].map(|order| whole_power_quotient([a as f64, b as f64], n, order));
                assert_eq!(found, expected.map(|value| value as f64), "{a}, {b}, {n}");
            }
        }
    }

    /// Between values of one sign all terms have one sign: the error is a few u for each factor.
    #[test]
    fn quotients_are_accurate_at_every_gap() {
        let mut random = Random::new(3);
        for _ in 0..1000 {
            let (a, n) = (random.uniform(0.0, 3.0), random.below(20) as u32);
            let b = a * (1.0 + 10f64.powf(random.uniform(-18.0, 0.0)));
            for order in 0..3 {
                let m = n.saturating_sub(order) as i32;
                let terms = (0..m).map(|k| a.powi(m - 1 - k) * b.powi(k));
                let expected = falling(n, order) * terms.sum::<f64>();
                let found = whole_power_quotient([a, b], n, order);
                let tolerance = f64::EPSILON * f64::from(m) * expected.abs();
                assert!(
                    (found - expected).abs() <= tolerance,
                    "{a}, {b}, {n}, {order}: {found} for {expected}"
                );
            }
            // The limit is the derivative, to rounding.
            let (found, slope) = (whole_power_quotient([a, a], n, 1), whole_power(a, n, 2));
            assert!((found - slope).abs() <= f64::EPSILON * f64::from(n) * slope.abs(), "{a}, {n}");
        }
    }
}
