//! Newton's method on a body that is divided among ranks.
//!
//! It goes as [`piola::step`] goes on one machine, with its line search: a point that an element of any rank
//! refuses is a step too long on every rank, because all numbers that decide are sums over the ranks. PETSc's
//! SNES is not used: it knows neither pins that move into the first system, nor a filter on demand, nor an
//! end below the rounding error of the energy.
//!
//! The objective is that of a stage (see [`piola::step::StagedSteps`]),
//!
//! ```text
//! E(x) = ½‖x − s − τ w‖²_M / (τσ) + α/(2τ) ‖x − s‖²_M + Ψ(x) − Σ m g·x + Σ springs
//! ```
//!
//! Positions of copies follow those of their owners without being sent: every rank moves them by the same
//! arithmetic, along directions that are sent once in an iteration, while the elements inside are evaluated.

use piola::point::Filter;
use piola::step::{Convergence, EnergyChange, Filtering, Line, LineSearchSettings, Spring, Stage, Term};

use crate::elastic::Elastic;
use crate::error::Error;
use crate::petsc::{Ending, GhostedVector, PetscError};
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Settings of Newton's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonSettings {
    /// Treatment of negative eigenvalues of dP/dF: one filter, or clamped ones on demand.
    pub filtering: Filtering,
    /// Number of iterations after which to stop.
    pub max_iterations: usize,
    /// Share of the first gradient's norm at which the minimum counts as found.
    pub tolerance: f64,
    /// Share of the right side to which the first linear system is solved, and later ones at most.
    pub linear_tolerance: f64,
    /// Number of iterations of the linear solver after which to take what it has found.
    pub max_linear_iterations: usize,
    /// Settings of the line search.
    pub line_search: LineSearchSettings,
}

/// Report of a minimisation, the same on all ranks.
#[derive(Clone, Debug, PartialEq)]
pub struct NewtonReport {
    /// Reason why it stopped.
    pub convergence: Convergence,
    /// Number of directions that were found.
    pub iterations: usize,
    /// Norm of the gradient over the free nodes before the first iteration, N; where pins move, right after
    /// they have.
    pub first_residual: f64,
    /// Norm of the gradient evaluated last, N.
    pub residual: f64,
    /// Number of trials of the line search that left the domain of a material.
    pub refused_trials: usize,
    /// Largest number of elements in an iteration whose tangent the filter changed.
    pub filtered: usize,
    /// Largest multiple of inertia that had to be added for a positive definite matrix.
    pub shift: f64,
    /// Number of iterations of the linear solver in each system, those of attempts that failed included.
    pub linear_iterations: Vec<usize>,
    /// Number of linear systems that were given up before their tolerance.
    pub truncated: usize,
}

/// What does not change in a minimisation, on one rank.
pub struct Objective<'a> {
    /// All ranks.
    pub team: &'a Team,
    /// The nodes of this rank.
    pub share: &'a Share,
    /// The elements of this rank.
    pub elastic: &'a mut Elastic,
    /// Sends copies and sums.
    pub exchange: &'a mut GhostedVector,
    /// Mass of each owned node, kg.
    pub masses: &'a [f64],
    /// The stage of the step.
    pub stage: &'a Stage,
    /// α of damping proportional to mass, 1/s.
    pub damping: f64,
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// Springs at owned nodes.
    pub springs: &'a Vec<Spring>,
    /// Diagonal that a unit of regularisation adds for each mass, 1/s².
    pub regularisation: f64,
    /// Diagonal that is always added for each mass to the second derivatives, 1/s².
    pub guard: f64,
}

