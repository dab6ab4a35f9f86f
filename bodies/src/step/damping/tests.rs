use piola::__private::random::Random;

use super::*;
use crate::mesh::Bounds;
use crate::step::{LinearSolver, NewtonSettings, Simulation, SimulationSettings};
use crate::system::Pins;
use crate::system::testing::{beam, kirchhoff, shake, stiffness_product};

const BETA: f64 = 0.03;
const GRAVITY: [f64; 3] = [0.3, -9.81, 0.0];
const DT: f64 = 0.02;

/// A beam held at its left end, out of shape and in motion, with its pins.
fn shaken(damping: Damping, linear: LinearSolver) -> Simulation {
    let mesh = beam(5);
    let pins = Pins::in_box(&mesh, Bounds { min: [-0.01; 3], max: [0.01, 1.0, 1.0] }).expect("the left end");
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    let newton = NewtonSettings { tolerance: 1e-11, linear, ..NewtonSettings::default() };
    let settings = SimulationSettings { gravity: GRAVITY, damping, newton, ..SimulationSettings::default() };
    let mut simulation = Simulation::new(body, &pins, settings).expect("a simulation");
    let mut random = Random::new(11);
    let mut positions = shake(&mut random, &mesh.positions, 0.02);
    pins.nodes().iter().for_each(|&node| positions[node] = mesh.positions[node]);
    let velocities = shake(&mut random, &vec![[0.0; 3]; positions.len()], 0.5);
    simulation.set_positions(&positions).expect("finite");
    simulation.set_velocities(&velocities).expect("finite");
    simulation
}

/// The equation of motion, with products of K that share no sum with the matrix.
#[test]
fn a_step_balances_momentum_with_the_damping_force() {
    let mut simulation = shaken(Damping::Stiffness { time: BETA }, LinearSolver::Cholesky);
    let (before, velocities) = (simulation.positions().to_vec(), simulation.velocities().to_vec());
    simulation.step(DT).expect("a step");

    let body = simulation.body();
    let nodes = before.len();
    let mut elastic = Elastic::new(body);
    let viscous = stiffness_product(body, &before, Filter::Clamp, simulation.velocities());
    elastic.evaluate(body, simulation.positions());
    elastic.evaluate_gradients(body);
    let mut gradient = vec![[0.0; 3]; nodes];
    elastic.add_gradient(body, &mut gradient);

    let mut largest = 0.0f64;
    for node in (0..nodes).filter(|node| simulation.pinned().binary_search(node).is_err()) {
        for c in 0..3 {
            let acceleration = (simulation.velocities()[node][c] - velocities[node][c]) / DT - GRAVITY[c];
            let force = body.masses()[node] * acceleration;
            let rest = force + gradient[node][c] + BETA * viscous[node][c];
            // Newton's method stops at 10⁻¹¹ of the first residual, some 10³ N.
            assert!(rest.abs() <= 1e-7, "{rest:e} N are left at node {node}");
            largest = largest.max((BETA * viscous[node][c]).abs());
        }
    }
    assert!(largest > 1.0, "the damping force matters: {largest} N");
}

#[test]
fn all_solvers_damp_alike() {
    let ends =
        [LinearSolver::Cholesky, LinearSolver::ConjugateGradients { tolerance: 1e-10, max_iterations: 2000 }]
            .map(|linear| {
                let mut simulation = shaken(Damping::Stiffness { time: BETA }, linear);
                for _ in 0..5 {
                    simulation.step(DT).expect("a step");
                }
                simulation.positions().to_vec()
            });
    for other in &ends[1..] {
        for (x, expected) in other.iter().zip(&ends[0]) {
            for c in 0..3 {
                // Five steps, each minimised to 10⁻¹¹ of forces that would move the beam by its length.
                assert!((x[c] - expected[c]).abs() <= 1e-9, "{} for {}", x[c], expected[c]);
            }
        }
    }
}

#[test]
fn it_takes_energy_and_leaves_a_flight() {
    let energy_after = |damping| {
        let mut simulation = shaken(damping, LinearSolver::Cholesky);
        for _ in 0..20 {
            simulation.step(DT).expect("a step");
        }
        simulation.energies().kinetic
    };
    assert!(energy_after(Damping::Stiffness { time: BETA }) < 0.5 * energy_after(Damping::None));

    let mesh = beam(2);
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    let settings =
        SimulationSettings { damping: Damping::Stiffness { time: 10.0 }, ..SimulationSettings::default() };
    let mut flying = Simulation::new(body, &Pins::none(), settings).expect("a simulation");
    flying.set_velocities(&vec![[1.0, 2.0, 3.0]; mesh.positions.len()]).expect("finite");
    for _ in 0..10 {
        flying.step(DT).expect("a step");
    }
    for v in flying.velocities() {
        for c in 0..3 {
            // Velocities are differences of positions of about 1 m over 0.02 s, of which Newton leaves 10⁻⁶.
            assert!((v[c] - [1.0, 2.0, 3.0][c]).abs() <= 1e-5, "{v:?}");
        }
    }
}
