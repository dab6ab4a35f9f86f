//! Wall time of a trajectory against its error, over time steps, Newton's method, filters, linear solvers and
//! precisions.
//!
//! The dinosaur is played as its scene says. So is the horse, but from a start at two thirds of its height:
//! from the ground, where most elements are flat, each time step leads elsewhere, which is measured too. The
//! reference is the same motion by the integrator of third order with 1/16 of the scene's time step and
//! Newton's method to a relative 10⁻¹⁰; that of 1/32 says how far the reference itself may be off.
//!
//! A dinosaur of rubber is drawn by half its height and let go, without damping: of it the page tells what an
//! error of 0.02 body heights costs with each integrator. Its reference has 1/32 of the time step.
//!
//! Three more bodies fly free, without pins, pulls and damping, so that no force changes their momenta: the
//! dinosaur turning and stretching, a stiff and nearly incompressible one turning fast, and a bar that
//! vibrates gently for ten thousand steps. Their energy and angular momentum are followed over time. The bar
//! has no reference: after hundreds of periods, distances would tell of phases alone.

use std::time::Instant;

use clap::ValueEnum;
use indicatif::ProgressBar;
use piola::point::Filter;
use piola::step::{Filtering, Integrator, LinearSolver, NewtonSettings, SimulationSettings};

use crate::data::{AdaptiveRow, HistoryRow, StepRow};

pub(crate) mod adaptive;
mod arrival;
mod embedded;
mod motion;

pub(crate) use arrival::arrivals;
use motion::{Motion, Track};

/// How much finer than the scene the reference of the scenes is.
const FINE: usize = 16;

/// How often the ways of a body are gone whose times are compared; the least counts.
const REPEATS: usize = 5;

/// Ways that take longer, s, are gone once.
const LONG: f64 = 3.0;

/// Integrators over which the time step is varied, with Newton's method to the end.
pub(crate) const INTEGRATORS: [(&str, Integrator); 3] = [
    ("implicit Euler", Integrator::ImplicitEuler),
    ("SDIRK2", Integrator::Sdirk2),
    ("SDIRK3", Integrator::Sdirk3),
];

/// Implicit Euler with one iteration of Newton's method, over which the time step is varied too.
pub(crate) const SINGLE: &str = "implicit Euler, one iteration";

/// The axis of all integrators with one iteration for each minimisation, at the scene's time step.
pub(crate) const SINGLE_AXIS: &str = "one iteration";

/// A body and how long it is followed.
pub(crate) struct Course {
    body: Body,
    /// In time steps of the scene.
    frames: usize,
    /// Whether as many settings as there are, or some.
    is_quick: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Body {
    /// As in the scene.
    FlatHorse,
    Horse,
    Dinosaur,
    LetGo,
    Free,
    Spinning,
    Quiet,
}

impl Body {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FlatHorse => "flattened horse",
            Self::Horse => "horse",
            Self::Dinosaur => "dinosaur",
            Self::LetGo => "rubber dinosaur let go",
            Self::Free => "dinosaur in free flight",
            Self::Spinning => "stiff dinosaur, spinning",
            Self::Quiet => "bar, ten thousand steps",
        }
    }
}

/// One way to go the course.
struct Way {
    axis: &'static str,
    setting: String,
    /// By what the scene's time step is divided; less than one makes it longer.
    division: f64,
    settings: SimulationSettings,
}

/// What is to be measured: these bodies, or all where none is named.
pub(crate) fn plan(is_quick: bool, bodies: &[Body]) -> Vec<Course> {
    let course = |body, [quick, whole]: [usize; 2]| Course {
        body,
        frames: if is_quick { quick } else { whole },
        is_quick,
    };
    let mut plan = vec![
        course(Body::Horse, [2, 30]),
        course(Body::Dinosaur, [4, 75]),
        course(Body::LetGo, [4, 30]),
        course(Body::Free, [4, 30]),
        course(Body::Spinning, [4, 30]),
        course(Body::Quiet, [100, 10_000]),
        course(Body::FlatHorse, [2, 8]),
    ];
    plan.retain(|course| bodies.is_empty() || bodies.contains(&course.body));
    plan
}

/// Steps of the progress bar.
pub(crate) fn count(plan: &[Course]) -> u64 {
    plan.iter().map(|course| course.ways().len() as u64 + 3).sum()
}

/// What was measured.
#[derive(Default)]
pub(crate) struct Measured {
    pub(crate) rows: Vec<StepRow>,
    /// Of the free bodies, at the scene's time step.
    pub(crate) histories: Vec<HistoryRow>,
    /// Of the dinosaur, with steps that follow from their error.
    pub(crate) frames: Vec<AdaptiveRow>,
}

