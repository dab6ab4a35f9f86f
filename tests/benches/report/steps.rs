//! Wall time of a trajectory against its error, over time steps, Newton's method, filters, linear solvers and
//! precisions.
//!
//! The dinosaur is played as its scene says. So is the horse, but from a start at two thirds of its height:
//! from the ground, where most elements are flat, each time step leads elsewhere, which is measured too. A
//! further body flies free: the dinosaur without pins, pulls and damping, turning and stretching, whose
//! momenta no force changes. The reference is the same motion by the integrator of third order with 1/16 of
//! the scene's time step and Newton's method to a relative 10⁻¹⁰; that of 1/32 says how far the reference
//! itself may be off.

use std::time::Instant;

use indicatif::ProgressBar;
use piola::point::Filter;
use piola::step::{Filtering, Integrator, LinearSolver, NewtonSettings, SimulationSettings};

use crate::data::StepRow;

mod embedded;
mod motion;

use motion::{Motion, Track};

/// How much finer than the scene the reference is.
const FINE: usize = 16;

/// Settings over which the time step is varied: implicit Euler with Newton's method to the end and with one
/// iteration, and integrators of higher order.
pub(crate) const FULL: &str = "full Newton";
pub(crate) const SINGLE: &str = "one iteration";
pub(crate) const SECOND_ORDER: &str = "second order";
pub(crate) const THIRD_ORDER: &str = "third order";

/// A body and how long it is followed.
pub(crate) struct Course {
    body: Body,
    /// In time steps of the scene.
    frames: usize,
    /// Whether as many settings as there are, or some.
    is_quick: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Body {
    /// As in the scene.
    FlatHorse,
    Horse,
    Dinosaur,
    Free,
}

impl Body {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::FlatHorse => "flattened horse",
            Self::Horse => "horse",
            Self::Dinosaur => "dinosaur",
            Self::Free => "dinosaur in free flight",
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

/// What is to be measured.
pub(crate) fn plan(is_quick: bool) -> Vec<Course> {
    let course = |body, [quick, whole]: [usize; 2]| Course {
        body,
        frames: if is_quick { quick } else { whole },
        is_quick,
    };
    vec![
        course(Body::Horse, [2, 60]),
        course(Body::Dinosaur, [4, 90]),
        course(Body::Free, [4, 30]),
        course(Body::FlatHorse, [2, 8]),
    ]
}

/// Steps of the progress bar.
pub(crate) fn count(plan: &[Course]) -> u64 {
    plan.iter().map(|course| course.ways().len() as u64 + 3).sum()
}

/// All rows of a plan, computed by one thread.
///
/// # Errors
/// Where a reference cannot be computed: a way that fails is a row that says so.
pub(crate) fn rows(plan: &[Course], progress: &ProgressBar) -> Result<Vec<StepRow>, String> {
    let thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    thread.map_err(|error| error.to_string())?.install(|| rows_by_this_thread(plan, progress))
}

fn rows_by_this_thread(plan: &[Course], progress: &ProgressBar) -> Result<Vec<StepRow>, String> {
    let mut rows = Vec::new();
    for course in plan {
        progress.set_message(course.body.name());
        let reference = reference(course, FINE, progress)?;
        let finer = reference_row(course, &reference, progress)?;
        let exact = solved_by(NewtonSettings::default().with_tolerance(1e-12).with_max_iterations(100));
        let (solved, _) = follow(course, 1.0, exact).map_err(|error| named(course, &error))?;
        progress.inc(1);
        rows.push(finer);
        for way in course.ways() {
            rows.push(row(course, &way, &reference, &solved));
            progress.inc(1);
        }
        if course.body == Body::Free {
            rows.extend(embedded::rows(course.frames, &reference, &solved)?);
        }
    }
    Ok(rows)
}

fn named(course: &Course, error: &str) -> String {
    format!("{}: {error}", course.body.name())
}

impl Course {
    /// Those that tell something about it.
    fn ways(&self) -> Vec<Way> {
        let mut ways = ways();
        if self.body == Body::FlatHorse {
            ways.retain(|way| way.axis == "h" && way.division <= 8.0);
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
        ways.push(way("h", FULL, division, full));
        ways.push(way("h", SINGLE, division, NewtonSettings::single()));
        ways.push(with("h", SECOND_ORDER, division, solved_by(full).with_integrator(Integrator::Sdirk2)));
        // With the time step of the reference it would be compared with itself.
        if division < FINE as f64 {
            let third = solved_by(full).with_integrator(Integrator::Sdirk3);
            ways.push(with("h", THIRD_ORDER, division, third));
        }
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
        ("trust region", Filtering::TrustRegion { tolerance: 0.01 }),
    ] {
        ways.push(way("filter", name, 1.0, full.with_filtering(filtering)));
    }
    ways.push(way("solver", "Cholesky f64", 1.0, full));
    let refined = LinearSolver::RefinedCholesky { tolerance: 1e-10 };
    ways.push(way("solver", "Cholesky f32, refined", 1.0, full.with_linear(refined)));
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

/// The reference itself, judged by one of half its time step.
fn reference_row(course: &Course, reference: &Track, progress: &ProgressBar) -> Result<StepRow, String> {
    let settings = SimulationSettings::default();
    let setting = format!("h/{FINE} beside h/{}", 2 * FINE);
    let way = Way { axis: "reference", setting, division: FINE as f64, settings };
    let finer = self::reference(course, 2 * FINE, progress)?;
    Ok(judged(course, &way, Ok((reference.clone(), f64::NAN)), &finer, reference))
}

fn row(course: &Course, way: &Way, reference: &Track, solved: &Track) -> StepRow {
    judged(course, way, follow(course, way.division, way.settings), reference, solved)
}

fn judged(
    course: &Course,
    way: &Way,
    result: Result<(Track, f64), String>,
    reference: &Track,
    solved: &Track,
) -> StepRow {
    let mut row = empty_row(course.body, way);
    match result {
        Ok((track, seconds)) => row.fill(&track, seconds, reference, (way.division == 1.0).then_some(solved)),
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
        algebraic_error: f64::NAN,
        energy_drift: f64::NAN,
        linear_momentum_drift: f64::NAN,
        angular_momentum_drift: f64::NAN,
        failure: None,
    }
}

impl StepRow {
    /// `solved` is the same motion with the same time step, each step solved as far as rounding allows.
    fn fill(&mut self, track: &Track, seconds: f64, reference: &Track, solved: Option<&Track>) {
        let drift = track.drift();
        self.seconds = seconds;
        self.steps = track.steps;
        self.newton_iterations = track.newton_iterations;
        self.linear_iterations = track.linear_iterations;
        self.error = track.distance(reference);
        self.algebraic_error = solved.map_or(f64::NAN, |solved| track.distance(solved));
        self.energy_drift = drift.energy;
        self.linear_momentum_drift = drift.linear_momentum;
        self.angular_momentum_drift = drift.angular_momentum;
    }
}

fn solved_by(newton: NewtonSettings) -> SimulationSettings {
    SimulationSettings::default().with_newton(newton)
}
