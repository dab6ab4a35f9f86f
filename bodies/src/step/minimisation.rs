//! Newton's method for a body, or for the part of a machine: its variables are the nodal positions.
//!
//! The energy of a body that is divided among [machines](Machine) is the sum over their parts, and so are its
//! derivatives. Positions and directions are known at all nodes of a part, those of other machines included.
//! Gradients are sums over the parts at the nodes that a machine owns, and zero at copies of others. Results
//! are sums and extrema over the machines, so that all make the same decisions: if an element of any machine
//! refuses a point, the step is too long on all. On one machine nothing is added.

use piola::lanes::Real;
use piola::point::Filter;

use crate::system::Body;
use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::linear::multigrid::Division;

use super::error::NewtonError;
use super::line_search::Line;
use super::newton::NewtonReport;
use super::objective::{Objective, product};
use super::solver::{Machine, System};
use super::term::{EnergyChange, contradiction};

#[derive(Clone)]
pub(super) struct NewtonWorkspace<M> {
    pub(super) machine: M,
    gradient: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
}

impl<M: Machine> NewtonWorkspace<M> {
    pub(super) fn new(machine: M, nodes: usize) -> Self {
        let zero = || vec![[0.0; 3]; nodes];
        Self { machine, gradient: zero(), direction: zero(), trial: zero() }
    }

    /// Discards the direction, which is zero at pinned nodes.
    pub(super) fn forget_direction(&mut self) {
        self.direction.fill([0.0; 3]);
    }

    /// Adds the gradients of all machines at the nodes that this one owns.
    fn sum_gradient(&mut self) {
        let (nodes, gradient) = (self.machine.nodes_mut(), &mut self.gradient);
        nodes.sum(gradient);
        let owned = gradient.len() - nodes.copies();
        gradient[owned..].fill([0.0; 3]);
    }

    /// Norm of the gradient over the free nodes.
    fn free_norm(&self) -> f64 {
        let square = |g: [f64; 3]| g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        let own = self.machine.free_nodes().iter().map(|&node| square(self.gradient[node])).sum::<f64>();
        self.machine.nodes().total(own).sqrt()
    }
}

/// The minimisation of a stage of a step: the objective with its variables x, the gradient g at x, a
/// direction d, and the trial x + step d of a line search.
///
/// Each number that a method returns is the same on all machines.
pub(super) struct Minimisation<'a, M> {
    objective: Objective<'a>,
    workspace: &'a mut NewtonWorkspace<M>,
    x: &'a mut [[f64; 3]],
    /// Displacement of each pinned node, m; zero for others.
    pins_move: &'a [[f64; 3]],
    /// Survey of the energies evaluated last.
    pub(super) survey: Evaluated,
    /// First and second derivative of the quadratic part along the direction.
    quadratic: [f64; 2],
}

impl<'a, M: Machine> Minimisation<'a, M> {
    /// Starts at `x`, where the energies have been evaluated last, with this survey.
    pub(super) fn new(
        objective: Objective<'a>,
        workspace: &'a mut NewtonWorkspace<M>,
        x: &'a mut [[f64; 3]],
        pins_move: &'a [[f64; 3]],
        survey: Evaluated,
    ) -> Result<Self, NewtonError> {
        demand_admissible(workspace.machine.nodes(), &survey, objective.body, objective.elastic)?;
        if let Some(term) = objective.terms.refusing(x) {
            return Err(NewtonError::TermRefuses { term });
        }
        workspace.machine.begin();
        Ok(Self { objective, workspace, x, pins_move, survey, quadratic: [0.0; 2] })
    }
}

impl<M: Machine> Line for Minimisation<'_, M> {
    fn change(&mut self, step: f64) -> Option<EnergyChange> {
        let Self { objective, workspace: NewtonWorkspace { machine, direction, trial, .. }, x, .. } = self;
        for node in 0..x.len() {
            for c in 0..3 {
                trial[node][c] = x[node][c] + step * direction[node][c];
            }
        }
        let terms = objective.terms.change(x, trial);
        let terms = terms.filter(|_| objective.elastic.evaluate(objective.body, trial).survey.is_clean());
        let elastic = &objective.elastic;
        // One message of all numbers.
        let own = terms.map_or([1.0, 0.0, 0.0, 0.0, 0.0], |terms| {
            let noise = elastic.difference_noise(objective.body);
            [0.0, terms.difference, elastic.difference(), noise, terms.noise]
        });
        let [refused, terms, elastic, elastic_noise, terms_noise] = machine.nodes().totals(own);
        if refused > 0.0 {
            return None;
        }
        let [slope, curvature] = self.quadratic;
        let (linear, quadratic) = (step * slope, 0.5 * step * step * curvature);
        // Slope and curvature are sums of products; 4u allows for the cancellation within the slope.
        let noise = 4.0 * f64::UNIT_ROUNDOFF * (linear.abs() + quadratic) + elastic_noise + terms_noise;
        Some(EnergyChange { difference: linear + quadratic + terms + elastic, noise })
    }

    fn slope(&mut self) -> f64 {
        let Self { objective, workspace, .. } = self;
        objective.elastic.evaluate_gradients(objective.body);
        objective.gradient(&workspace.trial, &mut workspace.gradient);
        workspace.sum_gradient();
        self.descent()
    }
}

