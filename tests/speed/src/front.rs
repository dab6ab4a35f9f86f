//! Pareto front of times and errors.

/// Times closer than this share are taken for equal: what repeated runs differ by.
pub const RESOLUTION: f64 = 0.05;

/// A time and an error.
type Pair = (f64, f64);

/// True if a pair is on the Pareto front: it is finite, and no finite rival [`beats`] it.
#[must_use]
pub fn is_on_front(pair: Pair, rivals: &[Pair], unit: f64) -> bool {
    let is_finite = |(time, error): Pair| time.is_finite() && error.is_finite();
    is_finite(pair) && !rivals.iter().any(|&rival| is_finite(rival) && beats(rival, pair, unit))
}

/// True if the first is faster and its error is no larger, or as fast and its error is smaller.
///
/// Times within the [`RESOLUTION`] are equal, and so are errors within a `unit`, the unit roundoff: which of
/// two is smaller is then luck.
#[must_use]
pub fn beats((time, error): Pair, (other_time, other_error): Pair, unit: f64) -> bool {
    let is_faster = time < (1.0 - RESOLUTION) * other_time;
    let is_slower = other_time < (1.0 - RESOLUTION) * time;
    (is_faster && error <= other_error + unit) || (!is_slower && error + unit < other_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(pairs: &[Pair], expected: &[bool]) {
        let front: Vec<bool> = pairs.iter().map(|&pair| is_on_front(pair, pairs, 0.1)).collect();
        assert_eq!(front, expected);
    }

    #[test]
    fn what_is_worse_in_both_is_beaten_and_ties_are_not() {
        let pairs = [(1.0, 5.0), (2.0, 3.0), (3.0, 4.0), (4.0, 1.0), (0.5, f64::INFINITY), (0.1, f64::NAN)];
        check(&pairs, &[true, true, false, true, false, false]);
        // Equals do not beat each other, but a tie in one does.
        check(&[(1.0, 1.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)], &[true, true, false, false]);
        // What is hardly longer or hardly larger is a tie.
        check(&[(1.0, 1.0), (1.04, 1.0)], &[true, true]);
        check(&[(1.0, 1.0), (1.06, 1.0)], &[true, false]);
        check(&[(1.0, 1.0), (1.0, 1.09)], &[true, true]);
        check(&[(1.0, 1.0), (1.0, 1.11)], &[true, false]);
        check(&[(1.0, 1.09), (1.06, 1.0)], &[true, false]);
    }
}
