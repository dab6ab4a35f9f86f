//! A run from frame to frame.

use std::io::Write;
use std::time::{Duration, Instant};

use piola::batch::TileMaterial;
use piola_bodies::step::StepReport;
use piola_laboratory::AtRest;
use piola_laboratory::curve::Volume;
use rayon::ThreadPool;

use super::Finished;
use super::progress::{MAX_LENGTH, Progress, Saved};
use crate::error::Error;
use crate::fields;
use crate::geometry::Geometry;
use crate::measure;
use crate::moment::Moment;
use crate::output::{
    Ended, FinalState, Folder, STATE_FILE, StepCounts, Summary, cage_file, frame_file, read_text, seal,
    write_ply,
};
use crate::play::Play;
use crate::settings::Settings;
use crate::statics::{Watch, find_equilibrium};
use crate::tensile_reading::read_specimen;

/// Minimum time between states on the disk: a run that is killed must recompute at most this much.
const PAUSE: Duration = Duration::from_secs(1);
/// Time between states on the disk, as a multiple of the time that it takes to write one.
const SHARE: u32 = 20;
/// Forces on a body that are together below this share of Young's modulus times the square of its size are
/// rounding: those of ten thousand elements of its size, each with an error of a few roundings, are smaller
/// still.
const NO_FORCE: f64 = 1e-11;

/// A scene with everything that is needed to play it.
pub(super) struct Setup<'a> {
    settings: &'a Settings,
    pub(super) geometry: Geometry,
    pub(super) play: Play,
    threads: ThreadPool,
    /// The material if tetrahedra are written, too.
    cages_of: Option<Box<dyn TileMaterial<f64>>>,
}

impl<'a> Setup<'a> {
    pub(super) fn new(settings: &'a Settings, vtu: bool) -> Result<Self, Error> {
        let geometry = Geometry::load(settings)?;
        let play = Play::new(settings, &geometry)?;
        let threads = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build()?;
        let cages_of = if vtu { Some(settings.material.build()?.elements) } else { None };
        Ok(Self { settings, geometry, play, threads, cages_of })
    }
}

/// A run between its first frame and its last.
pub(super) struct Course<'a> {
    setup: Setup<'a>,
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

impl<'a> Course<'a> {
    /// A new run, with its frame 0.
    pub(super) fn begin(setup: Setup<'a>, folder: Folder) -> Result<Self, Error> {
        let mesh = &setup.geometry.mesh;
        let simulation = setup.play.simulation();
        let start = simulation.positions();
        let starts_at_rest =
            measure::distance_from_rest(mesh, start, simulation.pinned().len()) <= Summary::RECOVERED;
        let progress = Progress {
            inverted_at_start: measure::inverted(&mesh.positions, start, &mesh.tets),
            // Until the forces of the first step are known.
            stationary_start: !starts_at_rest,
            min_det_f: f64::INFINITY,
            newton_iterations: 0,
            steps: StepCounts::default(),
            energy: 0.0,
            motion: Vec::new(),
        };
        let mut course = Self::new(setup, folder, progress);
        match course.write_frame(0) {
            Ok(()) => Ok(course),
            Err(error) => Err(course.abandon(error)),
        }
    }

    /// A run that continues from its last state, in this folder.
    pub(super) fn resume(mut setup: Setup<'a>, folder: Folder) -> Result<Self, Error> {
        let refused = |reason| {
            Error::Usage(format!(
                "the run in {} cannot continue: {reason}; give the options that it was begun with, or leave out --resume \
                 to begin anew",
                folder.path().display()
            ))
        };
        let text = read_text(&folder.path().join(STATE_FILE), MAX_LENGTH)?;
        let vtu = setup.cages_of.is_some();
        let saved = Saved::read(text.trim_end_matches('\n'), setup.settings, vtu).map_err(refused)?;
        setup.play = saved.moment.resume(&setup.geometry)?;
        for frame in 0..=setup.play.clock().frame() {
            if !folder.path().join(frame_file(frame)).is_file() {
                return Err(refused(format!("{} is missing", frame_file(frame))));
            }
        }
        Ok(Self::new(setup, folder, saved.progress))
    }

