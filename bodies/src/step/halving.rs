//! Adaptive steps, whose length follows from their error.
//!
//! A step of length h with the result x₁ is made again as two of h/2, with x₂. For a method of order p the
//! error of x₁ is near C hᵖ⁺¹, and the error of x₂ is 2ᵖ times smaller, therefore about
//!
//! ```text
//! max |x₂ − x₁| / (2ᵖ − 1)
//! ```
//!
//! If that is no more than the tolerance allows in the time h, x₂ is the state after h. Otherwise h is
//! halved, and the first of the two halves is already the x₁ of the next attempt. A step that fails is halved
//! too.
//!
//! Bodies that are suddenly pulled or let go move less smoothly than a third order demands: p is at most 2.

use super::integrator::State;
use super::staged::StagedSteps;

/// Number of halvings after which a step is taken regardless of its error.
const MAX_HALVINGS: u32 = 12;

/// Share of its allowance below which an error lets the next step be twice as long.
const GROWS_BELOW: f64 = 0.1;

/// System whose steps can be repeated from an earlier state, so that [`advance_within`] can choose their
/// length.
pub trait Repeatable {
    /// Report of a step.
    type Report;
    /// Reason why a step fails.
    type Error;

    /// State of the nodes, with pins and springs.
    fn steps(&self) -> &StagedSteps;

    /// [`Repeatable::steps`] for changes.
    fn steps_mut(&mut self) -> &mut StagedSteps;

    /// Makes a step of `dt`, s.
    ///
    /// # Errors
    /// The error of a step that fails, which is then tried again in halves.
    fn step(&mut self, dt: f64) -> Result<Self::Report, Self::Error>;

    /// Discards results computed at earlier positions.
    fn forget(&mut self) {}

    /// The largest of the distances, m, that machines have found, each for its nodes.
    fn largest(&self, distance: f64) -> f64 {
        distance
    }

    /// True if repeating the step cannot help after this error.
    fn is_final(error: &Self::Error) -> bool {
        let _ = error;
        false
    }
}

/// Report of the steps that [`advance_within`] has made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pace<R> {
    /// Reports of all steps, those of refused attempts included; the last one is of the last step.
    pub reports: Vec<R>,
    /// Number of steps that were taken, each made as two halves.
    pub taken: usize,
    /// Number of attempts whose error was too large, or which failed.
    pub refused: usize,
    /// Number of steps that were taken although their error was too large, since they were the shortest.
    pub unresolved: usize,
    /// Length of the shortest step that was taken, s.
    pub shortest: f64,
    /// Estimated errors of all steps together, m.
    pub error: f64,
}

/// Integrates over a time span, s, with adaptive steps that keep the sum of their position errors below
/// `allowed`, m.
///
/// [`Simulation::advance_within`](super::Simulation::advance_within) is implemented by it. The first attempt
/// takes the whole time at once; the shortest step is 2⁻¹² of it.
///
/// # Errors
/// The error of a step of the shortest length, or [a final one](Repeatable::is_final). The state is then the
/// one before.
pub fn advance_within<B: Repeatable>(
    body: &mut B,
    duration: f64,
    allowed: f64,
) -> Result<Pace<B::Report>, B::Error> {
    let whole = body.steps().clone();
    let mut course = Course { body, whole, duration, reports: Vec::new() };
    let pace = course.run(allowed);
    let Course { body, whole, reports, .. } = course;
    match pace {
        Ok(pace) => Ok(Pace { reports, ..pace }),
        Err(error) => {
            *body.steps_mut() = whole;
            body.forget();
            Err(error)
        }
    }
}

/// Time span of the integration.
struct Course<'a, B: Repeatable> {
    body: &'a mut B,
    /// State at the start, with the prescribed motion of the nodes until the end.
    whole: StagedSteps,
    duration: f64,
    reports: Vec<B::Report>,
}

impl<B: Repeatable> Course<'_, B> {
    fn run(&mut self, allowed: f64) -> Result<Pace<B::Report>, B::Error> {
        let weight = 2.0_f64.powi(self.whole.integrator().order().min(2)) - 1.0;
        let parts = 1_u32 << MAX_HALVINGS;
        let (mut taken, mut refused, mut unresolved, mut error) = (0, 0, 0, 0.0);
        let mut shortest = parts;
        let (mut at, mut length) = (0, parts);
        // The state after a whole step from here, where an earlier attempt has found it.
        let mut whole: Option<State> = None;
        loop {
            let before = self.state();
            let attempt = self.attempt(at, length, whole.take());
            let is_shortest = length == 1;
            match attempt {
                Ok(Attempt { distance, first_half }) => {
                    let estimate = distance / weight;
                    let share = f64::from(length) / f64::from(parts);
                    if estimate <= allowed * share || is_shortest {
                        at += length;
                        taken += 1;
                        unresolved += usize::from(estimate > allowed * share);
                        error += estimate;
                        shortest = shortest.min(length);
                        if at == parts {
                            let shortest = self.duration * (f64::from(shortest) / f64::from(parts));
                            return Ok(Pace {
                                reports: Vec::new(),
                                taken,
                                refused,
                                unresolved,
                                shortest,
                                error,
                            });
                        }
                        // A longer step ends where one of its length would, counted from the start.
                        if estimate <= GROWS_BELOW * allowed * share && at % (2 * length) == 0 {
                            length *= 2;
                        }
                        continue;
                    }
                    whole = Some(first_half);
                }
                Err(error) if is_shortest || B::is_final(&error) => return Err(error),
                Err(_) => {}
            }
            refused += 1;
            self.restore(&before);
            length /= 2;
        }
    }

    /// Makes a step of `length` parts from `at` as two halves, and compares it with that made as a whole.
    fn attempt(&mut self, at: u32, length: u32, whole: Option<State>) -> Result<Attempt, B::Error> {
        let parts = f64::from(1_u32 << MAX_HALVINGS);
        let (start, end) = (f64::from(at) / parts, f64::from(at + length) / parts);
        let middle = 0.5 * (start + end);
        let whole = match whole {
            Some(whole) => whole,
            None => {
                let before = self.state();
                self.step_between(start, end)?;
                let whole = self.state();
                self.restore(&before);
                whole
            }
        };
        self.step_between(start, middle)?;
        let first_half = self.state();
        self.step_between(middle, end)?;
        let pairs = self.body.steps().positions().as_flattened().iter().zip(whole.x.as_flattened());
        let distance = self.body.largest(pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max));
        Ok(Attempt { distance, first_half })
    }

    /// Makes one step between two shares of the whole time.
    fn step_between(&mut self, start: f64, end: f64) -> Result<(), B::Error> {
        self.body.steps_mut().drive(&self.whole, start, end);
        let report = self.body.step((end - start) * self.duration)?;
        self.reports.push(report);
        Ok(())
    }

    fn state(&self) -> State {
        self.body.steps().state.clone()
    }

    fn restore(&mut self, state: &State) {
        self.body.steps_mut().state.clone_from(state);
        self.body.forget();
    }
}

/// A step that was made as two halves.
struct Attempt {
    /// Largest distance along an axis between a node after the two halves and after the whole step, m.
    distance: f64,
    first_half: State,
}
