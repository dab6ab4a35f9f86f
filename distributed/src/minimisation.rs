//! Newton's method for a body that is divided among ranks.
//!
//! The method is piola's ([`piola_bodies::step::divided::minimize`]). This body is a [`Minimisation`] whose
//! results are sums and extrema over the ranks, so that all ranks make the same decisions. If an element of
//! any rank refuses a point, the step is too long on every rank. PETSc's SNES is not used, because it does
//! not support pins that move into the first system, a filter on demand, or an end below the rounding error
//! of the energy.
//!
//! The objective is the one of a stage (see [`piola_bodies::step::divided::StagedSteps`]),
//!
//! ```text
//! E(x) = ½‖x − s − τ w‖²_M / (τσ) + α/(2τ) ‖x − s‖²_M + Ψ(x) − Σ m g·x + Σ springs
//! ```
//!
//! Positions of copies are not sent: every rank moves them with the same arithmetic as their owners, along
//! directions that are sent once in an iteration.

use piola::point::Filter;
use piola_bodies::step::divided::{Definiteness, End, Line, Linearised, Minimisation, Solution, Stage};
use piola_bodies::step::{EnergyChange, NewtonError, Spring, Term};

use crate::elastic::Elastic;
use crate::error::Error;
use crate::petsc::{GhostedVector, PetscError};
use crate::share::Share;
use crate::system::LinearSystem;
use crate::team::Team;

/// Data of one rank that do not change during a minimisation.
pub struct Objective<'a> {
    /// Team of all ranks.
    pub team: &'a Team,
    /// Nodes and elements of this rank.
    pub share: &'a Share,
    /// Energies of the elements of this rank.
    pub elastic: &'a mut Elastic,
    /// Vector that exchanges copies and sums.
    pub exchange: &'a mut GhostedVector,
    /// Mass of each owned node, kg.
    pub masses: &'a [f64],
    /// Stage of the step.
    pub stage: &'a Stage,
    /// α of damping proportional to mass, 1/s.
    pub damping: f64,
    /// Gravity, m/s².
    pub gravity: [f64; 3],
    /// Springs at owned nodes.
    pub springs: &'a Vec<Spring>,
    /// Diagonal entry of one unit of regularisation, per mass, 1/s².
    pub regularisation: f64,
    /// Diagonal entry that is always added to the second derivatives, per mass, 1/s².
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

    /// Evaluates the energies of all elements; returns the tag of an element, on any rank, without an energy.
    fn evaluate(&mut self, x: &[[f64; 3]]) -> Option<usize> {
        self.elastic.evaluate(x);
        self.refused()
    }

    /// Smallest tag of an element, on any rank, without a result of the last evaluation.
    fn refused(&self) -> Option<usize> {
        let tag = self.team.min(self.elastic.refused().map_or(f64::INFINITY, |tag| tag as f64));
        tag.is_finite().then_some(tag as usize)
    }

    /// Adds the gradient at the owned nodes, N, of inertia, damping and gravity.
    fn add_quadratic_gradient(&self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) {
        for (node, total) in gradient.iter_mut().enumerate() {
            let [v, a] = self.stage.motion(node, x[node]);
            for c in 0..3 {
                total[c] += self.masses[node] * (a[c] + self.damping * v[c] - self.gravity[c]);
            }
        }
    }

    /// Replaces `gradient`, N, at the owned nodes by the gradient at the last evaluated positions.
    fn gradient(&mut self, x: &[[f64; 3]], gradient: &mut [[f64; 3]]) -> Result<(), PetscError> {
        self.elastic.gradient(self.exchange, gradient)?;
        self.springs.add_gradient(x, gradient);
        self.add_quadratic_gradient(x, gradient);
        Ok(())
    }

    /// Scalar product over the free nodes of all ranks.
    fn product(&self, a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
        let pairs = a[..self.share.free].iter().zip(b);
        let own: f64 = pairs.map(|(a, b)| a[0] * b[0] + a[1] * b[1] + a[2] * b[2]).sum();
        self.team.sum([own])[0]
    }
}

/// Limits of the linear solver.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Relative tolerance of the first linear system, and upper bound of later tolerances.
    pub tolerance: f64,
    /// Maximum number of iterations.
    pub max_iterations: usize,
}