impl Objective<'_> {
    /// Second derivative of inertia and damping in each coordinate of a node.
    fn diagonal(&self, node: usize) -> f64 {
        let [tau, sigma] = self.stage.lengths();
        self.masses[node] * (1.0 / sigma + self.damping) / tau
    }

    /// Stiffness of the springs at each owned node, N/m.
    fn spring_stiffness(&self) -> Vec<f64> {
        let mut stiffness = vec![0.0; self.share.owned];
        for spring in self.springs {
            for (node, weight) in spring.anchor.nodes.iter().zip(spring.anchor.weights) {
                if weight != 0.0 {
                    stiffness[*node] += spring.stiffness * weight * weight;
                }
            }
        }
        stiffness
    }

    /// Evaluates the energies of all elements; the tag of an element of any rank without one.
    fn evaluate(&mut self, x: &[[f64; 3]]) -> Option<u64> {
        self.elastic.evaluate_inner(x);
        self.elastic.evaluate_border(x);
        self.refused()
    }

    /// The smallest tag of an element of any rank that what was evaluated last does not exist of.
    fn refused(&self) -> Option<u64> {
        let tag = self.team.min(self.elastic.refused().map_or(f64::INFINITY, |tag| tag as f64));
        tag.is_finite().then_some(tag as u64)
    }

    /// Adds the gradient of all but deformation at the owned nodes, N.
    fn add_quadratic_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        for (node, total) in gradient.iter_mut().enumerate() {
            let [v, a] = self.stage.motion(node, x[node]);
            for c in 0..3 {
                total[c] += self.masses[node] * (a[c] + self.damping * v[c] - self.gravity[c]);
            }
        }
    }

    /// Replaces `gradient`, N, of the owned nodes, where the energies were evaluated last.
    fn gradient(&mut self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.elastic.gradient(self.exchange, gradient)?;
        self.springs.add_gradient(x, gradient);
        self.add_quadratic_gradient(x, gradient);
        Ok(())
    }

    /// Sum over all ranks of products of the free nodes.
    fn product(&self, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let pairs = a[..self.share.free].iter().zip(b);
        let own: f64 = pairs.map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sum();
        self.team.sum([own])[0]
    }
}

/// Moves `x`, m, of the nodes of each rank towards a minimum, the pinned ones by `pins_move` where it is
/// given.
///
/// # Errors
/// An [`Error`] that all ranks have, or one of PETSc.
pub fn minimize(
    objective: Objective<'_>,
    system: &mut LinearSystem,
    settings: &NewtonSettings,
    x: &mut [[f64; 3]],
    pins_move: Option<&[[f64; 3]]>,
) -> Result<NewtonReport, Error> {
    let nodes = x.len();
    let owned = objective.share.owned;
    let mut iteration = Iteration {
        settings,
        system,
        gradient: vec![[0.0; 3]; owned],
        direction: vec![[0.0; 3]; nodes],
        trial: vec![[0.0; 3]; nodes],
        is_sending: false,
        spring_stiffness: objective.spring_stiffness(),
        report: NewtonReport {
            convergence: Convergence::Limit,
            iterations: 0,
            first_residual: f64::NAN,
            residual: f64::NAN,
            refused_trials: 0,
            filtered: 0,
            shift: 0.0,
            linear_iterations: Vec::new(),
            truncated: 0,
        },
        objective,
    };
    iteration.system.begin();
    if let Some(element) = iteration.objective.evaluate(x) {
        return Err(Error::Inadmissible { element });
    }
    iteration.run(x, pins_move)?;
    Ok(iteration.report)
}

/// A minimisation under way.
struct Iteration<'a, 'b> {
    objective: Objective<'a>,
    system: &'b mut LinearSystem,
    settings: &'b NewtonSettings,
    /// Of owned nodes, N.
    gradient: Vec<[f64; 3]>,
    /// Of all nodes of the rank, m.
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
    /// Whether copies of the direction are under way.
    is_sending: bool,
    spring_stiffness: Vec<f64>,
    report: NewtonReport,
}

/// Outcome of a line search.
#[derive(PartialEq, Eq)]
enum Progress {
    Decrease,
    /// The objective changed by no more than noise; the slope has decided.
    BelowNoise,
    /// Nothing is left to gain but noise.
    Nothing,
}

