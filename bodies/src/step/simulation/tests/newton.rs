//! Newton's method within a step: its convergence, and the settings it refuses.

use super::*;

#[test]
fn full_newton_converges_quadratically() {
    let mesh = beam(6);
    let filtering = Filtering::Always(Filter::None);
    let residual_after = |max_iterations: usize| {
        let newton = NewtonSettings { filtering, max_iterations, tolerance: 1e-15, ..Default::default() };
        let mut body = held(&mesh, kirchhoff(), falling(newton));
        body.step(0.05).expect("a step").newton.residual
    };
    // The residual of a report is the one before its last iteration.
    let residuals: Vec<f64> = (1..=5).map(residual_after).collect();
    for pair in residuals.windows(2).skip(1) {
        let ratio = pair[1] / (pair[0] * pair[0]);
        let constant = residuals[2] / (residuals[1] * residuals[1]);
        let floor = 1e-11 * residuals[0];
        assert!(ratio <= 10.0 * constant || pair[1] <= floor, "residuals {residuals:?}");
    }
    assert!(residuals[4] <= 1e-8 * residuals[0], "residuals {residuals:?}");
}

#[test]
fn a_report_says_why_newton_ended() {
    let mesh = beam(3);
    let run =
        |newton: NewtonSettings| held(&mesh, kirchhoff(), falling(newton)).step(0.05).expect("a step").newton;
    assert_eq!(run(NewtonSettings::default()).convergence, Convergence::Tolerance);
    let single = run(NewtonSettings::single());
    assert_eq!((single.convergence, single.iterations), (Convergence::Limit, 1));
    let endless = run(NewtonSettings { tolerance: 0.0, ..Default::default() });
    assert_eq!(endless.convergence, Convergence::Rounding, "{endless:?}");
    assert!(endless.residual <= 1e-9 * endless.first_residual, "{endless:?}");
}

#[test]
fn a_refusal_is_a_step_too_long_and_an_error_leaves_the_state() {
    let mesh = beam(3);
    let pins = left_end(&mesh);
    let settings = SimulationSettings { gravity: [-400.0, 0.0, 0.0], ..settings(NewtonSettings::single()) };
    let mut body = simulation(&mesh, neo_hookean(), &pins, settings);
    let mut refused = 0;
    for _ in 0..20 {
        let report = body.step(0.05).expect("a shorter step");
        assert!(report.min_det > 0.0);
        refused += report.newton.refused_trials;
    }
    assert!(refused > 0, "so much gravity would turn the elements inside out");

    let before = (body.positions().to_vec(), body.velocities().to_vec());
    for &node in pins.nodes() {
        body.prescribe(node, [9.0, 0.0, 0.0]).expect("pinned");
    }
    let error = body.step(0.05).expect_err("pins far on the other side");
    assert!(matches!(error, StepError::Newton(NewtonError::PinsMoveTooFar { .. })), "{error}");
    assert_eq!(before, (body.positions().to_vec(), body.velocities().to_vec()));
    for &node in pins.nodes() {
        body.prescribe(node, mesh.positions[node]).expect("pinned");
    }
    body.step(0.05).expect("the state is as good as before");
}

#[test]
fn a_start_outside_the_domain_is_told_with_its_stretches() {
    let mesh = beam(3);
    let mut body = held(&mesh, neo_hookean(), settings(NewtonSettings::single()));
    let inverted = mesh.positions.iter().map(|[x, y, z]| [2.0 * x, *y, -0.5 * z]);
    body.set_positions(&inverted.collect::<Vec<_>>()).expect("finite");
    let error = body.step(0.01).expect_err("inverted");
    let StepError::Newton(NewtonError::Inadmissible { element, stretches }) = error else {
        panic!("{error}")
    };
    assert_eq!(element, body.body().elements()[0].tag);
    for (found, expected) in stretches.into_iter().zip([2.0, 1.0, -0.5]) {
        assert!((found - expected).abs() <= 1e-13, "some hundred u: {found}");
    }
    let text = error.to_string();
    assert!(text.contains("beyond J > 0 only"), "{text}");
}

/// The error that is left is a share of the error of the step, and costs fewer iterations than a tolerance
/// would.
#[test]
fn a_share_of_the_error_of_a_step_is_enough() {
    let mesh = beam(4);
    let end = |integrator: Integrator, error_share: f64| {
        let newton = NewtonSettings { tolerance: 1e-10, error_share, ..Default::default() };
        let mut body = held(&mesh, neo_hookean(), SimulationSettings { integrator, ..settings(newton) });
        let velocities: Vec<[f64; 3]> =
            mesh.positions.iter().map(|x| [3.0 * x[0], 2.0 * x[0], 0.0]).collect();
        body.set_velocities(&velocities).expect("finite");
        let reports: Vec<StepReport> = (0..10).map(|_| body.step(0.03).expect("a step")).collect();
        let iterations: usize = reports.iter().map(|report| report.newton.iterations).sum();
        (body.positions().to_vec(), iterations)
    };
    // What the integrators differ by is the error of the first, at least.
    for (integrator, other) in
        [(Integrator::ImplicitEuler, Integrator::Sdirk2), (Integrator::Sdirk2, Integrator::Sdirk3)]
    {
        let (solved, all) = end(integrator, 0.0);
        let (enough, fewer) = end(integrator, 0.01);
        let error = distance(&solved, &end(other, 0.0).0);
        assert!(4 * fewer < 3 * all, "{integrator:?}: {fewer} iterations, and {all} to the tolerance");
        let left = distance(&solved, &enough);
        assert!(left > 0.0 && left < 0.1 * error, "{integrator:?}: {left:e} of {error:e}");
    }
}
