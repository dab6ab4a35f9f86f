//! Tolerances that are met, motions that are hit exactly, and failures that leave nothing behind.

use crate::mesh::TetMesh;
use crate::step::testing::{distance, falling, held};
use crate::step::{Integrator, NewtonSettings, Simulation, SimulationSettings, Spring, StepError};
use crate::system::testing::{beam, neo_hookean};

/// A bar that swings from one end, stretched by its velocities.
fn bar(mesh: &TetMesh, integrator: Integrator) -> Simulation {
    let newton = NewtonSettings { tolerance: 1e-10, ..Default::default() };
    let mut bar = held(mesh, neo_hookean(), SimulationSettings { integrator, ..falling(newton) });
    bar.set_velocities(&mesh.positions.iter().map(|&[x, y, _]| [2.0 * x, x * y, x]).collect::<Vec<_>>())
        .expect("finite");
    bar
}

const DURATION: f64 = 0.1;

#[test]
fn tolerances_are_met_by_every_integrator() {
    let mesh = beam(3);
    let mut exact = bar(&mesh, Integrator::Sdirk3);
    for _ in 0..2000 {
        exact.step(DURATION / 2000.0).expect("a short step");
    }
    for (integrator, tolerance) in [
        (Integrator::ImplicitEuler, 1e-1),
        (Integrator::Sdirk2, 1e-2),
        (Integrator::Sdirk2, 1e-4),
        (Integrator::Sdirk3, 1e-4),
    ] {
        let mut bar = bar(&mesh, integrator);
        let report = bar.advance_within(DURATION, tolerance).expect("a motion");
        let error = distance(bar.positions(), exact.positions());
        let allowed = tolerance * DURATION;
        assert!(error <= 3.0 * allowed, "{integrator:?} to {allowed:e}: {error:e}");
        assert!(report.error <= allowed && report.unresolved == 0, "{integrator:?}: {report:?}");
        assert!(report.taken > 1, "{integrator:?}: {report:?}");
    }
}

/// Pins and springs are where they shall be at the end, and have moved evenly on the way.
#[test]
fn prescribed_motions_end_exactly() {
    let mesh = beam(3);
    let mut bar = bar(&mesh, Integrator::Sdirk2);
    let tip = mesh.positions.len() - 1;
    let spring = |x: f64| [Spring::on_node(tip, [x, 0.2, 0.1], 100.0)];
    bar.set_springs(&spring(0.3)).expect("a node");
    bar.prescribe(0, [0.01, 0.02, 0.03]).expect("pinned");
    bar.set_springs(&spring(0.35)).expect("a node");
    let mut steps = bar.clone();
    bar.advance_within(0.05, 1e-3).expect("a motion");
    assert_eq!((bar.positions()[0], bar.springs()[0].target[0]), ([0.01, 0.02, 0.03], 0.35));
    for step in 1..=200 {
        let share = f64::from(step) / 200.0;
        steps.prescribe(0, [0.01, 0.02, 0.03].map(|x| x * share)).expect("pinned");
        steps.set_springs(&spring(0.3 + 0.05 * share)).expect("a node");
        steps.step(0.05 / 200.0).expect("a step");
    }
    assert!(distance(bar.positions(), steps.positions()) <= 3e-3 * 0.05);
}

#[test]
fn failures_leave_the_state_before() {
    let mesh = beam(1);
    let mut bar = bar(&mesh, Integrator::Sdirk2);
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(bar.advance_within(0.1, tolerance), Err(StepError::Tolerance { .. })));
    }
    assert!(bar.advance_within(f64::NAN, 1e-3).is_err());
    // A pinned node is driven through its element: no step, however short, gets past that.
    let before = (bar.positions().to_vec(), bar.velocities().to_vec());
    bar.prescribe(0, [5.0, 5.0, 5.0]).expect("pinned");
    let error = bar.advance_within(0.1, 1.0).expect_err("an element inside out");
    assert!(matches!(error, StepError::Newton(_)), "{error}");
    assert_eq!(before, (bar.positions().to_vec(), bar.velocities().to_vec()));
    bar.prescribe(0, mesh.positions[0]).expect("pinned");
    bar.advance_within(0.1, 1.0).expect("back in its place");
}
