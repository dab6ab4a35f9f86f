//! Simulations for the tests of steps, and distances of their results.

use piola::batch::TileMaterial;

#[cfg(feature = "faer")]
use super::LinearSolver;
use super::{NewtonSettings, Simulation, SimulationSettings};
use crate::mesh::{Bounds, TetMesh};
use crate::system::{Body, Pins};

pub(super) fn left_end(mesh: &TetMesh) -> Pins {
    Pins::in_box(mesh, Bounds { min: [-0.01; 3], max: [0.01, 1.0, 1.0] }).expect("the left end")
}

/// A body of 1000 kg/m³ at rest.
pub(super) fn simulation(
    mesh: &TetMesh,
    material: impl TileMaterial<f64> + 'static,
    pins: &Pins,
    settings: SimulationSettings,
) -> Simulation {
    Simulation::new(Body::new(mesh, material, 1000.0).expect("a body"), pins, settings).expect("a simulation")
}

/// A body of 1000 kg/m³ whose left end is held.
pub(super) fn held(
    mesh: &TetMesh,
    material: impl TileMaterial<f64> + 'static,
    settings: SimulationSettings,
) -> Simulation {
    simulation(mesh, material, &left_end(mesh), settings)
}

pub(super) fn settings(newton: NewtonSettings) -> SimulationSettings {
    SimulationSettings { newton, ..Default::default() }
}

/// Settings with the gravity of the earth.
pub(super) fn falling(newton: NewtonSettings) -> SimulationSettings {
    SimulationSettings { gravity: [0.0, -9.81, 0.0], ..settings(newton) }
}

/// Default settings of Newton's method with another linear solver.
#[cfg(feature = "faer")]
pub(super) fn solved_by(linear: LinearSolver) -> NewtonSettings {
    NewtonSettings { linear, ..Default::default() }
}

/// The factorisation, and conjugate gradients to this tolerance.
#[cfg(feature = "faer")]
pub(super) fn solvers(tolerance: f64) -> [LinearSolver; 2] {
    [LinearSolver::Cholesky, LinearSolver::ConjugateGradients { tolerance, max_iterations: 2000 }]
}

/// Largest difference of a coordinate, NaN if one is NaN.
pub(super) fn distance(x: &[[f64; 3]], y: &[[f64; 3]]) -> f64 {
    let differences = x.as_flattened().iter().zip(y.as_flattened()).map(|(x, y)| (x - y).abs());
    differences.fold(0.0, |largest, d| if d > largest || d.is_nan() { d } else { largest })
}
