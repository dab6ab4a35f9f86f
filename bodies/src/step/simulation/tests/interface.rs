//! Settings, copies and errors.

use super::*;
use crate::hand_written::RotatedLinear;
use crate::system::testing::scaled;

#[test]
fn nonsense_is_refused_with_a_reason() {
    let mesh = beam(1);
    let body = || Body::new(&mesh, rotated(), 1000.0).expect("a body");
    let message = |change: &dyn Fn(&mut SimulationSettings)| {
        let mut settings = SimulationSettings::default();
        change(&mut settings);
        Simulation::new(body(), &Pins::none(), settings).expect_err("nonsense").to_string()
    };
    assert_eq!(message(&|s| s.damping = -1.0), "damping must be finite and not negative");
    assert_eq!(message(&|s| s.gravity[1] = f64::NAN), "gravity must be finite");
    assert_eq!(message(&|s| s.newton.max_iterations = 0), "Newton's method needs at least one iteration");
    assert_eq!(message(&|s| s.newton.tolerance = f64::NAN), "the tolerance must be at least 0 and below 1");
    for (tolerance, max_iterations, rule) in [
        (1.0, 9, "the tolerance of the linear solver must be between 0 and 1"),
        (f64::NAN, 9, "the tolerance of the linear solver must be between 0 and 1"),
        (0.1, 0, "conjugate gradients need at least one iteration"),
    ] {
        let linear = LinearSolver::ConjugateGradients { tolerance, max_iterations };
        assert_eq!(message(&|s| s.newton.linear = linear), rule);
    }

    let error =
        Simulation::new(body(), &Pins::at([8]), SimulationSettings::default()).expect_err("no such node");
    assert_eq!(error.to_string(), "there is no node 8: the 8 nodes are numbered from 0");
    let mut simulation =
        Simulation::new(body(), &Pins::at([1]), SimulationSettings::default()).expect("a simulation");
    let wrong = SimulationSettings { damping: f64::NAN, ..SimulationSettings::default() };
    assert!(simulation.set_settings(wrong).is_err());
    assert_eq!(simulation.settings(), &SimulationSettings::default(), "the settings before are still there");
    let spring = |node, stiffness| [Spring::on_node(node, [0.0; 3], stiffness)];
    for (refused, message) in [
        (
            simulation.prescribe(0, [0.0; 3]),
            "node 0 (from 0) is not pinned, so its motion cannot be prescribed",
        ),
        (simulation.set_positions(&[[0.0; 3]]), "expected one entry for each of 8 nodes, found 1"),
        (simulation.set_velocities(&[[f64::INFINITY; 3]; 8]), "the entry of node 0 (from 0) is not finite"),
        (
            simulation.set_springs(&spring(0, -1.0)),
            "spring 0 (from 0) has a negative stiffness or an entry that is not finite",
        ),
        (simulation.set_springs(&spring(99, 1.0)), "there is no node 99: the 8 nodes are numbered from 0"),
    ] {
        assert_eq!(refused.expect_err(message).to_string(), message);
    }
    let error = simulation.step(0.0).expect_err("no time");
    assert_eq!(error.to_string(), "the time step is 0 s; it must be positive and finite");
    for dt in [1e-200, 1e-308, 5e-324] {
        let message = simulation.step(dt).expect_err("inertia overflows").to_string();
        assert!(message.contains("so short that mass over its square overflows"), "{dt:e}: {message}");
    }
    assert!(simulation.step(1e-100).is_ok(), "that is still in range");
}

/// Moduli whose energy overflows, and a material that admits every deformation: the domain is not to blame.
#[test]
fn what_overflows_is_not_outside_of_a_domain() {
    let mesh = beam(1);
    let stiff = scaled(1e308, RotatedLinear);
    let mut body = simulation(&mesh, stiff, &Pins::none(), SimulationSettings::default());
    let stretched: Vec<_> = mesh.positions.iter().map(|[x, y, z]| [9.0 * x, *y, *z]).collect();
    body.set_positions(&stretched).expect("finite");
    let error = body.step(0.01).expect_err("an infinite energy");
    let StepError::Newton(NewtonError::ElementNotFinite { .. }) = error else { panic!("{error}") };
    assert!(error.to_string().contains("exceed the range of f64"), "{error}");
}

#[test]
fn the_solver_fits_the_body() {
    assert_eq!(LinearSolver::for_elements(1031), LinearSolver::Cholesky);
    assert!(matches!(LinearSolver::for_elements(5000), LinearSolver::ConjugateGradients { .. }));
}

#[test]
fn simulations_go_to_other_threads() {
    fn check<T: Clone + Send + Sync + 'static>() {}
    check::<Body>();
    check::<Simulation>();
    check::<TetMesh>();
    check::<crate::system::Cholesky>();
    check::<crate::system::LowerTriangle>();
}

#[test]
fn errors_convert_and_name_their_source() {
    use std::error::Error;
    let error = StepError::from(NewtonError::from(LinearError::OutOfMemory));
    let newton = error.source().expect("the minimisation failed");
    assert_eq!(newton.source().map(ToString::to_string), Some(LinearError::OutOfMemory.to_string()));
    let error = SetupError::from(LinearError::OutOfMemory);
    assert_eq!(error.to_string(), LinearError::OutOfMemory.to_string());
}
