//! The energy–momentum method on a real mesh: a dinosaur that tumbles freely and is strongly deformed keeps
//! its energy and its momenta to rounding.
//!
//! Over 20 steps, or over a thousand, which take a minute:
//! `PIOLA_LONG=1 cargo test --release -p piola-scenes --test energy_momentum -- --nocapture`.

use piola::material::Moduli;
use piola::mesh::TetMesh;
use piola::step::{Integrator, NewtonSettings, Simulation, SimulationSettings};
use piola::system::{Body, Pins};
use piola_materials::{NeoHookean, Ogden};
use piola_scenes::geometry::Geometry;
use piola_scenes::scene::DINOSAUR;
use piola_scenes::settings::Settings;

/// Energy, J, and linear and angular momentum, N s and N m s.
struct Constants {
    energy: f64,
    linear: [f64; 3],
    angular: [f64; 3],
}

impl Constants {
    fn of(simulation: &mut Simulation) -> Self {
        let energies = simulation.energies();
        let mut constants = Self { energy: energies.total(), linear: [0.0; 3], angular: [0.0; 3] };
        let states = simulation.positions().iter().zip(simulation.velocities());
        for (&mass, (x, v)) in simulation.body().masses().iter().zip(states) {
            for c in 0..3 {
                let (a, b) = ((c + 1) % 3, (c + 2) % 3);
                constants.linear[c] += mass * v[c];
                constants.angular[c] += mass * (x[a] * v[b] - x[b] * v[a]);
            }
        }
        constants
    }
}

/// Turns once in two seconds about y and z and is stretched along x, m/s.
fn tumbling(mesh: &TetMesh) -> Vec<[f64; 3]> {
    let bounds = mesh.bounds();
    let centre: [f64; 3] = std::array::from_fn(|c| 0.5 * (bounds.min[c] + bounds.max[c]));
    let velocity = |position: &[f64; 3]| {
        let [x, y, z]: [f64; 3] = std::array::from_fn(|c| position[c] - centre[c]);
        [6.0 * x + 3.0 * z - 2.0 * y, -3.0 * y + 2.0 * x, -3.0 * z - 3.0 * x]
    };
    mesh.positions.iter().map(velocity).collect()
}

/// Steps of 1/30 s from the rest shape; the energies that deformation and motion exchange are of one size.
#[expect(clippy::print_stderr, reason = "the figure that documents quote")]
fn check_constants(body: Body, mesh: &TetMesh) {
    let steps = if std::env::var_os("PIOLA_LONG").is_some() { 1000 } else { 20 };
    let newton = NewtonSettings::default().with_tolerance(1e-13);
    let settings =
        SimulationSettings::default().with_newton(newton).with_integrator(Integrator::EnergyMomentum);
    let mut simulation = Simulation::new(body, &Pins::none(), settings).expect("a simulation");
    simulation.set_velocities(&tumbling(mesh)).expect("finite");
    let first = Constants::of(&mut simulation);
    let norm = |x: [f64; 3]| x.iter().map(|c| c * c).sum::<f64>().sqrt();
    let change = |a: [f64; 3], b: [f64; 3]| norm(std::array::from_fn(|c| a[c] - b[c]));
    // Momentum that is zero, up to rounding, is judged beside that of the nodes.
    let size: f64 =
        simulation.body().masses().iter().zip(simulation.velocities()).map(|(m, v)| m * norm(*v)).sum();
    let (mut largest_strain_energy, mut largest_drift) = (0.0_f64, 0.0_f64);
    for step in 1..=steps {
        let report = simulation.step(1.0 / 30.0).expect("a step");
        largest_strain_energy = largest_strain_energy.max(report.energies.elastic / first.energy);
        let now = Constants::of(&mut simulation);
        let drifts = [
            (now.energy - first.energy).abs() / first.energy,
            change(now.angular, first.angular) / norm(first.angular),
            change(now.linear, first.linear) / size,
        ];
        largest_drift = drifts.into_iter().fold(largest_drift, f64::max);
        assert!(largest_drift <= 1e-10, "step {step}: {drifts:?}");
    }
    assert!(largest_strain_energy > 0.3, "{largest_strain_energy}");
    eprintln!("{steps} steps: energy and momenta change by {largest_drift:.1e} at most");
}

fn dinosaur() -> TetMesh {
    Geometry::load(&Settings::new(&DINOSAUR)).expect("the mesh of the scene").mesh
}

#[test]
fn neo_hookean_rubber_keeps_energy_and_momenta() {
    let mesh = dinosaur();
    let Moduli { mu, lambda, .. } = Moduli::from_young_poisson(1e6, 0.45).expect("moduli");
    let material = NeoHookean::new(mu, lambda).expect("a material");
    check_constants(Body::new(&mesh, material, 1000.0).expect("a body"), &mesh);
}

#[test]
fn ogden_rubber_keeps_energy_and_momenta() {
    let mesh = dinosaur();
    let material = Ogden::new([4.2e5, 1.5e3, -8e3], [1.3, 5.0, -2.0], 3e6).expect("a material");
    check_constants(Body::new(&mesh, material, 1000.0).expect("a body"), &mesh);
}
