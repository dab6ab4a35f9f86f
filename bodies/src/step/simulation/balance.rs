//! Forces on all nodes, and the reactions of pins, which follow from the balance of forces.

use crate::step::error::NewtonError;
use crate::step::minimisation::demand_admissible;
use crate::step::solver::Machine;

use super::{Simulation, SimulationSettings};

impl Simulation {
    /// Gradient of all energies at the current state, N, with damping but without inertia. The elastic
    /// energies must have been evaluated there last.
    fn balance(&mut self) -> Vec<[f64; 3]> {
        let (x, v) = (&self.steps.state.x, &self.steps.state.v);
        let mut total = vec![[0.0; 3]; x.len()];
        self.elastic.evaluate_gradients(&self.body);
        self.elastic.add_gradient(&self.body, &mut total);
        self.all_terms().add_gradient(x, &mut total);
        let SimulationSettings { damping, gravity, .. } = self.settings;
        for (node, (total, mass)) in total.iter_mut().zip(self.body.masses()).enumerate() {
            for c in 0..3 {
                let force = self.forces.get(node).map_or(0.0, |force| force[c]);
                total[c] += mass * (damping * v[node][c] - gravity[c]) - force;
            }
        }
        total
    }

    /// Reaction of the pins on each pinned node, N, in the order of [`Simulation::pinned`]: the force that,
    /// together with all other forces, gives the node its acceleration at the end of the last step.
    ///
    /// In statics their sum balances gravity, given forces and springs.
    ///
    /// # Errors
    /// [`NewtonError::Inadmissible`] or [`NewtonError::ElementNotFinite`] for an element that has no forces
    /// at the current positions.
    pub fn reactions(&mut self) -> Result<Vec<[f64; 3]>, NewtonError> {
        let survey = self.survey();
        demand_admissible(self.workspace.machine.nodes(), &survey, &self.body, &self.elastic)?;
        let forces = self.balance();
        let reaction = |&node: &usize| {
            std::array::from_fn(|c| {
                forces[node][c] + self.body.masses()[node] * self.accelerations()[node][c]
            })
        };
        Ok(self.pinned().iter().map(reaction).collect())
    }
}
