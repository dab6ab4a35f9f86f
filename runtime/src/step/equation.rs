//! Newton's method for the equation of a step that is no minimum, with continuation in the step's length.
//!
//! The Jacobian J of an equation r(x) = 0 need not be symmetric, and there is no function to decrease.
//! Newton's method goes along d = −J⁻¹ r, as far as the next correction with the same Jacobian gets shorter:
//! ‖J⁻¹ r(x + t d)‖ ≤ (1 − t/4) ‖d‖, the natural monotonicity test \[Deu04, 3.3\], which does not depend on
//! how equations are scaled, as the norm of r does between large elements and small or flat ones.
//!
//! It starts from the positions before the step, as slow motions demand that are stiff beside their inertia.
//! Where that fails it starts from where velocities alone would take the body, and where that fails too the
//! equation is first solved for a shorter step, whose inertia is larger: the whole step is reached by
//! continuation, with solutions of shorter ones extended along a line.
//!
//! \[Deu04\] Deuflhard, *Newton Methods for Nonlinear Problems*, 2004.

use super::line_search::LineSearchSettings;
use super::newton::{Convergence, NewtonError, NewtonReport, NewtonSettings};

/// Share of the first residual below which the rest counts as rounding, where it falls by less than half.
const ROUNDING: f64 = 1e-8;

/// The smallest share of a step by which continuation goes on.
const SMALLEST_SHARE: f64 = 1.0 / 256.0;

/// Where Newton's method for a [`StepEquation`] starts.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum StepStart {
    /// The positions before the step, with the pins moved.
    Before,
    /// Where velocities alone take the nodes from there, in the share of the step.
    Velocities,
    /// The solution that was kept last, of a smaller share, extended to the share of the step along the line
    /// from the positions before the step.
    Kept {
        /// Share of the step that it solves.
        share: f64,
    },
}

impl StepStart {
    /// Position of a free node at the start, m, for a share of the step: `before` is where it is before the
    /// step, `ahead` its displacement by its velocity alone in the whole step, and `kept` where it is in the
    /// solution that was kept last.
    #[must_use]
    pub fn position(self, share: f64, before: [f64; 3], ahead: [f64; 3], kept: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| match self {
            Self::Before => before[c],
            Self::Velocities => before[c] + share * ahead[c],
            Self::Kept { share: solved } => before[c] + share / solved * (kept[c] - before[c]),
        })
    }
}

/// The equation r(x) = 0 of a step that is no minimum, for [`solve_step`].
///
/// It keeps x, a direction and a correction, vectors of all unknowns, in memory of its own, which may be
/// divided among machines. For a share of the step, less than one, its solution must be nearer to the state
/// before: that of an energy–momentum step has the [accelerations](super::Stage::acceleration) of a shorter
/// stage, so that inertia is greater, and damping and forces as they are.
pub trait StepEquation {
    /// The Jacobian J of r, or what solves systems with it.
    type Jacobian;
    /// Reason why an attempt fails.
    type Error: From<NewtonError>;

    /// Sets x, of the equation for this share of the step's length, and evaluates r there. Returns ‖r‖ in N.
    ///
    /// # Errors
    /// An error of this attempt; another one may succeed.
    fn start(&mut self, share: f64, start: StepStart) -> Result<f64, Self::Error>;

    /// Takes the Jacobian at x, where r was evaluated last.
    ///
    /// # Errors
    /// An error of this attempt.
    fn linearise(&mut self) -> Result<Self::Jacobian, Self::Error>;

    /// Replaces the correction by −J⁻¹ r, for the r that was evaluated last. Returns its norm in m; one that
    /// is not finite ends the attempt.
    ///
    /// # Errors
    /// An error of this attempt.
    fn correct(&mut self, jacobian: &Self::Jacobian) -> Result<f64, Self::Error>;

    /// Makes the correction the direction. Returns the share of it, 1 or less, to be tried first.
    fn take_direction(&mut self) -> f64;

    /// Evaluates r at x plus `step` times the direction, and returns ‖r‖ in N; `None` where r does not exist,
    /// or is not finite.
    ///
    /// # Errors
    /// An error that ends the attempt.
    fn try_step(&mut self, step: f64) -> Result<Option<f64>, Self::Error>;

