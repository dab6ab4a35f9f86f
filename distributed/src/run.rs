//! Subcommands: a box that sags, statics, and runs in time.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use piola::material::Moduli;
use piola_bodies::step::{
    AdaptiveReport, Convergence, NewtonReport, NewtonSettings, SimulationSettings, StepReport,
};
use piola_scenes::clock::Clock;
use piola_scenes::material::MaterialSpec;
use piola_scenes::measure;
use piola_scenes::output::{Ended, Newton, StepCounts};
use piola_scenes::play::{self, Stretch};
use piola_scenes::settings::Settings;
use serde::{Deserialize, Serialize};

use crate::checkpoint;
use crate::command::{BodyOptions, BoxOptions, RunOptions, Task};
use crate::error::Error;
use crate::output::{self, Summary};
use crate::part::MaterialPart;
use crate::portion::Portion;
use crate::setting::Setting;
use crate::share::Share;
use crate::simulation::Simulation;
use crate::team::Team;

/// Description of a checkpoint of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Settings on which the motion depends.
    pub settings: String,
    /// Checksum of the mesh.
    pub body: u32,
    /// Number of completed steps.
    pub frame: usize,
    /// Clock at the checkpoint; `None` in statics.
    pub clock: Option<Clock>,
    progress: Progress,
}

/// Measurements of a run up to now.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Progress {
    newton_iterations: usize,
    systems: usize,
    linear_iterations: usize,
    relative_residual: f64,
    min_det_f: f64,
    steps: StepCounts,
}

impl Progress {
    fn new() -> Self {
        Self { min_det_f: 1.0, ..Self::default() }
    }

    fn note(&mut self, StepReport { newton, min_det, .. }: &StepReport, systems: &[usize]) {
        self.min_det_f = self.min_det_f.min(*min_det);
        self.newton_iterations += newton.iterations;
        self.systems += systems.len();
        self.linear_iterations += systems.iter().sum::<usize>();
        self.relative_residual = relative_residual(newton);
    }

