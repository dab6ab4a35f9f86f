//! Agreement of runs on several ranks with the simulation on one machine.
//!
//! Each run is started by `mpirun`. The positions in its checkpoint are compared with those of piola's
//! simulation.

mod common;

use std::path::Path;

use common::{TestResult, checkpoint_in, command, finish, state_after};
use piola::material::Moduli;
use piola::point::Filter;
use piola_bodies::mesh::{Bounds, TetMesh, tetrahedral_box};
use piola_bodies::step::{
    Convergence, Filtering, Integrator, LinearSolver, NewtonSettings, Simulation, SimulationSettings,
};
use piola_bodies::system::{Body, Part, Pins};
use piola_scenes::geometry::Geometry;
use piola_scenes::material::MaterialSpec;
use piola_scenes::output::Newton;
use piola_scenes::play::{Play, step_settings};
use piola_scenes::scene::{DINOSAUR, HORSE, Scene, TWIST};
use piola_scenes::settings::Settings;

/// Numbers of ranks: one, two and four by default; three in addition with PIOLA_RANKS=1,2,3,4.
fn ranks() -> Vec<usize> {
    let given = std::env::var("PIOLA_RANKS").unwrap_or_else(|_| "1,2,4".to_owned());
    given.split(',').map(|count| count.parse().expect("integers separated by commas")).collect()
}

fn newton() -> NewtonSettings {
    NewtonSettings {
        filtering: Filtering::Always(Filter::Clamp),
        linear: LinearSolver::Cholesky,
        max_iterations: 200,
        tolerance: 1e-12,
        ..Default::default()
    }
}

/// Settings of a body under its own weight.
fn falling() -> SimulationSettings {
    SimulationSettings { gravity: [0.0, -9.81, 0.0], newton: newton(), ..Default::default() }
}

/// Options that solve to the tolerance of [`newton`].
const SOLVED: &str = "--newton full --newton-tolerance 1e-12 --newton-iterations 200 --filter clamp";

/// Largest distance between nodes, m.
fn distance(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let pairs = a.iter().zip(b);
    pairs.map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()).fold(0.0, f64::max)
}

fn matching(scene: &Scene, name: &str) -> Result<MaterialSpec, Box<dyn std::error::Error>> {
    let own = (scene.material)();
    Ok(if own.is(name) { own } else { MaterialSpec::matching(name, own.build()?.moduli) })
}

/// Compares one machine with several numbers of ranks over `frames` fully solved steps. The initial state is
/// the result of a cheap run over `before` steps.
#[track_caller]
#[expect(clippy::print_stdout, reason = "figures, shown with --nocapture")]
fn check_scene(scene: &'static Scene, material: &str, before: usize, frames: usize) -> TestResult {
    let settings = Settings { material: matching(scene, material)?, ..Settings::new(scene) };
    let geometry = Geometry::load(&settings)?;
    let scratch = tempfile::tempdir()?;
    for count in ranks() {
        let folder = scratch.path().join(count.to_string());
        let run = |options: String| {
            state_after(count, &format!("run {} --material '{material}' {options}", scene.name), &folder)
        };
        let state = run(format!("--frames {before} --newton single"))?;
        let mut play = Play::new(settings.clone(), geometry.clone())?;
        play.simulation.set_settings(SimulationSettings { newton: newton(), ..step_settings(&settings) })?;
        play.resume(state.about.clock.expect("of a run"), &state.positions, &state.velocities)?;
        for _ in 0..frames {
            let report = play.step()?.newton;
            // If 10⁻¹² is below the rounding error of the forces, the iterations end at this error.
            let is_solved =
                report.convergence != Convergence::Limit && report.residual <= 1e-10 * report.first_residual;
            assert!(is_solved, "{report:?}");
        }
        let found = run(format!("--resume --frames {} {SOLVED}", before + frames))?;
        let error = distance(&found.positions, play.simulation.positions()) / play.height;
        println!("{}, {material}, on {count} ranks: {error:.1e} body heights", scene.name);
        // 10⁻⁹ body heights for each step.
        assert!(error <= 1e-9 * frames as f64, "{error:e} body heights on {count} ranks");
    }
    Ok(())
}

