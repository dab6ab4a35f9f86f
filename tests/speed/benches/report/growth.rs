//! Time and memory of a time step against the number of elements, by a factor and by conjugate gradients, and
//! of an equilibrium.
//!
//! A cube of rubber, one face held, falls under its own weight: boxes of all sizes solve the same problem.
//! Each step of a hundredth of a second makes one iteration of Newton's method.

use std::time::Instant;

use peak_alloc::PeakAlloc;
use piola::material::Moduli;
use piola_bodies::mesh::{Bounds, tetrahedral_box};
use piola_bodies::step::{Convergence, LinearSolver, NewtonSettings, Simulation, SimulationSettings};
use piola_bodies::system::{Body, Pins};
use piola_materials::StableNeoHookean;
use serde::Serialize;

use crate::Outcome;

/// Cells along an edge; a cell has six elements. A factor takes too much beyond [`MOST_OF_FACTOR`].
const CELLS: [usize; 7] = [6, 8, 12, 17, 25, 38, 56];
const MOST_OF_FACTOR: usize = 25;

const TIME_STEP: f64 = 0.01;

/// Number of timed steps, after a first one that finds cold caches.
const STEPS: usize = 3;

/// A step or an equilibrium of a box.
#[derive(Default, Serialize)]
pub(crate) struct GrowthRow {
    pub(crate) way: &'static str,
    pub(crate) threads: usize,
    pub(crate) elements: usize,
    /// The least of the steps.
    pub(crate) seconds: f64,
    pub(crate) peak_bytes: usize,
    pub(crate) newton_iterations: usize,
    pub(crate) linear_iterations: usize,
}

/// A way to solve: its name, the settings of Newton's method, and the number of threads.
type Way = (&'static str, NewtonSettings, usize);

const EQUILIBRIUM: &str = "equilibrium, conjugate gradients";

fn ways() -> [Way; 6] {
    let iterative = |tolerance| LinearSolver::ConjugateGradients { tolerance, max_iterations: 20_000 };
    let step = |linear| NewtonSettings { linear, ..NewtonSettings::single() };
    let equilibrium = NewtonSettings { linear: iterative(1e-2), ..Default::default() };
    [
        ("step, Cholesky", step(LinearSolver::Cholesky), 1),
        ("step, conjugate gradients 1e-3", step(iterative(1e-3)), 1),
        ("step, Cholesky", step(LinearSolver::Cholesky), 2),
        ("step, conjugate gradients 1e-3", step(iterative(1e-3)), 2),
        (EQUILIBRIUM, equilibrium, 1),
        (EQUILIBRIUM, equilibrium, 2),
    ]
}

pub(crate) fn rows(is_quick: bool, memory: &PeakAlloc) -> Outcome<Vec<GrowthRow>> {
    eprintln!("growing bodies …");
    let mut rows = Vec::new();
    let cells = if is_quick { &CELLS[..4] } else { &CELLS };
    for way in ways() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(way.2).build()?;
        // Each thread gets its buffers, such as 64 MiB for dense products, with a first box, which does not
        // count.
        pool.install(|| measure(way, cells[0], memory))?;
        for &cells in cells {
            if way.1.linear != LinearSolver::Cholesky || cells <= MOST_OF_FACTOR {
                rows.push(pool.install(|| measure(way, cells, memory))?);
            }
        }
    }
    Ok(rows)
}

fn measure((way, newton, threads): Way, cells: usize, memory: &PeakAlloc) -> Outcome<GrowthRow> {
    memory.reset_peak_usage();
    let before = memory.current_usage();
    let mesh = tetrahedral_box([cells; 3], [1.0; 3])?;
    let moduli = Moduli::from_young_poisson(1e6, 0.45)?;
    let body = Body::new(&mesh, StableNeoHookean::new(moduli.mu, moduli.lambda)?, 1000.0)?;
    let face = Bounds { min: [-1.0; 3], max: [1e-9, 2.0, 2.0] };
    let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], newton, ..Default::default() };
    let mut simulation = Simulation::new(body, &Pins::in_box(&mesh, face)?, settings)?;
    let is_static = way == EQUILIBRIUM;
    let mut row = GrowthRow { way, threads, elements: mesh.tets.len(), ..GrowthRow::default() };
    for _ in 0..if is_static { 1 } else { 1 + STEPS } {
        let clock = Instant::now();
        let report = if is_static { simulation.equilibrate()? } else { simulation.step(TIME_STEP)? };
        let seconds = clock.elapsed().as_secs_f64();
        if is_static && report.newton.convergence != Convergence::Tolerance {
            return Err(format!("{} elements are not in equilibrium", row.elements).into());
        }
        row.seconds = if row.seconds == 0.0 { seconds } else { row.seconds.min(seconds) };
        row.newton_iterations = report.newton.iterations;
        row.linear_iterations = report.newton.linear_iterations;
    }
    row.peak_bytes = memory.peak_usage().saturating_sub(before);
    Ok(row)
}
