//! The cube of `piola-mpi box` with piola on one machine, without PETSc, for a comparison of times.
//!
//! `cargo run --release --example alone -- 10000,94000 1`, on one thread, is compared with
//! `piola-mpi box --elements 94000`.

#![expect(clippy::print_stdout, reason = "a program for the command line")]

use std::error::Error;
use std::time::Instant;

use piola::material::Moduli;
use piola_bodies::mesh::{Bounds, tetrahedral_box};
use piola_bodies::step::{LinearSolver, NewtonSettings, Simulation, SimulationSettings};
use piola_bodies::system::{Body, Part, Pins};
use piola_scenes::material::MaterialSpec;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().collect();
    let [_, sizes, threads] = words.as_slice() else {
        return Err("expected numbers of elements and a number of threads, such as 10000,94000 1".into());
    };
    rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).use_current_thread().build_global()?;
    println!(
        "| elements | Newton iterations | CG iterations, total | relative residual | set-up time, s | solve time, s |\n\
         |---|---|---|---|---|---|"
    );
    for elements in sizes.split(',') {
        let clock = Instant::now();
        let cells = (elements.parse::<f64>()? / 6.0).cbrt().ceil() as usize;
        let mesh = tetrahedral_box([cells; 3], [1.0; 3])?;
        let moduli = Moduli::from_young_poisson(1e6, 0.45)?;
        let material = MaterialSpec::new("stable neo-Hookean")
            .with_parameter("mu", [moduli.mu])
            .with_parameter("lambda", [moduli.lambda]);
        let part = Part { group: None, material: material.build()?.elements, density: 1000.0 };
        let body = Body::from_parts(&mesh, vec![part])?;
        let pins = Pins::in_box(&mesh, Bounds { min: [-1.0; 3], max: [1e-9, 2.0, 2.0] })?;
        let linear = LinearSolver::ConjugateGradients { tolerance: 1e-2, max_iterations: 20_000 };
        let settings = SimulationSettings::default()
            .with_gravity([0.0, -9.81, 0.0])
            .with_newton(NewtonSettings::default().with_linear(linear));
        let mut simulation = Simulation::new(body, &pins, settings)?;
        let (set_up, clock) = (clock.elapsed(), Instant::now());
        let report = simulation.equilibrate()?.newton;
        println!(
            "| {} | {} | {} | {:.1e} | {:.2} | {:.2} |",
            mesh.tets.len(),
            report.iterations,
            report.linear_iterations,
            report.residual / report.first_residual,
            set_up.as_secs_f64(),
            clock.elapsed().as_secs_f64(),
        );
    }
    Ok(())
}
