//! Wall time of a motion against its error: integrators over the time step, and other ways to solve a step.
//!
//! A dinosaur of rubber, its feet pinned, is drawn by half its height and let go, without damping. The
//! reference is the same motion by the integrator of third order with 1/32 of the scenes' time step and
//! Newton's method to a relative 10⁻¹⁰; the row `reference` is its distance from one with 1/64.

use std::time::Instant;

use piola::Inversion;
use piola::point::Filter;
use piola_bodies::mesh::Bounds;
use piola_bodies::step::{
    Filtering, Integrator, LinearSolver, NewtonSettings, Simulation, SimulationSettings, Spring,
};
use piola_bodies::system::{Body, Pins};
use piola_materials::NeoHookean;
use piola_scenes::geometry::Geometry;
use piola_scenes::scene::DINOSAUR;
use piola_scenes::settings::Settings;
use serde::Serialize;

use crate::Outcome;

/// Frames per second.
const RATE: f64 = 30.0;

/// Steps per frame of the reference.
const FINE: f64 = 32.0;

/// Number of runs of each way, of which the least time counts. Ways longer than [`LONG`], s, run once.
const REPEATS: usize = 5;
const LONG: f64 = 3.0;

/// Integrators over which the time step is varied, with Newton's method to the end.
pub(crate) const INTEGRATORS: [(&str, Integrator); 3] = [
    ("implicit Euler", Integrator::ImplicitEuler),
    ("SDIRK2", Integrator::Sdirk2),
    ("SDIRK3", Integrator::Sdirk3),
];

/// Implicit Euler with one iteration of Newton's method, over which the time step is varied too.
pub(crate) const SINGLE: &str = "implicit Euler, one iteration";

/// A way to step a body through a motion.
#[derive(Default, Serialize)]
pub(crate) struct StepRow {
    pub(crate) setting: &'static str,
    /// Time step, s.
    pub(crate) h: f64,
    /// Wall time of all steps, s.
    pub(crate) seconds: f64,
    pub(crate) steps: usize,
    pub(crate) newton_iterations: usize,
    pub(crate) linear_iterations: usize,
    /// Largest distance of a node from the reference after any frame, body heights.
    pub(crate) error: f64,
    /// Largest distance of a node from the reference after the last frame, body heights.
    pub(crate) final_error: f64,
}

struct Way {
    setting: &'static str,
    /// Steps in a frame; less than one makes steps longer.
    division: f64,
    newton: NewtonSettings,
    integrator: Integrator,
}

/// Positions of the nodes after frames, m.
type Track = Vec<Vec<[f64; 3]>>;

/// A row for the reference and for each way, computed by one thread.
pub(crate) fn rows(is_quick: bool) -> Outcome<Vec<StepRow>> {
    eprintln!("motions …");
    let thread = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    thread.install(|| measure(is_quick))
}

fn measure(is_quick: bool) -> Outcome<Vec<StepRow>> {
    let (drawn, height) = drawn()?;
    let frames = if is_quick { 4 } else { 30 };
    let repeats = if is_quick { 1 } else { REPEATS };
    let newton = NewtonSettings { tolerance: 1e-10, ..Default::default() };
    let reference = |division| Way { setting: "reference", division, newton, integrator: Integrator::Sdirk3 };
    let ways = ways(is_quick);
    let (_, finer) = follow(&drawn, &reference(2.0 * FINE), frames)?;
    let (row, exact) = follow(&drawn, &reference(FINE), frames)?;
    let mut rows = vec![row.judged(&exact, &finer, height)];
    for way in &ways {
        let (row, track) = follow(&drawn, way, frames)?;
        rows.push(row.judged(&track, &exact, height));
    }
    // In turns, so that a disturbance hits all ways.
    for _ in 1..repeats {
        for (way, row) in ways.iter().zip(&mut rows[1..]).filter(|(_, row)| row.seconds < LONG) {
            row.seconds = row.seconds.min(follow(&drawn, way, frames)?.0.seconds);
        }
    }
    Ok(rows)
}