    fn note_start(&mut self, team: &Team, simulation: &Simulation) {
        let share = &simulation.share;
        let rest: Vec<[f64; 3]> = share.places.iter().map(|place| place.rest).collect();
        let tets: Vec<[usize; 4]> = share.elements.iter().map(|&(nodes, ..)| nodes).collect();
        self.min_det_f = team.min(measure::min_det_f(&rest, simulation.part.positions(), &tets));
    }
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
    let parts = [MaterialPart { material, density: 1000.0 }];
    let clock = Instant::now();
    let share = Share::of(team, Portion::of_cube(team, cells, 1.0))?;
    let settings = SimulationSettings::default().with_gravity([0.0, -9.81, 0.0]).with_newton(newton);
    let mut simulation = Simulation::new(team, share, &parts, settings)?;
    team.wait();
    let (set_up, clock) = (clock.elapsed(), Instant::now());
    let report = simulation.advance(|part| part.equilibrate_here())?.newton;
    let systems = simulation.part.machine().take_systems();
    team.wait();
    let solved = clock.elapsed();
    if let Some(folder) = &options.out {
        output::prepare(team, folder, true)?;
        let about =
            About { settings: String::new(), body: 0, frame: 0, clock: None, progress: Progress::new() };
        checkpoint::write(team, &checkpoint::file_in(folder), &simulation, &about)?;
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
    let newton = options.solver.settings(false)?;
    let folder = folder(&options.out, &task);
    let setting = Setting::new(team, &task)?;
    output::prepare(team, &folder, options.force)?;
    let mut course = Course::new(team, &task, &setting, newton)?;
    // In statics, prescribed motions are complete.
    course.simulation.prescribe(|node| setting.place(node, f64::INFINITY))?;
    let clock = Instant::now();
    let report = course.simulation.advance(|part| part.equilibrate_here())?;
    course.progress.note(&report, &course.simulation.part.machine().take_systems());
    course.frame = 1;
    let about = course.about(None)?;
    output::write_frame(team, &folder, 1, &course.simulation)?;
    checkpoint::write(team, &checkpoint::file_in(&folder), &course.simulation, &about)?;
    let mut summary = course.summary(&[clock.elapsed()]);
    (summary.frames_wanted, summary.dt, summary.integrator) = (1, None, None);
    if report.newton.convergence == Convergence::Limit {
        summary.ended = Ended::Failed;
        summary.failures.push("the body is not in equilibrium; increase --newton-iterations".to_owned());
    }
    output::write_summary(team, &folder, &summary)?;
    Ok(summary)
}

/// Runs a scene; returns its summary.
///
/// # Errors
/// An [`Error`] of the options, the body, the first step or a file. If a later step fails, the run
/// ends, and the summary contains the failure.
pub fn run(team: &Team, options: &RunOptions) -> Result<Summary, Error> {
    let task = team.agree(options.task())?;
    let newton = options.body.solver.settings(options.steps.newton == Newton::Single)?;
    let folder = folder(&options.body.out, &task);
    let setting = Setting::new(team, &task)?;
    if !options.resume {
        output::prepare(team, &folder, options.body.force)?;
    }
    let mut course = Course::new(team, &task, &setting, newton)?;
    let mut clock = Clock::new(task.settings.dt);
    let file = checkpoint::file_in(&folder);
    if options.resume {
        clock = course.resume(&file)?;
    } else {
        course.progress.note_start(team, &course.simulation);
        if options.vtu {
            output::write_frame(team, &folder, 0, &course.simulation)?;
        }
    }
    let springs = setting.springs(clock.time(), clock.time());
    course.simulation.set(|part| part.set_springs(&springs))?;
    let wanted = task.settings.frames;
    let (mut times, mut failures) = (Vec::new(), Vec::new());
    while course.frame < wanted {
        let begun = Instant::now();
        let stepped = course.step(clock);
        clock = clock.next();
        if let Err(error) = stepped {
            // A failure of the first step is an error of the run; errors of PETSc may be on one rank alone.
            if course.frame == 0 || !error.is_common() {
                return Err(error);
            }
            failures.push(error.to_string());
            break;
        }
        times.push(begun.elapsed());
        if options.vtu {
            output::write_frame(team, &folder, course.frame, &course.simulation)?;
        }
        let is_due = options.checkpoint_every > 0 && course.frame.is_multiple_of(options.checkpoint_every);
        if is_due || course.frame == wanted {
            let about = course.about(Some(clock))?;
            checkpoint::write(team, &file, &course.simulation, &about)?;
        }
    }
    if options.vtu {
        output::write_frames(team, &folder, course.frame, task.settings.dt)?;
    }
    let mut summary = course.summary(&times);
    if !failures.is_empty() {
        (summary.ended, summary.failures) = (Ended::Failed, failures);
    }
    output::write_summary(team, &folder, &summary)?;
    Ok(summary)
}

fn folder(out: &Option<PathBuf>, task: &Task) -> PathBuf {
    out.clone().unwrap_or_else(|| Path::new("out").join(task.settings.scene.name))
}

/// State of a run between its first and its last step.
struct Course<'a> {
    team: &'a Team,
    task: &'a Task,
    setting: &'a Setting,
    simulation: Simulation,
    progress: Progress,
    frame: usize,
}

impl<'a> Course<'a> {
    fn new(
        team: &'a Team,
        task: &'a Task,
        setting: &'a Setting,
        newton: NewtonSettings,
    ) -> Result<Self, Error> {
        let settings = play::step_settings(&task.settings).with_newton(newton);
        // The elements of groups have the materials with the numbers 1, 2, …; all others have the first one.
        let first = MaterialPart { material: task.settings.material.clone(), density: task.settings.density };
        let materials: Vec<_> =
            std::iter::once(first).chain(task.parts.iter().map(|(_, part)| part.clone())).collect();
        let simulation = Simulation::new(team, setting.share.clone(), &materials, settings)?;
        Ok(Self { team, task, setting, simulation, progress: Progress::new(), frame: 0 })
    }

    /// Advances from the frame at the clock to the next one.
    fn step(&mut self, clock: Clock) -> Result<(), Error> {
        // Equal on all ranks.
        let (first, last) = play::stretches(&self.setting.pulls, clock);
        for stretch in first.into_iter().chain([last]) {
            self.advance(stretch)?;
        }
        self.frame += 1;
        Ok(())
    }