impl<M: Machine> Minimisation<'_, M> {
    /// Evaluates g after the energies; returns its norm over the free variables, N.
    pub(super) fn gradient(&mut self) -> f64 {
        self.objective.elastic.evaluate_gradients(self.objective.body);
        self.objective.gradient(self.x, &mut self.workspace.gradient);
        self.workspace.sum_gradient();
        self.workspace.free_norm()
    }

    /// Evaluates g and the filtered second derivatives K; with `pins_move`, adds K times the displacement of
    /// the pins to g. Returns the norm of g over the free variables, N.
    pub(super) fn linearise(
        &mut self,
        filter: Filter,
        pins_move: bool,
        report: &mut NewtonReport,
    ) -> Result<f64, NewtonError> {
        let Self { objective, workspace, x, .. } = self;
        objective.terms.linearise(x, objective.blocks)?;
        workspace.machine.join(objective.body, objective.blocks)?;
        let tangents = workspace
            .machine
            .with_stiffness(|stiffness| stiffness.linearise(objective.body, objective.elastic, filter));
        demand_admissible(workspace.machine.nodes(), &tangents, objective.body, objective.elastic)?;
        let NewtonWorkspace { machine, gradient, .. } = &mut **workspace;
        objective.gradient(x, gradient);
        if pins_move {
            machine.with_stiffness(|stiffness| {
                stiffness.add_product(objective.body, self.pins_move, gradient);
            });
            objective.add_product(self.pins_move, gradient);
        }
        workspace.sum_gradient();
        let residual = workspace.free_norm();
        let counts = [tangents.survey.filtered, tangents.survey.bounded];
        let [filtered, bounded] = workspace.machine.nodes().totals(counts.map(|count| count as f64));
        report.filtered = report.filtered.max(filtered as usize);
        report.bounded = report.bounded.max(bounded as usize);
        Ok(residual)
    }

    /// Solves K d = −g. The relative tolerance takes effect if it is tighter than the solver's own.
    /// Returns false if K must be definite and is not.
    pub(super) fn solve(
        &mut self,
        tolerance: f64,
        must_be_definite: bool,
        report: &mut NewtonReport,
    ) -> Result<bool, NewtonError> {
        let NewtonWorkspace { machine, gradient, direction, .. } = &mut *self.workspace;
        let system = System { objective: &self.objective, x: self.x, gradient, tolerance, must_be_definite };
        let solved = machine.solve(system, direction)?;
        machine.nodes_mut().copy(direction);
        let Some(solution) = solved else { return Ok(false) };
        report.shift = report.shift.max(solution.shift);
        report.linear_iterations += solution.iterations;
        report.truncated += usize::from(solution.truncated);
        Ok(true)
    }

    /// Moves the pins in x, and evaluates the energies there.
    pub(super) fn move_pins(&mut self) -> Result<(), NewtonError> {
        for (x, d) in self.x.as_flattened_mut().iter_mut().zip(self.pins_move.as_flattened()) {
            *x += d;
        }
        self.survey = self.objective.elastic.evaluate(self.objective.body, self.x);
        let nodes = self.workspace.machine.nodes();
        if let Some((element, _)) = inadmissible(nodes, &self.survey, self.objective.body) {
            return Err(NewtonError::PinsMoveTooFar { element });
        }
        match self.objective.terms.refusing(self.x) {
            Some(term) => Err(NewtonError::TermRefuses { term }),
            None => Ok(()),
        }
    }

    /// g·d over the free variables, J.
    pub(super) fn descent(&self) -> f64 {
        let NewtonWorkspace { machine, gradient, direction, .. } = &*self.workspace;
        machine.nodes().total(product(gradient, direction))
    }

    /// Share of the direction that a line search tries first, at most 1.
    pub(super) fn longest_step(&self) -> f64 {
        self.objective.terms.longest_step(self.x, &self.workspace.direction)
    }

    /// Prepares [`Line::change`]: differences of energies are relative to x.
    pub(super) fn set_base(&mut self) {
        let Self { objective, workspace: NewtonWorkspace { machine, gradient, direction, .. }, .. } = self;
        objective.elastic.set_base();
        objective.quadratic_gradient(self.x, gradient);
        let own = [product(gradient, direction), objective.curvature(direction)];
        self.quadratic = machine.nodes().totals(own);
    }

    /// Replaces x by the trial evaluated last.
    pub(super) fn accept(&mut self) {
        self.x.copy_from_slice(&self.workspace.trial);
        self.survey = self.objective.elastic.survey();
    }

    /// Evaluates the energies at x again; returns the rounding error of their differences there, J.
    pub(super) fn reject(&mut self) -> f64 {
        self.survey = self.objective.elastic.evaluate(self.objective.body, self.x);
        self.workspace.machine.nodes().total(self.objective.noise(self.x))
    }

    /// Checks that the energies of each term and of the materials change along ±d, up to the
    /// [longest step](Self::longest_step), as their gradients predict, after [`Minimisation::set_base`].
    /// Overwrites g and the trial.
    pub(super) fn demand_true_gradients(&mut self, longest: f64) -> Result<(), NewtonError> {
        let Self { objective: Objective { elastic, body, terms, .. }, workspace, x, .. } = self;
        let NewtonWorkspace { machine, gradient, direction, trial } = &mut **workspace;
        for term in (0..terms.others.len()).map(Some).chain([None]) {
            let evaluate = |to: &[[f64; 3]], gradient: &mut [[f64; 3]]| match term {
                Some(term) => {
                    let term = &terms.others[term];
                    term.change(x, to).inspect(|_| term.add_gradient(to, gradient))
                }
                None => elastic.evaluate(body, to).survey.is_clean().then(|| {
                    elastic.evaluate_gradients(body);
                    elastic.add_gradient(body, gradient);
                    EnergyChange { difference: elastic.difference(), noise: elastic.difference_noise(body) }
                }),
            };
            let total = |own| machine.nodes().totals(own);
            if contradiction(x, (direction, longest), [trial, gradient], total, evaluate).is_some() {
                return Err(NewtonError::WrongGradient { term });
            }
        }
        Ok(())
    }

    /// Largest displacement of a node along d, m.
    pub(super) fn displacement(&self) -> f64 {
        let square = |d: &[f64; 3]| d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        let own = self.workspace.direction.iter().map(square).fold(0.0, f64::max).sqrt();
        self.workspace.machine.nodes().largest(own)
    }

    /// Scale of the error in time of the step with the nodes at x, m.
    pub(super) fn error_scale(&self) -> f64 {
        let own = self.objective.stage.error_scale(self.x);
        self.workspace.machine.nodes().largest(own)
    }
}