    fn new(setup: Setup<'a>, folder: Folder, progress: Progress) -> Self {
        let positions = setup.play.simulation().positions().to_vec();
        let (times, failures) = (Vec::new(), Vec::new());
        Self { setup, folder, progress, positions, times, due: Instant::now(), failures }
    }

    pub(super) fn play(mut self, watch: &mut Watch<'_>) -> Result<Finished, Error> {
        let mut ended = Ended::Finished;
        let first = self.setup.play.clock().frame() + 1;
        for frame in first..=self.setup.settings.frames {
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
        if self.setup.play.clock().frame() + 1 == self.progress.motion.len() {
            self.save_state().unwrap_or_else(|error| self.failures.push(error.to_string()));
        }
        Ok(self.finish(ended, watch))
    }

    fn step(&mut self, frame: usize) -> Result<(), Error> {
        let clock = Instant::now();
        let report = self.setup.threads.install(|| self.setup.play.step())?;
        self.times.push(clock.elapsed());
        self.write_frame(frame)?;
        self.note(frame, &report);
        let now = Instant::now();
        if self.due <= now {
            self.save_state()?;
            self.due = Instant::now() + PAUSE.max(SHARE * now.elapsed());
        }
        Ok(())
    }

    fn note(&mut self, frame: usize, report: &StepReport) {
        if frame == 1 {
            let mesh = &self.setup.geometry.mesh;
            let size = measure::total_volume(&mesh.positions, &mesh.tets).cbrt();
            let no_force = NO_FORCE * self.setup.play.moduli().young() * size * size;
            self.progress.stationary_start &= report.newton.first_residual <= no_force;
        }
        self.progress.steps += self.setup.play.steps();
        self.progress.newton_iterations += report.newton.iterations;
        self.progress.energy = report.energies.elastic;
    }

    fn write_frame(&mut self, frame: usize) -> Result<(), Error> {
        let simulation = self.setup.play.simulation();
        let (nodes, mesh) = (simulation.positions(), &self.setup.geometry.mesh);
        let surface = self.setup.geometry.surface_at(nodes);
        let triangles = &self.setup.geometry.triangles;
        self.folder.write(&frame_file(frame), |file| write_ply(file, &surface, triangles))?;
        if let Some(material) = &self.setup.cages_of {
            self.folder
                .write(&cage_file(frame), |file| fields::write(file, simulation, material.as_ref()))?;
        }
        let Progress { motion, min_det_f, .. } = &mut self.progress;
        motion.push(motion.last().unwrap_or(&0.0) + measure::mean_distance(&self.positions, nodes));
        *min_det_f = min_det_f.min(measure::min_det_f(&mesh.positions, nodes, &mesh.tets));
        self.positions.copy_from_slice(nodes);
        Ok(())
    }

    fn save_state(&mut self) -> Result<(), Error> {
        let moment = Moment::of(self.setup.settings, &self.setup.geometry, &self.setup.play);
        let saved = Saved::new(self.setup.cages_of.is_some(), moment, self.progress.clone());
        self.folder.replace(STATE_FILE, |file| file.write_all(&seal(&saved)?))
    }

    /// Removes all files of a run that has made no step.
    fn abandon(self, error: Error) -> Error {
        self.folder.abandon();
        error
    }

    fn finish(mut self, mut ended: Ended, watch: &mut Watch<'_>) -> Finished {
        let pinned = self.setup.play.simulation().pinned().len();
        let distance = measure::distance_from_rest(&self.setup.geometry.mesh, &self.positions, pinned);
        let recovered = distance <= Summary::RECOVERED;
        let reading =
            self.setup.settings.scene.gauge.filter(|_| ended == Ended::Finished).and_then(|marks| {
                let material = self.setup.settings.material.interpreted();
                let material = material.map_err(|error| self.failures.push(error.to_string())).ok()?;
                Some(read_specimen(&self.setup.geometry.mesh, self.setup.play.simulation(), marks, &material))
            });
        let (scene, end) = (self.setup.settings.scene, self.setup.play.clock().time());
        let released = scene.pulls.iter().map(|pull| pull.released).filter(|released| released.is_finite());
        let held_until = released.fold(end, f64::max);
        let is_held = ended == Ended::Finished && !recovered && held_until > end;
        let held = is_held.then(|| {
            format!("the last frame is at {end:.2} s, and the body is pulled until {held_until:.2} s: more frames show if it recovers")
        });
        let final_state = match ended {
            Ended::Finished if !recovered && !is_held => self.examine(watch).unwrap_or_else(|error| {
                match error {
                    Error::Interrupted => ended = Ended::Interrupted,
                    Error::Equilibrium(_) => self.failures.push(error.to_string()),
                    error => {
                        self.failures.push(format!("the equilibrium at the end cannot be examined: {error}"));
                    }
                }
                None
            }),
            _ => None,
        };
        let frames = self.progress.motion.len() - 1;
        let total: Duration = self.times.iter().sum();
        let Self {
            setup: Setup { settings, geometry, play, cages_of, .. },
            folder,
            progress,
            times,
            failures,
            ..
        } = self;
        let at_rest = AtRest { moduli: play.moduli(), volume: Volume::Free };
        let warnings = play.warnings(&geometry).into_iter();
        let missing = reading.and_then(|reading| reading.missing()).map(str::to_owned);
        let summary = Summary {
            scene: settings.scene.name.into(),
            material: play.material().to_string(),
            parameters: play.parameters().clone(),
            shear_modulus: play.moduli().mu,
            bulk_modulus: play.moduli().bulk(),
            poisson: Some(play.moduli().poisson()).filter(|poisson| poisson.is_finite()),
            tets: geometry.mesh.tets.len(),
            nodes: geometry.mesh.positions.len(),
            surface_vertices: geometry.surface_vertices(),
            frames,
            frames_wanted: settings.frames,
            ended,
            failures,
            warnings: warnings.chain(missing).chain(held).chain(at_rest.warning()).collect(),
            dt: settings.dt,
            newton_iterations_mean: progress.newton_iterations as f64 / frames as f64,
            inverted_at_start: progress.inverted_at_start,
            stationary_start: progress.stationary_start,
            min_det_f: progress.min_det_f,
            max_distance_from_rest: distance,
            energy: progress.energy,
            ms_per_step_median: median(&times).map(|time| 1e3 * time.as_secs_f64()),
            steps_per_second: (!times.is_empty()).then(|| times.len() as f64 / total.as_secs_f64()),
            integrator: settings.integrator,
            tolerance: settings.tolerance,
            steps: progress.steps,
            newton: settings.newton,
            recovered,
            reading,
            final_state,
        };
        Finished { summary, geometry, motion: progress.motion, folder, vtu: cages_of.is_some() }
    }

    /// Finds the equilibrium to which the body is drawn.
    fn examine(&mut self, watch: &mut Watch<'_>) -> Result<Option<FinalState>, Error> {
        let Setup { play, geometry, threads, .. } = &mut self.setup;
        threads.install(|| find_equilibrium(play, &geometry.mesh, watch)).map(Some)
    }
}

/// The median of times; the mean of the two in the middle if their number is even.
fn median(times: &[Duration]) -> Option<Duration> {
    let mut times = times.to_vec();
    times.sort_unstable();
    let middle = times.len() / 2;
    match times.len() {
        0 => None,
        odd if odd % 2 == 1 => Some(times[middle]),
        _ => Some((times[middle - 1] + times[middle]) / 2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_of_even_and_odd_counts() {
        let times = |ms: &[u64]| median(&ms.iter().map(|&ms| Duration::from_millis(ms)).collect::<Vec<_>>());
        assert_eq!(times(&[9, 1, 5]), Some(Duration::from_millis(5)));
        assert_eq!(times(&[9, 1, 5, 7]), Some(Duration::from_millis(6)));
        assert_eq!(times(&[]), None);
    }
}