#[test]
fn a_dinosaur_of_three_energies_moves_equally() -> TestResult {
    check_scene(&DINOSAUR, "Ogden", 20, 4)?;
    check_scene(&DINOSAUR, "stable neo-Hookean", 50, 4)?;
    check_scene(&DINOSAUR, "rotated linear", 50, 4)
}

/// Begins after the flat phase, in which the stress of rotated linear elasticity is discontinuous, so that
/// steps cannot be solved to the tolerance.
#[test]
fn a_horse_of_three_energies_moves_equally() -> TestResult {
    check_scene(&HORSE, "rotated linear", 30, 4)?;
    check_scene(&HORSE, "neo-Hookean", 30, 4)?;
    check_scene(&HORSE, "Ogden", 30, 4)
}

/// Compares the final positions of a run on each number of ranks with positions on one machine, m.
#[track_caller]
#[expect(clippy::print_stdout, reason = "figures, shown with --nocapture")]
fn check(ranks: &[usize], arguments: &str, expected: &[[f64; 3]], most: f64) -> TestResult {
    let scratch = tempfile::tempdir()?;
    for &count in ranks {
        let folder = scratch.path().join(count.to_string());
        let found = state_after(count, arguments, &folder)?;
        let error = distance(&found.positions, expected);
        println!("{arguments} on {count} ranks: {error:.1e} m");
        assert!(error <= most, "{error:e} m on {count} ranks: {arguments}");
    }
    Ok(())
}

/// Compares two ranks with one machine after fully solved frames of the dinosaur.
#[track_caller]
fn check_dinosaur(settings: &Settings, frames: usize, options: &str) -> TestResult {
    let geometry = Geometry::load(settings)?;
    let mut play = Play::new(settings.clone(), geometry)?;
    play.simulation.set_settings(SimulationSettings { newton: newton(), ..step_settings(settings) })?;
    for _ in 0..frames {
        play.step()?;
    }
    let run = format!("run dinosaur --frames {frames} {SOLVED} {options}");
    let most = 1e-9 * frames as f64 * play.height;
    check(&[2], &run, play.simulation.positions(), most)
}

/// All integrators except implicit Euler, in the pull of the dinosaur.
#[test]
fn integrators_agree() -> TestResult {
    for (name, integrator) in [("sdirk2", Integrator::Sdirk2), ("sdirk3", Integrator::Sdirk3)] {
        let settings = Settings { integrator, gravity: 9.81, ..Settings::new(&DINOSAUR) };
        check_dinosaur(&settings, 5, &format!("--gravity 9.81 --integrator {name}"))?;
    }
    Ok(())
}

/// A frame is divided at the end of a pull within it. The energy is a formula.
#[test]
fn events_within_a_frame_are_met_with_a_formula_too() -> TestResult {
    let spec = matching(&DINOSAUR, "neo-Hookean")?;
    let parameters = spec.build()?.parameters;
    let [mu, lambda] = ["mu", "lambda"].map(|name| parameters[name][0]);
    let settings = Settings { material: spec, dt: 0.4, ..Settings::new(&DINOSAUR) };
    let energy = "mu/2*(I1 - 3) - mu*ln(J) + lambda/2*ln(J)^2";
    let options = format!("--dt=0.4 --energy '{energy}' --param=mu={mu} --param=lambda={lambda}");
    // The pull reaches its end at 1.5 s, and is released at 2 s.
    check_dinosaur(&settings, 4, &options)
}

/// Each program chooses steps that satisfy the tolerance. Steps are solved to different numbers of digits, so
/// that trajectories differ by a fraction of the tolerance.
#[test]
fn steps_within_a_tolerance_agree() -> TestResult {
    let (tolerance, dt, frames) = (0.05, 0.1, 4);
    let settings = Settings {
        dt,
        integrator: Integrator::Sdirk2,
        tolerance: Some(tolerance),
        newton: Newton::Full,
        ..Settings::new(&DINOSAUR)
    };
    let geometry = Geometry::load(&settings)?;
    let mut play = Play::new(settings, geometry)?;
    let mut taken = 0;
    for _ in 0..frames {
        play.step()?;
        taken += play.steps.taken;
    }
    let scratch = tempfile::tempdir()?;
    let folder = scratch.path().join("run");
    let options = format!(
        "run dinosaur --dt {dt} --frames {frames} --integrator sdirk2 --tolerance {tolerance} --newton full"
    );
    let found = state_after(2, &options, &folder)?;
    let error = distance(&found.positions, play.simulation.positions()) / play.height;
    let summary: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.join("summary.json"))?)?;
    println!("{taken} steps, and {} on two ranks: {error:.1e} body heights", summary["steps"]["taken"]);
    assert!(taken > frames, "{taken} steps do not test this");
    assert_eq!(summary["steps"]["taken"], taken);
    assert!(error <= 0.1 * tolerance * dt * frames as f64, "{error:e} body heights");
    Ok(())
}

