//! A run from frame to frame.

use std::time::{Duration, Instant};

use piola_laboratory::Specimen;
use piola_laboratory::curve::{Mode, Volume, respond};
use rayon::ThreadPool;

use super::progress::{Progress, restore, save};
use super::{Finished, Output};
use crate::error::Error;
use crate::fields;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{Ended, Folder, Summary, TensileReading, cage_file, frame_file, write_ply};
use crate::play::Play;
use crate::scene::{Amplitude, Start};
use crate::settings::Settings;
use crate::statics::{Watch, find_equilibrium};

/// Minimum time between states on the disk: a run that is killed must recompute at most this much.
const PAUSE: Duration = Duration::from_secs(1);
/// Time between states on the disk, as a multiple of the time that it takes to write one.
const SHARE: u32 = 20;

/// A run between its first frame and its last.
#[derive(Debug)]
pub struct Course {
    /// The scene, at the last frame.
    pub play: Play,
    threads: ThreadPool,
    /// True if tetrahedra are written, too.
    vtu: bool,
    folder: Folder,
    progress: Progress,
    /// Positions of the nodes in the last frame that was written, m.
    positions: Vec<[f64; 3]>,
    /// Times of the steps since the run was started or resumed.
    times: Vec<Duration>,
    /// Time after which the next state is written; the first is due at once.
    due: Instant,
    failures: Vec<String>,
}

impl Course {
    /// A new run, with its frame 0, or the run in the folder at its last state.
    ///
    /// # Errors
    /// An error of the settings, the body or the folder: nothing is written then.
    pub fn open(settings: &Settings, output: &Output) -> Result<Self, Error> {
        let mut play = Play::new(settings.clone(), Geometry::load(settings)?)?;
        let threads = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build()?;
        let (folder, progress) = if output.resume {
            let folder = Folder::reopen(&output.folder)?;
            let progress = restore(&folder, output.vtu, &mut play)?;
            (folder, progress)
        } else {
            play.check_start()?;
            (Folder::create(&output.folder)?, Progress::at_start(&play))
        };
        let positions = play.simulation.positions().to_vec();
        let (times, failures, due, vtu) = (Vec::new(), Vec::new(), Instant::now(), output.vtu);
        let mut course = Self { play, threads, vtu, folder, progress, positions, times, due, failures };
        if !output.resume
            && let Err(error) = course.write_frame(0)
        {
            return Err(course.abandon(error));
        }
        Ok(course)
    }

    /// Plays the scene to its end. If it ends early after the first step, the frames before are kept with a
    /// summary of what happened.
    ///
    /// # Errors
    /// An error of the first step or its files, or [`Error::Interrupted`] if `watch` stops the run before it:
    /// nothing is written then.
    pub fn play(mut self, watch: &mut Watch<'_>) -> Result<Finished, Error> {
        let mut ended = Ended::Finished;
        for frame in self.play.clock.frame + 1..=self.play.settings.frames {
            let made = if watch(frame - 1) { Err(Error::Interrupted) } else { self.step(frame) };
            match made {
                Ok(()) => {}
                Err(error) if frame == 1 => return Err(self.abandon(error)),
                Err(Error::Interrupted) => {
                    ended = Ended::Interrupted;
                    break;
                }
                Err(error) => {
                    self.failures.push(error.to_string());
                    ended = Ended::Failed;
                    break;
                }
            }
        }
        // Where a file could not be written, the state of an earlier frame stays.
        if self.play.clock.frame + 1 == self.progress.motion.len() {
            self.save_state().unwrap_or_else(|error| self.failures.push(error.to_string()));
        }
        Ok(self.finish(ended, watch))
    }

    fn step(&mut self, frame: usize) -> Result<(), Error> {
        let clock = Instant::now();
        let report = self.threads.install(|| self.play.step())?;
        self.times.push(clock.elapsed());
        self.write_frame(frame)?;
        self.progress.steps += self.play.steps;
        self.progress.newton_iterations += report.newton.iterations;
        self.progress.energy = report.energies.elastic;
        let now = Instant::now();
        if self.due <= now {
            self.save_state()?;
            self.due = Instant::now() + PAUSE.max(SHARE * now.elapsed());
        }
        Ok(())
    }

    fn write_frame(&mut self, frame: usize) -> Result<(), Error> {
        let Play { simulation, geometry, .. } = &self.play;
        let (nodes, mesh) = (simulation.positions(), &geometry.mesh);
        let surface = geometry.surface_at(nodes);
        self.folder
            .write(&frame_file(frame), false, |file| write_ply(file, &surface, &geometry.triangles))?;
        if self.vtu {
            self.folder.write(&cage_file(frame), false, |file| fields::write(file, simulation))?;
        }
        let Progress { motion, min_det_f, .. } = &mut self.progress;
        motion.push(motion.last().unwrap_or(&0.0) + measure::mean_distance(&self.positions, nodes));
        *min_det_f = min_det_f.min(measure::min_det_f(&mesh.positions, nodes, &mesh.tets));
        self.positions.copy_from_slice(nodes);
        Ok(())
    }

    fn save_state(&self) -> Result<(), Error> {
        save(&self.folder, self.vtu, &self.play, &self.progress)
    }

    /// Removes all files of a run that has made no step.
    fn abandon(self, error: Error) -> Error {
        self.folder.abandon();
        error
    }

