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

use crate::step::integrator::State;
use crate::step::newton::NewtonReport;
use crate::step::spring::Spring;

use super::{Simulation, StepError, StepReport};

/// Halvings after which a step is taken whatever its error.
const MAX_HALVINGS: u32 = 12;

/// Share of its allowance below which an error lets the next step be twice as long.
const GROWS_BELOW: f64 = 0.1;

/// Report of [`Simulation::advance_within`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct AdaptiveReport {
    /// Energies and smallest det F at the end, and the minimisations of all steps together, those of refused
    /// attempts included.
    pub step: StepReport,
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

/// The time that is advanced over, and what moves evenly meanwhile.
struct Course {
    duration: f64,
    /// Positions before.
    before: State,
    /// Positions of pinned nodes at the end.
    targets: Vec<[f64; 3]>,
    /// Targets of springs before.
    targets_before: Vec<[f64; 3]>,
    /// Springs at the end.
    springs: Vec<Spring>,
}

/// Share of the error of a step to which its minimum is found, at least: a tenth to a third of the iterations
/// less than with a tolerance of 10⁻⁶, and the same steps.
const ENOUGH: f64 = 0.03;

impl Simulation {
    /// Advances by a time, s, in steps so short that they make no error of positions above `tolerance`, m/s,
    /// times the time. Errors of the mesh are not its concern.
    ///
    /// Pinned nodes and targets of springs move evenly over the whole time. The first attempt takes it all at
    /// once, so that nothing but the state before decides. Motions too fast for any tolerance, as those of a
    /// body that has just been let go inside out, are followed in steps of 2⁻¹² of the time.
    ///
    /// ```
    /// use piola::mesh::tetrahedral_box;
    /// use piola::step::{Integrator, NewtonSettings, Simulation, SimulationSettings};
    /// use piola::system::{Body, Pins};
    ///
    /// /// Rubber.
    /// #[piola::material(domain(J > 0.0))]
    /// fn Rubber([l1, l2, l3]: [f64; 3], /** Pa. */ mu: f64, /** Pa. */ lambda: f64) -> f64 {
    ///     mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
    /// }
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mesh = tetrahedral_box([4, 1, 1], [0.4, 0.1, 0.1])?;
    /// let body = Body::new(&mesh, Rubber::new(1e5, 4e5)?, 1000.0)?;
    /// let settings = SimulationSettings::default().with_integrator(Integrator::Sdirk2);
    /// let mut bar = Simulation::new(body, &Pins::at([0, 1, 2, 3]), settings.with_gravity([0.0, -9.81, 0.0]))?;
    /// // A thirtieth of a second, to 0.1 mm in each second.
    /// let report = bar.advance_within(1.0 / 30.0, 1e-4)?;
    /// assert!(report.error <= 1e-4 / 30.0 && report.unresolved == 0);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// [`StepError`] if a step of the shortest length fails, or neither the time nor the tolerance is positive
    /// and finite. The state before is then untouched.
    pub fn advance_within(&mut self, duration: f64, tolerance: f64) -> Result<AdaptiveReport, StepError> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(StepError::Tolerance { tolerance });
        }
        let course = Course {
            duration,
            before: self.state.clone(),
            targets: self.targets.clone(),
            targets_before: self.targets_before.clone(),
            springs: self.springs.clone(),
        };
        let newton = self.settings.newton;
        self.settings.newton.error_share = newton.error_share.max(ENOUGH);
        let result = self.follow(&course, tolerance);
        self.settings.newton = newton;
        self.targets.copy_from_slice(&course.targets);
        self.springs.copy_from_slice(&course.springs);
        if result.is_err() {
            self.restore(&course.before);
            self.targets_before.copy_from_slice(&course.targets_before);
        }
        result
    }

    fn follow(&mut self, course: &Course, tolerance: f64) -> Result<AdaptiveReport, StepError> {
        let weight = 2.0_f64.powi(self.settings.integrator.order().min(2)) - 1.0;
        let parts = 1_u32 << MAX_HALVINGS;
        let mut sum: Option<NewtonReport> = None;
        let (mut taken, mut refused, mut unresolved, mut error) = (0, 0, 0, 0.0);
        let mut shortest = parts;
        let (mut at, mut length) = (0, parts);
        // The state after a whole step from here, where an earlier attempt has found it.
        let mut whole: Option<State> = None;
        loop {
            let before = self.state.clone();
            let attempt = self.attempt(course, at, length, whole.take(), &mut sum);
            let is_shortest = length == 1;
            let allowed = tolerance * course.duration * f64::from(length) / f64::from(parts);
            let estimate = match attempt {
                Ok(Attempt { report, distance, first_half }) => {
                    let estimate = distance / weight;
                    if estimate <= allowed || is_shortest {
                        at += length;
                        taken += 1;
                        unresolved += usize::from(estimate > allowed);
                        error += estimate;
                        shortest = shortest.min(length);
                        if at == parts {
                            let newton = sum.unwrap_or_else(|| report.newton.clone());
                            let step = StepReport { newton, ..report };
                            let shortest = course.duration * f64::from(shortest) / f64::from(parts);
                            return Ok(AdaptiveReport { step, taken, refused, unresolved, shortest, error });
                        }
                        // A longer step ends where one of its length would, counted from the start.
                        if estimate <= GROWS_BELOW * allowed && at % (2 * length) == 0 {
                            length *= 2;
                        }
                        continue;
                    }
                    whole = Some(first_half);
                    Ok(())
                }
                Err(error) => Err(error),
            };
            if is_shortest {
                estimate?;
            }
            refused += 1;
            self.restore(&before);
            length /= 2;
        }
    }

    /// Makes a step of `length` parts from `at` as two halves, and compares it with that made as a whole.
    fn attempt(
        &mut self,
        course: &Course,
        at: u32,
        length: u32,
        whole: Option<State>,
        sum: &mut Option<NewtonReport>,
    ) -> Result<Attempt, StepError> {
        let parts = f64::from(1_u32 << MAX_HALVINGS);
        let (start, end) = (f64::from(at) / parts, f64::from(at + length) / parts);
        let middle = 0.5 * (start + end);
        let whole = match whole {
            Some(whole) => whole,
            None => {
                let before = self.state.clone();
                self.step_between(course, start, end, sum)?;
                let whole = self.state.clone();
                self.restore(&before);
                whole
            }
        };
        self.step_between(course, start, middle, sum)?;
        let first_half = self.state.clone();
        let report = self.step_between(course, middle, end, sum)?;
        let pairs = self.state.x.as_flattened().iter().zip(whole.x.as_flattened());
        let distance = pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        Ok(Attempt { report, distance, first_half })
    }

    /// Makes one step between shares of the time.
    fn step_between(
        &mut self,
        course: &Course,
        start: f64,
        end: f64,
        sum: &mut Option<NewtonReport>,
    ) -> Result<StepReport, StepError> {
        for &node in self.pins.nodes() {
            self.targets[node] = between(course.before.x[node], course.targets[node], end);
        }
        for (index, (before, spring)) in course.targets_before.iter().zip(&course.springs).enumerate() {
            self.targets_before[index] = between(*before, spring.target, start);
            self.springs[index].target = between(*before, spring.target, end);
        }
        let report = self.step((end - start) * course.duration)?;
        *sum = Some(report.newton.clone().after(sum.take()));
        Ok(report)
    }

    fn restore(&mut self, state: &State) {
        self.state.clone_from(state);
        self.evaluated = None;
    }
}

/// A step that was made as two halves.
struct Attempt {
    /// Report of the second half.
    report: StepReport,
    /// Largest distance along an axis of a node from where the whole step takes it, m.
    distance: f64,
    first_half: State,
}

/// The point at a share of the way, and the ends themselves without rounding.
fn between(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    match share {
        0.0 => from,
        1.0 => to,
        _ => std::array::from_fn(|c| from[c] + share * (to[c] - from[c])),
    }
}

#[cfg(test)]
mod tests;
