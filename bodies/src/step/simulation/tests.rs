//! Motions: falls, momentum and energy. The children test the rest.

use piola::__private::random::Random;
use piola::point::Filter;

use super::*;
use crate::mesh::TetMesh;
use crate::step::testing::{distance, falling, held, left_end, settings, simulation, solved_by, solvers};
use crate::step::{Convergence, Filtering, Integrator, LinearSolver, NewtonError, NewtonSettings, StepError};
use crate::system::LinearError;
use crate::system::testing::{beam, kirchhoff, neo_hookean, rotated, shake};

mod interface;
mod newton;
mod statics;

fn total(masses: &[f64], vectors: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|c| masses.iter().zip(vectors).map(|(m, v)| m * v[c]).sum())
}

#[test]
fn a_free_body_falls_without_deforming() {
    let mesh = beam(4);
    let gravity = [1.0, -9.81, 0.5];
    let rate = 0.7;
    let dt = 0.02;
    let settings = SimulationSettings { gravity, damping: rate, ..Default::default() };
    let mut free = simulation(&mesh, rotated(), &Pins::none(), settings);
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
    let settings = settings(NewtonSettings { tolerance: 1e-10, ..Default::default() });
    let mut free = simulation(&mesh, kirchhoff(), &Pins::none(), settings);
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
        let mut body = held(&mesh, rotated(), settings(newton));
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
