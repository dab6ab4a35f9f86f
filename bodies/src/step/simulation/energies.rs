//! Energies of a body in motion.

use crate::step::solver::Machine;
use crate::system::linear::multigrid::Division;

use super::Simulation;

/// Energies of a body, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Energies {
    /// Energy of deformation.
    pub elastic: f64,
    /// Energy of motion.
    pub kinetic: f64,
    /// Energy in the field of gravity, 0 in the rest shape.
    pub gravity: f64,
    /// Energy of the springs.
    pub springs: f64,
    /// Energy in the field of given forces, 0 in the rest shape.
    pub forces: f64,
    /// Energy of other terms.
    pub terms: f64,
}

impl Energies {
    /// Sum of all energies, J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.elastic + self.kinetic + self.gravity + self.springs + self.forces + self.terms
    }
}

impl<M: Machine> Simulation<M> {
    /// Energies of the current state; the elastic one is NaN if an element is outside its domain.
    #[must_use]
    pub fn energies(&mut self) -> Energies {
        let survey = self.survey();
        self.energies_of(if survey.survey.is_clean() { self.elastic.energy() } else { f64::NAN })
    }

    pub(super) fn energies_of(&self, elastic: f64) -> Energies {
        let (x, v) = (self.positions(), self.velocities());
        let mut energies = Energies { elastic, ..Energies::default() };
        for (node, mass) in self.body.masses().iter().enumerate() {
            for c in 0..3 {
                let displacement = x[node][c] - self.body.rest()[node][c];
                energies.kinetic += 0.5 * mass * v[node][c].powi(2);
                energies.gravity -= mass * self.settings.gravity[c] * displacement;
                energies.forces -= self.forces.get(node).map_or(0.0, |force| force[c] * displacement);
            }
        }
        energies.springs += self.springs().iter().map(|spring| spring.energy(x)).sum::<f64>();
        energies.terms += self.terms.iter().map(|term| term.energy(x).unwrap_or(f64::NAN)).sum::<f64>();
        let Energies { elastic, kinetic, gravity, springs, forces, terms } = energies;
        let own = [elastic, kinetic, gravity, springs, forces, terms];
        let [elastic, kinetic, gravity, springs, forces, terms] = self.workspace.machine.nodes().totals(own);
        Energies { elastic, kinetic, gravity, springs, forces, terms }
    }
}
