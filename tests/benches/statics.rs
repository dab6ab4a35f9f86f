//! Boxes of growing size sag under their own weight: time and memory of a static solve by conjugate
//! gradients.
//!
//! `cargo bench -p piola-tests --bench statics` goes to a million elements, some minutes on two threads; `--
//! --cells 6,12,25` takes other boxes, of six elements a cell. A cube of rubber of 1 m hangs from one face;
//! Newton's method goes on to a residual of 10⁻⁶ of the weight, its systems as tight as its convergence
//! needs.

#![expect(clippy::print_stdout, reason = "a command line tool")]

use std::error::Error;
use std::time::Instant;

use clap::Parser;
use peak_alloc::PeakAlloc;
use piola::material::Moduli;
use piola::mesh::{Bounds, tetrahedral_box};
use piola::step::{Convergence, LinearSolver, NewtonSettings, Simulation, SimulationSettings};
use piola::system::{Body, Pins};
use piola_materials::StableNeoHookean;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const SOLVER: LinearSolver = LinearSolver::ConjugateGradients { tolerance: 1e-2, max_iterations: 20_000 };

/// Time and memory of a static solve by conjugate gradients.
#[derive(Debug, Parser)]
struct Arguments {
    /// Cells along an edge of each box.
    #[arg(long, value_delimiter = ',', default_values_t = [12, 17, 25, 38, 55])]
    cells: Vec<usize>,

    /// Threads; 0 for one per core.
    #[arg(long, default_value_t = 2)]
    threads: usize,

    /// Cargo says this.
    #[arg(long, hide = true)]
    bench: bool,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Arguments { cells, threads, .. } = Arguments::parse();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    println!("| elements | Newton | conjugate gradients | residual | s | growth | MiB at most |");
    println!("|---|---|---|---|---|---|---|");
    let mut before: Option<(usize, f64)> = None;
    for cells in cells {
        let elements = 6 * cells.pow(3);
        MEMORY.reset_peak_usage();
        let used = MEMORY.current_usage();
        let mut simulation = hanging(cells)?;
        let clock = Instant::now();
        let report = pool.install(|| simulation.equilibrate())?.newton;
        let seconds = clock.elapsed().as_secs_f64();
        if report.convergence != Convergence::Tolerance {
            return Err(format!("{elements} elements are not in equilibrium: {report:?}").into());
        }
        let growth = before.map_or(String::new(), |(fewer, less)| {
            format!("n^{:.2}", (seconds / less).ln() / (elements as f64 / fewer as f64).ln())
        });
        println!(
            "| {elements} | {} | {} | {:.1e} | {seconds:.2} | {growth} | {:.0} |",
            report.iterations,
            report.linear_iterations,
            report.residual / report.first_residual,
            MEMORY.peak_usage().saturating_sub(used) as f64 / f64::from(1 << 20),
        );
        before = Some((elements, seconds));
    }
    Ok(())
}

/// A cube at rest that is held at one face.
fn hanging(cells: usize) -> Result<Simulation, Box<dyn Error>> {
    let mesh = tetrahedral_box([cells; 3], [1.0; 3])?;
    let moduli = Moduli::from_young_poisson(1e6, 0.45)?;
    let body = Body::new(&mesh, StableNeoHookean::new(moduli.mu, moduli.lambda)?, 1000.0)?;
    let face = Bounds { min: [-1.0; 3], max: [1e-9, 2.0, 2.0] };
    let pins = Pins::in_box(&mesh, face)?;
    let newton = NewtonSettings::default().with_linear(SOLVER);
    let settings = SimulationSettings::default().with_gravity([0.0, -9.81, 0.0]).with_newton(newton);
    Ok(Simulation::new(body, &pins, settings)?)
}