impl Iteration<'_, '_> {
    fn run(&mut self, x: &mut [[f64; 3]], mut pins_move: Option<&[[f64; 3]]>) -> Result<(), Error> {
        // Iterations in a row that have gained nothing beyond noise.
        let mut idle = 0;
        let mut progress = Progress::Decrease;
        let mut forcing = 1.0;
        while self.report.iterations < self.settings.max_iterations {
            if self.report.iterations > 0 {
                let before = self.report.residual;
                if self.note_gradient(x)? {
                    break;
                }
                let is_idle = progress == Progress::BelowNoise && self.report.residual > 0.9 * before;
                idle = if is_idle { idle + 1 } else { 0 };
                // Twice, since the gradient of a filtered iteration need not fall each time.
                if idle == 2 {
                    self.report.convergence = Convergence::Rounding;
                    break;
                }
                forcing = self.forcing(before);
            }
            if !self.find_direction(x, pins_move, forcing)? {
                break;
            }
            if let Some(d) = pins_move.take()
                && !self.move_pins(x, d)?
            {
                continue;
            }
            progress = self.search(x)?;
            if progress == Progress::Nothing {
                self.report.convergence = Convergence::Rounding;
                break;
            }
        }
        Ok(())
    }

    /// Evaluates the gradient; true where it is small enough.
    fn note_gradient(&mut self, x: &[[f64; 3]]) -> Result<bool, Error> {
        self.objective.gradient(x, &mut self.gradient)?;
        self.note_residual()
    }

    /// Keeps the norm of the gradient; true where it is small enough.
    fn note_residual(&mut self) -> Result<bool, Error> {
        let residual = self.objective.product(&self.gradient, &self.gradient).sqrt();
        if !residual.is_finite() {
            return Err(Error::NotFinite);
        }
        if self.report.first_residual.is_nan() {
            self.report.first_residual = residual;
        }
        self.report.residual = residual;
        let converged = residual <= self.settings.tolerance * self.report.first_residual;
        if converged {
            self.report.convergence = Convergence::Tolerance;
        }
        Ok(converged)
    }

    /// A relative tolerance for the next system \[EW96, choice 2\], no tighter than the last one of all needs
    /// to be.
    ///
    /// \[EW96\] Eisenstat, Walker, *Choosing the forcing terms in an inexact Newton method*, 1996.
    fn forcing(&self, before: f64) -> f64 {
        let NewtonReport { residual, first_residual, .. } = self.report;
        let enough = 0.5 * self.settings.tolerance * first_residual / residual;
        (0.9 * (residual / before).powi(2)).max(enough).max(f64::EPSILON)
    }

    /// Linearises and solves for a direction; false where the gradient is small enough already.
    fn find_direction(
        &mut self,
        x: &[[f64; 3]],
        pins_move: Option<&[[f64; 3]]>,
        forcing: f64,
    ) -> Result<bool, Error> {
        let (filter, on_demand) = match self.settings.filtering {
            Filtering::Always(filter) => (filter, false),
            _ => (Filter::None, true),
        };
        self.linearise(filter, x, pins_move)?;
        if pins_move.is_none() && self.report.iterations == 0 && self.note_residual()? {
            return Ok(false);
        }
        let tolerance = forcing.min(self.settings.linear_tolerance);
        if !self.solve(x, tolerance, on_demand)? {
            self.linearise(Filter::Clamp, x, pins_move)?;
            self.solve(x, tolerance, false)?;
        }
        self.report.iterations += 1;
        Ok(true)
    }

    /// Evaluates the gradient and the filtered second derivatives. Pins that move enter the right side with
    /// their displacement d: K p = −g − K d.
    fn linearise(
        &mut self,
        filter: Filter,
        x: &[[f64; 3]],
        pins_move: Option<&[[f64; 3]]>,
    ) -> Result<(), Error> {
        let Self { objective, gradient, report, .. } = self;
        objective.elastic.linearise(filter, objective.exchange, gradient)?;
        if let Some(element) = objective.refused() {
            return Err(Error::Inadmissible { element });
        }
        report.filtered = report.filtered.max(objective.team.count(objective.elastic.filtered()));
        objective.springs.add_gradient(x, gradient);
        objective.add_quadratic_gradient(x, gradient);
        if let Some(d) = pins_move {
            objective.elastic.add_product(objective.exchange, d, gradient)?;
        }
        Ok(())
    }

