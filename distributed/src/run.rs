//! Subcommands: a box that sags, statics, and runs in time.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use piola::material::Moduli;
use piola_bodies::step::{Convergence, NewtonReport, SimulationSettings, StepReport};
use piola_scenes::clock::Clock;
use piola_scenes::material::{MaterialPart, MaterialSpec};
use piola_scenes::measure;
use piola_scenes::output::{Ended, Newton, StepCounts};
use piola_scenes::play::{self, DragSprings, Stretch};
use piola_scenes::run::speed;
use piola_scenes::settings::{Settings, difference};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::checkpoint;
use crate::command::{BodyOptions, BoxOptions, RunOptions, Task};
use crate::error::Error;
use crate::output::{self, Summary};
use crate::portion::Portion;
use crate::setting::{self, BodyFacts};
use crate::share::Share;
use crate::simulation::Simulation;
use crate::team::Team;

/// Description of a checkpoint: what its run depends on, and measurements of the run up to it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Settings on which the motion depends, by name.
    settings: Value,
    /// Checksum of the mesh.
    body: u32,
    /// Number of completed steps.
    pub frame: usize,
    /// Clock at the checkpoint; `None` in statics.
    pub clock: Option<Clock>,
    newton_iterations: usize,
    systems: usize,
    linear_iterations: usize,
    relative_residual: f64,
    min_det_f: f64,
    steps: StepCounts,
}

fn relative_residual(report: &NewtonReport) -> f64 {
    if report.residual == 0.0 { 0.0 } else { report.residual / report.first_residual }
}

/// Computes the sag of a cube under its own weight; returns a row of the table with the titles [`TITLES`].
///
/// # Errors
/// An [`Error`] of the options, the solver or a file.
pub fn sag(team: &Team, options: &BoxOptions) -> Result<String, Error> {
    let newton = options.solver.settings(false)?;
    let cells = ((options.elements.max(1) as f64 / 6.0).cbrt() - 1e-9).ceil().max(1.0) as u64;
    let moduli = Moduli::from_young_poisson(1e6, 0.45).map_err(Error::usage)?;
    let material = MaterialSpec::new("stable neo-Hookean")
        .with_parameter("mu", [moduli.mu])
        .with_parameter("lambda", [moduli.lambda]);
    let parts = [MaterialPart { group: None, material, density: 1000.0 }];
    let clock = Instant::now();
    let share = Share::of(team, Portion::of_cube(team, cells, 1.0))?;
    let settings = SimulationSettings { gravity: [0.0, -9.81, 0.0], newton, ..Default::default() };
    let mut simulation = Simulation::new(team, share, &parts, settings)?;
    team.wait();
    let (set_up, clock) = (clock.elapsed(), Instant::now());
    let report = simulation.advance(|part| part.equilibrate_here())?.newton;
    let systems = simulation.part.machine().take_systems();
    team.wait();
    let solved = clock.elapsed();
    if let Some(folder) = &options.out {
        output::prepare(team, folder, true)?;
        checkpoint::write(team, &checkpoint::file_in(folder), &simulation, &About::default())?;
    }
    if report.convergence == Convergence::Limit {
        let residual = relative_residual(&report);
        return Err(Error::usage(format!(
            "the body is not in equilibrium: the relative residual is {residual:.1e}"
        )));
    }
    let memory = team.sum([peak_memory()])[0] / f64::from(1 << 20);
    let share = &simulation.share;
    let copies = team.max((share.ids.len() - share.owned) as f64);
    let total: usize = systems.iter().sum();
    let mean = total as f64 / systems.len().max(1) as f64;
    Ok(format!(
        "| {} | {} | {} | {} | {total} | {mean:.1} | {} | {:.1e} | {:.2} | {:.2} | {memory:.0} | {copies:.0} |",
        share.totals[1],
        share.totals[0],
        team.size,
        report.iterations,
        systems.iter().max().unwrap_or(&0),
        relative_residual(&report),
        set_up.as_secs_f64(),
        solved.as_secs_f64(),
    ))
}

/// Head of the table of which [`sag`] returns a row.
pub const TITLES: &str = "\
| elements | nodes | ranks | Newton iterations | CG iterations, total | CG iterations per linear system, mean \
| CG iterations per linear system, maximum | relative residual | set-up time, s | solve time, s \
| peak memory, total of all ranks, MiB | copies on a rank, maximum |
|---|---|---|---|---|---|---|---|---|---|---|---|";

/// Peak memory of this process, bytes; 0 if the system does not report it.
fn peak_memory() -> f64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kibibytes = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
    1024.0 * kibibytes.unwrap_or(0.0)
}

