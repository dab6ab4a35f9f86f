//! Derivatives by the values of a function that is a parameter, for which no declaration has a formula.

use piola::Real;

/// Weights w1, w2, w3 of the central difference of sixth order.
const WEIGHTS: [f64; 3] = [45.0 / 60.0, -9.0 / 60.0, 1.0 / 60.0];

/// Derivatives of each of N results by each value; NaN by a value next to which there are no results.
///
/// The difference of sixth order, with a step h,
///
/// ```text
/// g′(v) ≈ Σ wk (g(v + k h) − g(v − k h))/h,   k = 1, 2, 3,   w = 3/4, −3/20, 1/60
/// ```
///
/// has an error of h⁶ |g⁽⁷⁾|/140 and a rounding error of 2 Σ |wk| ε/h = 1.83 ε/h, where ε is that of g. The
/// step is 2⁻⁷ times the power of two below |v|, and 2⁻⁷ for v = 0. So a function that is linear in its
/// values, such as a spline, has the rounding error only, at most 470 ε/|v|; and where g varies as a power
/// vⁿ, the derivative errs by (n − 1) … (n − 6)/140 · 2⁻⁴², which is below 10⁻¹³ up to n = 7 and 10⁻¹⁰ up to
/// n = 10.
pub(super) fn by_values<const N: usize>(
    values: &[f64],
    results: impl Fn(&[f64]) -> Option<[f64; N]>,
) -> Vec<[f64; N]> {
    let mut moved = values.to_vec();
    let mut slopes = Vec::with_capacity(values.len());
    for (place, &value) in values.iter().enumerate() {
        let (_, size) = value.power_of_two_scale();
        let step = size / 128.0;
        let mut slope = [0.0; N];
        for (k, weight) in (1..).map(f64::from).zip(WEIGHTS) {
            let [above, below] = [k, -k].map(|k| {
                moved[place] = k.mul_add(step, value);
                results(&moved).unwrap_or([f64::NAN; N])
            });
            for (slope, (above, below)) in slope.iter_mut().zip(above.into_iter().zip(below)) {
                *slope += weight * (above - below) / step;
            }
        }
        moved[place] = value;
        slopes.push(slope);
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of the slopes of vⁿ by each value, as a fraction of n vⁿ⁻¹.
    fn error(n: i32, value: f64) -> f64 {
        let slopes = by_values(&[1.0, value], |values| Some([values[0], values[1].powi(n)]));
        assert_eq!((slopes[0][1], slopes[1][0]), (0.0, 0.0));
        let exact = f64::from(n) * value.powi(n - 1);
        (slopes[1][1] / exact - 1.0).abs()
    }

    #[test]
    fn slopes_of_powers_err_by_what_is_said() {
        for value in [1e-9, -0.3, 1.0, 1.999, 4e5] {
            for n in 1..=10 {
                let truncated: f64 =
                    (1..7).map(|k| f64::from(n - k)).product::<f64>() / 140.0 * 2f64.powi(-42);
                let rounded = 470.0 * f64::EPSILON / f64::from(n);
                assert!(error(n, value) <= 1.1 * truncated + 2.0 * rounded, "{n} at {value}");
            }
        }
    }

    #[test]
    fn a_value_that_is_zero_has_a_step() {
        let slopes = by_values(&[0.0], |values| Some([3.0 * values[0] + values[0] * values[0]]));
        assert!((slopes[0][0] - 3.0).abs() <= 1e-14);
    }

    #[test]
    fn where_there_are_no_results_there_is_no_slope() {
        let slopes = by_values(&[1.0, 1.0], |values| (values[0] <= 1.0).then_some([values[1]]));
        assert!(slopes[0][0].is_nan() && (slopes[1][0] - 1.0).abs() <= 1e-13);
    }
}
