//! Time and memory of a time step against the number of elements, for each linear solver.
//!
//! A cube of rubber, one face held, falls under its own weight: boxes of all sizes solve the same problem.
//! Each step of a hundredth of a second makes one iteration of Newton's method. A solver is stopped where the
//! next box would, by what the ones before it took, take it beyond 2 GiB or 60 s; but for conjugate gradients
//! to 10⁻³, which an inexact Newton's method asks for: these go to a million elements.

use std::time::Instant;

use indicatif::ProgressBar;
use peak_alloc::PeakAlloc;
use piola::material::Moduli;
use piola::mesh::{Bounds, tetrahedral_box};
use piola::step::{LinearSolver, NewtonSettings, Simulation, SimulationSettings};
use piola::system::{Body, Pins};
use piola_materials::StableNeoHookean;
use rayon::ThreadPool;

use crate::data::GrowthRow;

mod compressed;

use compressed::Stepper;

/// Cells along an edge; a cell has six elements.
const CELLS: [usize; 7] = [6, 8, 12, 17, 25, 38, 55];

const TIME_STEP: f64 = 0.01;

/// How many steps are counted after a first one, of boxes of up to so many elements; of larger ones, one.
const STEPS: usize = 3;
const LARGE: usize = 200_000;

pub(crate) const DIRECT: &str = "Cholesky f64";
pub(crate) const ITERATIVE: &str = "CG 1e-3";
pub(crate) const COMPRESSED_ROWS: &str = "CSR, Jacobi 1e-3";

/// Relative residual that an inexact Newton's method asks for.
const LOOSE: f64 = 1e-3;

const GRAVITY: [f64; 3] = [0.0, -9.81, 0.0];

const GIB: f64 = 1024.0 * 1024.0 * 1024.0;
const MOST_BYTES: f64 = 2.0 * GIB;
const MOST_SECONDS: f64 = 60.0;

/// Of a solver and a number of threads, from small to large.
pub(crate) struct Series {
    solver: &'static str,
    /// `None` for the code with [compressed rows](compressed).
    linear: Option<LinearSolver>,
    /// Whether it ends where it takes too much.
    is_limited: bool,
    threads: usize,
    cells: &'static [usize],
}

/// What is to be measured.
pub(crate) fn plan(is_quick: bool) -> Vec<Series> {
    let iterative = |tolerance| Some(LinearSolver::ConjugateGradients { tolerance, max_iterations: 10_000 });
    let solvers = [
        (DIRECT, Some(LinearSolver::Cholesky), true),
        (ITERATIVE, iterative(LOOSE), false),
        ("CG 1e-6", iterative(1e-6), true),
        (COMPRESSED_ROWS, None, true),
    ];
    let cells = if is_quick { &CELLS[..4] } else { &CELLS };
    let with = |threads| {
        solvers.map(|(solver, linear, is_limited)| Series { solver, linear, is_limited, threads, cells })
    };
    with(1).into_iter().chain(with(2)).collect()
}

/// A row for each box, and one that says why where a series ends early.
///
/// # Errors
/// Where a box cannot be made or stepped.
pub(crate) fn rows(
    plan: &[Series],
    memory: &PeakAlloc,
    progress: &ProgressBar,
) -> Result<Vec<GrowthRow>, String> {
    let mut rows = Vec::new();
    for series in plan {
        let threads = rayon::ThreadPoolBuilder::new().num_threads(series.threads).build();
        let threads = threads.map_err(|error| error.to_string())?;
        let failed = |error: Box<dyn std::error::Error>| format!("{}: {error}", series.solver);
        // Each thread gets its buffers, such as 64 MiB for dense products, with the first box, which does not
        // count.
        series.measure(series.cells[0], memory, &threads).map_err(failed)?;
        let mut before: Vec<GrowthRow> = Vec::new();
        for &cells in series.cells {
            progress.set_message(format!("{} {}", series.solver, 6 * cells.pow(3)));
            if let Some(reason) = too_large(&before, cells).filter(|_| series.is_limited) {
                before.push(GrowthRow { stopped: Some(reason), ..series.row(cells) });
                break;
            }
            before.push(series.measure(cells, memory, &threads).map_err(failed)?);
        }
        rows.extend(before);
        progress.inc(1);
    }
    Ok(rows)
}

