//! Simulations for the tests of steps, and distances of their results.

use piola::batch::TileMaterial;

use super::{Simulation, SimulationSettings};
use crate::mesh::{Bounds, TetMesh};
use crate::system::{Body, Pins};

/// Nodes of the left end of a beam.
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

/// Largest difference of a coordinate, NaN if one is NaN.
pub(super) fn distance(x: &[[f64; 3]], y: &[[f64; 3]]) -> f64 {
    let differences = x.as_flattened().iter().zip(y.as_flattened()).map(|(x, y)| (x - y).abs());
    differences.fold(0.0, |largest, d| if d > largest || d.is_nan() { d } else { largest })
}
