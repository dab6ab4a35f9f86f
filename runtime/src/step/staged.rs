//! Stages of steps for a minimiser that is not piola's own, such as that of a body divided among machines.
//!
//! This module knows no forces: stages couple no two nodes, so that each part of a body may have its own.

use super::integrator::{Integrator, Method, Stage, Stages, State};
use super::simulation::SetupError;
use super::spring::Spring;

/// State of nodes, and the stages by which an [`Integrator`] advances it, for a minimiser of one's own.
///
/// A step is [begun](StagedSteps::begin), its stages are minimised one by one, and it is
/// [finished](StagedSteps::finish); a step that is begun anew instead leaves the state as it was. The minimum
/// of a stage is where
///
/// ```text
/// M a = −∇Ψ(x) + other forces at x and v, with v = (x − s)/τ and a = (v − w)/σ
/// ```
///
/// for the s, w, τ and σ of its [`Stage`].
///
/// ```
/// use piola::step::{Integrator, StagedSteps};
///
/// // Free fall: M a = M g, whatever the mass.
/// let (g, dt) = (-9.81, 0.1);
/// let mut steps = StagedSteps::new(Integrator::Sdirk2, &[[0.0; 3]]);
/// for stage in 0..steps.begin(dt) {
///     steps.begin_stage(stage, &[], &[[0.0; 3]]);
///     let [tau, sigma] = steps.stage().lengths();
///     let (start, velocity) = (steps.stage().start()[0][1], steps.stage().velocities()[0][1]);
///     steps.end_stage(stage, &[[0.0, start + tau * (velocity + sigma * g), 0.0]]);
/// }
/// steps.finish();
/// assert!((steps.positions()[0][1] - 0.5 * g * dt * dt).abs() < 1e-15);
/// assert!((steps.velocities()[0][1] - g * dt).abs() < 1e-15);
/// ```
#[derive(Clone, Debug)]
pub struct StagedSteps {
    integrator: Integrator,
    method: Method,
    dt: f64,
    state: State,
    next: State,
    stages: Stages,
    pins_move: Vec<[f64; 3]>,
}

impl StagedSteps {
    /// Nodes at rest at these positions, m.
    #[must_use]
    pub fn new(integrator: Integrator, positions: &[[f64; 3]]) -> Self {
        let state = State::at_rest(positions);
        Self {
            integrator,
            method: integrator.method(),
            dt: 0.0,
            next: state.clone(),
            stages: Stages::new(integrator, positions.len()),
            pins_move: vec![[0.0; 3]; positions.len()],
            state,
        }
    }

    /// Position of each node after the last step, m.
    #[must_use]
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.state.x
    }

    /// Velocity of each node after the last step, m/s.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; 3]] {
        &self.state.v
    }

    /// Acceleration of each node as [`Simulation::accelerations`](super::Simulation::accelerations) has it,
    /// m/s².
    #[must_use]
    pub fn accelerations(&self) -> &[[f64; 3]] {
        &self.state.a
    }

    /// Replaces the state: positions, m, and velocities, m/s.
    ///
    /// # Errors
    /// [`SetupError::Length`] unless there is one of each for each node.
    pub fn set_state(&mut self, positions: &[[f64; 3]], velocities: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check(positions.len())?;
        self.check(velocities.len())?;
        self.state.x.copy_from_slice(positions);
        self.state.v.copy_from_slice(velocities);
        Ok(())
    }

    /// Sets the accelerations at the end of the step before, m/s².
    ///
    /// # Errors
    /// [`SetupError::Length`] unless there is one for each node.
    pub fn set_accelerations(&mut self, accelerations: &[[f64; 3]]) -> Result<(), SetupError> {
        self.check(accelerations.len())?;
        self.state.a.copy_from_slice(accelerations);
        Ok(())
    }

    /// Begins a step of `dt`, s, infinite for statics. Returns the number of its stages.
    pub fn begin(&mut self, dt: f64) -> usize {
        let is_static = dt == f64::INFINITY;
        let integrator = if is_static { Integrator::ImplicitEuler } else { self.integrator };
        self.method = integrator.method();
        self.dt = dt;
        self.next.x.copy_from_slice(&self.state.x);
        self.method.stages()
    }

    /// The share of their way through the step that pinned nodes and targets of springs have gone in a stage.
    #[must_use]
    pub fn share(&self, stage: usize) -> f64 {
        self.method.share(stage)
    }

    /// Begins a stage of the step, counted from 0; pinned nodes are on their way to their entries of
    /// `targets`, m, which has one for each node. Returns whether one of them moves.
    ///
    /// # Panics
    /// If there is no target of a pinned node, or no such stage.
    pub fn begin_stage(&mut self, stage: usize, pinned: &[usize], targets: &[[f64; 3]]) -> bool {
        self.stages.begin(&self.method, stage, self.dt, &self.state);
        let share = self.method.share(stage);
        let mut is_moving = false;
        for &node in pinned {
            let before = self.state.x[node];
            let way: [f64; 3] = std::array::from_fn(|c| targets[node][c] - before[c]);
            for c in 0..3 {
                self.pins_move[node][c] = share * way[c] - (self.next.x[node][c] - before[c]);
                is_moving |= self.pins_move[node][c] != 0.0;
            }
        }
        is_moving
    }

    /// The stage begun last.
    #[must_use]
    pub fn stage(&self) -> &Stage {
        &self.stages.current
    }

    /// Positions from which the minimisation of the stage starts, m.
    #[must_use]
    pub fn start(&self) -> &[[f64; 3]] {
        &self.next.x
    }

    /// Displacement of each pinned node in the stage, m; zero for others.
    #[must_use]
    pub fn pins_move(&self) -> &[[f64; 3]] {
        &self.pins_move
    }

    /// Ends a stage at its minimum, m.
    ///
    /// # Panics
    /// If there is not one position for each node, or no such stage.
    pub fn end_stage(&mut self, stage: usize, positions: &[[f64; 3]]) {
        self.next.x.copy_from_slice(positions);
        if stage + 1 < self.method.stages() {
            self.stages.end(stage, positions);
        }
    }

    /// Ends the step, at the end of its last stage.
    pub fn finish(&mut self) {
        self.stages.finish(&mut self.next);
        std::mem::swap(&mut self.state, &mut self.next);
    }

    fn check(&self, found: usize) -> Result<(), SetupError> {
        let expected = self.state.x.len();
        if found == expected { Ok(()) } else { Err(SetupError::Length { expected, found }) }
    }
}