/// What the last two boxes say of the next, by a power of the number of elements.
fn too_large(before: &[GrowthRow], cells: usize) -> Option<String> {
    let elements = 6 * cells.pow(3);
    let before: Vec<&GrowthRow> = before.iter().collect();
    let last = before.last()?;
    let next = |value: fn(&GrowthRow) -> f64| {
        let slope = slope(&before, value)?;
        Some(value(last) * (elements as f64 / last.elements as f64).powf(slope))
    };
    let (bytes, seconds) = (next(|row| row.peak_bytes)?, next(|row| row.seconds_per_step)?);
    if bytes > MOST_BYTES {
        return Some(format!("{elements} elements would take about {:.1} GiB", bytes / GIB));
    }
    (seconds > MOST_SECONDS).then(|| format!("{elements} elements would take about {seconds:.0} s a step"))
}

/// The exponent of growth between the two largest boxes.
pub(crate) fn slope(rows: &[&GrowthRow], value: impl Fn(&GrowthRow) -> f64) -> Option<f64> {
    let [.., first, second] = rows else { return None };
    let ratio = second.elements as f64 / first.elements as f64;
    Some((value(second) / value(first)).ln() / ratio.ln())
}

impl Series {
    fn row(&self, cells: usize) -> GrowthRow {
        GrowthRow {
            solver: self.solver,
            threads: self.threads,
            elements: 6 * cells.pow(3),
            unknowns: 0,
            seconds_per_step: f64::NAN,
            peak_bytes: f64::NAN,
            newton_iterations: f64::NAN,
            linear_iterations: f64::NAN,
            stopped: None,
        }
    }

    fn measure(
        &self,
        cells: usize,
        memory: &PeakAlloc,
        threads: &ThreadPool,
    ) -> Result<GrowthRow, Box<dyn std::error::Error>> {
        memory.reset_peak_usage();
        let before = memory.current_usage();
        let mut row = self.row(cells);
        let (unknowns, mut step) = self.scene(cells)?;
        row.unknowns = unknowns;
        (row.seconds_per_step, row.newton_iterations, row.linear_iterations) = (0.0, 0.0, 0.0);
        let steps = if row.elements > LARGE { 1 } else { STEPS };
        for index in 0..=steps {
            let clock = Instant::now();
            let (newton_iterations, linear_iterations) = threads.install(&mut step)?;
            // The first finds cold caches.
            if index > 0 {
                let share = 1.0 / steps as f64;
                row.seconds_per_step += share * clock.elapsed().as_secs_f64();
                row.newton_iterations += share * newton_iterations as f64;
                row.linear_iterations += share * linear_iterations as f64;
            }
        }
        row.peak_bytes = memory.peak_usage().saturating_sub(before) as f64;
        Ok(row)
    }

    /// The number of unknowns, and what makes a step.
    fn scene(&self, cells: usize) -> Result<(usize, Step), Box<dyn std::error::Error>> {
        let mesh = tetrahedral_box([cells; 3], [1.0; 3])?;
        let moduli = Moduli::from_young_poisson(1e6, 0.45)?;
        let rubber = StableNeoHookean::new(moduli.mu, moduli.lambda)?;
        let body = Body::new(&mesh, rubber, 1000.0)?;
        let (min, max) = ([-1.0; 3], [1e-9, 2.0, 2.0]);
        let pins = Pins::in_box(&mesh, Bounds { min, max })?;
        let Some(linear) = self.linear else {
            let pinned = pins.nodes();
            let mut stepper = Stepper::new(&body, rubber, pinned)?;
            let step =
                move || Ok((1, stepper.step(TIME_STEP, GRAVITY, LOOSE).map_err(|error| error.to_string())?));
            return Ok((3 * (mesh.positions.len() - pinned.len()), Box::new(step)));
        };
        let newton = NewtonSettings::single().with_linear(linear);
        let settings = SimulationSettings::default().with_gravity(GRAVITY).with_newton(newton);
        let mut simulation = Simulation::new(body, &pins, settings)?;
        let unknowns = 3 * (simulation.positions().len() - simulation.pinned().len());
        let step = move || {
            let report = simulation.step(TIME_STEP).map_err(|error| error.to_string())?;
            Ok((report.newton.iterations, report.newton.linear_iterations))
        };
        Ok((unknowns, Box::new(step)))
    }
}

/// Makes a step, and returns the iterations of Newton's method and of the linear solver.
type Step = Box<dyn FnMut() -> Result<(usize, usize), String> + Send>;