/// Checks that all elements of all machines were admissible at the last evaluation of the energies.
pub(super) fn demand_admissible(
    nodes: &impl Division,
    survey: &Evaluated,
    body: &Body,
    elastic: &Elastic,
) -> Result<(), NewtonError> {
    let Some((element, is_here)) = inadmissible(nodes, survey, body) else { return Ok(()) };
    let mut own = [0.0; 5];
    if is_here {
        let mut all = body.elements().iter().zip(elastic.stretches());
        let found = all.find(|(other, _)| other.tag == element);
        let [l1, l2, l3] = found.map_or([f64::NAN; 3], |(_, stretches)| stretches);
        own = [1.0, survey.survey.refused as f64, l1, l2, l3];
    }
    let [machines, refused, stretches @ ..] = nodes.totals(own);
    if refused == 0.0 {
        return Err(NewtonError::ElementNotFinite { element });
    }
    Err(NewtonError::Inadmissible { element, stretches: stretches.map(|stretch| stretch / machines) })
}

/// Tag of the first element without a valid energy on any machine, and true if it is on this one.
fn inadmissible(nodes: &impl Division, evaluated: &Evaluated, body: &Body) -> Option<(usize, bool)> {
    let own = evaluated.survey.first.map(|element| body.elements()[element].tag);
    let number = own.map_or(f64::INFINITY, |tag| tag as f64);
    let first = -nodes.largest(-number);
    match own {
        Some(tag) if number == first => Some((tag, true)),
        _ => first.is_finite().then_some((first as usize, false)),
    }
}