    /// Moves x to where r was evaluated last.
    fn accept(&mut self);

    /// Keeps x, which solves the equation of a share, for [`StepStart::Kept`].
    fn keep_solution(&mut self);

    /// Whether no other attempt can help after this error.
    fn is_final(error: &Self::Error) -> bool {
        let _ = error;
        false
    }
}

/// Solves the equation of a step, whose Jacobian J need not be symmetric, by Newton's method.
///
/// It goes along d = −J⁻¹ r, as far as the next correction with the same J gets shorter, ‖J⁻¹ r(x + t d)‖ ≤
/// (1 − t/4) ‖d‖, the natural monotonicity test \[Deu04, 3.3\]. It starts from the positions before the step,
/// or, where that fails, from where velocities take the body; where that fails too, shares of the step are
/// solved first, each from the solution of the one before.
///
/// Each attempt ends at the [tolerance](NewtonSettings::tolerance), fails after
/// [`max_iterations`](NewtonSettings::max_iterations), and shortens steps as the line search says; other
/// settings have no part in it.
///
/// \[Deu04\] Deuflhard, *Newton Methods for Nonlinear Problems*, 2004.
///
/// # Errors
/// [`NewtonError::NotSolved`] and [`NewtonError::NotFinite`], and errors of the equation.
pub fn solve_step<E: StepEquation>(
    equation: &mut E,
    settings: &NewtonSettings,
    line_search: &LineSearchSettings,
) -> Result<NewtonReport, E::Error> {
    let mut report: Option<NewtonReport> = None;
    let (mut done, mut more, mut start) = (0.0, 1.0, StepStart::Before);
    loop {
        let share = f64::min(done + more, 1.0);
        match attempt(equation, share, start, settings, line_search) {
            Ok(found) => {
                let all = found.after(report.take());
                if share == 1.0 {
                    return Ok(all);
                }
                report = Some(all);
                equation.keep_solution();
                (done, more, start) = (share, 2.0 * more, StepStart::Kept { share });
            }
            Err(error) if E::is_final(&error) => return Err(error),
            Err(_) if start == StepStart::Before => start = StepStart::Velocities,
            Err(_) if more > SMALLEST_SHARE => more *= 0.5,
            Err(error) => return Err(error),
        }
    }
}

/// Solves the equation for a share of the step.
fn attempt<E: StepEquation>(
    equation: &mut E,
    share: f64,
    start: StepStart,
    settings: &NewtonSettings,
    line_search: &LineSearchSettings,
) -> Result<NewtonReport, E::Error> {
    let mut residual = equation.start(share, start)?;
    let mut report = NewtonReport { first_residual: residual, ..NewtonReport::before(settings) };
    loop {
        report.residual = residual;
        if !residual.is_finite() {
            return Err(NewtonError::NotFinite.into());
        }
        if residual <= settings.tolerance * report.first_residual {
            report.convergence = Convergence::Tolerance;
            return Ok(report);
        }
        let not_solved = |iterations| NewtonError::NotSolved { iterations, residual }.into();
        if report.iterations == settings.max_iterations {
            return Err(not_solved(report.iterations));
        }
        let rounding = ROUNDING * report.first_residual;
        report.iterations += 1;
        match iterate(equation, line_search, &mut report)? {
            Some(next) if next > 0.5 * residual && next <= rounding => {
                (report.convergence, report.residual) = (Convergence::Rounding, next);
                return Ok(report);
            }
            Some(next) => residual = next,
            None if residual <= rounding => {
                report.convergence = Convergence::Rounding;
                return Ok(report);
            }
            None => return Err(not_solved(report.iterations)),
        }
    }
}

/// An iteration from where r was evaluated last; returns ‖r‖ at its end, `None` where no step along the
/// direction is good.
fn iterate<E: StepEquation>(
    equation: &mut E,
    line_search: &LineSearchSettings,
    report: &mut NewtonReport,
) -> Result<Option<f64>, E::Error> {
    let jacobian = equation.linearise()?;
    let length = correct(equation, &jacobian)?;
    let mut step = equation.take_direction();
    for _ in 0..line_search.max_trials {
        match equation.try_step(step)?.filter(|residual| residual.is_finite()) {
            None => report.refused_trials += 1,
            residual => {
                if line_search.accepts_increase
                    || correct(equation, &jacobian)? <= (1.0 - 0.25 * step) * length
                {
                    equation.accept();
                    report.step_lengths.push(step);
                    return Ok(residual);
                }
            }
        }
        step *= line_search.shrink;
    }
    Ok(None)
}

