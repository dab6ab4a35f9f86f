//! Number of the step, and its time.

use serde::{Deserialize, Serialize};

/// Largest number of steps that double precision counts exactly.
const MAX_FRAME: u64 = 1 << 53;

/// Clock of a scene: a count of steps from 0, with a length that may change between them.
///
/// Time is the number of steps of the present length, times that length, after the time when it last changed:
/// a sum over all steps would gather a rounding error with each.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Clock {
    /// Number of steps made so far.
    pub frame: usize,
    /// Length of the next step, s.
    pub(crate) dt: f64,
    since_frame: usize,
    since_time: f64,
}

impl Clock {
    /// A clock before the first step, of length `dt`, s.
    #[must_use]
    pub fn new(dt: f64) -> Self {
        Self { frame: 0, dt, since_frame: 0, since_time: 0.0 }
    }

    /// The time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.since_time + (self.frame - self.since_frame) as f64 * self.dt
    }

    /// The clock after one more step.
    #[must_use]
    pub fn next(self) -> Self {
        Self { frame: self.frame + 1, ..self }
    }

    /// The clock with another length of the steps that follow, s.
    #[must_use]
    pub fn with_dt(self, dt: f64) -> Self {
        Self { dt, since_frame: self.frame, since_time: self.time(), ..self }
    }

    /// True if steps can have led here and can continue; a file may contain anything.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        self.dt > 0.0
            && self.dt.is_finite()
            && self.since_time >= 0.0
            && self.since_frame <= self.frame
            && self.frame as u64 <= MAX_FRAME
            && self.time().is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_goes_on_when_steps_change_their_length() {
        let mut clock = Clock::new(0.5);
        for _ in 0..3 {
            clock = clock.next();
        }
        assert_eq!((clock.frame, clock.time()), (3, 1.5));
        clock = clock.with_dt(0.25);
        assert_eq!(clock.time(), 1.5);
        assert_eq!((clock.next().frame, clock.next().time()), (4, 1.75));
    }

    #[test]
    fn one_that_runs_ahead_of_itself_is_not_sound() {
        assert!(Clock::new(0.1).is_sound());
        assert!(!Clock::new(f64::NAN).is_sound());
        assert!(!Clock { since_frame: 1, ..Clock::new(0.1) }.is_sound());
        assert!(!Clock { frame: usize::MAX, ..Clock::new(0.1) }.is_sound());
        assert!(!Clock { since_time: -1.0, ..Clock::new(0.1) }.is_sound());
        assert!(!Clock { frame: 1 << 20, ..Clock::new(1e308) }.is_sound());
    }
}
