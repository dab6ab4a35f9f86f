//! Steps of a divided body that keep energy and momenta.
//!
//! The equation is that of [`Integrator::EnergyMomentum`](piola::step::Integrator::EnergyMomentum),
//!
//! ```text
//! r(x) = M a(x) + α M v(x) + ∇̄Ψ(xₙ, 2 x − xₙ) − M g + ∇ springs(x) = 0
//! ```
//!
//! with the gradient ∇̄Ψ between two states of [`piola::system::DiscreteGradient`], and
//! [`piola::step::solve_step`] solves it. Its matrix is not symmetric: PETSc's GMRES solves linear systems.

use piola::step::{NewtonError, StepEquation, StepStart, Term, solve_step};

use crate::error::Error;
use crate::newton::{NewtonReport, NewtonSettings, Objective};
use crate::petsc::Ending;
use crate::system::LinearSystem;

/// Share of the right side to which linear systems are solved at most: Newton's method judges a step by the
/// length of the next correction.
const LINEAR_TOLERANCE: f64 = 1e-6;

/// Iterations of the linear solver after which a shorter step is solved first.
const MAX_LINEAR_ITERATIONS: usize = 2000;

/// Moves `x`, m, of the nodes of each rank from the positions before the step to those in its middle, the
/// pinned ones by `pins_move` where it is given.
///
/// # Errors
/// An [`Error`] that all ranks have, or one of PETSc.
pub fn solve(
    objective: Objective<'_>,
    system: &mut LinearSystem,
    settings: &NewtonSettings,
    x: &mut [[f64; 3]],
    pins_move: Option<&[[f64; 3]]>,
) -> Result<NewtonReport, Error> {
    let (nodes, owned) = (x.len(), objective.share.owned);
    let before = x.to_vec();
    for (x, d) in x.iter_mut().zip(pins_move.into_iter().flatten()) {
        (0..3).for_each(|c| x[c] += d[c]);
    }
    objective.elastic.begin_between(&before);
    if let Some(tag) = objective.refused() {
        return Err(NewtonError::Inverted { element: tag as usize }.into());
    }
    system.begin();
    let zero = || vec![[0.0; 3]; nodes];
    let mut equation = Equation {
        spring_stiffness: objective.spring_stiffness(),
        start: x.to_vec(),
        before,
        x: x.to_vec(),
        trial: zero(),
        displacement: zero(),
        direction: zero(),
        correction: zero(),
        kept: zero(),
        residual: vec![[0.0; 3]; owned],
        share: 1.0,
        tolerance: settings.linear_tolerance.min(LINEAR_TOLERANCE),
        max_iterations: settings.max_linear_iterations.min(MAX_LINEAR_ITERATIONS),
        linear_iterations: Vec::new(),
        objective,
        system,
    };
    let newton = piola::step::NewtonSettings::default()
        .with_tolerance(settings.tolerance)
        .with_max_iterations(settings.max_iterations);
    let report = solve_step(&mut equation, &newton, &settings.line_search)?;
    x.copy_from_slice(&equation.x);
    Ok(NewtonReport {
        convergence: report.convergence,
        iterations: report.iterations,
        first_residual: report.first_residual,
        residual: report.residual,
        refused_trials: report.refused_trials,
        filtered: 0,
        shift: 0.0,
        linear_iterations: equation.linear_iterations,
        truncated: 0,
    })
}

/// The equation of a step, or of a share of it; vectors are of all nodes of the rank, but for the residual.
struct Equation<'a, 'b> {
    objective: Objective<'a>,
    system: &'b mut LinearSystem,
    spring_stiffness: Vec<f64>,
    /// Positions before the step, m, and with the pins moved.
    before: Vec<[f64; 3]>,
    start: Vec<[f64; 3]>,
    x: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
    /// Displacement from the state before the step to the one after, m.
    displacement: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    correction: Vec<[f64; 3]>,
    /// The solution for the share of the step that was solved for last, m.
    kept: Vec<[f64; 3]>,
    /// r of the owned nodes, N.
    residual: Vec<[f64; 3]>,
    share: f64,
    tolerance: f64,
    max_iterations: usize,
    linear_iterations: Vec<usize>,
}

