//! Arguments that nobody should give, and good ones among them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use piola::__private::random::Random;
use piola::Inversion;
use piola::mesh::{Group, TetMesh, tetrahedral_box};
use piola::point::Filter;
use piola::step::{
    Damping, Filtering, Integrator, LineSearchSettings, LinearSolver, NewtonSettings, SimulationSettings,
};
use piola::system::Pins;

use crate::Rubber;

/// Runs of each test, each with arguments of its own.
pub(crate) const SEEDS: u64 = 2000;

/// Numbers at which something ends.
const ENDS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MAX,
    f64::MIN,
    1e200,
    1e-200,
    f64::MIN_POSITIVE,
    5e-324,
    1e100,
    -1e-100,
    f64::EPSILON,
];

/// Numbers of nodes and cells that no address space holds.
pub(crate) const TOO_MANY: [usize; 4] = [1 << 48, 1 << 60, usize::MAX / 2, usize::MAX];

/// Calls a function with arguments of many seeds.
#[track_caller]
pub(crate) fn check(mut call: impl FnMut(&mut Hostile)) {
    for seed in 0..SEEDS {
        let mut hostile = Hostile(Random::new(seed));
        assert!(catch_unwind(AssertUnwindSafe(|| call(&mut hostile))).is_ok(), "panic with seed {seed}");
    }
}

/// A source of arguments, good ones among them, so that each check is passed now and then.
pub(crate) struct Hostile(pub(crate) Random);

impl Hostile {
    pub(crate) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.0.below(choices.len())]
    }

    pub(crate) fn number(&mut self) -> f64 {
        if self.0.once_in(4) { self.one_of(&ENDS) } else { self.0.uniform(-2.0, 2.0) }
    }

    /// Mostly a good number.
    pub(crate) fn about(&mut self, good: f64) -> f64 {
        if self.0.once_in(8) { self.number() } else { good }
    }

    pub(crate) fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.number())
    }

    /// Mostly this length.
    pub(crate) fn length(&mut self, good: usize) -> usize {
        match self.0.below(6) {
            0 => self.0.below(2 * good + 2),
            1 => good.saturating_sub(1),
            _ => good,
        }
    }

    pub(crate) fn numbers(&mut self, good: usize) -> Vec<f64> {
        let all_good = self.0.once_in(2);
        (0..self.length(good))
            .map(|_| if all_good { self.0.uniform(0.5, 2.0) } else { self.number() })
            .collect()
    }

    pub(crate) fn points(&mut self, good: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let mut points = good.to_vec();
        points.resize(self.length(good.len()), [0.5; 3]);
        if self.0.once_in(2) && !points.is_empty() {
            let node = self.0.below(points.len());
            points[node] = self.point();
        }
        points
    }

    /// Mostly a node that exists.
    pub(crate) fn node(&mut self, nodes: usize) -> usize {
        match self.0.below(12) {
            0 => self.one_of(&TOO_MANY),
            1 => nodes,
            _ => self.0.below(nodes.clamp(1, 1000)),
        }
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

    pub(crate) fn rubber(&mut self) -> Rubber {
        let mu = if self.0.once_in(8) { self.one_of(&[1e-300, 1e300, 1e150]) } else { 1e5 };
        let rubber = Rubber::new(mu, 4.0 * mu).expect("positive moduli");
        let inversion = match self.0.below(3) {
            0 => Inversion::Refuse,
            1 => Inversion::Extend { epsilon: 0.1 },
            _ => Inversion::Extend { epsilon: self.one_of(&[5e-324, 1e-100, 1.0 - f64::EPSILON]) },
        };
        rubber.with_inversion(inversion).expect("a threshold between 0 and 1")
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
        let damping = match self.0.below(3) {
            0 => Damping::None,
            1 => Damping::Mass { rate: self.about(1.0) },
            _ => Damping::Stiffness { time: self.about(1e-3) },
        };
        let newton = NewtonSettings::default()
            .with_linear(linear)
            .with_filtering(filtering)
            .with_tolerance(self.about(1e-6))
            .with_max_iterations(self.one_of(&[1, 5, 50]));
        let line_search = LineSearchSettings::default()
            .with_sufficient_decrease(self.about(1e-4))
            .with_shrink(self.about(0.5))
            .with_max_trials(self.one_of(&[0, 1, 48, 48]));
        let integrator = self.one_of(&[Integrator::ImplicitEuler, Integrator::Sdirk2, Integrator::Sdirk3]);
        SimulationSettings::default()
            .with_integrator(integrator)
            .with_gravity([self.about(0.0), self.about(-9.81), self.about(0.0)])
            .with_damping(damping)
            .with_newton(newton)
            .with_line_search(line_search)
    }
}
