//! Steps whose length follows from their error.
//!
//! A step of length h with the result x₁ is made again as two of h/2, with x₂. Of a method of order p both
//! have an error near C hᵖ⁺¹, and 2ᵖ times smaller that of x₂, which is therefore about
//!
//! ```text
//! max |x₂ − x₁| / (2ᵖ − 1)
//! ```
//!
//! Where that is no more than the tolerance allows in the time h, x₂ is the state after h. Else h is halved,
//! and the first of the two halves is already the x₁ of the next attempt. A step that fails is halved too.
//!
//! Bodies that are suddenly pulled or let go move less smoothly than a third order demands: p is at most 2.

use super::integrator::Integrator;

/// Halvings after which a step is taken whatever its error.
const MAX_HALVINGS: u32 = 12;

/// Share of its allowance below which an error lets the next step be twice as long.
const GROWS_BELOW: f64 = 0.1;

/// A body whose steps can be made again from an earlier state, so that [`advance_within`] finds their length.
pub trait Repeatable {
    /// The state between two steps.
    type State;
    /// Report of a step.
    type Report;
    /// Why a step fails.
    type Error;

    /// The state after the last step.
    fn state(&self) -> Self::State;

    /// Returns to a state.
    fn restore(&mut self, state: &Self::State);

    /// Largest distance along an axis of a node from where a state has it, m.
    fn distance(&self, from: &Self::State) -> f64;

    /// Makes one step between two shares of the whole time, from 0 to 1.
    ///
    /// # Errors
    /// Of a step that fails, which is then tried again in halves.
    fn step_between(&mut self, start: f64, end: f64) -> Result<Self::Report, Self::Error>;

    /// Whether an error leaves nothing to try again.
    fn is_final(error: &Self::Error) -> bool {
        let _ = error;
        false
    }
}

/// The steps that [`advance_within`] has made.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Pace<R> {
    /// Report of the last step.
    pub report: R,
    /// Number of steps that were taken, each made as two halves.
    pub taken: usize,
    /// Number of attempts whose error was too large, or which failed.
    pub refused: usize,
    /// Number of steps that were taken although their error was too large, since they were the shortest.
    pub unresolved: usize,
    /// Length of the shortest step that was taken, as a share of the whole time.
    pub shortest: f64,
    /// Estimated errors of all steps together, m.
    pub error: f64,
}

/// Advances a body over a time in steps so short that they make no error of positions above `allowed`, m, in
/// all of it.
///
/// This is [`Simulation::advance_within`](super::Simulation::advance_within) for bodies that are none, such
/// as one that is divided among machines. The first attempt takes the whole time at once; the shortest step
/// is 2⁻¹² of it.
///
/// ```
/// use piola::step::{Integrator, Repeatable, advance_within};
///
/// /// A node that decays by implicit Euler's method, at thrice the rate of the whole time.
/// struct Decay(f64);
///
/// impl Repeatable for Decay {
///     type State = f64;
///     type Report = ();
///     type Error = std::convert::Infallible;
///
///     fn state(&self) -> f64 {
///         self.0
///     }
///     fn restore(&mut self, state: &f64) {
///         self.0 = *state;
///     }
///     fn distance(&self, from: &f64) -> f64 {
///         (self.0 - from).abs()
///     }
///     fn step_between(&mut self, start: f64, end: f64) -> Result<(), Self::Error> {
///         self.0 /= 1.0 + 3.0 * (end - start);
///         Ok(())
///     }
/// }
///
/// let mut node = Decay(1.0);
/// let pace = advance_within(&mut node, Integrator::ImplicitEuler, 0.05)?;
/// assert!(pace.error <= 0.05 && pace.taken > 10 && (node.0 - (-3.0_f64).exp()).abs() < 0.005);
/// # Ok::<(), std::convert::Infallible>(())
/// ```
///
/// # Errors
/// Of a step of the shortest length, or [one that is final](Repeatable::is_final). The body is then somewhere
/// on its way.
pub fn advance_within<B: Repeatable>(
    body: &mut B,
    integrator: Integrator,
    allowed: f64,
) -> Result<Pace<B::Report>, B::Error> {
    let weight = 2.0_f64.powi(integrator.order().min(2)) - 1.0;
    let parts = 1_u32 << MAX_HALVINGS;
    let (mut taken, mut refused, mut unresolved, mut error) = (0, 0, 0, 0.0);
    let mut shortest = parts;
    let (mut at, mut length) = (0, parts);
    // The state after a whole step from here, where an earlier attempt has found it.
    let mut whole: Option<B::State> = None;
    loop {
        let before = body.state();
        let attempt = attempt(body, at, length, whole.take());
        let is_shortest = length == 1;
        match attempt {
            Ok(Attempt { report, distance, first_half }) => {
                let estimate = distance / weight;
                let share = f64::from(length) / f64::from(parts);
                if estimate <= allowed * share || is_shortest {
                    at += length;
                    taken += 1;
                    unresolved += usize::from(estimate > allowed * share);
                    error += estimate;
                    shortest = shortest.min(length);
                    if at == parts {
                        let shortest = f64::from(shortest) / f64::from(parts);
                        return Ok(Pace { report, taken, refused, unresolved, shortest, error });
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
        body.restore(&before);
        length /= 2;
    }
}

/// A step that was made as two halves.
struct Attempt<B: Repeatable> {
    /// Report of the second half.
    report: B::Report,
    /// Largest distance along an axis of a node from where the whole step takes it, m.
    distance: f64,
    first_half: B::State,
}

/// Makes a step of `length` parts from `at` as two halves, and compares it with that made as a whole.
fn attempt<B: Repeatable>(
    body: &mut B,
    at: u32,
    length: u32,
    whole: Option<B::State>,
) -> Result<Attempt<B>, B::Error> {
    let parts = f64::from(1_u32 << MAX_HALVINGS);
    let (start, end) = (f64::from(at) / parts, f64::from(at + length) / parts);
    let middle = 0.5 * (start + end);
    let whole = match whole {
        Some(whole) => whole,
        None => {
            let before = body.state();
            body.step_between(start, end)?;
            let whole = body.state();
            body.restore(&before);
            whole
        }
    };
    body.step_between(start, middle)?;
    let first_half = body.state();
    let report = body.step_between(middle, end)?;
    Ok(Attempt { report, distance: body.distance(&whole), first_half })
}

/// The point at a share of the way between two, and these themselves without rounding: where a pinned node
/// is in a step between two shares of a time.
#[must_use]
pub fn on_the_way(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    match share {
        0.0 => from,
        1.0 => to,
        _ => std::array::from_fn(|c| from[c] + share * (to[c] - from[c])),
    }
}
