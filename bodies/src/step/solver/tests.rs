use piola::__private::random::Random;
use piola::point::Filter;

use super::*;
use crate::hand_written::RotatedLinear;
use crate::mesh::Anchor;
use crate::mesh::{TetMesh, tetrahedral_box};
use crate::step::testing::{distance, falling, held, settings, simulation, solved_by, solvers};
use crate::step::{
    Filtering, NewtonError, NewtonReport, NewtonSettings, Simulation, SimulationSettings, Spring, StepError,
    StepReport,
};
use crate::system::testing::{beam, kirchhoff, rotated, scaled, shake};
use crate::system::{Cholesky, LinearError, LowerTriangle, Pins};

/// A beam whose held end is moved and turned while a spring pulls at the other, under gravity: its reports.
fn waved(linear: LinearSolver, mesh: &TetMesh, steps: usize) -> (Simulation, Vec<NewtonReport>) {
    let falling = falling(NewtonSettings { tolerance: 1e-9, ..solved_by(linear) });
    let mut body = held(mesh, rotated(), SimulationSettings { damping: 0.5, ..falling });
    let last = body.body().elements().len() - 1;
    let anchor = Anchor { nodes: body.body().elements()[last].nodes, weights: [0.1, 0.2, 0.3, 0.4] };
    body.set_springs(&[Spring { anchor, target: [1.0, 0.5, 0.2], stiffness: 200.0 }]).expect("one element");
    let mut reports = Vec::new();
    for step in 1..=steps {
        let angle = 0.05 * step as f64;
        for node in body.pinned().to_vec() {
            let [x, y, z] = mesh.positions[node];
            let turned = [y * angle.cos() - z * angle.sin(), y * angle.sin() + z * angle.cos()];
            body.prescribe(node, [x - 0.3 * angle, turned[0], turned[1]]).expect("pinned");
        }
        reports.push(body.step(0.02).expect("a step").newton);
    }
    (body, reports)
}

/// Also with a loose tolerance, which costs iterations of Newton's method and no accuracy.
#[test]
fn all_solvers_take_the_same_way() {
    let mesh = tetrahedral_box([8, 2, 2], [0.8, 0.2, 0.2]).expect("a box");
    let (exact, reports) = waved(LinearSolver::Cholesky, &mesh, 12);
    assert!(reports.iter().all(|report| report.linear_iterations == 0 && report.truncated == 0));
    for tolerance in [1e-10, 0.05] {
        let linear = LinearSolver::ConjugateGradients { tolerance, max_iterations: 2000 };
        let (body, reports) = waved(linear, &mesh, 12);
        for report in reports {
            assert!(report.linear_iterations >= report.iterations, "{report:?}");
            assert_eq!((report.truncated, report.shift), (0, 0.0));
        }
        // Each step is minimised to 10⁻⁹ of forces that would move the beam by its length.
        assert!(distance(body.positions(), exact.positions()) <= 1e-8, "{tolerance}");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // Enough nodes and elements for several chunks of every kind.
    let mesh = tetrahedral_box([40, 6, 6], [4.0, 0.6, 0.6]).expect("a box");
    for linear in
        [LinearSolver::Cholesky, LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 50 }]
    {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            pool.install(|| {
                let (body, reports) = waved(linear, &mesh, 2);
                (body.positions().to_vec(), reports)
            })
        };
        let one = run(1);
        // Equal floating-point numbers are equal bits except for the sign of zero, which cannot pass on.
        assert!(one == run(2), "{linear:?}");
    }
}