    fn finish(mut self, mut ended: Ended, watch: &mut Watch<'_>) -> Finished {
        let mesh = &self.play.geometry.mesh;
        let pinned = self.play.simulation.pinned().len();
        let distance = measure::distance_from_rest(mesh, &self.positions, pinned);
        let is_at_rest = distance <= Summary::RECOVERED;
        let scene = self.play.settings.scene;
        let reading = scene.gauge.filter(|_| ended == Ended::Finished).and_then(|marks| {
            let material = self.play.settings.material.interpreted();
            let material = material.map_err(|error| self.failures.push(error.to_string())).ok()?;
            Some(read_specimen(&self.play, marks, &material))
        });
        let end = self.play.clock.time();
        let released = scene.pulls.iter().map(|pull| pull.released).filter(|released| released.is_finite());
        let held_until = released.fold(0.0, f64::max);
        let is_held = ended == Ended::Finished && !is_at_rest && held_until > end;
        let held = is_held.then(|| {
            format!("the last frame is at {end:.2} s, and the body is pulled until {held_until:.2} s: more frames show if it recovers")
        });
        let final_state = match ended {
            Ended::Finished if !is_at_rest && !is_held => {
                let found = self.threads.install(|| find_equilibrium(&mut self.play, watch));
                let failed = |error| match error {
                    Error::Interrupted => ended = Ended::Interrupted,
                    Error::Equilibrium(_) => self.failures.push(error.to_string()),
                    error => {
                        self.failures.push(format!("the equilibrium at the end cannot be examined: {error}"));
                    }
                };
                found.map_err(failed).ok()
            }
            _ => None,
        };
        let frames = self.progress.motion.len() - 1;
        let [ms_per_step_median, steps_per_second] = speed(&self.times);
        let Self { play, vtu, folder, progress, failures, .. } = self;
        let Play { settings, geometry, material, parameters, moduli, overview: mut body, .. } = play;
        let is_moved = match settings.start {
            Start::Rest | Start::Scrambled { amplitude: Amplitude::Edges(0.0), .. } => held_until > 0.0,
            _ => true,
        };
        let asks = is_moved && body.held < body.nodes;
        let missing = reading.and_then(|reading| reading.missing()).map(str::to_owned);
        body.warnings.extend(missing.into_iter().chain(held));
        let summary = Summary {
            scene: scene.name.into(),
            material: material.to_string(),
            parameters,
            shear_modulus: moduli.mu,
            bulk_modulus: moduli.bulk(),
            poisson: Some(moduli.poisson()).filter(|poisson| poisson.is_finite()),
            body,
            surface_vertices: geometry.embedding.len(),
            frames,
            frames_wanted: settings.frames,
            ended,
            failures,
            dt: settings.dt,
            newton_iterations_mean: progress.newton_iterations as f64 / frames as f64,
            inverted_at_start: progress.inverted_at_start,
            min_det_f: progress.min_det_f,
            max_distance_from_rest: distance,
            energy: progress.energy,
            ms_per_step_median,
            steps_per_second,
            integrator: settings.integrator,
            tolerance: settings.tolerance,
            steps: progress.steps,
            newton: settings.newton,
            recovered: asks.then_some(is_at_rest),
            reading,
            final_state,
        };
        Finished { summary, geometry, motion: progress.motion, folder, vtu }
    }
}

/// Measures an upright specimen between two marks, in shares of its height.
fn read_specimen(play: &Play, marks: [f64; 2], material: &dyn Specimen<f64>) -> TensileReading {
    let (mesh, positions) = (&play.geometry.mesh, play.simulation.positions());
    let low = mesh.bounds().min[1];
    let marks = marks.map(|share| low + share * play.height);
    let stretch = measure::upright_stretch(&mesh.positions, positions, marks);
    let springs = play.simulation.springs().iter();
    let upwards = springs.map(|pull| pull.stiffness * (pull.target[1] - pull.anchor.position(positions)[1]));
    let cross_section = play.overview.volume / play.height;
    let bar = stretch.filter(|_| play.settings.parts.is_empty());
    let bar = bar.and_then(|stretch| respond(material, Mode::Uniaxial, Volume::Free, stretch).ok());
    TensileReading {
        stretch,
        nominal_stress: upwards.sum::<f64>() / cross_section,
        uniaxial_stress: bar.map(|bar| bar.stress),
    }
}

/// Median time of steps, ms, the mean of the two in the middle if their number is even, and the number of
/// steps per second; `None` without a step.
///
/// ```
/// use piola_scenes::run::speed;
/// use std::time::Duration;
///
/// for times in [&[9, 1, 5][..], &[9, 1, 4, 6]] {
///     let times: Vec<_> = times.iter().copied().map(Duration::from_millis).collect();
///     assert_eq!(speed(&times), [Some(5.0), Some(200.0)]);
/// }
/// assert_eq!(speed(&[]), [None; 2]);
/// ```
#[must_use]
pub fn speed(times: &[Duration]) -> [Option<f64>; 2] {
    let mut times = times.to_vec();
    times.sort_unstable();
    let Some(last) = times.len().checked_sub(1) else { return [None; 2] };
    let median = (times[last / 2] + times[times.len() / 2]) / 2;
    let total: Duration = times.iter().sum();
    [Some(1e3 * median.as_secs_f64()), Some(times.len() as f64 / total.as_secs_f64())]
}