    fn advance(&mut self, stretch: Stretch) -> Result<(), Error> {
        let Self { team: _, task, setting, simulation, progress, .. } = self;
        let springs = setting.springs(stretch.start, stretch.end);
        simulation.set(|part| part.set_springs(&springs))?;
        simulation.prescribe(|node| setting.place(node, stretch.end))?;
        let (steps, report) = match task.settings.tolerance {
            None => {
                let report = simulation.advance(|part| part.step_here(stretch.length))?;
                (StepCounts { taken: 1, ..StepCounts::default() }, report)
            }
            Some(share) => {
                let tolerance = share * setting.height();
                let report =
                    simulation.advance(|part| part.advance_within_here(stretch.length, tolerance))?;
                let AdaptiveReport { taken, refused, unresolved, step, .. } = report;
                (StepCounts { taken, refused, unresolved }, step)
            }
        };
        progress.steps += steps;
        progress.note(&report, &simulation.part.machine().take_systems());
        Ok(())
    }

    /// Settings on which the motion depends, as JSON.
    fn settings(&self) -> Result<String, Error> {
        let Task { settings, parts, moves } = self.task;
        let lasting = Settings { frames: 1, threads: 1, newton: Newton::Single, ..settings.clone() };
        let materials: Vec<_> =
            parts.iter().map(|(group, part)| (group, &part.material, part.density)).collect();
        serde_json::to_string(&(lasting, materials, moves)).map_err(Error::usage)
    }

    fn about(&self, clock: Option<Clock>) -> Result<About, Error> {
        Ok(About {
            settings: self.settings()?,
            body: self.setting.body.checksum,
            frame: self.frame,
            clock,
            progress: self.progress.clone(),
        })
    }

    fn resume(&mut self, file: &Path) -> Result<Clock, Error> {
        let settings = self.settings()?;
        let about: About = checkpoint::read(self.team, file, &mut self.simulation)?;
        if about.body != self.setting.body.checksum {
            return Err(checkpoint::refused(file, "it belongs to another mesh"));
        }
        let clock = about.clock.filter(|_| about.settings == settings).ok_or_else(|| {
            checkpoint::refused(file, format!("its run began with other options: {}", about.settings))
        })?;
        (self.frame, self.progress) = (about.frame, about.progress);
        Ok(clock)
    }

    fn summary(&mut self, times: &[Duration]) -> Summary {
        let team = self.team;
        let energy = self.simulation.part.energies().elastic;
        let (share, state) = (&self.simulation.share, &self.simulation.part);
        let distance = |node: usize| {
            let (x, rest) = (state.positions()[node], share.places[node].rest);
            (0..3).map(|c| (x[c] - rest[c]).powi(2)).sum::<f64>().sqrt()
        };
        let farthest = team.max((0..share.owned).map(distance).fold(0.0, f64::max)) / self.setting.height();
        let pins = team.count(share.owned - share.free);
        let settings = &self.task.settings;
        let info = settings.material.build().ok();
        let mut sorted: Vec<f64> = times.iter().map(|time| 1e3 * time.as_secs_f64()).collect();
        sorted.sort_unstable_by(f64::total_cmp);
        let total: f64 = sorted.iter().sum();
        let Progress { newton_iterations, systems, linear_iterations, relative_residual, min_det_f, steps } =
            self.progress;
        Summary {
            scene: settings.scene.name.to_owned(),
            material: info.as_ref().map_or_else(String::new, |info| info.name.to_string()),
            parameters: info.map(|info| info.parameters).unwrap_or_default(),
            tets: share.totals[1],
            nodes: share.totals[0],
            ranks: team.size,
            copies_max: team.max((share.ids.len() - share.owned) as f64) as usize,
            frames: self.frame,
            frames_wanted: settings.frames,
            ended: Ended::Finished,
            failures: Vec::new(),
            warnings: self.setting.body.warnings.clone(),
            dt: Some(settings.dt),
            integrator: Some(settings.integrator),
            tolerance: settings.tolerance,
            steps,
            newton_iterations_mean: newton_iterations as f64 / self.frame.max(1) as f64,
            linear_iterations_mean: linear_iterations as f64 / systems.max(1) as f64,
            relative_residual,
            min_det_f,
            max_distance_from_rest: (pins >= 3).then_some(farthest),
            energy,
            ms_per_step_median: sorted.get(sorted.len() / 2).copied(),
            steps_per_second: (total > 0.0).then(|| 1e3 * sorted.len() as f64 / total),
        }
    }
}
