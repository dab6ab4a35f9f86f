//! Slopes: a central difference approaches a right derivative as h², until rounding takes over.

use super::*;

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