/// Minimisation of a stage of a step, on one rank.
pub struct StageMinimisation<'a> {
    objective: Objective<'a>,
    system: &'a mut LinearSystem,
    limits: Limits,
    /// Positions of all nodes of the rank, m.
    x: &'a mut [[f64; 3]],
    /// Displacement of each pinned node, m; zero for others.
    pins_move: &'a [[f64; 3]],
    /// Gradient at the owned nodes, N.
    gradient: Vec<[f64; 3]>,
    /// Direction of all nodes of the rank, m.
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
    spring_stiffness: Vec<f64>,
    /// Slope and curvature of inertia, damping and gravity along the direction.
    quadratic: [f64; 2],
    /// Number of iterations of the linear solver in each linear system.
    systems: Vec<usize>,
}

impl<'a> StageMinimisation<'a> {
    /// Begins at `x`, m, the positions of the nodes of the rank.
    ///
    /// # Errors
    /// [`Error::Inadmissible`], on all ranks.
    pub fn new(
        mut objective: Objective<'a>,
        system: &'a mut LinearSystem,
        limits: Limits,
        x: &'a mut [[f64; 3]],
        pins_move: &'a [[f64; 3]],
    ) -> Result<Self, Error> {
        system.begin();
        if let Some(element) = objective.evaluate(x) {
            return Err(Error::Inadmissible { element });
        }
        Ok(Self {
            system,
            limits,
            gradient: vec![[0.0; 3]; objective.share.owned],
            direction: vec![[0.0; 3]; x.len()],
            trial: vec![[0.0; 3]; x.len()],
            spring_stiffness: objective.spring_stiffness(),
            quadratic: [0.0; 2],
            systems: Vec::new(),
            objective,
            x,
            pins_move,
        })
    }

    /// Number of iterations of the linear solver in each linear system, including failed attempts.
    #[must_use]
    pub fn systems(self) -> Vec<usize> {
        self.systems
    }
}

impl Line for StageMinimisation<'_> {
    type Error = Error;

    fn change(&mut self, step: f64) -> Result<Option<EnergyChange>, Error> {
        for node in 0..self.x.len() {
            for c in 0..3 {
                self.trial[node][c] = self.x[node][c] + step * self.direction[node][c];
            }
        }
        self.objective.elastic.evaluate(&self.trial);

        let Objective { team, elastic, springs, .. } = &self.objective;
        let is_refused = elastic.refused().is_some();
        let of_elements = elastic.change();
        let of_springs = springs.change(self.x, &self.trial).unwrap_or_default();
        let [difference, noise, refused] = team.sum([
            if is_refused { 0.0 } else { of_elements.difference + of_springs.difference },
            if is_refused { 0.0 } else { of_elements.noise + of_springs.noise },
            f64::from(u8::from(is_refused)),
        ]);
        if refused > 0.0 {
            return Ok(None);
        }
        let [slope, curvature] = self.quadratic;
        let (linear, quadratic) = (step * slope, 0.5 * step * step * curvature);
        Ok(Some(EnergyChange {
            difference: linear + quadratic + difference,
            // Slope and curvature are sums of products; 4u allows for the cancellation within the slope.
            noise: 2.0 * f64::EPSILON * (linear.abs() + quadratic) + noise,
        }))
    }

    fn slope(&mut self) -> Result<f64, Error> {
        self.objective.gradient(&self.trial, &mut self.gradient)?;
        Ok(self.descent())
    }
}

