//! Forces on all nodes, and the reactions of pins, which follow from the balance of forces.

use crate::step::error::NewtonError;
use crate::step::minimisation::demand_admissible;
use crate::step::solver::Machine;

use super::{Simulation, SimulationSettings};

impl Simulation {
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
        let (x, v) = (&self.steps.state.x, &self.steps.state.v);
        let mut total = vec![[0.0; 3]; x.len()];
        self.elastic.evaluate_gradients(&self.body);
        self.elastic.add_gradient(&self.body, &mut total);
        self.all_terms().add_gradient(x, &mut total);
        let SimulationSettings { damping, gravity, .. } = self.settings;
        let reaction = |&node: &usize| {
            let mass = self.body.masses()[node];
            std::array::from_fn(|c| {
                let force = self.forces.get(node).map_or(0.0, |force| force[c]);
                let others = total[node][c] + (mass * (damping * v[node][c] - gravity[c]) - force);
                others + mass * self.accelerations()[node][c]
            })
        };
        Ok(self.pinned().iter().map(reaction).collect())
    }
}