/// Computes the equilibrium of a body; returns its summary.
///
/// # Errors
/// An [`Error`] of the options, the body, the solver or a file.
pub fn statics(team: &Team, options: &BodyOptions) -> Result<Summary, Error> {
    let task = team.agree(options.task())?;
    let mut course = Course::new(team, &task, options, false)?;
    output::prepare(team, &course.folder, options.force)?;
    // In statics, prescribed motions are complete.
    course.prescribe(f64::INFINITY)?;
    let clock = Instant::now();
    let report = course.simulation.advance(|part| part.equilibrate_here())?;
    course.note(&report);
    course.about.frame = 1;
    course.write_frame()?;
    course.write_checkpoint()?;
    let mut summary = course.summary(&[clock.elapsed()]);
    (summary.frames_wanted, summary.dt, summary.integrator) = (1, None, None);
    if report.newton.convergence == Convergence::Limit {
        summary.ended = Ended::Failed;
        summary.failures.push("the body is not in equilibrium; increase --newton-iterations".to_owned());
    }
    output::write_summary(team, &course.folder, &summary)?;
    Ok(summary)
}

/// Runs a scene; returns its summary.
///
/// # Errors
/// An [`Error`] of the options, the body, the first step or a file. If a later step fails, the run
/// ends, and the summary contains the failure.
pub fn run(team: &Team, options: &RunOptions) -> Result<Summary, Error> {
    let task = team.agree(options.task())?;
    let mut course = Course::new(team, &task, &options.body, options.steps.newton == Newton::Single)?;
    let mut clock = Clock::new(task.settings.dt);
    if options.resume {
        clock = course.resume()?;
    } else {
        output::prepare(team, &course.folder, options.body.force)?;
        course.note_start();
        if options.vtu {
            course.write_frame()?;
        }
    }
    course.pull(clock.time(), clock.time())?;
    let wanted = task.settings.frames;
    let (mut times, mut failures) = (Vec::new(), Vec::new());
    while course.about.frame < wanted {
        let begun = Instant::now();
        if let Err(error) = course.step(clock) {
            // A failure of the first step is an error of the run; errors of PETSc may be on one rank alone.
            if course.about.frame == 0 || !error.is_common() {
                return Err(error);
            }
            failures.push(error.to_string());
            break;
        }
        clock = clock.next();
        (course.about.frame, course.about.clock) = (course.about.frame + 1, Some(clock));
        times.push(begun.elapsed());
        if options.vtu {
            course.write_frame()?;
        }
        let frame = course.about.frame;
        let is_due = options.checkpoint_every > 0 && frame.is_multiple_of(options.checkpoint_every);
        if is_due || frame == wanted {
            course.write_checkpoint()?;
        }
    }
    if options.vtu {
        output::write_frames(team, &course.folder, course.about.frame, task.settings.dt)?;
    }
    let mut summary = course.summary(&times);
    if !failures.is_empty() {
        (summary.ended, summary.failures) = (Ended::Failed, failures);
    }
    output::write_summary(team, &course.folder, &summary)?;
    Ok(summary)
}

/// A run between its first and its last step.
struct Course<'a> {
    team: &'a Team,
    task: &'a Task,
    folder: PathBuf,
    body: BodyFacts,
    pulls: Vec<DragSprings>,
    simulation: Simulation,
    about: About,
}

impl<'a> Course<'a> {
    /// Reads and divides the body; `is_single` for one Newton iteration in each step.
    fn new(team: &'a Team, task: &'a Task, options: &BodyOptions, is_single: bool) -> Result<Self, Error> {
        let newton = options.solver.settings(is_single)?;
        let Task { settings, moves } = task;
        let (share, body, pulls) = setting::divided(team, task)?;
        let steps = SimulationSettings { newton, ..play::step_settings(settings) };
        let lasting = Settings { frames: 1, threads: 1, newton: Newton::Single, ..settings.clone() };
        let mut lasting = serde_json::to_value(lasting).map_err(Error::usage)?;
        lasting["moves"] = serde_json::to_value(moves).map_err(Error::usage)?;
        Ok(Self {
            simulation: Simulation::new(team, share, &settings.all_parts(), steps)?,
            about: About { settings: lasting, body: body.checksum, min_det_f: 1.0, ..About::default() },
            folder: options.out.clone().unwrap_or_else(|| Path::new("out").join(settings.scene.name)),
            team,
            task,
            body,
            pulls,
        })
    }

    /// Advances from the frame at the clock to the next one.
    fn step(&mut self, clock: Clock) -> Result<(), Error> {
        // Equal on all ranks.
        let (first, last) = play::stretches(&self.pulls, clock);
        first.into_iter().chain([last]).try_for_each(|stretch| self.advance(stretch))
    }

    fn advance(&mut self, stretch: Stretch) -> Result<(), Error> {
        self.pull(stretch.start, stretch.end)?;
        self.prescribe(stretch.end)?;
        let tolerance = self.task.settings.tolerance.map(|share| share * self.height());
        let (report, steps) = self.simulation.advance(|part| stretch.make(part, tolerance))?;
        self.about.steps += steps;
        self.note(&report);
        Ok(())
    }

