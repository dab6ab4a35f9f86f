//! A scene played to its end, with files.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use piola::batch::TileMaterial;

use crate::error::Error;
use crate::fields;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{CAGES_FILE, Folder, SUMMARY_FILE, Summary, cage_file, frame_file, write_ply, write_pvd};
use crate::play::Play;
use crate::settings::Settings;
use crate::statics::find_equilibrium;
use crate::tensile_reading::read_specimen;

/// Forces on a body that are together below this share of Young's modulus times the square of its size are
/// rounding: those of ten thousand elements of its size, each with an error of a few roundings, are smaller
/// still.
const NO_FORCE: f64 = 1e-11;

/// Files that a run leaves.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Output {
    /// The folder for surfaces and the summary.
    pub folder: PathBuf,
    /// Whether the tetrahedra are written with [`crate::fields`], too.
    pub vtu: bool,
}

impl Output {
    /// Surfaces and the summary, in a folder.
    #[must_use]
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into(), vtu: false }
    }

    /// Writes the tetrahedra as well, or not.
    #[must_use]
    pub fn with_vtu(mut self, vtu: bool) -> Self {
        self.vtu = vtu;
        self
    }
}

/// The body in one frame of a run.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    /// Number of the frame; 0 is the start.
    pub frame: usize,
    /// Positions of the nodes, m.
    pub nodes: &'a [[f64; 3]],
    /// Positions of the surface's vertices, m.
    pub surface: &'a [[f32; 3]],
}

/// A run whose files are complete, but not yet in their place.
#[derive(Debug)]
pub struct Finished {
    /// Results of the run.
    pub summary: Summary,
    /// The files: add others, then [publish](Folder::publish) them all.
    pub folder: Folder,
    /// The body at rest, and its surface.
    pub geometry: Geometry,
}

/// Plays a scene to its end, calling `on_frame` at the start and after every time step.
///
/// # Errors
/// An error of the settings, the body, the folder, a step or a file. Then nothing is written.
pub fn run(
    settings: &Settings,
    output: &Output,
    on_frame: &mut dyn FnMut(Snapshot<'_>),
) -> Result<Finished, Error> {
    let geometry = Geometry::load(settings)?;
    let mut play = Play::new(settings, &geometry)?;
    let threads = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build()?;

    let cages_of = if output.vtu { Some(settings.material.build()?.elements) } else { None };
    let folder = Folder::prepare(&output.folder)?;
    let mut files = Files { geometry: &geometry, folder, min_det_f: f64::INFINITY, cages_of, on_frame };
    files.frame(0, &play)?;
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
        files.frame(frame, &play)?;
    }

    let distance = measure::distance_from_rest(mesh, play.simulation().positions(), pinned);
    let reading = match settings.scene.gauge {
        Some(marks) => {
            let material = settings.material.specimen()?;
            Some(read_specimen(mesh, play.simulation(), marks, material.as_ref()))
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
        min_det_f: files.min_det_f,
        max_distance_from_rest: distance,
        energy,
        ms_per_step_median: 1e3 * median(&times).as_secs_f64(),
        steps_per_second: settings.frames as f64 / times.iter().sum::<Duration>().as_secs_f64(),
        newton: settings.newton,
        recovered,
        reading,
        final_state: None,
    };
    if !recovered {
        summary.final_state = Some(threads.install(|| find_equilibrium(&mut play, mesh))?);
    }
    let mut folder = files.folder;
    if output.vtu {
        let frames = (0..=settings.frames).map(|frame| (frame as f64 * settings.dt, cage_file(frame)));
        folder.write(CAGES_FILE, |file| write_pvd(file, frames))?;
    }
    folder.write(SUMMARY_FILE, |file| summary.write_json(file))?;
    Ok(Finished { summary, folder, geometry })
}

/// Writes the files of each frame, and measures it.
struct Files<'a> {
    geometry: &'a Geometry,
    folder: Folder,
    min_det_f: f64,
    /// The material where tetrahedra are written, too.
    cages_of: Option<Box<dyn TileMaterial<f64>>>,
    on_frame: &'a mut dyn FnMut(Snapshot<'_>),
}

impl Files<'_> {
    fn frame(&mut self, frame: usize, play: &Play) -> Result<(), Error> {
        let nodes = play.simulation().positions();
        let mesh = &self.geometry.mesh;
        self.min_det_f = self.min_det_f.min(measure::min_det_f(&mesh.positions, nodes, &mesh.tets));
        let surface = self.geometry.surface_at(nodes);
        self.folder.write(&frame_file(frame), |file| write_ply(file, &surface, &self.geometry.triangles))?;
        if let Some(material) = &self.cages_of {
            let write = |file: &mut _| fields::write(file, play.simulation(), material.as_ref());
            self.folder.write(&cage_file(frame), write)?;
        }
        (self.on_frame)(Snapshot { frame, nodes, surface: &surface });
        Ok(())
    }
}

/// The median of times; the mean of the two in the middle if their number is even.
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
    fn median_of_even_and_odd_counts() {
        let times = |ms: &[u64]| median(&ms.iter().map(|&ms| Duration::from_millis(ms)).collect::<Vec<_>>());
        assert_eq!(times(&[9, 1, 5]), Duration::from_millis(5));
        assert_eq!(times(&[9, 1, 5, 7]), Duration::from_millis(6));
        assert_eq!(times(&[]), Duration::ZERO);
    }
}