fn ways(is_quick: bool) -> Vec<Way> {
    // As scenes solve steps of higher order; those of first order lose nothing by it.
    let full = NewtonSettings { error_share: 0.03, ..Default::default() };
    let divisions =
        [0.5, 1.0, 2.0, 4.0, 8.0, 16.0].into_iter().filter(|division| !is_quick || *division <= 4.0);
    let mut ways = Vec::new();
    for division in divisions {
        ways.extend(INTEGRATORS.map(|(setting, integrator)| Way {
            setting,
            division,
            newton: full,
            integrator,
        }));
        let (newton, integrator) = (NewtonSettings::single(), Integrator::ImplicitEuler);
        ways.push(Way { setting: SINGLE, division, newton, integrator });
    }
    let iterative = LinearSolver::ConjugateGradients { tolerance: 1e-3, max_iterations: 10_000 };
    let filtering = Filtering::Always(Filter::Clamp);
    for (setting, newton) in [
        ("implicit Euler, always clamped", NewtonSettings { filtering, ..full }),
        ("implicit Euler, conjugate gradients 1e-3", NewtonSettings { linear: iterative, ..full }),
    ] {
        ways.push(Way { setting, division: 1.0, newton, integrator: Integrator::ImplicitEuler });
    }
    ways
}

/// The body in equilibrium, its head drawn sideways by half its height, and the height, m.
fn drawn() -> Outcome<(Simulation, f64)> {
    /// The head is drawn in parts, so that each equilibrium is near the previous one.
    const PARTS: usize = 10;
    let mesh = Geometry::load(&Settings::new(&DINOSAUR))?.mesh;
    let bounds = mesh.bounds();
    let height = bounds.size()[1];
    let feet = Bounds {
        min: [f64::NEG_INFINITY; 3],
        max: [f64::INFINITY, bounds.min[1] + 0.08 * height, f64::INFINITY],
    };
    let rubber = NeoHookean::new(344_830.0, 3_103_400.0)?;
    let rubber = rubber.with_inversion(Inversion::Extend { epsilon: 0.1 })?;
    let body = Body::new(&mesh, rubber, DINOSAUR.density)?;
    let mut simulation = Simulation::new(body, &Pins::in_box(&mesh, feet)?, SimulationSettings::default())?;
    let places = mesh.positions.iter().enumerate();
    let head = places.max_by(|(_, a), (_, b)| (a[0] + a[1]).total_cmp(&(b[0] + b[1])));
    let (head, &[x, y, z]) = head.ok_or("a mesh without nodes")?;
    for part in 1..=PARTS {
        let target = [x, y, z + 0.5 * height * part as f64 / PARTS as f64];
        simulation.set_springs(&[Spring::on_node(head, target, 1e6)])?;
        simulation.equilibrate()?;
    }
    simulation.set_springs(&[])?;
    Ok((simulation, height))
}

/// Releases the body and follows it for `frames` frames. Leaves the errors of the row to [`StepRow::judged`].
fn follow(drawn: &Simulation, way: &Way, frames: usize) -> Outcome<(StepRow, Track)> {
    let mut simulation = drawn.clone();
    let Way { newton, integrator, .. } = *way;
    simulation.set_settings(SimulationSettings { newton, integrator, ..Default::default() })?;
    let (h, steps) = (1.0 / RATE / way.division, (frames as f64 * way.division).round() as usize);
    let unknown = StepRow { error: f64::NAN, final_error: f64::NAN, ..StepRow::default() };
    let mut row = StepRow { setting: way.setting, h, steps, ..unknown };
    let mut track = Track::new();
    let clock = Instant::now();
    for step in 1..=steps {
        let report = simulation.step(h)?.newton;
        row.newton_iterations += report.iterations;
        row.linear_iterations += report.linear_iterations;
        if step % way.division.max(1.0) as usize == 0 {
            track.push(simulation.positions().to_vec());
        }
    }
    row.seconds = clock.elapsed().as_secs_f64();
    Ok((row, track))
}

impl StepRow {
    /// The row with its errors against the reference, body heights.
    fn judged(self, track: &Track, exact: &Track, height: f64) -> Self {
        // Of a track with longer steps each frame is one of several of the reference.
        let stride = exact.len() / track.len();
        let errors = track.iter().zip(exact.iter().skip(stride - 1).step_by(stride)).map(|(frame, exact)| {
            let squares = frame.iter().zip(exact).map(|(x, y)| (0..3).map(|c| (x[c] - y[c]).powi(2)).sum());
            squares.fold(0.0, f64::max).sqrt() / height
        });
        let (error, final_error) =
            errors.fold((0.0, 0.0), |(most, _): (f64, f64), last| (most.max(last), last));
        Self { error, final_error, ..self }
    }

    /// Wall time for a second of motion, ms.
    pub(crate) fn milliseconds(&self) -> f64 {
        1e3 * self.seconds / (self.steps as f64 * self.h)
    }
}