    /// Solves for the direction, and begins to send it; false if the matrix is indefinite and must not be.
    fn solve(&mut self, x: &[[f64; 3]], tolerance: f64, must_be_definite: bool) -> Result<bool, Error> {
        let Self { objective, system, direction, gradient, spring_stiffness, .. } = self;
        let mut shift = 0.0;
        loop {
            let diagonal = |node: usize| {
                let added = objective.guard + shift * objective.regularisation;
                objective.diagonal(node) + objective.masses[node] * added + spring_stiffness[node]
            };
            system.assemble(objective.share, objective.elastic, diagonal, x)?;
            let owned = &mut direction[..objective.share.owned];
            let max_iterations = self.settings.max_linear_iterations;
            let (ending, iterations) = system.solve(
                objective.team,
                gradient,
                owned,
                tolerance,
                max_iterations,
                !must_be_definite,
            )?;
            self.report.linear_iterations.push(iterations);
            let slope = if ending == Ending::Failed { f64::NAN } else { objective.product(gradient, owned) };
            let descends = slope < 0.0;
            if matches!(ending, Ending::Converged | Ending::GivenUp) && descends {
                self.report.truncated += usize::from(ending == Ending::GivenUp);
                break;
            }
            if must_be_definite {
                return Ok(false);
            }
            // What conjugate gradients have found before they met a direction of negative curvature descends.
            if ending == Ending::Indefinite && descends {
                self.report.truncated += 1;
                break;
            }
            shift = if shift == 0.0 { 1.0 } else { 10.0 * shift };
            if shift > 1e12 {
                return Err(Error::NotPositive { shift: 1e12 });
            }
            self.report.shift = self.report.shift.max(shift);
        }
        objective.exchange.begin_copies(&direction[..objective.share.owned])?;
        self.is_sending = true;
        Ok(true)
    }

    /// Moves the pins; false where the direction, found before they moved, does not descend behind the move.
    fn move_pins(&mut self, x: &mut [[f64; 3]], d: &[[f64; 3]]) -> Result<bool, Error> {
        self.end_copies()?;
        for (x, d) in x.as_flattened_mut().iter_mut().zip(d.as_flattened()) {
            *x += d;
        }
        if let Some(element) = self.objective.evaluate(x) {
            return Err(Error::PinsMoveTooFar { element });
        }
        self.note_gradient(x)?;
        Ok(self.objective.product(&self.gradient, &self.direction) < 0.0)
    }

    fn end_copies(&mut self) -> Result<(), PetscError> {
        if std::mem::take(&mut self.is_sending) {
            self.objective.exchange.end_copies(&mut self.direction[self.objective.share.owned..])?;
        }
        Ok(())
    }

    /// Moves `x` along the direction as far as it is good.
    fn search(&mut self, x: &mut [[f64; 3]]) -> Result<Progress, Error> {
        let slope = self.objective.product(&self.gradient, &self.direction);
        if !slope.is_finite() {
            return Err(Error::NotFinite);
        }
        self.objective.elastic.set_base();
        let quadratic = self.quadratic_along(x);
        let search = self.settings.line_search;
        let mut line = Along { iteration: self, x, quadratic, last: None, refused: 0, failure: None };
        let step = search.step(&mut line, 1.0, slope);
        let Along { last, refused, failure, .. } = line;
        if let Some(error) = failure {
            return Err(error.into());
        }
        self.report.refused_trials += refused;
        let Some((_, change)) = step.and(last) else {
            self.objective.evaluate(x);
            let noise = self.objective.team.sum([self.objective.elastic.change().noise])[0];
            if -slope > noise {
                return Err(Error::LineSearch { residual: self.report.residual, refused });
            }
            return Ok(Progress::Nothing);
        };
        x.copy_from_slice(&self.trial);
        Ok(if change.difference.abs() <= change.noise { Progress::BelowNoise } else { Progress::Decrease })
    }

