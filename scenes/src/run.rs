//! From settings to files: plays a scene.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use piola::batch::TileMaterial;
use piola::step::Simulation;

use crate::error::Error;
use crate::fields;
use crate::gauge;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{
    CAGES_FILE, Folder, PICTURE_FILE, SUMMARY_FILE, Summary, cage_file, frame_file, write_ply, write_pvd,
};
use crate::play::Play;
use crate::render::{self, contact_sheet};
use crate::settings::Settings;
use crate::settle::settle;

/// Tiles of the contact sheet.
const TILES: usize = 12;
/// How many frames are kept in memory to choose the tiles from.
const CANDIDATES: usize = 400;

/// Forces on a body that are together below this share of Young's modulus times the square of its size are rounding:
/// those of ten thousand elements of its size, each with an error of a few roundings, are smaller still.
const NO_FORCE: f64 = 1e-11;

/// Where a run leaves its files, and which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Output {
    /// The folder for surfaces, a picture and the summary.
    pub folder: PathBuf,
    /// Whether the tetrahedra are written with [`crate::fields`], too.
    pub vtu: bool,
}

/// Plays a scene, calling `on_step` after every time step, and leaves its files.
///
/// # Errors
/// With [`Error::exit_code`] 2 where the settings make no sense or the folder cannot be written to, else 1 where a
/// step or a file fails. Then nothing is written.
pub fn run(settings: &Settings, output: &Output, on_step: &mut dyn FnMut()) -> Result<Summary, Error> {
    let geometry = Geometry::load(settings)?;
    let mut play = Play::new(settings, &geometry)?;
    let threads = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build();
    let threads = threads.map_err(|error| Error::Threads { reason: error.to_string() })?;

    let cages_of = if output.vtu { Some(settings.energy.build()?.elements) } else { None };
    let mut recording = Recording::new(&geometry, settings, Folder::prepare(&output.folder)?, cages_of);
    recording.frame(0, play.simulation())?;
    let mesh = &geometry.mesh;
    let pinned = play.simulation().pinned().len();
    let start = play.simulation().positions();
    let inverted_at_start = measure::inverted(&mesh.positions, start, &mesh.tets);
    let starts_at_rest = measure::distance_from_rest(mesh, start, pinned) <= Summary::RECOVERED;
    let no_force =
        NO_FORCE * play.moduli().young() * measure::total_volume(&mesh.positions, &mesh.tets).powf(2.0 / 3.0);
    let mut stationary_start = false;

    let mut times = Vec::with_capacity(settings.frames);
    let mut iterations = 0;
    let mut energy = 0.0;
    for frame in 1..=settings.frames {
        let clock = Instant::now();
        let report = threads.install(|| play.step());
        times.push(clock.elapsed());
        let report = report?;
        if frame == 1 {
            stationary_start = !starts_at_rest && report.newton.first_residual <= no_force;
        }
        iterations += report.newton.iterations;
        energy = report.energies.elastic;
        recording.frame(frame, play.simulation())?;
        on_step();
    }

    let distance = measure::distance_from_rest(mesh, play.simulation().positions(), pinned);
    let reading = match settings.scene.gauge {
        Some(marks) => {
            let material = settings.energy.specimen()?;
            Some(gauge::read(mesh, play.simulation(), marks, material.as_ref()))
        }
        None => None,
    };
    let recovered = distance <= Summary::RECOVERED;
    let mut summary = Summary {
        scene: settings.scene.name.into(),
        material: play.material().into(),
        parameters: play.parameters().clone(),
        tets: mesh.tets.len(),
        nodes: mesh.positions.len(),
        surface_vertices: geometry.surface_vertices(),
        frames: settings.frames,
        dt: settings.dt,
        newton_iterations_mean: iterations as f64 / settings.frames as f64,
        inverted_at_start,
        stationary_start,
        min_det_f: recording.min_det_f,
        max_distance_from_rest: distance,
        energy,
        ms_per_step_median: 1e3 * median(&times).as_secs_f64(),
        steps_per_second: settings.frames as f64 / times.iter().sum::<Duration>().as_secs_f64(),
        newton: settings.newton,
        recovered,
        reading,
        standing: None,
    };
    if !recovered {
        summary.standing = Some(threads.install(|| settle(&mut play, mesh))?);
    }
    recording.finish(settings, &summary)?;
    Ok(summary)
}

/// Keeps what the files at the end are made from, and writes those that can be written on the way.
struct Recording<'a> {
    geometry: &'a Geometry,
    folder: Folder,
    dt: f64,
    last: usize,
    min_det_f: f64,
    /// Node positions of the frame before, m.
    before: Vec<[f64; 3]>,
    /// Sum over all steps of the mean distance that nodes have moved, m.
    path: f64,
    /// What may become tiles, and the path up to there. Only the frames that `stride` divides are kept, and the last.
    candidates: Vec<(render::Frame, f64)>,
    /// The material where tetrahedra are written, too.
    cages_of: Option<Box<dyn TileMaterial<f64>>>,
    stride: usize,
}

