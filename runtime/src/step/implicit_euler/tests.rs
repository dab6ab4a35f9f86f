use super::*;
use crate::batch::TileMaterial;
use crate::mesh::{Bounds, TetMesh, tetrahedral_box};
use crate::point::Filter;
use crate::random::Random;
use crate::step::{Convergence, Filtering, InitialGuess, LinearSolver, NewtonSettings};
use crate::system::testing::{KIRCHHOFF, NEO_HOOKEAN, ROTATED, beam, shake};

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
        ROTATED,
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
        KIRCHHOFF,
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
        let mut body = simulation(&mesh, ROTATED, &left_end(&mesh), settings(newton));
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
fn full_newton_converges_quadratically() {
    let mesh = beam(6);
    let gravity = [0.0, -9.81, 0.0];
    let residual_after = |iterations: usize| {
        let newton = NewtonSettings {
            filtering: Filtering::Always(Filter::None),
            max_iterations: iterations,
            tolerance: 1e-15,
            ..Default::default()
        };
        let mut body = simulation(
            &mesh,
            KIRCHHOFF,
            &left_end(&mesh),
            SimulationSettings { gravity, ..settings(newton) },
        );
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
    let gravity = [0.0, -9.81, 0.0];
    let run = |newton: NewtonSettings| {
        let mut body = simulation(
            &mesh,
            KIRCHHOFF,
            &left_end(&mesh),
            SimulationSettings { gravity, ..settings(newton) },
        );
        body.step(0.05).expect("a step").newton
    };
    assert_eq!(run(NewtonSettings::default()).convergence, Convergence::Tolerance);
    let single = run(NewtonSettings::single());
    assert_eq!((single.convergence, single.iterations), (Convergence::Limit, 1));
    let endless = run(NewtonSettings { tolerance: 0.0, ..NewtonSettings::default() });
    assert_eq!(endless.convergence, Convergence::Rounding, "{endless:?}");
    assert!(endless.residual <= 1e-9 * endless.first_residual, "{endless:?}");
}

#[test]
fn a_body_at_rest_stays_at_rest() {
    let mesh = beam(3);
    let mut body = simulation(&mesh, ROTATED, &Pins::none(), settings(NewtonSettings::single()));
    for _ in 0..3 {
        body.step(0.1).expect("a step");
    }
    for (x, rest) in body.positions().iter().zip(&mesh.positions) {
        for c in 0..3 {
            assert!((x[c] - rest[c]).abs() <= 1e-14);
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
            ROTATED,
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
    let mut body = simulation(&mesh, ROTATED, &pins, settings(NewtonSettings::single()));
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
        ROTATED,
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
    let far = crate::mesh::Anchor { nodes: [0, 11, 0, 0], weights: [0.5, 0.5, 0.0, 0.0] };
    let error = body.set_springs(&[Spring { anchor: far, target, stiffness: 1.0 }]).expect_err("two ends");
    assert_eq!(error, SetupError::SpringAcrossElements { index: 0 });
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
            ROTATED,
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
fn a_refusal_is_a_step_too_long_and_an_error_leaves_the_state() {
    let mesh = beam(3);
    let pins = left_end(&mesh);
    let gravity = [-400.0, 0.0, 0.0];
    let mut body = simulation(
        &mesh,
        NEO_HOOKEAN,
        &pins,
        SimulationSettings { gravity, ..settings(NewtonSettings::single()) },
    );
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
    let mut body = simulation(&mesh, NEO_HOOKEAN, &left_end(&mesh), settings(NewtonSettings::single()));
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

#[test]
fn an_indefinite_matrix_is_shifted_and_reported() {
    let mesh = beam(3);
    let newton = NewtonSettings {
        filtering: Filtering::Always(Filter::None),
        tolerance: 0.0,
        ..NewtonSettings::single()
    };
    let mut body = simulation(&mesh, KIRCHHOFF, &left_end(&mesh), settings(newton));
    let squeezed: Vec<_> = mesh.positions.iter().map(|x| [0.4 * x[0], x[1], x[2]]).collect();
    body.set_positions(&squeezed).expect("finite");
    let report = body.step(0.1).expect("a step with a shift");
    assert!(report.newton.shift > 0.0);
}

#[test]
fn nonsense_is_refused_with_a_reason() {
    let mesh = beam(1);
    let body = || Body::new(&mesh, ROTATED, 1000.0).expect("a body");
    let message = |change: &dyn Fn(&mut SimulationSettings)| {
        let mut settings = SimulationSettings::default();
        change(&mut settings);
        Simulation::new(body(), &Pins::none(), settings).expect_err("nonsense").to_string()
    };
    assert_eq!(
        message(&|s| s.damping = Damping::Mass { rate: -1.0 }),
        "damping must be finite and not negative"
    );
    assert_eq!(message(&|s| s.gravity[1] = f64::NAN), "gravity must be finite");
    assert_eq!(message(&|s| s.newton.max_iterations = 0), "Newton's method needs at least one iteration");
    assert_eq!(message(&|s| s.newton.tolerance = f64::NAN), "the tolerance must be at least 0 and below 1");
    assert_eq!(message(&|s| s.line_search.shrink = 1.0), "the shrinking factor must be between 0 and 1");

    let error =
        Simulation::new(body(), &Pins::at([8]), SimulationSettings::default()).expect_err("no such node");
    assert_eq!(error.to_string(), "there is no node 8 (from 0) among 8");
    let mut simulation =
        Simulation::new(body(), &Pins::at([1]), SimulationSettings::default()).expect("a simulation");
    assert_eq!(simulation.prescribe(0, [0.0; 3]), Err(SetupError::NotPinned { node: 0 }));
    assert_eq!(simulation.set_positions(&[[0.0; 3]]), Err(SetupError::Length { expected: 8, found: 1 }));
    assert_eq!(simulation.set_velocities(&[[f64::INFINITY; 3]; 8]), Err(SetupError::NotFinite { node: 0 }));
    assert_eq!(
        simulation.set_springs(&[Spring::on_node(0, [0.0; 3], -1.0)]),
        Err(SetupError::Spring { index: 0 })
    );
    let error = simulation.step(0.0).expect_err("no time");
    assert_eq!(error.to_string(), "the time step is 0 s; it must be a positive number");
}

#[test]
fn a_body_with_every_node_pinned_moves_as_told() {
    let mesh = beam(1);
    let mut body = simulation(&mesh, ROTATED, &Pins::at(0..8), settings(NewtonSettings::default()));
    body.prescribe(3, [0.2, 0.2, 0.2]).expect("pinned");
    body.step(0.1).expect("nothing to solve");
    assert_eq!(body.positions()[3], [0.2; 3]);
    assert_eq!(body.positions()[4], mesh.positions[4]);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // 2400 elements: several pieces of work for each thread in every parallel loop.
    let mesh = tetrahedral_box([16, 5, 5], [3.2, 1.0, 1.0]).expect("a box");
    let start = shake(&mut Random::new(5), &mesh.positions, 0.05);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut body =
                simulation(&mesh, ROTATED, &Pins::at([0, 1, 2]), settings(NewtonSettings::single()));
            let mut positions = start.clone();
            positions[..3].copy_from_slice(&mesh.positions[..3]);
            body.set_positions(&positions).expect("finite");
            let reports: Vec<_> = (0..5).map(|_| body.step(1.0 / 30.0).expect("a step")).collect();
            (body.positions().to_vec(), reports)
        })
    };
    let (one, two) = (run(1), run(2));
    // Equal floating-point numbers are equal bits but for the sign of zero, which cannot pass on.
    assert_eq!(one, two);
    assert_eq!(one, run(3));
}

/// Forces balance to the last digits, under gravity and a spring.
#[test]
fn statics_finds_an_equilibrium() {
    let mesh = beam(6);
    let newton = NewtonSettings { tolerance: 1e-12, ..NewtonSettings::default() };
    for linear in
        [LinearSolver::Cholesky, LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 }]
    {
        let settings = SimulationSettings {
            gravity: [0.0, -9.81, 0.0],
            newton: NewtonSettings { linear, ..newton },
            ..SimulationSettings::default()
        };
        let mut body = simulation(&mesh, KIRCHHOFF, &left_end(&mesh), settings);
        body.set_velocities(&vec![[1.0, 0.0, 0.0]; mesh.positions.len()]).expect("finite");
        let report = body.equilibrate().expect("an equilibrium").newton;
        assert_eq!(report.convergence, Convergence::Tolerance, "{report:?}");
        assert!(report.residual <= 1e-12 * report.first_residual);
        assert!(body.velocities().iter().all(|v| *v == [0.0; 3]));
        // Dynamics, started there, finds nothing to do: h² g would be 4 mm.
        let hanging = body.positions().to_vec();
        body.step(0.02).expect("a step");
        for (x, before) in body.positions().iter().zip(&hanging) {
            for c in 0..3 {
                assert!((x[c] - before[c]).abs() <= 1e-11, "{} for {}", x[c], before[c]);
            }
        }
    }
}

/// Without pins the matrix is singular; the body still neither drifts nor turns away.
#[test]
fn statics_of_a_free_body_leaves_it_where_it_is() {
    let mesh = beam(4);
    let newton = NewtonSettings { tolerance: 1e-10, ..NewtonSettings::default() };
    let mut body = simulation(&mesh, ROTATED, &Pins::none(), settings(newton));
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
    for (x, rest) in body.positions().iter().zip(&mesh.positions) {
        for c in 0..3 {
            assert!((x[c] - rest[c]).abs() <= 0.02, "{x:?} for {rest:?}");
        }
    }
}

#[test]
fn velocities_are_a_good_guess_in_flight_and_harmless_elsewhere() {
    let mesh = beam(4);
    let newton = NewtonSettings { start: InitialGuess::Velocity, ..NewtonSettings::default() };
    let mut flying = simulation(&mesh, ROTATED, &Pins::none(), settings(newton));
    flying.set_velocities(&vec![[1.0, 2.0, 0.0]; mesh.positions.len()]).expect("finite");
    let report = flying.step(0.5).expect("a step").newton;
    // What is left to do is to undo the rounding of 1 m.
    assert!(report.first_residual <= 1e-6, "{report:?}");

    let mut turning = simulation(&mesh, NEO_HOOKEAN, &Pins::none(), settings(newton));
    let spin: Vec<_> = mesh.positions.iter().map(|&[x, y, z]| [z, 1e3 * y, -1e3 * x]).collect();
    turning.set_velocities(&spin).expect("finite");
    let report = turning.step(0.5).expect("the guess is refused, the step is made");
    assert!(report.newton.change <= 0.0 && report.energies.total().is_finite(), "{report:?}");
}

/// Any setting that is accepted gives finite numbers or an error that leaves the state as it was.
#[test]
fn no_setting_returns_nan() {
    let mesh = beam(2);
    let mut random = Random::new(17);
    let mut ends = [0; 3];
    for case in 0..400 {
        let mut number = || match (random.uniform(0.0, 1.0) * 10.0) as usize {
            0 => 0.0,
            1 => f64::NAN,
            2 => f64::INFINITY,
            3 => -1.0,
            4 => f64::MAX,
            5 => f64::MIN_POSITIVE,
            _ => 10f64.powf(random.uniform(-6.0, 3.0)),
        };
        let filters = [Filter::None, Filter::Clamp, Filter::Absolute].map(Filtering::Always);
        let filtering = [Filtering::OnDemand, Filtering::TrustRegion { tolerance: number() }];
        let linear = [
            LinearSolver::Automatic,
            LinearSolver::RefinedCholesky { tolerance: number() },
            LinearSolver::ConjugateGradients { tolerance: number(), max_iterations: number() as usize % 50 },
        ];
        let damping =
            [Damping::None, Damping::Mass { rate: number() }, Damping::Stiffness { time: number() }];
        let settings = SimulationSettings {
            gravity: [0.0, if case % 5 == 0 { number() } else { -9.81 }, 0.0],
            damping: damping[case % 3],
            newton: NewtonSettings {
                filtering: if case % 2 == 0 { filters[case / 2 % 3] } else { filtering[case / 2 % 2] },
                start: [InitialGuess::Position, InitialGuess::Velocity][case / 3 % 2],
                max_iterations: 1 + case % 7,
                tolerance: if case % 11 == 0 { number() } else { 1e-8 },
                linear: linear[case / 5 % 3],
            },
            line_search: LineSearchSettings::default(),
        };
        let body = Body::new(&mesh, NEO_HOOKEAN, 1000.0).expect("a body");
        let Ok(mut body) = Simulation::new(body, &left_end(&mesh), settings) else {
            ends[0] += 1;
            continue;
        };
        let dt = number();
        let velocities = shake(&mut Random::new(case as u64), &vec![[0.0; 3]; mesh.positions.len()], 3.0);
        body.set_velocities(&velocities).expect("finite");
        for step in 0..3 {
            let before = (body.positions().to_vec(), body.velocities().to_vec());
            let result = if step == 1 { body.equilibrate() } else { body.step(dt) };
            match result {
                Ok(report) => {
                    let state = body.positions().iter().chain(body.velocities());
                    assert!(state.flatten().all(|x| x.is_finite()), "{settings:?}, dt {dt:e}: {report:?}");
                    let NewtonReport { residual, change, .. } = report.newton;
                    assert!(residual.is_finite() && change <= 1e-9, "{settings:?}, dt {dt:e}: {report:?}");
                    assert!(report.min_det.is_finite() && report.energies.elastic.is_finite(), "{report:?}");
                    ends[1] += 1;
                }
                Err(_) => {
                    assert_eq!(
                        before,
                        (body.positions().to_vec(), body.velocities().to_vec()),
                        "{settings:?}"
                    );
                    ends[2] += 1;
                }
            }
        }
    }
    assert!(ends.iter().all(|&count| count > 20), "refused, stepped, failed: {ends:?}");
}

#[test]
fn the_solver_fits_the_body_and_may_be_chosen() {
    assert_eq!(LinearSolver::for_elements(1031), LinearSolver::Cholesky);
    assert!(matches!(LinearSolver::for_elements(50_000), LinearSolver::RefinedCholesky { .. }));
    assert!(matches!(LinearSolver::for_elements(1_000_000), LinearSolver::ConjugateGradients { .. }));
    let mesh = beam(3);
    let run = |linear| {
        let newton = NewtonSettings { linear, ..NewtonSettings::default() };
        let mut body = simulation(
            &mesh,
            ROTATED,
            &left_end(&mesh),
            SimulationSettings { gravity: [0.0, -9.81, 0.0], ..settings(newton) },
        );
        body.step(0.05).expect("a step")
    };
    assert_eq!(run(LinearSolver::Automatic), run(LinearSolver::Cholesky));
}

/// A copy taken in the middle of a motion goes on with the same bits, and does not move the original.
#[test]
fn a_clone_is_independent_and_exact() {
    let mesh = beam(4);
    for linear in [
        LinearSolver::Cholesky,
        LinearSolver::RefinedCholesky { tolerance: 1e-8 },
        LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 },
    ] {
        let newton = NewtonSettings::default()
            .with_linear(linear)
            .with_filtering(Filtering::TrustRegion { tolerance: 0.01 });
        let settings = SimulationSettings::default()
            .with_gravity([0.0, -9.81, 0.0])
            .with_damping(Damping::Stiffness { time: 1e-3 })
            .with_newton(newton);
        let mut body = simulation(&mesh, NEO_HOOKEAN, &left_end(&mesh), settings);
        body.step(0.01).expect("a step");
        let before = body.positions().to_vec();
        let mut copy = body.clone();
        let first: Vec<_> = (0..3).map(|_| copy.step(0.01).expect("a step")).collect();
        assert_eq!(body.positions(), before);
        let second: Vec<_> = (0..3).map(|_| body.step(0.01).expect("a step")).collect();
        assert_eq!((first, copy.positions()), (second, body.positions()));
    }
}

#[test]
fn simulations_go_to_other_threads() {
    fn check<T: Clone + Send + Sync + 'static>() {}
    check::<Body>();
    check::<Simulation>();
    check::<TetMesh>();
    check::<crate::system::StiffnessOperator>();
    check::<crate::system::Cholesky>();
    check::<crate::system::BlockMatrix>();
}

#[test]
fn errors_convert_and_name_their_source() {
    use std::error::Error;
    let error = StepError::from(NewtonError::from(LinearError::OutOfMemory));
    let newton = error.source().expect("the minimisation failed");
    assert_eq!(newton.source().map(ToString::to_string), Some(LinearError::OutOfMemory.to_string()));
    assert!(SetupError::from(LinearError::OutOfMemory).source().is_some());
}