/// Copies, new simulations in the same state and a user-defined factorisation continue a motion with the same
/// bits: a step depends on the state before it alone, and a copy does not move the original.
#[test]
fn whoever_continues_a_motion_gives_the_same_bits() {
    let mesh = tetrahedral_box([12, 4, 4], [1.2, 0.4, 0.4]).expect("a box");
    let [cholesky, gradients] = solvers(1e-10);
    for (linear, h) in [(cholesky, 0.02), (gradients, 0.02), (gradients, 1.0)] {
        let start = || held(&mesh, rotated(), falling(solved_by(linear)));
        let steps = |body: &mut Simulation| -> Vec<StepReport> {
            (0..3).map(|_| body.step(h).expect("a step")).collect()
        };
        let mut whole = start();
        steps(&mut whole);
        let mut others = vec![whole.clone(), start()];
        others[1].set_positions(whole.positions()).expect("finite");
        others[1].set_velocities(whole.velocities()).expect("finite");
        if linear == LinearSolver::Cholesky {
            others.push(whole.clone());
            others[2].set_linear_solver(Cholesky::new(&[0], &[]).expect("no unknowns")).expect("a pattern");
        }
        let (reports, end) = (steps(&mut whole), whole.positions().to_vec());
        for mut other in others {
            assert_eq!((steps(&mut other), other.positions()), (reports.clone(), &end[..]), "{linear:?}");
        }
        assert_eq!(whole.positions(), end);
    }
}