impl StepEquation for Equation<'_, '_> {
    type Jacobian = ();
    type Error = Error;

    fn start(&mut self, share: f64, start: StepStart) -> Result<f64, Error> {
        self.share = share;
        let free = self.objective.share.free_numbers.iter().enumerate().filter(|(_, free)| free.is_some());
        for (node, _) in free {
            let before = self.start[node];
            let ahead = self.objective.stage.ahead(node, before);
            self.x[node] = start.position(share, before, ahead, self.kept[node]);
        }
        self.trial.copy_from_slice(&self.x);
        self.evaluate()?.map_err(|tag| NewtonError::Inverted { element: tag as usize }.into())
    }

    fn linearise(&mut self) -> Result<(), Error> {
        let more = self.more_inertia();
        let Self { objective, system, spring_stiffness, x, .. } = self;
        objective.elastic.linearise_between();
        if let Some(tag) = objective.refused() {
            return Err(NewtonError::ElementNotFinite { element: tag as usize }.into());
        }
        let diagonal =
            |node: usize| objective.diagonal(node) + more * objective.inertia(node) + spring_stiffness[node];
        Ok(system.assemble(objective.share, objective.elastic, diagonal, x)?)
    }

    fn correct(&mut self, (): &()) -> Result<f64, Error> {
        let Self { objective, system, correction, residual, .. } = self;
        let owned = &mut correction[..objective.share.owned];
        let (tolerance, limit) = (self.tolerance, self.max_iterations);
        let (ending, iterations) = system.solve(objective.team, residual, owned, tolerance, limit, true)?;
        self.linear_iterations.push(iterations);
        if ending != Ending::Converged {
            return Err(Error::Unsolved { iterations });
        }
        let (owned, copies) = correction.split_at_mut(objective.share.owned);
        objective.exchange.begin_copies(owned)?;
        objective.exchange.end_copies(copies)?;
        Ok(objective.product(owned, owned).sqrt())
    }

    fn take_direction(&mut self) -> f64 {
        std::mem::swap(&mut self.direction, &mut self.correction);
        1.0
    }

    fn try_step(&mut self, step: f64) -> Result<Option<f64>, Error> {
        for (node, trial) in self.trial.iter_mut().enumerate() {
            *trial = std::array::from_fn(|c| self.x[node][c] + step * self.direction[node][c]);
        }
        Ok(self.evaluate()?.ok())
    }

    fn accept(&mut self) {
        self.x.copy_from_slice(&self.trial);
    }

    fn keep_solution(&mut self) {
        self.kept.copy_from_slice(&self.x);
    }

    fn is_final(error: &Error) -> bool {
        error.is_final()
    }
}

impl Equation<'_, '_> {
    /// Evaluates r at the positions to be tried; ‖r‖ over the free nodes of all ranks, or the tag of an
    /// element that is inverted after the step.
    fn evaluate(&mut self) -> Result<Result<f64, u64>, Error> {
        let Self { objective, before, trial, displacement, residual, .. } = self;
        for (node, d) in displacement.iter_mut().enumerate() {
            *d = std::array::from_fn(|c| 2.0 * (trial[node][c] - before[node][c]));
        }
        objective.elastic.gradient_between(objective.exchange, displacement, residual)?;
        if let Some(tag) = objective.refused() {
            return Ok(Err(tag));
        }
        objective.springs.add_gradient(trial, residual);
        objective.add_quadratic_gradient(trial, residual);
        if self.share < 1.0 {
            for node in 0..objective.share.free {
                let [whole, shorter] =
                    [1.0, self.share].map(|share| objective.stage.acceleration(node, trial[node], share));
                for c in 0..3 {
                    residual[node][c] += objective.masses[node] * (shorter[c] - whole[c]);
                }
            }
        }
        Ok(Ok(objective.product(residual, residual).sqrt()))
    }

    /// Inertia that a share adds, beside that of the whole step: 1/share² − 1 times as much.
    fn more_inertia(&self) -> f64 {
        (self.share * self.share).recip() - 1.0
    }
}
