//! Newton's method for a body on one machine: its variables are the nodal positions.

use piola::NoSuchNode;
use piola::lanes::Real;
use piola::point::Filter;

use crate::system::assemble::Elastic;
use crate::system::element::Evaluated;
use crate::system::{Body, LinearError, Pins};

use super::line_search::Line;
use super::newton::{Linearised, Minimisation, NewtonError};
use super::objective::{Objective, product};
use super::solver::{Choice, Definiteness, Solution, Solver};
use super::term::{EnergyChange, NodeBlocks};

/// Memory of Newton's method.
#[derive(Clone)]
pub(super) struct NewtonWorkspace {
    solver: Box<dyn Solver>,
    choice: Choice,
    pins: Pins,
    gradient: Vec<[f64; 3]>,
    direction: Vec<[f64; 3]>,
    trial: Vec<[f64; 3]>,
}

impl NewtonWorkspace {
    /// Allocates the memory for a body with these pins.
    pub(super) fn new(body: &Body, pins: &Pins, choice: Choice) -> Result<Self, LinearError> {
        let nodes = body.rest().len();
        Ok(Self {
            solver: choice.set_up(body, pins, &[])?,
            choice,
            pins: pins.clone(),
            gradient: vec![[0.0; 3]; nodes],
            direction: vec![[0.0; 3]; nodes],
            trial: vec![[0.0; 3]; nodes],
        })
    }

    /// True if the linear solver is user-defined.
    pub(super) fn has_user_defined_solver(&self) -> bool {
        matches!(self.choice, Choice::UserDefined(_))
    }

    /// Replaces the pins; sets up a new solver if the present one cannot handle them.
    pub(super) fn set_pins(&mut self, body: &Body, pins: &Pins) -> Result<(), LinearError> {
        if !self.solver.set_pins(pins) {
            self.solver = self.choice.set_up(body, pins, &[])?;
        }
        self.pins = pins.clone();
        Ok(())
    }

    /// Sets up a new solver if the blocks of the terms join nodes without a block in its matrix.
    fn join(&mut self, body: &Body, blocks: &NodeBlocks) -> Result<(), LinearError> {
        let is_free = |node: &usize| self.pins.nodes().binary_search(node).is_err();
        let is_missing = |[a, b]: &[usize; 2]| is_free(a) && is_free(b) && !self.solver.joins(*a, *b);
        if blocks.pairs().any(|pair| is_missing(&pair)) {
            let pairs: Vec<[usize; 2]> = blocks.pairs().collect();
            self.solver = self.choice.set_up(body, &self.pins, &pairs)?;
        }
        Ok(())
    }

    /// Norm of the gradient over the free nodes.
    fn free_norm(&self) -> f64 {
        let square = |g: [f64; 3]| g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        self.solver.free_nodes().iter().map(|&node| square(self.gradient[node])).sum::<f64>().sqrt()
    }
}

/// The minimisation of a stage of a step.
pub(super) struct StageMinimisation<'a> {
    objective: Objective<'a>,
    workspace: &'a mut NewtonWorkspace,
    x: &'a mut [[f64; 3]],
    /// Displacement of each pinned node, m; zero for others.
    pins_move: &'a [[f64; 3]],
    /// Survey of the energies evaluated last.
    survey: Evaluated,
    /// First and second derivative of the quadratic part along the direction.
    quadratic: [f64; 2],
}

impl<'a> StageMinimisation<'a> {
    /// Starts at `x`, where the energies have been evaluated last, with this survey.
    pub(super) fn new(
        objective: Objective<'a>,
        workspace: &'a mut NewtonWorkspace,
        x: &'a mut [[f64; 3]],
        pins_move: &'a [[f64; 3]],
        survey: Evaluated,
    ) -> Result<Self, NewtonError> {
        demand_admissible(&survey, objective.body, objective.elastic)?;
        if let Some(term) = objective.terms.refusing(x) {
            return Err(NewtonError::TermRefuses { term });
        }
        workspace.solver.begin();
        Ok(Self { objective, workspace, x, pins_move, survey, quadratic: [0.0; 2] })
    }

    /// Survey of the energies at the end.
    pub(super) fn survey(&self) -> Evaluated {
        self.survey
    }
}