impl Minimisation for StageMinimisation<'_> {
    fn gradient(&mut self) -> Result<f64, Error> {
        self.objective.gradient(self.x, &mut self.gradient)?;
        Ok(self.objective.product(&self.gradient, &self.gradient).sqrt())
    }

    fn linearise(&mut self, filter: Filter, pins_move: bool) -> Result<Linearised, Error> {
        let Self { objective, system, gradient, x, .. } = self;
        let Objective { elastic, exchange, .. } = objective;
        system.with_stiffness(|stiffness| elastic.linearise(filter, stiffness, exchange, gradient))?;
        if let Some(element) = objective.refused() {
            return Err(Error::Inadmissible { element });
        }
        objective.springs.add_gradient(x, gradient);
        objective.add_quadratic_gradient(x, gradient);
        if pins_move {
            system.add_product(self.pins_move, gradient)?;
        }
        Ok(Linearised {
            residual: objective.product(gradient, gradient).sqrt(),
            filtered: objective.team.count(objective.elastic.filtered()),
            bounded: objective.team.count(objective.elastic.bounded()),
        })
    }

    /// Solves for the direction, and sends it to copies.
    fn solve(&mut self, tolerance: f64, definiteness: Definiteness) -> Result<Option<Solution>, Error> {
        let Self { objective, system, direction, gradient, spring_stiffness, systems, .. } = self;
        let Objective { share, team, .. } = *objective;
        let must_be_definite = definiteness == Definiteness::Required;
        let limits = (tolerance.min(self.limits.tolerance), self.limits.max_iterations);
        let inertia = |node: usize| objective.diagonal(node) + objective.masses[node] * objective.guard;
        system.add_to_diagonal(share, |node| inertia(node) + spring_stiffness[node]);
        let mut solution = Solution::default();
        loop {
            let owned = &mut direction[..share.owned];
            let may_fall_back = !must_be_definite;
            let solved =
                system.solve(team, share, self.x, inertia, gradient, owned, limits, may_fall_back)?;
            systems.push(solved.iterations);
            solution.iterations += solved.iterations;
            let slope =
                if solved.end == End::NotFinite { f64::NAN } else { objective.product(gradient, owned) };
            let descends = slope < 0.0 && slope.is_finite();
            if matches!(solved.end, End::Converged | End::Limit) && descends {
                solution.truncated = solved.end == End::Limit;
                break;
            }
            if must_be_definite {
                return Ok(None);
            }
            // Conjugate gradients that end at negative curvature return a direction of descent.
            if solved.end == End::NegativeCurvature && descends {
                solution.truncated = true;
                break;
            }
            let shift = if solution.shift == 0.0 { 1.0 } else { 10.0 * solution.shift };
            if shift > 1e12 {
                return Err(Error::NotPositive { shift: 1e12 });
            }
            let added = (shift - solution.shift) * objective.regularisation;
            system.add_to_diagonal(share, |node| added * objective.masses[node]);
            solution.shift = shift;
        }
        objective.exchange.copy(direction.as_flattened_mut())?;
        Ok(Some(solution))
    }

    fn move_pins(&mut self) -> Result<(), Error> {
        for (x, d) in self.x.as_flattened_mut().iter_mut().zip(self.pins_move.as_flattened()) {
            *x += d;
        }
        match self.objective.evaluate(self.x) {
            Some(element) => Err(NewtonError::PinsMoveTooFar { element }.into()),
            None => Ok(()),
        }
    }

    fn descent(&self) -> f64 {
        self.objective.product(&self.gradient, &self.direction)
    }

    fn set_base(&mut self) {
        self.objective.elastic.set_base();
        let Objective { share, team, .. } = self.objective;
        let mut gradient = vec![[0.0; 3]; share.owned];
        self.objective.add_quadratic_gradient(self.x, &mut gradient);
        let mut own = [0.0; 2];
        for node in 0..share.free {
            let d = self.direction[node];
            for c in 0..3 {
                own[0] += gradient[node][c] * d[c];
                own[1] += self.objective.diagonal(node) * d[c] * d[c];
            }
        }
        self.quadratic = team.sum(own);
    }

    fn accept(&mut self) {
        self.x.copy_from_slice(&self.trial);
    }

    fn reject(&mut self) -> f64 {
        self.objective.evaluate(self.x);
        let of_springs = self.objective.springs.change(self.x, self.x).unwrap_or_default();
        self.objective.team.sum([self.objective.elastic.change().noise + of_springs.noise])[0]
    }

    fn displacement(&self) -> f64 {
        let square = |d: &[f64; 3]| d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let owned = &self.direction[..self.objective.share.owned];
        self.objective.team.max(owned.iter().map(square).fold(0.0, f64::max).sqrt())
    }

    fn error_scale(&self) -> f64 {
        self.objective.team.max(self.objective.stage.error_scale(self.x))
    }
}
