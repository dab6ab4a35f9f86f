//! State of nodes between steps, their prescribed motion, and the stages of a step.
//!
//! This module is independent of forces: stages couple no two nodes, so that each part of a body may have its
//! own.

use piola::NoSuchNode;

use super::error::SetupError;
use super::integrator::{Integrator, Method, Stage, State};
use super::spring::Spring;
use crate::system::Pins;

/// State of the nodes of a body, or of the part of a machine, and the stages by which an [`Integrator`]
/// advances it.
///
/// A step is [begun](StagedSteps::begin), its stages are minimised one by one, and it is
/// [finished](StagedSteps::finish); a step that is begun again instead leaves the state as it was. The
/// minimum of a stage is where
///
/// ```text
/// M a = −∇Ψ(x) + other forces at x and v, with v = (x − s)/τ and a = (v − w)/τ
/// ```
///
/// for the s, w and τ of its [`Stage`].
#[derive(Clone, Debug)]
pub(super) struct StagedSteps {
    method: Method,
    dt: f64,
    pub(super) state: State,
    /// State after the step in progress; its positions are those of the current stage, where the minimisation
    /// begins and which the minimum replaces.
    pub(super) next: State,
    pub(super) stage: Stage,
    /// Springs with their targets in this stage.
    pub(super) stage_springs: Vec<Spring>,
    /// v, m/s, and a, m/s², of each completed stage except for the last.
    done: Vec<[Vec<[f64; 3]>; 2]>,
    pub(super) pins: Pins,
    /// Position of each pinned node, and only of those, after the next step, m.
    pub(super) targets: Vec<[f64; 3]>,
    /// Displacement of each pinned node in the current stage, m; zero for others.
    pub(super) pins_move: Vec<[f64; 3]>,
    pub(super) springs: Vec<Spring>,
    /// Targets of the springs where the next step starts, m.
    pub(super) targets_before: Vec<[f64; 3]>,
}

impl StagedSteps {
    /// State of nodes at rest at these positions, m, some of them pinned.
    pub(super) fn new(
        integrator: Integrator,
        positions: &[[f64; 3]],
        pins: &Pins,
    ) -> Result<Self, SetupError> {
        let nodes = positions.len();
        if let Some(&node) = pins.nodes().iter().find(|&&node| node >= nodes) {
            return Err(NoSuchNode { element: None, node, nodes }.into());
        }
        let state = State::at_rest(positions);
        let mut steps = Self {
            method: integrator.method(),
            dt: 0.0,
            next: state.clone(),
            stage: Stage::at_rest(nodes),
            stage_springs: Vec::new(),
            done: Vec::new(),
            pins: pins.clone(),
            targets: positions.to_vec(),
            pins_move: vec![[0.0; 3]; nodes],
            springs: Vec::new(),
            targets_before: Vec::new(),
            state,
        };
        steps.set_integrator(integrator);
        Ok(steps)
    }

    /// Replaces the integrator from the next step on.
    pub(super) fn set_integrator(&mut self, integrator: Integrator) {
        let zero = || vec![[0.0; 3]; self.state.x.len()];
        self.stage.is_second_order = integrator.order() > 1;
        self.done.resize_with(integrator.method().rows.len() - 1, || [zero(), zero()]);
    }

    /// Replaces the pinned nodes. A node that was not pinned before is held where it is.
    pub(super) fn set_pins(&mut self, pins: &Pins) {
        for node in 0..self.state.x.len() {
            let is_in = |pins: &Pins| pins.nodes().binary_search(&node).is_ok();
            if !(is_in(&self.pins) && is_in(pins)) {
                self.targets[node] = self.state.x[node];
                self.pins_move[node] = [0.0; 3];
            }
        }
        self.pins = pins.clone();
    }

    /// Begins a step of `dt`, s, infinite for statics. Returns the number of its stages.
    pub(super) fn begin(&mut self, integrator: Integrator, dt: f64) -> usize {
        let is_static = dt == f64::INFINITY;
        let integrator = if is_static { Integrator::ImplicitEuler } else { integrator };
        self.method = integrator.method();
        self.dt = dt;
        self.next.x.copy_from_slice(&self.state.x);
        self.method.rows.len()
    }

    /// Begins a stage of the step, counted from 0: pinned nodes and targets of springs are at its share of
    /// their motion through the step. Returns true if a pinned node moves.
    pub(super) fn begin_stage(&mut self, stage: usize) -> bool {
        let State { x, v, a } = &self.state;
        let Stage { start, velocities, length, accelerations, .. } = &mut self.stage;
        *length = self.method.diagonal * self.dt;
        accelerations.copy_from_slice(stage.checked_sub(1).map_or(a, |before| &self.done[before][1]));
        start.copy_from_slice(x);
        velocities.copy_from_slice(v);
        for (coefficient, [v, a]) in self.method.rows[stage].iter().zip(&self.done) {
            add(start, self.dt * coefficient, v);
            add(velocities, self.dt * coefficient, a);
        }
        let share = self.method.share(stage);
        self.stage_springs.clone_from(&self.springs);
        for (spring, &before) in self.stage_springs.iter_mut().zip(&self.targets_before) {
            spring.target = on_the_way(before, spring.target, share);
        }
        let mut is_moving = false;
        for &node in self.pins.nodes() {
            let (target, before) = (self.targets[node], self.state.x[node]);
            let way: [f64; 3] = std::array::from_fn(|c| target[c] - before[c]);
            for c in 0..3 {
                self.pins_move[node][c] = share * way[c] - (self.next.x[node][c] - before[c]);
                is_moving |= self.pins_move[node][c] != 0.0;
            }
        }
        is_moving
    }

    /// Ends a stage, with the positions of `next` at the minimum.
    pub(super) fn end_stage(&mut self, stage: usize) {
        let is_last = stage + 1 == self.method.rows.len();
        let State { x, v, a } = &mut self.next;
        let [v, a] = if is_last { [v, a] } else { self.done[stage].each_mut() };
        for (node, &x) in x.iter().enumerate() {
            [v[node], a[node]] = self.stage.motion(node, x);
        }
    }

    /// Ends the step, at the end of its last stage.
    pub(super) fn finish(&mut self) {
        std::mem::swap(&mut self.state, &mut self.next);
        for (before, spring) in self.targets_before.iter_mut().zip(&self.springs) {
            *before = spring.target;
        }
    }

    /// Moves pinned nodes and springs from one share of the motion that `whole` prescribes to another.
    pub(super) fn drive(&mut self, whole: &Self, start: f64, end: f64) {
        for &node in whole.pins.nodes() {
            self.targets[node] = on_the_way(whole.state.x[node], whole.targets[node], end);
        }
        for (index, (before, spring)) in whole.targets_before.iter().zip(&whole.springs).enumerate() {
            self.targets_before[index] = on_the_way(*before, spring.target, start);
            self.springs[index].target = on_the_way(*before, spring.target, end);
        }
    }
}

/// Point at a share of the way between two points; exactly these at the ends.
fn on_the_way(from: [f64; 3], to: [f64; 3], share: f64) -> [f64; 3] {
    match share {
        0.0 => from,
        1.0 => to,
        _ => std::array::from_fn(|c| from[c] + share * (to[c] - from[c])),
    }
}

fn add(sum: &mut [[f64; 3]], factor: f64, x: &[[f64; 3]]) {
    for (sum, x) in sum.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *sum += factor * x;
    }
}
