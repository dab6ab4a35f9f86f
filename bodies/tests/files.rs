//! Settings and reports come back from JSON with the same bits (feature `serde`).
#![cfg(all(feature = "serde", feature = "faer"))]

use std::fmt::Debug;

use piola::material;
use piola::point::Filter;
use piola_bodies::mesh::tetrahedral_box;
use piola_bodies::step::{
    Equilibrium, Filtering, LinearSolver, NewtonReport, NewtonSettings, Simulation, SimulationSettings,
    Spring, StepReport,
};
use piola_bodies::system::{Body, Pins};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// Neo-Hookean solid, moduli in Pa.
#[material(domain(J > 0.0), extend)]
fn Rubber([l1, l2, l3]: [f64; 3], mu: f64, lambda: f64) -> f64 {
    mu / 2.0 * (I1 - 3.0) - mu * J.ln() + lambda / 2.0 * J.ln().powi(2)
}

/// The text of a value that comes back equal, and as the same text: the same bits except for NaN, which JSON
/// has not.
#[track_caller]
fn check<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) -> String {
    let text = serde_json::to_string(value).expect("serialises");
    let back: T = serde_json::from_str(&text).expect("deserialises");
    assert_eq!(back, *value);
    assert_eq!(serde_json::to_string(&back).expect("serialises"), text);
    text
}

#[test]
fn settings_come_back() {
    let third = 1.0 / 3.0;
    for linear in [
        LinearSolver::Automatic,
        LinearSolver::Cholesky,
        LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 1000 },
    ] {
        for filtering in [Filtering::Always(Filter::Absolute), Filtering::OnDemand] {
            let newton = NewtonSettings { linear, tolerance: third, filtering, ..Default::default() };
            check(&SimulationSettings { newton, damping: third, ..Default::default() });
        }
    }
    assert_eq!(check(&Filtering::Always(Filter::Clamp)), r#"{"always":"clamp"}"#);
    check(&Spring::on_node(3, [0.1, 0.2, third], 1e3));
}

#[test]
fn what_is_left_out_of_settings_is_the_default_and_what_is_unknown_an_error() {
    let read = |text: &str| serde_json::from_str::<SimulationSettings>(text);
    let settings =
        read(r#"{"newton": {"tolerance": 1e-9}, "gravity": [0, 0, -1.62]}"#).expect("good settings");
    let newton = NewtonSettings { tolerance: 1e-9, ..Default::default() };
    assert_eq!(settings, SimulationSettings { newton, gravity: [0.0, 0.0, -1.62], ..Default::default() });
    let error = read(r#"{"newton": {"tolerence": 1e-9}}"#).expect_err("a slip of the pen");
    assert!(error.to_string().contains("unknown field `tolerence`"), "{error}");
}

#[test]
fn reports_come_back() -> Result<(), Box<dyn std::error::Error>> {
    let mesh = tetrahedral_box([3, 1, 1], [0.3, 0.1, 0.1])?;
    let pins = Pins::at([0, 1, 2, 3]);
    let body = Body::new(&mesh, Rubber::new(1e5, 4e5)?, 1000.0)?;
    let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], ..Default::default() };
    let mut simulation = Simulation::new(body, &pins, settings)?;
    let report = simulation.step(1.0 / 30.0)?;
    assert!(report.energies.kinetic > 0.0 && !report.newton.step_lengths.is_empty());
    check::<StepReport>(&report);
    check::<NewtonReport>(&report.newton);
    simulation.equilibrate()?;
    check(&Equilibrium::of(&simulation)?);
    Ok(())
}
