//! Changes between two steps: of the state, pins, forces, terms and settings.

use std::sync::Arc;

use piola::NoSuchNode;

use crate::step::error::SetupError;
use crate::step::solver::{Choice, Machine, OneMachine, SparseSolver};
use crate::step::spring::Spring;
use crate::step::staged::StagedSteps;
use crate::step::term::Term;
use crate::system::{LinearError, Pins};

use super::settings::check_settings;
use super::{Simulation, SimulationSettings};

impl<M: Machine> Simulation<M> {
    /// Sets the position of each node, m, for any deformation, even collapsed. Pins hold their nodes there.
    ///
    /// # Errors
    /// [`SetupError`] unless there is one finite position for each node.
    pub fn set_positions(&mut self, positions: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(positions)?;
        self.steps.state.x.copy_from_slice(positions);
        self.steps.targets.copy_from_slice(positions);
        self.evaluated = None;
        Ok(())
    }

    /// Sets the velocity of each node, m/s; of a pinned node it lasts until the next step.
    ///
    /// # Errors
    /// [`SetupError`] unless there is one finite velocity for each node.
    pub fn set_velocities(&mut self, velocities: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(velocities)?;
        self.steps.state.v.copy_from_slice(velocities);
        Ok(())
    }

    /// Sets the acceleration of each node at the end of the step before, m/s²: with positions and velocities
    /// the whole state of a motion that is resumed.
    ///
    /// [`NewtonSettings::error_share`](crate::step::NewtonSettings::error_share) judges the error of a step
    /// by them, and [`Simulation::reactions`] takes them.
    ///
    /// # Errors
    /// [`SetupError`] unless there is one finite acceleration for each node.
    pub fn set_accelerations(&mut self, accelerations: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check_nodal(accelerations)?;
        self.steps.state.a.copy_from_slice(accelerations);
        Ok(())
    }

    /// Prescribes the position of a pinned node, m, after the next step and from then on.
    ///
    /// # Errors
    /// [`SetupError`] for a node that is not pinned, or a position that is not finite.
    pub fn prescribe(&mut self, node: usize, position: [f64; 3]) -> Result<(), SetupError> {
        if self.pinned().binary_search(&node).is_err() {
            return Err(SetupError(format!(
                "node {node} (from 0) is not pinned, so its motion cannot be prescribed"
            )));
        }
        if position.iter().any(|x| !x.is_finite()) {
            return Err(not_finite(node));
        }
        self.steps.targets[node] = position;
        Ok(())
    }

    /// Replaces all springs.
    ///
    /// If a spring has the same index and anchor as one before, its target moves evenly in the course of the
    /// next step. Implicit Euler depends on the end of a step only, other integrators also on what is
    /// between.
    ///
    /// # Errors
    /// [`SetupError`] for a node that does not exist, a negative stiffness or a number that is not finite. The
    /// springs then stay as they were.
    pub fn set_springs(&mut self, springs: &[Spring]) -> Result<(), SetupError> {
        let nodes = self.positions().len();
        springs.iter().enumerate().try_for_each(|(index, spring)| check_spring(index, spring, nodes))?;
        let StagedSteps { springs: all, targets_before, .. } = &mut self.steps;
        let before = |(index, spring): (usize, &Spring)| match all.get(index) {
            Some(old) if old.anchor == spring.anchor => targets_before[index],
            _ => spring.target,
        };
        *targets_before = springs.iter().enumerate().map(before).collect();
        all.clear();
        all.extend_from_slice(springs);
        Ok(())
    }

    fn check_nodal(&self, vectors: &[[f64; 3]]) -> Result<(), SetupError> {
        let (nodes, found) = (self.positions().len(), vectors.len());
        if found != nodes {
            return Err(SetupError(format!("expected one entry for each of {nodes} nodes, found {found}")));
        }
        match vectors.iter().position(|x| x.iter().any(|c| !c.is_finite())) {
            Some(node) => Err(not_finite(node)),
            None => Ok(()),
        }
    }
}