    /// Sets the springs of the pulls as they are at the end of a time interval, s.
    fn pull(&mut self, start: f64, end: f64) -> Result<(), Error> {
        let springs: Vec<_> = self.pulls.iter().flat_map(|pull| pull.during(start, end)).collect();
        self.simulation.set(|part| part.set_springs(&springs))
    }

    /// Prescribes the positions of moved nodes at a time, s, after the next step.
    fn prescribe(&mut self, time: f64) -> Result<(), Error> {
        let Self { task, simulation, .. } = self;
        let places = &simulation.share.places;
        let place = |node: usize| Some((node, setting::moved(&task.moves, &places[node], time)?));
        let places: Vec<_> = simulation.share.pinned().into_iter().filter_map(place).collect();
        simulation.set(|part| places.into_iter().try_for_each(|(node, place)| part.prescribe(node, place)))
    }

    /// Height of the body, m.
    fn height(&self) -> f64 {
        self.body.bounds.size()[1]
    }

    fn note(&mut self, StepReport { newton, min_det, .. }: &StepReport) {
        let systems = self.simulation.part.machine().take_systems();
        let about = &mut self.about;
        about.min_det_f = about.min_det_f.min(*min_det);
        about.newton_iterations += newton.iterations;
        about.systems += systems.len();
        about.linear_iterations += systems.iter().sum::<usize>();
        about.relative_residual = relative_residual(newton);
    }

    fn note_start(&mut self) {
        let share = &self.simulation.share;
        let rest: Vec<[f64; 3]> = share.places.iter().map(|place| place.rest).collect();
        let tets: Vec<[usize; 4]> = share.elements.iter().map(|&(nodes, ..)| nodes).collect();
        let own = measure::min_det_f(&rest, self.simulation.part.positions(), &tets);
        self.about.min_det_f = self.team.min(own);
    }

    fn write_frame(&self) -> Result<(), Error> {
        output::write_frame(self.team, &self.folder, self.about.frame, &self.simulation)
    }

    fn write_checkpoint(&self) -> Result<(), Error> {
        let file = checkpoint::file_in(&self.folder);
        checkpoint::write(self.team, &file, &self.simulation, &self.about)
    }

    /// Continues from the checkpoint in the folder; returns its clock.
    fn resume(&mut self) -> Result<Clock, Error> {
        let file = checkpoint::file_in(&self.folder);
        let Self { team, task, about: own, simulation, .. } = self;
        let check = |about: &About| {
            if about.body != own.body {
                return Err("it belongs to another mesh".to_owned());
            }
            match difference(&about.settings, &own.settings) {
                Some(difference) => Err(difference),
                None if about.clock.is_none() => Err("it is of `statics`, which makes no steps".to_owned()),
                None => Ok(()),
            }
        };
        *own = checkpoint::read(team, &file, simulation, check)?;
        Ok(own.clock.unwrap_or_else(|| Clock::new(task.settings.dt)))
    }

    fn summary(&mut self, times: &[Duration]) -> Summary {
        let team = self.team;
        let energy = self.simulation.part.energies().elastic;
        let (share, state) = (&self.simulation.share, &self.simulation.part);
        let rest: Vec<_> = share.places[..share.owned].iter().map(|place| place.rest).collect();
        let farthest = team.max(measure::max_distance(&rest, state.positions())) / self.height();
        let pins = team.count(share.owned - share.free);
        let settings = &self.task.settings;
        let info = settings.material.build().ok();
        let [ms_per_step_median, steps_per_second] = speed(times);
        let &About { frame, newton_iterations, systems, linear_iterations, .. } = &self.about;
        Summary {
            scene: settings.scene.name.to_owned(),
            material: info.as_ref().map_or_else(String::new, |info| info.name.to_string()),
            parameters: info.map(|info| info.parameters).unwrap_or_default(),
            tets: share.totals[1],
            nodes: share.totals[0],
            ranks: team.size,
            copies_max: team.max((share.ids.len() - share.owned) as f64) as usize,
            frames: frame,
            frames_wanted: settings.frames,
            ended: Ended::Finished,
            failures: Vec::new(),
            warnings: self.body.warnings.clone(),
            dt: Some(settings.dt),
            integrator: Some(settings.integrator),
            tolerance: settings.tolerance,
            steps: self.about.steps,
            newton_iterations_mean: newton_iterations as f64 / frame.max(1) as f64,
            linear_iterations_mean: linear_iterations as f64 / systems.max(1) as f64,
            relative_residual: self.about.relative_residual,
            min_det_f: self.about.min_det_f,
            max_distance_from_rest: (pins >= 3).then_some(farthest),
            energy,
            ms_per_step_median,
            steps_per_second,
        }
    }
}