/// The cube of `piola-mpi box`, with the settings of the bench `statics`.
#[test]
fn a_box_sags_as_on_one_machine() -> TestResult {
    let cells = 8;
    let mesh = tetrahedral_box([cells; 3], [1.0; 3])?;
    let moduli = Moduli::from_young_poisson(1e6, 0.45)?;
    let material = MaterialSpec::new("stable neo-Hookean")
        .with_parameter("mu", [moduli.mu])
        .with_parameter("lambda", [moduli.lambda])
        .build()?;
    let part = Part { group: None, material: material.elements, density: 1000.0 };
    let body = Body::from_parts(&mesh, vec![part])?;
    let pins = Pins::in_box(&mesh, Bounds { min: [-1.0; 3], max: [1e-9, 2.0, 2.0] })?;
    let mut simulation = Simulation::new(body, &pins, falling())?;
    simulation.equilibrate()?;
    let options = format!("box --elements {} --newton-tolerance 1e-12", mesh.tets.len());
    check(&ranks(), &options, simulation.positions(), 1e-8)
}

/// `-ksp_view` shows piola's levels and the solver of the last one. Options replace this solver and the
/// levels, with the same results.
#[test]
fn preconditioners_are_shown_and_replaced() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let mut first = None;
    for (number, (options, shown)) in [
        ("", ["multigrid: levels of 2197, ", "KSP Object: (coarse_)", "type: redundant"]),
        ("-coarse_pc_type gamg", ["multigrid: levels of 2197, ", "KSP Object: (coarse_)", "type: gamg"]),
        ("-pc_type gamg", ["type: gamg", "KSP Object: (mg_levels_1_)", "type: mpiaij"]),
        ("-pc_type bjacobi", ["type: bjacobi", "KSP Object: (sub_)", "type: mpiaij"]),
    ]
    .into_iter()
    .enumerate()
    {
        let folder = scratch.path().join(number.to_string());
        let sag = "box --elements 10000 --newton-tolerance 1e-10 -ksp_view";
        let options = format!("{sag} --out {} {options}", folder.display());
        let output = finish(command(3, &options))?;
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{options}: {}", String::from_utf8_lossy(&output.stderr));
        for shown in shown {
            assert!(text.contains(shown), "no `{shown}` by {options}: {text}");
        }
        let found = checkpoint_in(&folder)?;
        let first = first.get_or_insert_with(|| found.positions.clone());
        let error = distance(&found.positions, first);
        // Newton's tolerance, for a body that sags by a tenth of its length.
        assert!(error <= 1e-8, "{options}: {error:e} m");
    }
    Ok(())
}

/// A bar stands under its own weight and is bent at its top.
#[test]
fn statics_end_as_on_one_machine() -> TestResult {
    let mesh = Geometry::of(piola_scenes::scene::Body::BAR)?.mesh;
    let material = (TWIST.material)().build()?.elements;
    let body = Body::from_parts(&mesh, vec![Part { group: None, material, density: TWIST.density }])?;
    let at = |height: f64| Bounds { min: [-1.0, height, -1.0], max: [1.0, height, 1.0] };
    let (foot, top) = (Pins::in_box(&mesh, at(0.0))?, Pins::in_box(&mesh, at(1.0))?);
    let mut simulation = Simulation::new(body, &foot.and(&top), falling())?;
    for &node in top.nodes() {
        let [x, y, z] = mesh.positions[node];
        simulation.prescribe(node, [x + 0.1, y, z])?;
    }
    simulation.equilibrate()?;
    let options = "statics twist --gravity 9.81 --move :,1:1,:=0.1,0,0@1 --newton-tolerance 1e-12 --newton-iterations 200 \
                   --filter clamp";
    check(&ranks(), options, simulation.positions(), 1e-8)
}