/// All rows of a plan, computed by one thread.
///
/// # Errors
/// Where a reference cannot be computed: a way that fails is a row that says so.
pub(crate) fn measure(plan: &[Course], progress: &ProgressBar) -> Result<Measured, String> {
    let thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    thread.map_err(|error| error.to_string())?.install(|| measure_by_this_thread(plan, progress))
}

fn measure_by_this_thread(plan: &[Course], progress: &ProgressBar) -> Result<Measured, String> {
    let mut measured = Measured::default();
    for course in plan {
        progress.set_message(course.body.name());
        let references = references(course, progress, &mut measured)?;
        let ways = course.ways();
        let mut rows = Vec::new();
        for way in &ways {
            let result = follow(course, way.division, way.settings);
            if let Ok((track, _)) = &result {
                measured.histories.extend(track.history(course.body, way));
            }
            rows.push(judged(course, way, result, references.as_ref()));
            progress.inc(1);
        }
        if course.body == Body::LetGo {
            time_again(course, &ways, &mut rows);
        }
        measured.rows.append(&mut rows);
        if let (Body::Free, Some(references)) = (course.body, &references) {
            measured.rows.extend(embedded::rows(course.frames, references)?);
        }
        if let (Body::Dinosaur, Some(references)) = (course.body, &references) {
            adaptive::measure(course.frames, references, &mut measured);
        }
    }
    Ok(measured)
}

/// Times the ways again, in turns, and keeps the least time of each.
fn time_again(course: &Course, ways: &[Way], rows: &mut [StepRow]) {
    for _ in 1..if course.is_quick { 1 } else { REPEATS } {
        for (way, row) in ways.iter().zip(&mut *rows).filter(|(_, row)| row.seconds < LONG) {
            if let Ok((_, seconds)) = follow(course, way.division, way.settings) {
                row.seconds = row.seconds.min(seconds);
            }
        }
    }
}

/// What tracks of a body are compared with.
struct References {
    /// By third order and much shorter steps.
    exact: Track,
    /// By implicit Euler with the scene's time step, each step solved as far as rounding allows.
    solved: Track,
}

/// None of a body that is not compared.
fn references(
    course: &Course,
    progress: &ProgressBar,
    measured: &mut Measured,
) -> Result<Option<References>, String> {
    if course.body == Body::Quiet {
        progress.inc(3);
        return Ok(None);
    }
    let fine = course.fine();
    let exact = reference(course, fine, progress)?;
    let finer = reference(course, 2 * fine, progress)?;
    let to_rounding = NewtonSettings::default().with_tolerance(1e-12).with_max_iterations(100);
    let (solved, _) = follow(course, 1.0, solved_by(to_rounding)).map_err(|error| named(course, &error))?;
    progress.inc(1);
    let setting = format!("h/{fine} beside h/{}", 2 * fine);
    let settings = SimulationSettings::default();
    let way = Way { axis: "reference", setting, division: fine as f64, settings };
    let beside_finer = References { exact: finer, solved };
    measured.rows.push(judged(course, &way, Ok((exact.clone(), f64::NAN)), Some(&beside_finer)));
    Ok(Some(References { exact, ..beside_finer }))
}

fn named(course: &Course, error: &str) -> String {
    format!("{}: {error}", course.body.name())
}

impl Course {
    /// How much finer than the scene its reference is.
    fn fine(&self) -> usize {
        if self.body == Body::LetGo { 2 * FINE } else { FINE }
    }

    /// Those that tell something about it.
    fn ways(&self) -> Vec<Way> {
        let mut ways = ways();
        if self.body == Body::LetGo {
            ways.retain(|way| way.axis == "h");
            // As scenes solve steps of higher order; those of first order lose nothing by it either.
            let full = ways.iter_mut().filter(|way| way.setting != SINGLE);
            full.for_each(|way| way.settings.newton.error_share = 0.03);
        }
        if self.body == Body::Horse {
            ways.retain(|way| way.division <= 8.0);
        }
        if self.body == Body::FlatHorse {
            ways.retain(|way| way.axis == "h" && way.division <= 8.0);
        }
        if self.body == Body::Quiet {
            ways.retain(|way| {
                way.axis == SINGLE_AXIS || way.axis == "h" && (1.0..=4.0).contains(&way.division)
            });
        }
        if self.is_quick {
            ways.retain(|way| way.division <= 4.0);
        }
        ways
    }
}

