//! Equilibria, and bodies that stay in them.

use super::*;

/// Forces balance to the last digits, under gravity and a spring.
#[test]
fn statics_finds_an_equilibrium() {
    let mesh = beam(6);
    for linear in solvers(1e-3) {
        let newton = NewtonSettings { tolerance: 1e-12, ..solved_by(linear) };
        let mut body = held(&mesh, kirchhoff(), falling(newton));
        body.set_velocities(&vec![[1.0, 0.0, 0.0]; mesh.positions.len()]).expect("finite");
        let report = body.equilibrate().expect("an equilibrium").newton;
        assert_eq!(report.convergence, Convergence::Tolerance, "{report:?}");
        assert!(report.residual <= 1e-12 * report.first_residual);
        assert!(body.velocities().iter().all(|v| *v == [0.0; 3]));
        // Dynamics, started there, finds nothing to do: h² g would be 4 mm.
        let hanging = body.positions().to_vec();
        body.step(0.02).expect("a step");
        assert!(distance(body.positions(), &hanging) <= 1e-11);
    }
}

/// Without pins the matrix is singular; the body still neither drifts nor turns away.
#[test]
fn statics_of_a_free_body_leaves_it_where_it_is() {
    let mesh = beam(4);
    let newton = NewtonSettings { tolerance: 1e-10, ..Default::default() };
    let mut body = simulation(&mesh, rotated(), &Pins::none(), settings(newton));
    let start = shake(&mut Random::new(8), &mesh.positions, 0.02);
    body.set_positions(&start).expect("finite");
    let before = total(body.body().masses(), &start);
    let report = body.equilibrate().expect("an equilibrium");
    assert!(report.newton.residual <= 1e-8 * report.newton.first_residual, "{report:?}");
    assert!(report.energies.elastic <= 1e-14 * -report.newton.change, "{report:?}");
    let after = total(body.body().masses(), body.positions());
    let mass: f64 = body.body().masses().iter().sum();
    for c in 0..3 {
        // What rounding leaves of the sum of the forces, 10⁻¹³ N, meets the guard alone, 10⁻⁸ of a stiffness
        // of 10⁴ N/m.
        assert!((after[c] - before[c]).abs() <= 1e-8 * mass, "{before:?} became {after:?}");
    }
    assert!(distance(body.positions(), &mesh.positions) <= 0.02);
}

/// A body that nothing holds has no equilibrium under gravity, but one under forces that carry its weight.
#[test]
fn statics_of_a_body_that_nothing_holds_needs_balanced_loads() {
    let mesh = beam(4);
    let mut body = simulation(&mesh, rotated(), &Pins::none(), falling(NewtonSettings::default()));
    let lift: Vec<[f64; 3]> = body.body().masses().iter().map(|mass| [0.0, 9.81 * mass, 0.0]).collect();
    let weight: f64 = lift.iter().map(|lift| lift[1]).sum();
    let refused = body.equilibrate();
    // Both are sums of 20 terms.
    let is_weight = |force: f64| (force - weight).abs() <= 1e-14 * weight;
    assert!(matches!(refused, Err(StepError::Unheld { force }) if is_weight(force)), "{refused:?}");
    assert_eq!(body.positions(), mesh.positions);
    body.set_forces(&lift).expect("finite");
    body.equilibrate().expect("an equilibrium");
    // Rounding errors of elastic forces, 10⁻¹³ N, meet the guard of 10⁻⁴ N/m.
    assert!(distance(body.positions(), &mesh.positions) <= 1e-8);
}