impl Stage {
    /// s, m, of each node.
    #[must_use]
    pub fn start(&self) -> &[[f64; 3]] {
        &self.start
    }

    /// w, m/s, of each node.
    #[must_use]
    pub fn velocities(&self) -> &[[f64; 3]] {
        &self.velocities
    }

    /// τ and σ, s.
    #[must_use]
    pub fn lengths(&self) -> [f64; 2] {
        self.lengths
    }

    /// The spring in this stage, when its target has gone a share of its way from `before`, m.
    #[must_use]
    pub fn pulled(spring: Spring, before: [f64; 3], share: f64) -> Spring {
        let way = |c: usize| before[c] + share * (spring.target[c] - before[c]);
        // At the end without rounding.
        if share == 1.0 { spring } else { Spring { target: std::array::from_fn(way), ..spring } }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::tetrahedral_box;
    use crate::step::{NewtonSettings, Simulation, SimulationSettings};
    use crate::system::testing::NEO_HOOKEAN;
    use crate::system::{Body, Pins};

    const GRAVITY: [f64; 3] = [0.3, -9.81, 0.0];
    const DT: f64 = 0.02;

    fn simulation(integrator: Integrator, pins: &Pins) -> Simulation {
        let mesh = tetrahedral_box([1; 3], [0.1; 3]).expect("a box");
        let body = Body::new(&mesh, NEO_HOOKEAN, 1000.0).expect("a body");
        let newton = NewtonSettings::default().with_tolerance(1e-13);
        let settings = SimulationSettings::default()
            .with_gravity(GRAVITY)
            .with_integrator(integrator)
            .with_newton(newton);
        Simulation::new(body, pins, settings).expect("a simulation")
    }

    const INTEGRATORS: [Integrator; 3] = [Integrator::ImplicitEuler, Integrator::Sdirk2, Integrator::Sdirk3];

    /// A step in which all free nodes fall: the minimum of a stage is known.
    fn fall(steps: &mut StagedSteps, pinned: &[usize], targets: &[[f64; 3]]) {
        for stage in 0..steps.begin(DT) {
            steps.begin_stage(stage, pinned, targets);
            let mut x = steps.start().to_vec();
            let [tau, sigma] = steps.stage().lengths();
            for node in 0..x.len() {
                for c in 0..3 {
                    let velocity = steps.stage().velocities()[node][c] + sigma * GRAVITY[c];
                    x[node][c] = steps.stage().start()[node][c] + tau * velocity;
                }
            }
            for &node in pinned {
                x[node] = std::array::from_fn(|c| steps.start()[node][c] + steps.pins_move()[node][c]);
            }
            steps.end_stage(stage, &x);
        }
        steps.finish();
    }

    #[track_caller]
    fn close(found: &[[f64; 3]], expected: &[[f64; 3]], bound: f64) {
        for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
            assert!((found - expected).abs() <= bound, "{found} for {expected}");
        }
    }

    /// Velocities are differences of positions of 0.1 m over some milliseconds.
    #[test]
    fn a_falling_body_moves_as_in_a_simulation() {
        for integrator in INTEGRATORS {
            let mut simulation = simulation(integrator, &Pins::none());
            let rest = simulation.positions().to_vec();
            let mut steps = StagedSteps::new(integrator, &rest);
            for _ in 0..3 {
                simulation.step(DT).expect("a step");
                fall(&mut steps, &[], &rest);
            }
            close(steps.positions(), simulation.positions(), 1e-13);
            close(steps.velocities(), simulation.velocities(), 1e-11);
        }
    }

    #[test]
    fn pinned_nodes_move_as_in_a_simulation() {
        for integrator in INTEGRATORS {
            let pins = Pins::at(0..8);
            let mut simulation = simulation(integrator, &pins);
            let mut targets = simulation.positions().to_vec();
            let mut steps = StagedSteps::new(integrator, &targets);
            for _ in 0..3 {
                for node in 0..8 {
                    targets[node][0] += 0.01;
                    simulation.prescribe(node, targets[node]).expect("a pinned node");
                }
                simulation.step(DT).expect("a step");
                fall(&mut steps, pins.nodes(), &targets);
            }
            close(steps.positions(), simulation.positions(), 1e-15);
            close(steps.velocities(), simulation.velocities(), 1e-11);
            close(steps.accelerations(), simulation.accelerations(), 1e-8);
        }
    }

    #[test]
    fn wrong_lengths_are_refused() {
        let mut steps = StagedSteps::new(Integrator::Sdirk2, &[[0.0; 3]]);
        let expected = Err(SetupError::Length { expected: 1, found: 2 });
        assert_eq!(steps.set_state(&[[0.0; 3]; 2], &[[0.0; 3]]), expected);
        assert_eq!(steps.set_accelerations(&[[0.0; 3]; 2]), expected);
    }
}
