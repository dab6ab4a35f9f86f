//! Meshes, pins and settings, good ones among them.

use piola::point::Filter;
use piola_bodies::mesh::{Group, TetMesh, tetrahedral_box};
use piola_bodies::step::{Filtering, Integrator, LinearSolver, NewtonSettings, SimulationSettings};
use piola_bodies::system::Pins;

use crate::arguments::Hostile;

impl Hostile {
    /// Mostly a good number.
    pub(crate) fn about(&mut self, good: f64) -> f64 {
        if self.0.once_in(8) { self.number() } else { good }
    }

    pub(crate) fn pins(&mut self, nodes: usize) -> Pins {
        let count = self.0.below(6);
        let mut of =
            |_| if self.0.once_in(10) { self.node(nodes) } else { self.0.below(nodes.clamp(1, 1000)) };
        Pins::at((0..count).map(&mut of).collect::<Vec<_>>())
    }

    /// A small box in which something may be wrong.
    pub(crate) fn mesh(&mut self) -> TetMesh {
        let mut mesh = tetrahedral_box([2, 1, 1], [2.0, 1.0, 1.0]).expect("a box");
        let nodes = mesh.positions.len();
        if self.0.once_in(3) {
            mesh.positions = self.points(&mesh.positions.clone());
        }
        if self.0.once_in(4) {
            let (tet, corner) = (self.0.below(mesh.tets.len()), self.0.below(4));
            mesh.tets[tet][corner] = self.node(nodes);
        }
        if self.0.once_in(8) {
            let tet = self.0.below(mesh.tets.len());
            mesh.tets.push(mesh.tets[tet]);
        }
        if self.0.once_in(16) {
            mesh.tets.clear();
        }
        if self.0.once_in(4) {
            let scale = self.one_of(&[1e-160, 1e-103, 1e-90, 1e90, 1e103, 1e160]);
            mesh.positions.as_flattened_mut().iter_mut().for_each(|x| *x *= scale);
        }
        mesh.tags = (0..self.length(mesh.tets.len())).collect();
        mesh.groups = vec![Group {
            name: "half".to_owned(),
            dimension: self.0.below(4),
            nodes: vec![self.node(nodes), self.node(nodes)],
            tets: (0..3).map(|_| self.node(mesh.tets.len())).collect(),
        }];
        mesh
    }

    pub(crate) fn settings(&mut self) -> SimulationSettings {
        let linear = match self.0.below(3) {
            0 => LinearSolver::Automatic,
            1 => LinearSolver::Cholesky,
            _ => LinearSolver::ConjugateGradients {
                tolerance: self.about(1e-3),
                max_iterations: self.one_of(&[0, 1, 100]),
            },
        };
        let filtering = match self.0.below(2) {
            0 => Filtering::OnDemand,
            _ => Filtering::Always(self.one_of(&[Filter::None, Filter::Clamp, Filter::Absolute])),
        };
        let newton = NewtonSettings {
            linear,
            filtering,
            tolerance: self.about(1e-6),
            error_share: self.about(0.01),
            max_iterations: self.one_of(&[1, 5, 50]),
        };
        let integrator = self.one_of(&[Integrator::ImplicitEuler, Integrator::Sdirk2, Integrator::Sdirk3]);
        let gravity = [self.about(0.0), self.about(-9.81), self.about(0.0)];
        SimulationSettings { integrator, gravity, damping: self.about(1.0), newton }
    }
}
