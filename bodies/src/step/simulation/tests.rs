//! Motions: falls, pins, springs and recoveries. The children test the rest.

use piola::__private::random::Random;
use piola::NoSuchNode;
use piola::batch::TileMaterial;
use piola::point::Filter;

use super::*;
use crate::mesh::{Bounds, TetMesh, tetrahedral_box};
use crate::step::{
    Convergence, Damping, Filtering, Integrator, LineSearchSettings, LinearSolver, NewtonError, NewtonReport,
    NewtonSettings, StepError,
};
use crate::system::LinearError;
use crate::system::testing::{beam, kirchhoff, neo_hookean, rotated, shake};

mod interface;
mod newton;
mod statics;

fn settings(newton: NewtonSettings) -> SimulationSettings {
    SimulationSettings { newton, ..SimulationSettings::default() }
}

fn simulation(
    mesh: &TetMesh,
    material: impl TileMaterial<f64> + 'static,
    pins: &Pins,
    settings: SimulationSettings,
) -> Simulation {
    Simulation::new(Body::new(mesh, material, 1000.0).expect("a body"), pins, settings).expect("a simulation")
}

fn left_end(mesh: &TetMesh) -> Pins {
    Pins::in_box(mesh, Bounds { min: [-0.01; 3], max: [0.01, 1.0, 1.0] }).expect("the left end")
}

fn total(masses: &[f64], vectors: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|c| masses.iter().zip(vectors).map(|(m, v)| m * v[c]).sum())
}

#[test]
fn a_free_body_falls_without_deforming() {
    let mesh = beam(4);
    let gravity = [1.0, -9.81, 0.5];
    let rate = 0.7;
    let dt = 0.02;
    let mut free = simulation(
        &mesh,
        rotated(),
        &Pins::none(),
        SimulationSettings {
            gravity,
            damping: Damping::Mass { rate },
            ..settings(NewtonSettings::default())
        },
    );
    let (mut v, mut fall) = ([0.0; 3], [0.0; 3]);
    for _ in 0..10 {
        let report = free.step(dt).expect("a fall");
        assert_eq!(report.newton.step_lengths, [1.0], "one step, as the objective is quadratic along it");
        for c in 0..3 {
            // (v − vₙ)/h = g − α v
            v[c] = (v[c] + dt * gravity[c]) / (1.0 + dt * rate);
            fall[c] += dt * v[c];
        }
    }
    for (x, rest) in free.positions().iter().zip(&mesh.positions) {
        for c in 0..3 {
            // A linear solve of condition 10⁴ per step.
            assert!((x[c] - rest[c] - fall[c]).abs() <= 1e-10);
        }
    }
}

#[test]
fn a_free_body_keeps_its_momentum() {
    let mesh = beam(4);
    let mut free = simulation(
        &mesh,
        kirchhoff(),
        &Pins::none(),
        settings(NewtonSettings { tolerance: 1e-10, ..Default::default() }),
    );
    let mut random = Random::new(3);
    free.set_positions(&shake(&mut random, &mesh.positions, 0.02)).expect("finite");
    free.set_velocities(&shake(&mut random, &vec![[0.0; 3]; mesh.positions.len()], 1.0)).expect("finite");
    let before = total(free.body().masses(), free.velocities());
    for _ in 0..5 {
        free.step(0.01).expect("a step");
    }
    let after = total(free.body().masses(), free.velocities());
    let mass: f64 = free.body().masses().iter().sum();
    for c in 0..3 {
        // Residuals fall to 10⁻¹⁰ of forces of about 10³ N, over five steps of 0.01 s.
        assert!((after[c] - before[c]).abs() <= 1e-8 * mass, "{before:?} became {after:?}");
    }
}

#[test]
fn energy_never_grows_without_loads() {
    let mesh = beam(5);
    for newton in [NewtonSettings::single(), NewtonSettings::default()] {
        let mut body = simulation(&mesh, rotated(), &left_end(&mesh), settings(newton));
        let mut start = shake(&mut Random::new(4), &mesh.positions, 0.15);
        start[..4].copy_from_slice(&mesh.positions[..4]);
        body.set_positions(&start).expect("finite");
        let mut energy = body.energies().total();
        for _ in 0..60 {
            let report = body.step(0.02).expect("a step");
            let next = report.energies.total();
            // The minimised objective bounds the energy by that of the state before, up to the rounding of
            // both.
            assert!(next <= energy * (1.0 + 1e-12), "{energy} grew to {next}");
            energy = next;
        }
    }
}