    /// Slope and curvature along the direction of all but deformation and springs.
    fn quadratic_along(&self, x: &[[f64; 3]]) -> [f64; 2] {
        let Objective { share, team, .. } = self.objective;
        let mut gradient = vec![[0.0; 3]; share.owned];
        self.objective.add_quadratic_gradient(x, &mut gradient);
        let mut own = [0.0; 2];
        for node in 0..share.free {
            let d = self.direction[node];
            for c in 0..3 {
                own[0] += gradient[node][c] * d[c];
                own[1] += self.objective.diagonal(node) * d[c] * d[c];
            }
        }
        team.sum(own)
    }
}

/// The objective along a line.
struct Along<'i, 'a, 'b> {
    iteration: &'i mut Iteration<'a, 'b>,
    x: &'i [[f64; 3]],
    /// Slope and curvature of all but deformation and springs.
    quadratic: [f64; 2],
    /// The step tried last, with the change there.
    last: Option<(f64, EnergyChange)>,
    refused: usize,
    /// What PETSc has failed at, after which no answer means anything.
    failure: Option<PetscError>,
}

impl Along<'_, '_, '_> {
    /// Evaluates the energies at a step, those inside while copies of the direction arrive.
    fn evaluate(&mut self, step: f64) -> Result<(), PetscError> {
        let Self { iteration, x, .. } = self;
        let owned = iteration.objective.share.owned;
        let nodes = x.len();
        iteration.move_trial(x, step, 0..owned);
        iteration.objective.elastic.evaluate_inner(&iteration.trial);
        iteration.end_copies()?;
        iteration.move_trial(x, step, owned..nodes);
        iteration.objective.elastic.evaluate_border(&iteration.trial);
        Ok(())
    }
}

impl Iteration<'_, '_> {
    fn move_trial(&mut self, x: &[[f64; 3]], step: f64, nodes: std::ops::Range<usize>) {
        for node in nodes {
            for c in 0..3 {
                self.trial[node][c] = x[node][c] + step * self.direction[node][c];
            }
        }
    }
}

impl Line for Along<'_, '_, '_> {
    fn change(&mut self, step: f64) -> Option<EnergyChange> {
        if let Err(error) = self.evaluate(step) {
            self.failure.get_or_insert(error);
        }
        let Objective { team, elastic, springs, .. } = &self.iteration.objective;
        let is_refused = self.failure.is_some() || elastic.refused().is_some();
        let of_elements = elastic.change();
        let of_springs = springs.change(self.x, &self.iteration.trial).unwrap_or_default();
        let [difference, noise, refused] = team.sum([
            if is_refused { 0.0 } else { of_elements.difference + of_springs.difference },
            if is_refused { 0.0 } else { of_elements.noise + of_springs.noise },
            f64::from(u8::from(is_refused)),
        ]);
        if refused > 0.0 {
            self.refused += 1;
            self.last = None;
            return None;
        }
        let [slope, curvature] = self.quadratic;
        let (linear, quadratic) = (step * slope, 0.5 * step * step * curvature);
        let change = EnergyChange {
            difference: linear + quadratic + difference,
            // Slope and curvature are sums of products; 4u allows for the cancellation within the slope.
            noise: 2.0 * f64::EPSILON * (linear.abs() + quadratic) + noise,
        };
        self.last = Some((step, change));
        Some(change)
    }

    fn slope(&mut self) -> f64 {
        let Iteration { objective, trial, gradient, direction, .. } = &mut *self.iteration;
        if let Err(error) = objective.gradient(trial, gradient) {
            self.failure.get_or_insert(error);
        }
        objective.product(gradient, direction)
    }
}