/// A bar in TetGen's files, with markers and regions, an unused node, comments, and tetrahedra in both
/// orientations: the mesh as it is read, and a body of two materials and densities.
fn bar_of_tetgen(file: &Path) -> Result<(TetMesh, Body), Box<dyn std::error::Error>> {
    let bar = tetrahedral_box([2, 6, 2], [0.3, 1.0, 0.3])?;
    let stray = 11;
    let number = |node: usize| if node < stray { node + 1 } else { node + 2 };
    let mut nodes = format!("# a bar\n{} 3 1 1\n", bar.positions.len() + 1);
    for (node, [x, y, z]) in bar.positions.iter().enumerate() {
        let marker = if *y == 0.0 { 5 } else { 0 };
        nodes += &format!("{} {x:?} {y:?} {z:?} 0.5 {marker} # {y}\n", number(node));
    }
    nodes += &format!("{} 9 9 9 0.5 0\n", stray + 1);
    let mut tets = format!("{} 4 1\n", bar.tets.len());
    for (tet, nodes) in bar.tets.iter().enumerate() {
        let [a, b, c, d] = nodes.map(number);
        let [b, c] = if tet % 3 == 0 { [c, b] } else { [b, c] };
        tets += &format!("{} {a} {b} {c} {d} {}\n", tet + 1, if tet % 2 == 0 { 7 } else { -1 });
    }
    std::fs::write(file, nodes)?;
    std::fs::write(file.with_extension("ele"), tets)?;

    let mesh = piola_bodies::mesh::read_tetgen(file)?;
    let soft = (HORSE.material)().build()?.moduli;
    let part = |group: Option<&str>, name: &str, density: f64| -> Result<Part, Box<dyn std::error::Error>> {
        let material = MaterialSpec::matching(name, soft).build()?.elements;
        Ok(Part { group: group.map(str::to_owned), material, density })
    };
    let parts = vec![part(None, "neo-Hookean", 1000.0)?, part(Some("7"), "stable neo-Hookean", 3000.0)?];
    let body = Body::from_parts(&mesh, parts)?;
    Ok((mesh, body))
}

/// A bar of two materials and densities under gravity, with damping; its top moves and its foot, a group, is
/// held.
#[test]
fn groups_and_prescribed_motions_are_those_of_one_machine() -> TestResult {
    let scratch = tempfile::tempdir()?;
    let file = scratch.path().join("bar.node");
    let (mesh, body) = bar_of_tetgen(&file)?;
    let top = Pins::in_box(&mesh, Bounds { min: [-1.0, 1.0 - 1e-9, -1.0], max: [1.0, 1.0 + 1e-9, 1.0] })?;
    // The scene's damping.
    let settings = SimulationSettings { damping: 2.0, ..falling() };
    let (dt, frames) = (1.0 / 30.0, 6);
    let mut simulation = Simulation::new(body, &Pins::of_group(&mesh, "5")?.and(&top), settings)?;
    for frame in 1..=frames {
        let share = (f64::from(frame) * dt / 0.15).min(1.0);
        for &node in top.nodes() {
            let [x, y, z] = mesh.positions[node];
            simulation.prescribe(node, [x + 0.1 * share, y + 0.2 * share, z])?;
        }
        simulation.step(dt)?;
    }
    let options = format!(
        "run scramble --amplitude 0 --gravity 9.81 --pin 5 --move :,0.999999:,:=0.1,0.2,0@0.15 --frames {frames} \
         {SOLVED} --material neo-Hookean --part '7=stable neo-Hookean;density=3000' --mesh {}",
        file.display()
    );
    for count in ranks() {
        let folder = scratch.path().join(count.to_string());
        let found = state_after(count, &options, &folder)?;
        let error = distance(&found.positions, simulation.positions());
        assert!(error <= 1e-9 * f64::from(frames), "{error:e} m on {count} ranks");
        let summary: serde_json::Value =
            serde_json::from_slice(&std::fs::read(folder.join("summary.json"))?)?;
        let warnings = summary["warnings"].to_string();
        assert!(warnings.contains("1 nodes of the file belong to no tetrahedron"), "{warnings}");
    }
    Ok(())
}