#[test]
fn pins_hold_and_move_as_told() {
    let mesh = beam(4);
    let pins = left_end(&mesh);
    for newton in [NewtonSettings::single(), NewtonSettings::default()] {
        let mut body = simulation(
            &mesh,
            rotated(),
            &pins,
            SimulationSettings { damping: Damping::Mass { rate: 5.0 }, ..settings(newton) },
        );
        for step in 1..=40 {
            let shift = 0.01 * step as f64;
            for &node in pins.nodes() {
                let rest = mesh.positions[node];
                body.prescribe(node, [rest[0] + shift, rest[1], rest[2] - shift]).expect("pinned");
            }
            body.step(0.02).expect("a step");
            for &node in pins.nodes() {
                assert_eq!(body.positions()[node][0], mesh.positions[node][0] + shift);
            }
        }
        for _ in 0..200 {
            body.step(0.05).expect("a step");
        }
        for (x, rest) in body.positions().iter().zip(&mesh.positions) {
            // Damped for 10 s at 5/s, the beam has followed.
            assert!(
                (x[0] - rest[0] - 0.4).abs() + (x[2] - rest[2] + 0.4).abs() <= 1e-6,
                "{x:?} from {rest:?}"
            );
        }
    }
}

/// A rigid translation of the pins moves a body without inertia along in the first linear system already.
#[test]
fn moving_pins_enter_the_right_side() {
    let mesh = beam(3);
    let pins = left_end(&mesh);
    let mut body = simulation(&mesh, rotated(), &pins, settings(NewtonSettings::single()));
    for &node in pins.nodes() {
        let rest = mesh.positions[node];
        body.prescribe(node, [rest[0] + 1.0, rest[1], rest[2]]).expect("pinned");
    }
    // In 10⁵ s inertia is 10⁻¹⁴ of the stiffness.
    let report = body.step(1e5).expect("a step");
    for (x, rest) in body.positions().iter().zip(&mesh.positions) {
        assert!((x[0] - rest[0] - 1.0).abs() <= 1e-9, "{report:?}");
    }
}

#[test]
fn a_spring_stretches_until_forces_balance() {
    let mesh = beam(2);
    let mut body = simulation(
        &mesh,
        rotated(),
        &Pins::none(),
        SimulationSettings { damping: Damping::Mass { rate: 10.0 }, ..settings(NewtonSettings::default()) },
    );
    let element = body.body().elements()[3];
    let anchor = crate::mesh::Anchor { nodes: element.nodes, weights: [0.25; 4] };
    let target = [0.3, 0.4, -0.2];
    body.set_springs(&[Spring { anchor, target, stiffness: 500.0 }]).expect("one element");
    for _ in 0..400 {
        body.step(0.05).expect("a step");
    }
    let point = anchor.position(body.positions());
    for c in 0..3 {
        assert!((point[c] - target[c]).abs() <= 1e-6, "{point:?}");
    }
    body.set_springs(&[Spring::on_node(0, [0.0; 3], 1.0), Spring::on_node(11, [0.0; 3], 0.0)])
        .expect("nodes");
    let error = body.set_springs(&[Spring::on_node(99, target, 1.0)]).expect_err("no such node");
    assert!(matches!(error, SetupError::NoSuchNode(NoSuchNode { node: 99, .. })));
    assert_eq!(body.springs().len(), 2, "the springs before are still there");
}

#[test]
fn a_collapsed_body_recovers_without_nan() {
    let mesh = beam(4);
    let pins = left_end(&mesh);
    let flat = |x: &[f64; 3]| [0.0, x[1], x[2]];
    let point = |_: &[f64; 3]| [0.0; 3];
    let inside_out = |x: &[f64; 3]| [-x[0], x[1], x[2]];
    for collapse in [flat as fn(&[f64; 3]) -> [f64; 3], point, inside_out] {
        let mut body = simulation(
            &mesh,
            rotated(),
            &pins,
            SimulationSettings { damping: Damping::Mass { rate: 2.0 }, ..settings(NewtonSettings::single()) },
        );
        let start =
            mesh.positions.iter().enumerate().map(|(node, x)| if node < 4 { *x } else { collapse(x) });
        body.set_positions(&start.collect::<Vec<_>>()).expect("finite");
        for _ in 0..60 {
            let report = body.step(1.0 / 30.0).expect("a step");
            assert!(report.energies.total().is_finite() && report.min_det.is_finite());
        }
        assert!(body.positions().iter().flatten().all(|x| x.is_finite()));
    }
}

#[test]
fn a_body_with_every_node_pinned_moves_as_told() {
    let mesh = beam(1);
    let mut body = simulation(&mesh, rotated(), &Pins::at(0..8), settings(NewtonSettings::default()));
    body.prescribe(3, [0.2, 0.2, 0.2]).expect("pinned");
    body.step(0.1).expect("nothing to solve");
    assert_eq!(body.positions()[3], [0.2; 3]);
    assert_eq!(body.positions()[4], mesh.positions[4]);
}