impl Simulation {
    /// Replaces the set of pinned nodes. A node that was not pinned before is held where it is.
    ///
    /// Pinning nodes that were free when the linear solver was set up costs only the next factorisation;
    /// releasing nodes that were pinned then costs a new symbolic analysis.
    ///
    /// # Errors
    /// [`SetupError`] for a node that does not exist, or a failure of the linear solver. The pins then stay as
    /// they were.
    pub fn set_pins(&mut self, pins: &Pins) -> Result<(), SetupError> {
        let nodes = self.body.rest().len();
        if let Some(&node) = pins.nodes().last().filter(|&&node| node >= nodes) {
            return Err(NoSuchNode { element: None, node, nodes }.into());
        }
        self.workspace.machine.set_pins(&self.body, pins)?;
        self.workspace.forget_direction();
        self.steps.set_pins(pins);
        Ok(())
    }

    /// Sets a constant force on each node, N, from the next step on; an empty slice removes all forces.
    ///
    /// # Errors
    /// [`SetupError`] unless there is one finite force for each node.
    pub fn set_forces(&mut self, forces: &[[f64; 3]]) -> Result<(), SetupError> {
        if !forces.is_empty() {
            self.check_nodal(forces)?;
        }
        self.forces.clear();
        self.forces.extend_from_slice(forces);
        Ok(())
    }

    /// Replaces all [terms](Term) of the energy except for deformation, gravity and springs, from the next
    /// step on.
    pub fn set_terms(&mut self, terms: Vec<Arc<dyn Term>>) {
        self.terms = terms;
    }

    /// Replaces the settings from the next step on. Another linear solver, or another tolerance of it, is set
    /// up as by [`Simulation::new`].
    ///
    /// # Errors
    /// [`SetupError`] for a setting out of range, or a failure of the linear solver. The settings then stay as
    /// they were.
    pub fn set_settings(&mut self, settings: SimulationSettings) -> Result<(), SetupError> {
        check_settings(&settings)?;
        let (new, old) = (&settings.newton, &self.settings.newton);
        let is_user_defined = matches!(self.workspace.machine.choice, Choice::UserDefined(_));
        if new.linear != old.linear || is_user_defined {
            self.set_choice(Choice::Setting(new.linear))?;
        }
        self.steps.set_integrator(settings.integrator);
        self.settings = settings;
        Ok(())
    }

    /// Solves the linear systems of Newton's method by a user-defined solver, until the settings are
    /// replaced.
    ///
    /// # Errors
    /// [`SetupError`] with the error of the solver for the pattern. The solver before then stays.
    pub fn set_linear_solver(&mut self, solver: impl SparseSolver) -> Result<(), SetupError> {
        Ok(self.set_choice(Choice::UserDefined(Box::new(solver)))?)
    }

    fn set_choice(&mut self, choice: Choice) -> Result<(), LinearError> {
        self.workspace.machine = OneMachine::new(&self.body, &self.steps.pins, &[], choice)?;
        self.workspace.forget_direction();
        Ok(())
    }
}

fn check_spring(index: usize, spring: &Spring, nodes: usize) -> Result<(), SetupError> {
    if let Some(&node) = spring.anchor.nodes.iter().find(|&&node| node >= nodes) {
        return Err(NoSuchNode { element: None, node, nodes }.into());
    }
    let numbers = spring.anchor.weights.iter().chain(&spring.target).chain([&spring.stiffness]);
    if spring.stiffness < 0.0 || !numbers.into_iter().all(|x| x.is_finite()) {
        return Err(SetupError(format!(
            "spring {index} (from 0) has a negative stiffness or an entry that is not finite"
        )));
    }
    Ok(())
}

fn not_finite(node: usize) -> SetupError {
    SetupError(format!("the entry of node {node} (from 0) is not finite"))
}