/// Implicit Euler with full Newton unless the axis is another.
fn ways() -> Vec<Way> {
    let full = NewtonSettings::default();
    let with = |axis, setting: &str, division, settings| {
        let setting = setting.to_owned();
        Way { axis, setting, division, settings }
    };
    let way = |axis, setting: &str, division, newton| with(axis, setting, division, solved_by(newton));
    let mut ways = Vec::new();
    for division in [0.5, 1.0, 2.0, 4.0, 8.0, 16.0] {
        for (name, integrator) in INTEGRATORS {
            // With integrator and time step of the reference it would be compared with itself.
            if (integrator, division) != (Integrator::Sdirk3, FINE as f64) {
                ways.push(with("h", name, division, solved_by(full).with_integrator(integrator)));
            }
        }
        ways.push(way("h", SINGLE, division, NewtonSettings::single()));
    }
    for (name, integrator) in INTEGRATORS.into_iter().skip(1) {
        let single = solved_by(NewtonSettings::single()).with_integrator(integrator);
        ways.push(with(SINGLE_AXIS, name, 1.0, single));
    }
    for iterations in [2, 4] {
        let newton = full.with_max_iterations(iterations).with_tolerance(0.0);
        ways.push(way("newton", &format!("{iterations} iterations"), 1.0, newton));
    }
    for tolerance in [1e-1, 1e-2, 1e-4, 1e-8] {
        ways.push(way("newton", &format!("tolerance {tolerance:e}"), 1.0, full.with_tolerance(tolerance)));
    }
    for (name, filtering) in [
        ("no filter", Filtering::Always(Filter::None)),
        ("clamp", Filtering::Always(Filter::Clamp)),
        ("absolute", Filtering::Always(Filter::Absolute)),
        ("on demand", Filtering::OnDemand),
    ] {
        ways.push(way("filter", name, 1.0, full.with_filtering(filtering)));
    }
    ways.push(way("solver", "Cholesky f64", 1.0, full));
    for tolerance in [1e-1, 1e-2, 1e-4, 1e-8] {
        let linear = LinearSolver::ConjugateGradients { tolerance, max_iterations: 10_000 };
        let setting = format!("conjugate gradients {tolerance:e}");
        ways.push(way("solver", &setting, 1.0, full.with_linear(linear)));
    }
    ways
}

fn follow(course: &Course, division: f64, settings: SimulationSettings) -> Result<(Track, f64), String> {
    let mut motion = Motion::new(course.body, division, settings)?;
    let steps = (course.frames as f64 * division).round() as usize;
    let clock = Instant::now();
    motion.follow(steps)?;
    let seconds = clock.elapsed().as_secs_f64();
    Ok((motion.into_track(), seconds))
}

fn reference(course: &Course, fine: usize, progress: &ProgressBar) -> Result<Track, String> {
    let settings =
        solved_by(NewtonSettings::default().with_tolerance(1e-10)).with_integrator(Integrator::Sdirk3);
    let (track, _) = follow(course, fine as f64, settings).map_err(|error| named(course, &error))?;
    progress.inc(1);
    Ok(track)
}

fn judged(
    course: &Course,
    way: &Way,
    result: Result<(Track, f64), String>,
    references: Option<&References>,
) -> StepRow {
    let mut row = empty_row(course.body, way);
    match result {
        Ok((track, seconds)) => row.fill(&track, seconds, references),
        Err(error) => row.failure = Some(error),
    }
    row
}

/// Of a way that nobody has gone yet.
fn empty_row(body: Body, way: &Way) -> StepRow {
    StepRow {
        scene: body.name(),
        axis: way.axis,
        setting: way.setting.clone(),
        h: motion::TIME_STEP / way.division,
        seconds: f64::NAN,
        steps: 0,
        newton_iterations: 0,
        linear_iterations: 0,
        error: f64::NAN,
        final_error: f64::NAN,
        algebraic_error: f64::NAN,
        largest_energy_error: f64::NAN,
        energy_drift: f64::NAN,
        linear_momentum_drift: f64::NAN,
        angular_momentum_drift: f64::NAN,
        failure: None,
    }
}

impl StepRow {
    fn fill(&mut self, track: &Track, seconds: f64, references: Option<&References>) {
        let drift = track.drift();
        self.seconds = seconds;
        self.steps = track.steps;
        self.newton_iterations = track.newton_iterations;
        self.linear_iterations = track.linear_iterations;
        if let Some(References { exact, solved }) = references {
            self.error = track.distance(exact);
            self.final_error = track.final_distance(exact);
            if self.h == motion::TIME_STEP {
                self.algebraic_error = track.distance(solved);
            }
        }
        self.largest_energy_error = track.largest_energy_error();
        self.energy_drift = drift.energy;
        self.linear_momentum_drift = drift.linear_momentum;
        self.angular_momentum_drift = drift.angular_momentum;
    }
}

fn solved_by(newton: NewtonSettings) -> SimulationSettings {
    SimulationSettings::default().with_newton(newton)
}