impl Line for StageMinimisation<'_> {
    type Error = NewtonError;

    fn change(&mut self, step: f64) -> Result<Option<EnergyChange>, NewtonError> {
        let Self { objective, workspace: NewtonWorkspace { direction, trial, .. }, x, .. } = self;
        for node in 0..x.len() {
            for c in 0..3 {
                trial[node][c] = x[node][c] + step * direction[node][c];
            }
        }
        let Some(terms) = objective.terms.change(x, trial) else { return Ok(None) };
        if !objective.evaluate(trial).survey.is_clean() {
            return Ok(None);
        }
        let [slope, curvature] = self.quadratic;
        let (linear, quadratic) = (step * slope, 0.5 * step * step * curvature);
        let elastic = &objective.elastic;
        // Slope and curvature are sums of products; 4u allows for the cancellation within the slope.
        let noise = 4.0 * f64::UNIT_ROUNDOFF * (linear.abs() + quadratic)
            + elastic.difference_noise(objective.body)
            + terms.noise;
        let difference = linear + quadratic + terms.difference + elastic.difference();
        Ok(Some(EnergyChange { difference, noise }))
    }

    fn slope(&mut self) -> Result<f64, NewtonError> {
        let Self { objective, workspace: NewtonWorkspace { gradient, direction, trial, .. }, .. } = self;
        objective.elastic.evaluate_gradients(objective.body);
        objective.gradient(trial, gradient);
        Ok(product(gradient, direction))
    }
}

impl Minimisation for StageMinimisation<'_> {
    fn gradient(&mut self) -> Result<f64, NewtonError> {
        self.objective.elastic.evaluate_gradients(self.objective.body);
        self.objective.gradient(self.x, &mut self.workspace.gradient);
        Ok(self.workspace.free_norm())
    }

    fn linearise(&mut self, filter: Filter, pins_move: bool) -> Result<Linearised, NewtonError> {
        let Self { objective, workspace, x, .. } = self;
        objective.terms.linearise(x, objective.blocks);
        if let Some(node) = objective.blocks.missing() {
            return Err(NoSuchNode { element: None, node, nodes: x.len() }.into());
        }
        workspace.join(objective.body, objective.blocks)?;
        let tangents = workspace.solver.linearise(objective, filter);
        demand_admissible(&tangents, objective.body, objective.elastic)?;
        let NewtonWorkspace { solver, gradient, .. } = &mut **workspace;
        objective.gradient(x, gradient);
        if pins_move {
            solver.add_product(objective, self.pins_move, gradient);
        }
        let Evaluated { survey, .. } = tangents;
        let residual = workspace.free_norm();
        Ok(Linearised { residual, filtered: survey.filtered, bounded: survey.bounded })
    }

    fn solve(&mut self, tolerance: f64, definiteness: Definiteness) -> Result<Option<Solution>, NewtonError> {
        let NewtonWorkspace { solver, gradient, direction, .. } = &mut *self.workspace;
        Ok(solver.solve(&self.objective, self.x, gradient, direction, tolerance, definiteness)?)
    }

    fn move_pins(&mut self) -> Result<(), NewtonError> {
        for (x, d) in self.x.as_flattened_mut().iter_mut().zip(self.pins_move.as_flattened()) {
            *x += d;
        }
        self.survey = self.objective.evaluate(self.x);
        if let Some(element) = inadmissible(&self.survey, self.objective.body) {
            return Err(NewtonError::PinsMoveTooFar { element });
        }
        match self.objective.terms.refusing(self.x) {
            Some(term) => Err(NewtonError::TermRefuses { term }),
            None => Ok(()),
        }
    }

    fn descent(&self) -> f64 {
        product(&self.workspace.gradient, &self.workspace.direction)
    }

    fn longest_step(&self) -> f64 {
        self.objective.terms.longest_step(self.x, &self.workspace.direction)
    }

    fn set_base(&mut self) {
        let Self { objective, workspace: NewtonWorkspace { gradient, direction, .. }, .. } = self;
        objective.elastic.set_base();
        objective.quadratic_gradient(self.x, gradient);
        self.quadratic = [product(gradient, direction), objective.quadratic_curvature(direction)];
    }

    fn accept(&mut self) {
        self.x.copy_from_slice(&self.workspace.trial);
        self.survey = self.objective.elastic.survey();
    }

    fn reject(&mut self) -> f64 {
        self.survey = self.objective.evaluate(self.x);
        self.objective.noise(self.x)
    }

    fn displacement(&self) -> f64 {
        let square = |d: &[f64; 3]| d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        self.workspace.direction.iter().map(square).fold(0.0, f64::max).sqrt()
    }

    fn error_scale(&self) -> f64 {
        self.objective.quadratic.stage.error_scale(self.x)
    }
}

/// Checks that all elements were admissible at the last evaluation of the energies.
pub(super) fn demand_admissible(
    survey: &Evaluated,
    body: &Body,
    elastic: &Elastic,
) -> Result<(), NewtonError> {
    let Some(element) = inadmissible(survey, body) else { return Ok(()) };
    if survey.survey.refused == 0 {
        return Err(NewtonError::ElementNotFinite { element });
    }
    let mut all = body.elements().iter().zip(elastic.stretches());
    let stretches =
        all.find(|(other, _)| other.tag == element).map_or([f64::NAN; 3], |(_, stretches)| stretches);
    Err(NewtonError::Inadmissible { element, stretches })
}

/// Tag of the first element without a valid energy, if any.
fn inadmissible(evaluated: &Evaluated, body: &Body) -> Option<usize> {
    evaluated.survey.first.map(|element| body.elements()[element].tag)
}