fn correct<E: StepEquation>(equation: &mut E, jacobian: &E::Jacobian) -> Result<f64, E::Error> {
    let length = equation.correct(jacobian)?;
    if length.is_finite() { Ok(length) } else { Err(NewtonError::NotFinite.into()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One unknown with a stiff force: (x − 10 s)/s² + exp(2 x) − 1 = 0 for a share s of the step.
    struct Stiff {
        share: f64,
        x: f64,
        tried: f64,
        direction: f64,
        correction: f64,
        kept: f64,
        starts: Vec<(f64, StepStart)>,
        breaks: bool,
    }

    impl Stiff {
        fn new() -> Self {
            let [share, x, tried, direction, correction, kept] = [f64::NAN; 6];
            Self { share, x, tried, direction, correction, kept, starts: Vec::new(), breaks: false }
        }

        fn residual(&self) -> f64 {
            (self.tried - 10.0 * self.share) / self.share.powi(2) + (2.0 * self.tried).exp() - 1.0
        }

        fn solve(&mut self, max_iterations: usize) -> Result<NewtonReport, NewtonError> {
            let settings =
                NewtonSettings::default().with_tolerance(1e-10).with_max_iterations(max_iterations);
            solve_step(self, &settings, &LineSearchSettings::default())
        }
    }

    impl StepEquation for Stiff {
        type Jacobian = f64;
        type Error = NewtonError;

        fn start(&mut self, share: f64, start: StepStart) -> Result<f64, NewtonError> {
            self.starts.push((share, start));
            self.share = share;
            [self.x, ..] = start.position(share, [0.0; 3], [10.0; 3], [self.kept; 3]);
            self.tried = self.x;
            if self.breaks { Err(NewtonError::NotFinite) } else { Ok(self.residual().abs()) }
        }

        fn linearise(&mut self) -> Result<f64, NewtonError> {
            Ok(self.share.powi(-2) + 2.0 * (2.0 * self.x).exp())
        }

        fn correct(&mut self, jacobian: &f64) -> Result<f64, NewtonError> {
            self.correction = -self.residual() / jacobian;
            Ok(self.correction.abs())
        }

        fn take_direction(&mut self) -> f64 {
            self.direction = self.correction;
            1.0
        }

        fn try_step(&mut self, step: f64) -> Result<Option<f64>, NewtonError> {
            self.tried = self.x + step * self.direction;
            Ok(Some(self.residual().abs()))
        }

        fn accept(&mut self) {
            self.x = self.tried;
        }

        fn keep_solution(&mut self) {
            self.kept = self.x;
        }

        fn is_final(error: &NewtonError) -> bool {
            *error == NewtonError::NotFinite
        }
    }

    #[test]
    fn few_iterations_solve_shorter_steps_first() {
        let mut patient = Stiff::new();
        patient.solve(50).expect("a solution");
        assert_eq!(patient.starts, [(1.0, StepStart::Before)]);
        let mut hasty = Stiff::new();
        let report = hasty.solve(5).expect("a solution");
        assert_eq!(report.convergence, Convergence::Tolerance);
        assert!(report.iterations > 5, "{report:?}");
        assert_eq!(hasty.starts[..2], [(1.0, StepStart::Before), (1.0, StepStart::Velocities)]);
        assert!(hasty.starts.iter().any(|(_, start)| matches!(start, StepStart::Kept { .. })));
        for solved in [patient, hasty] {
            assert!((solved.x - 10.0 + (2.0 * solved.x).exp() - 1.0).abs() < 1e-8, "{}", solved.x);
        }
    }

    #[test]
    fn what_cannot_be_solved_ends() {
        let error = Stiff::new().solve(1).expect_err("one iteration");
        assert!(matches!(error, NewtonError::NotSolved { iterations: 1, .. }), "{error}");
        let mut broken = Stiff { breaks: true, ..Stiff::new() };
        assert_eq!(broken.solve(50), Err(NewtonError::NotFinite));
        assert_eq!(broken.starts.len(), 1);
    }
}