impl<'a> Recording<'a> {
    fn new(
        geometry: &'a Geometry,
        settings: &Settings,
        folder: Folder,
        cages_of: Option<Box<dyn TileMaterial<f64>>>,
    ) -> Self {
        Self {
            geometry,
            folder,
            dt: settings.dt,
            last: settings.frames,
            min_det_f: f64::INFINITY,
            before: Vec::new(),
            path: 0.0,
            candidates: Vec::new(),
            cages_of,
            stride: 1,
        }
    }

    fn frame(&mut self, number: usize, simulation: &Simulation) -> Result<(), Error> {
        let positions = simulation.positions();
        let mesh = &self.geometry.mesh;
        self.min_det_f = self.min_det_f.min(measure::min_det_f(&mesh.positions, positions, &mesh.tets));
        self.path += measure::mean_distance(&self.before, positions);
        self.before.clear();
        self.before.extend_from_slice(positions);

        let vertices = self.geometry.surface_at(positions);
        self.folder
            .write(&frame_file(number), |file| write_ply(file, &vertices, &self.geometry.triangles))?;
        if let Some(material) = &self.cages_of {
            let write = |file: &mut _| fields::write(file, simulation, material.as_ref());
            self.folder.write(&cage_file(number), write)?;
        }
        if number.is_multiple_of(self.stride) || number == self.last {
            let frame = render::Frame { number, time: number as f64 * self.dt, vertices };
            self.candidates.push((frame, self.path));
        }
        if self.candidates.len() > CANDIDATES {
            self.stride *= 2;
            self.candidates.retain(|(frame, _)| frame.number.is_multiple_of(self.stride));
        }
        Ok(())
    }

    fn finish(mut self, settings: &Settings, summary: &Summary) -> Result<(), Error> {
        // Half of the spacing follows time and half the motion, of which most may happen in few frames.
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let progress: Vec<_> = self
            .candidates
            .iter()
            .map(|(frame, path)| share(frame.number as f64, self.last as f64) + share(*path, self.path))
            .collect();
        let chosen = evenly_spread(&progress, TILES);
        let tiles: Vec<_> = chosen.into_iter().map(|index| self.candidates[index].0.clone()).collect();
        let picture = contact_sheet(&tiles, &self.geometry.triangles, &settings.body.style);
        self.folder.write(PICTURE_FILE, |file| picture.write_png(file).map_err(Into::into))?;
        if self.cages_of.is_some() {
            let frames = (0..=self.last).map(|frame| (frame as f64 * self.dt, cage_file(frame)));
            self.folder.write(CAGES_FILE, |file| write_pvd(file, frames))?;
        }
        self.folder.write(SUMMARY_FILE, |file| summary.write_json(file))?;
        self.folder.publish()
    }
}

/// Indices of at most `count` of these ascending numbers, as evenly spaced as different ones can be, both ends among
/// them.
fn evenly_spread(progress: &[f64], count: usize) -> Vec<usize> {
    let (Some(first), Some(last)) = (progress.first(), progress.last()) else { return Vec::new() };
    let count = count.min(progress.len());
    let mut chosen = Vec::with_capacity(count);
    let mut next = 0;
    for k in 0..count {
        let wanted = first + (last - first) * k as f64 / (count - 1).max(1) as f64;
        let after = progress.partition_point(|&other| other < wanted);
        let nearest = match after {
            0 => 0,
            after if after == progress.len() => after - 1,
            after if wanted - progress[after - 1] < progress[after] - wanted => after - 1,
            after => after,
        };
        // Enough must be left for those still to come, and of equal numbers at the end the last is wanted.
        let latest = progress.len() - (count - k);
        let index = if k + 1 == count { latest } else { nearest.clamp(next, latest) };
        chosen.push(index);
        next = index + 1;
    }
    chosen
}

/// The middle one of all times, the mean of the two in the middle where their number is even.
fn median(times: &[Duration]) -> Duration {
    let mut times = times.to_vec();
    times.sort_unstable();
    let middle = times.len() / 2;
    match times.len() {
        0 => Duration::ZERO,
        odd if odd % 2 == 1 => times[middle],
        _ => (times[middle - 1] + times[middle]) / 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_frames_are_spread_from_first_to_last() {
        let steady: Vec<_> = (0..=150).map(f64::from).collect();
        assert_eq!(evenly_spread(&steady, 12), [0, 14, 27, 41, 55, 68, 82, 95, 109, 123, 136, 150]);
        assert_eq!(evenly_spread(&steady[..4], 12), [0, 1, 2, 3]);
        assert_eq!(evenly_spread(&[0.0, 8.0, 9.0, 9.5, 10.0], 3), [0, 1, 4]);
        assert_eq!(evenly_spread(&[0.0, 10.0, 10.0, 10.0], 3), [0, 1, 3]);
        assert_eq!(evenly_spread(&[], 3), [0; 0]);
    }

    #[test]
    fn median_of_even_and_odd_counts() {
        let times = |ms: &[u64]| median(&ms.iter().map(|&ms| Duration::from_millis(ms)).collect::<Vec<_>>());
        assert_eq!(times(&[9, 1, 5]), Duration::from_millis(5));
        assert_eq!(times(&[9, 1, 5, 7]), Duration::from_millis(6));
        assert_eq!(times(&[]), Duration::ZERO);
    }
}
