//! Who is not beaten.

/// Times closer than this share are taken for equal: what repeated runs differ by.
pub const RESOLUTION: f64 = 0.05;

/// Of each pair of a time and an error, whether none beats it: the Pareto front, up to the [`RESOLUTION`] of times.
///
/// One beats another if it is faster and its error no larger, or as fast and its error smaller. A number that is not finite
/// is as large as can be, and never on the front.
#[must_use]
pub fn front(pairs: &[(f64, f64)]) -> Vec<bool> {
    let is_finite = |(time, error): (f64, f64)| time.is_finite() && error.is_finite();
    let is_beaten = |pair| pairs.iter().any(|&other| is_finite(other) && beats(other, pair));
    pairs.iter().map(|&pair| is_finite(pair) && !is_beaten(pair)).collect()
}

/// Whether the first pair beats the second.
#[must_use]
pub fn beats((time, error): (f64, f64), (other_time, other_error): (f64, f64)) -> bool {
    let is_faster = time < (1.0 - RESOLUTION) * other_time;
    let is_slower = other_time < (1.0 - RESOLUTION) * time;
    (is_faster && error <= other_error) || (!is_slower && error < other_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_worse_in_both_is_beaten() {
        let pairs = [(1.0, 5.0), (2.0, 3.0), (3.0, 4.0), (4.0, 1.0), (0.5, f64::INFINITY), (0.1, f64::NAN)];
        assert_eq!(front(&pairs), [true, true, false, true, false, false]);
    }

    #[test]
    fn equals_do_not_beat_each_other_but_a_tie_in_one_does() {
        assert_eq!(front(&[(1.0, 1.0), (1.0, 1.0), (1.0, 2.0), (2.0, 1.0)]), [true, true, false, false]);
    }

    #[test]
    fn a_time_that_is_hardly_longer_is_a_tie() {
        assert_eq!(front(&[(1.0, 1.0), (1.04, 1.0)]), [true, true]);
        assert_eq!(front(&[(1.0, 1.0), (1.06, 1.0)]), [true, false]);
    }
}
