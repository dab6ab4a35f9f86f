//! Settings, copies, threads and errors.

use super::*;
use crate::hand_written::RotatedLinear;
use crate::system::BodyError;
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
    assert_eq!(error.to_string(), "there is no node 8: the 8 nodes are numbered from 0");
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
fn any_number_of_threads_gives_the_same_bits() {
    // 2400 elements: several pieces of work for each thread in every parallel loop.
    let mesh = tetrahedral_box([16, 5, 5], [3.2, 1.0, 1.0]).expect("a box");
    let start = shake(&mut Random::new(5), &mesh.positions, 0.05);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut body =
                simulation(&mesh, rotated(), &Pins::at([0, 1, 2]), settings(NewtonSettings::single()));
            let mut positions = start.clone();
            positions[..3].copy_from_slice(&mesh.positions[..3]);
            body.set_positions(&positions).expect("finite");
            let reports: Vec<_> = (0..5).map(|_| body.step(1.0 / 30.0).expect("a step")).collect();
            (body.positions().to_vec(), reports)
        })
    };
    let (one, two) = (run(1), run(2));
    // Equal floating-point numbers are equal bits except for the sign of zero, which cannot pass on.
    assert_eq!(one, two);
    assert_eq!(one, run(3));
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
        let linear = [
            LinearSolver::Automatic,
            LinearSolver::Cholesky,
            LinearSolver::ConjugateGradients { tolerance: number(), max_iterations: number() as usize % 50 },
        ];
        let damping = [Damping::None, Damping::Mass { rate: number() }];
        let integrators = [Integrator::ImplicitEuler, Integrator::Sdirk2, Integrator::Sdirk3];
        let settings = SimulationSettings {
            gravity: [0.0, if case % 5 == 0 { number() } else { -9.81 }, 0.0],
            damping: damping[case % 2],
            integrator: integrators[case / 4 % 3],
            newton: NewtonSettings {
                filtering: if case % 2 == 0 { filters[case / 2 % 3] } else { Filtering::OnDemand },
                max_iterations: 1 + case % 7,
                tolerance: if case % 11 == 0 { number() } else { 1e-8 },
                error_share: if case % 13 == 0 { number() } else { 0.01 * (case % 3) as f64 },
                linear: linear[case / 5 % 3],
            },
            line_search: LineSearchSettings::default(),
        };
        let body = Body::new(&mesh, neo_hookean(), 1000.0).expect("a body");
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
    assert!(matches!(LinearSolver::for_elements(5000), LinearSolver::ConjugateGradients { .. }));
    let mesh = beam(3);
    let run = |linear| {
        let newton = NewtonSettings { linear, ..NewtonSettings::default() };
        let mut body = simulation(
            &mesh,
            rotated(),
            &left_end(&mesh),
            SimulationSettings { gravity: [0.0, -9.81, 0.0], ..settings(newton) },
        );
        body.step(0.05).expect("a step")
    };
    assert_eq!(run(LinearSolver::Automatic), run(LinearSolver::Cholesky));
}

/// A copy taken in the middle of a motion continues with the same bits, and does not move the original.
#[test]
fn a_clone_is_independent_and_exact() {
    let mesh = beam(4);
    for linear in
        [LinearSolver::Cholesky, LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 }]
    {
        let newton = NewtonSettings::default().with_linear(linear);
        let settings = SimulationSettings::default()
            .with_gravity([0.0, -9.81, 0.0])
            .with_damping(Damping::Mass { rate: 1.0 })
            .with_newton(newton);
        let mut body = simulation(&mesh, neo_hookean(), &left_end(&mesh), settings);
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
    check::<crate::system::Cholesky>();
    check::<crate::system::LowerTriangle>();
}

#[test]
fn errors_convert_and_name_their_source() {
    use std::error::Error;
    let error = StepError::from(NewtonError::from(LinearError::OutOfMemory));
    let newton = error.source().expect("the minimisation failed");
    assert_eq!(newton.source().map(ToString::to_string), Some(LinearError::OutOfMemory.to_string()));
    assert!(SetupError::from(LinearError::OutOfMemory).source().is_some());
}

/// Half the stiffness in the middle of a motion, and a line search that is left out.
#[test]
fn materials_are_replaced_between_steps() {
    let mesh = beam(3);
    let mut settings = SimulationSettings::default().with_gravity([0.0, -9.81, 0.0]);
    settings.line_search = settings.line_search.with_accepts_increase(true);
    let body = Body::new(&mesh, neo_hookean(), 1000.0).expect("a body");
    let mut simulation = Simulation::new(body, &left_end(&mesh), settings).expect("a simulation");
    simulation.equilibrate().expect("a hanging bar");
    let stiff = simulation.positions()[mesh.positions.len() - 1][1];
    assert!(matches!(
        simulation.set_material(1, neo_hookean()),
        Err(BodyError::NoSuchPart { part: 1, parts: 1 })
    ));
    simulation.set_material(0, kirchhoff()).expect("the only part");
    simulation.equilibrate().expect("a hanging bar");
    let softer = simulation.positions()[mesh.positions.len() - 1][1];
    let body = Body::new(&mesh, kirchhoff(), 1000.0).expect("a body");
    let mut fresh = Simulation::new(body, &left_end(&mesh), settings).expect("a simulation");
    fresh.equilibrate().expect("a hanging bar");
    let expected = fresh.positions()[mesh.positions.len() - 1][1];
    assert!(
        (softer - expected).abs() <= 1e-7 && (softer - stiff).abs() > 1e-4,
        "{stiff}, {softer}, {expected}"
    );
}