#[test]
fn negative_curvature_is_left_aside_and_reported() {
    let mesh = beam(6);
    let filtering = Filtering::Always(Filter::None);
    let newton = NewtonSettings { filtering, max_iterations: 200, ..solved_by(solvers(1e-10)[1]) };
    let mut body = held(&mesh, kirchhoff(), settings(newton));
    let squeezed = |x: &[f64; 3]| [0.4 * x[0], x[1], x[2]];
    let start: Vec<_> = mesh.positions.iter().map(squeezed).collect();
    body.set_positions(&shake(&mut Random::new(6), &start, 1e-3)).expect("finite");
    let before = body.energies().total();
    let report = body.step(0.1).expect("a step");
    assert!(report.newton.truncated > 0, "{report:?}");
    assert!(report.energies.total() < before && body.positions().iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn a_limit_of_iterations_leaves_a_direction_of_descent() {
    let mesh = beam(10);
    let linear = LinearSolver::ConjugateGradients { tolerance: 1e-10, max_iterations: 3 };
    let mut body = held(&mesh, rotated(), falling(NewtonSettings { linear, ..NewtonSettings::single() }));
    for _ in 0..5 {
        let report = body.step(0.02).expect("a step").newton;
        assert_eq!((report.linear_iterations, report.truncated), (3, 1));
        assert_eq!(report.step_lengths, [1.0]);
    }
}

/// From rubber foam to solids stiffer than diamond: with time steps that scale along, the motion is the same.
#[test]
fn stiffness_of_any_unit_is_as_good() {
    let mesh = beam(8);
    let run = |linear: LinearSolver, factor: f64| {
        let gravity = [0.0, -factor / 3e3, 0.0];
        let settings = SimulationSettings { gravity, ..settings(solved_by(linear)) };
        let mut body = held(&mesh, scaled(factor, RotatedLinear), settings);
        let reports: Vec<_> =
            (0..3).map(|_| body.step(3.0 / factor.sqrt()).expect("a step").newton).collect();
        (body.positions().to_vec(), reports)
    };
    let (expected, _) = run(LinearSolver::Cholesky, 3e4);
    for linear in solvers(1e-10) {
        for factor in [3e-12, 3e6, 3e12, 3e30] {
            let (positions, reports) = run(linear, factor);
            assert!(reports.iter().all(|report| report.truncated == 0 && report.shift == 0.0));
            // Newton's tolerance of 10⁻⁶, three times.
            assert!(distance(&positions, &expected) <= 1e-5, "{linear:?}, {factor:e} Pa");
        }
    }
}

/// A rigid translation of the pins moves a body without inertia along in the first linear system already.
#[test]
fn moving_pins_enter_the_right_side() {
    let mesh = beam(3);
    for linear in solvers(1e-10) {
        let mut body =
            held(&mesh, rotated(), settings(NewtonSettings { linear, ..NewtonSettings::single() }));
        for node in body.pinned().to_vec() {
            let [x, y, z] = mesh.positions[node];
            body.prescribe(node, [x + 1.0, y, z]).expect("pinned");
        }
        // In 10⁵ s inertia is 10⁻¹⁴ of the stiffness.
        body.step(1e5).expect("a step");
        for (x, rest) in body.positions().iter().zip(&mesh.positions) {
            // The tolerance of the linear system times its condition of about 10³.
            assert!((x[0] - rest[0] - 1.0).abs() <= 1e-7, "{linear:?}");
        }
    }
}

#[test]
fn solvers_are_exchanged_between_steps_and_know_the_same_springs() {
    let mesh = beam(4);
    let settings = |linear| falling(NewtonSettings { tolerance: 1e-9, ..solved_by(linear) });
    let mut exchanged = held(&mesh, rotated(), settings(LinearSolver::Cholesky));
    let mut exact = exchanged.clone();
    // Nodes 8 and 19 share no element; of nodes 0 and 19 the first is pinned.
    let spring =
        |nodes, weights| Spring { anchor: Anchor { nodes, weights }, target: [0.5; 3], stiffness: 10.0 };
    let across = spring([8, 19, 0, 0], [0.5, 0.5, 0.0, 0.0]);
    let to_a_pin = spring([0, 19, 0, 0], [0.5, 0.5, 0.0, 0.0]);
    let springs = [across, to_a_pin];
    exact.set_springs(&springs).expect("nodes");
    for linear in solvers(1e-10) {
        exchanged.set_settings(settings(linear)).expect("a solver");
        exchanged.set_springs(&springs).expect("nodes");
        exchanged.step(0.02).expect("a step");
        exact.step(0.02).expect("a step");
    }
    // Newton's tolerance, three times.
    assert!(distance(exchanged.positions(), exact.positions()) <= 1e-8);
}

#[test]
fn a_body_with_every_node_pinned_has_nothing_to_solve() {
    let mesh = beam(1);
    for linear in solvers(1e-10) {
        let mut body = simulation(&mesh, rotated(), &Pins::at(0..8), settings(solved_by(linear)));
        body.prescribe(3, [0.2, 0.2, 0.2]).expect("pinned");
        body.step(0.1).expect("nothing to solve");
        assert_eq!((body.positions()[3], body.positions()[4]), ([0.2; 3], mesh.positions[4]));
    }
}

#[test]
fn an_answer_that_does_not_solve_ends_the_step_and_half_a_solution_does_not() {
    let mesh = beam(4);
    let mut built_in = held(&mesh, rotated(), falling(solved_by(LinearSolver::Cholesky)));
    let start = built_in.clone();
    let stepped = |factor: f64| {
        let mut own = start.clone();
        let times = move |matrix: &LowerTriangle, b: &mut [f64], _: f64| -> Result<usize, LinearError> {
            let mut cholesky = Cholesky::new(matrix.column_starts(), matrix.row_indices())?;
            SparseSolver::solve(&mut cholesky, matrix, b, 0.0)?;
            b.iter_mut().for_each(|x| *x *= factor);
            Ok(0)
        };
        own.set_linear_solver(times).expect("a pattern");
        own.step(0.02).map(|_| own.positions().to_vec())
    };
    for factor in [0.0, -1.0, 3.0] {
        let error = stepped(factor).expect_err("no solution");
        let StepError::Newton(NewtonError::NotSolved { residual }) = error else { panic!("{error}") };
        // A condition of 10⁴.
        assert!((residual - f64::abs(1.0 - factor)).abs() <= 1e-10, "{factor}: {residual}");
    }
    built_in.step(0.02).expect("a step");
    // A tolerance of 10⁻⁶ of forces that move the beam by 4 mm.
    assert!(distance(&stepped(0.5).expect("a step"), built_in.positions()) <= 1e-7);
}

#[test]
fn solvers_of_ones_own_serve_until_they_fail_or_the_settings_are_replaced() {
    let mesh = beam(4);
    let settings = falling(solved_by(LinearSolver::Cholesky));
    let mut own = held(&mesh, rotated(), settings);
    let mut built_in = own.clone();
    let error = LinearError::NotPositive { column: 0 };
    own.set_linear_solver(move |_: &LowerTriangle, _: &mut [f64], _: f64| Err(error)).expect("a pattern");
    let failed = own.step(0.02).expect_err("a solver that never solves");
    assert!(matches!(failed, StepError::Newton(NewtonError::NotPositive { .. })), "{failed}");
    assert_eq!(own.positions(), mesh.positions);
    own.set_settings(settings).expect("as before");
    own.step(0.02).expect("a step");
    built_in.step(0.02).expect("a step");
    assert_eq!(own.positions(), built_in.positions());
}
