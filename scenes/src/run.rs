//! From settings to files: plays a scene.

use std::path::Path;
use std::time::{Duration, Instant};

use piola::mesh::TetMesh;
use piola::step::{self, NewtonSettings, Simulation};
use piola::system::{Body, Part, Pins};

use crate::error::Error;
use crate::geometry::Geometry;
use crate::measure;
use crate::output::{Folder, Newton, PICTURE_FILE, SUMMARY_FILE, Summary, frame_file, write_ply};
use crate::region;
use crate::render::{self, contact_sheet};
use crate::scene::{Pull, Start};
use crate::settings::Settings;

/// Tiles of the contact sheet.
const TILES: usize = 12;
/// How many frames are kept in memory to choose the tiles from.
const CANDIDATES: usize = 400;
/// The springs of a pull are together this much stiffer than a cube of the body's material and height.
const GRIP: f64 = 10.0;

/// Plays a scene, calling `on_step` after every time step, and leaves surfaces, a picture and the summary in `folder`.
///
/// # Errors
/// With [`Error::exit_code`] 2 where the settings make no sense or the folder cannot be written to, else 1 where a
/// step or a file fails. Then nothing is written.
pub fn run(settings: &Settings, folder: &Path, on_step: &mut dyn FnMut()) -> Result<Summary, Error> {
    settings.check()?;
    let geometry = Geometry::load(settings)?;
    let mesh = &geometry.mesh;
    let substance = settings.energy.build()?;
    let pins = pins(settings, mesh)?;
    let pulls = Pulls::of(settings.scene.pulls, mesh, substance.moduli.young());
    let setup = |reason: &dyn std::fmt::Display| Error::Setup { reason: reason.to_string() };

    let part = Part { group: None, material: substance.elements, density: settings.density };
    let body = Body::from_parts(mesh, vec![part]).map_err(|error| setup(&error))?;
    let mut simulation =
        Simulation::new(body, &pins, step_settings(settings)).map_err(|error| setup(&error))?;
    let start = start(settings.scene.start, &geometry, &pins);
    simulation.set_positions(&start).map_err(|error| setup(&error))?;
    let threads = rayon::ThreadPoolBuilder::new().num_threads(settings.threads).build();
    let threads = threads.map_err(|error| Error::Threads { reason: error.to_string() })?;

    let mut recording = Recording::new(&geometry, settings, Folder::prepare(folder)?);
    recording.frame(0, simulation.positions())?;
    let mut times = Vec::with_capacity(settings.frames);
    let mut iterations = 0;
    let mut energy = 0.0;
    for frame in 1..=settings.frames {
        let failed = |error: &dyn std::fmt::Display| Error::Step { frame, reason: error.to_string() };
        simulation.set_pulls(&pulls.at(frame as f64 * settings.dt)).map_err(|error| failed(&error))?;
        let clock = Instant::now();
        let report = threads.install(|| simulation.step(settings.dt));
        times.push(clock.elapsed());
        let report = report.map_err(|error| failed(&error))?;
        iterations += report.newton.iterations;
        energy = report.energies.elastic;
        recording.frame(frame, simulation.positions())?;
        on_step();
    }

    let distance = distance_from_rest(mesh, simulation.positions(), pins.nodes().len());
    let summary = Summary {
        scene: settings.scene.name.into(),
        material: substance.name.into(),
        tets: mesh.tets.len(),
        nodes: mesh.positions.len(),
        surface_vertices: geometry.surface_vertices(),
        frames: settings.frames,
        dt: settings.dt,
        newton_iterations_mean: iterations as f64 / settings.frames as f64,
        min_det_f: recording.min_det_f,
        max_distance_from_rest: distance,
        energy,
        ms_per_step_median: 1e3 * median(&times).as_secs_f64(),
        steps_per_second: settings.frames as f64 / times.iter().sum::<Duration>().as_secs_f64(),
        newton: settings.newton,
        recovered: distance <= Summary::RECOVERED,
    };
    recording.finish(settings, &summary)?;
    Ok(summary)
}

fn step_settings(settings: &Settings) -> step::Settings {
    let newton = match settings.newton {
        Newton::Single => NewtonSettings::single(),
        Newton::Full => NewtonSettings::default(),
    };
    let gravity = [0.0, -settings.gravity, 0.0];
    step::Settings { gravity, damping: settings.scene.damping, newton, ..step::Settings::default() }
}

/// The nodes that the settings pin, or else the scene.
fn pins(settings: &Settings, mesh: &TetMesh) -> Result<Pins, Error> {
    if settings.pins.is_empty() {
        let region = region::within(mesh.bounds(), settings.scene.pinned);
        let pin = format!("of the scene {}", settings.scene.name);
        return Pins::in_box(mesh, region).map_err(|error| Error::Pin { pin, reason: error.to_string() });
    }
    settings.pins.iter().try_fold(Pins::none(), |all, pin| {
        // What could be a box may also be the name of a group; then the user who named it means the group.
        let pins = match (mesh.group(pin), region::parse(pin)) {
            (None, Ok(region)) => Pins::in_box(mesh, region),
            (Some(_), _) => Pins::of_group(mesh, pin),
            (None, Err(_)) => {
                let groups = mesh.groups.iter().map(|group| group.name.clone()).collect();
                return Err(Error::UnknownPin { pin: pin.clone(), groups });
            }
        };
        let pins = pins.map_err(|error| Error::Pin { pin: format!("`{pin}`"), reason: error.to_string() })?;
        Ok(all.and(&pins))
    })
}

/// Where the nodes are in frame 0.
fn start(start: Start, geometry: &Geometry, pins: &Pins) -> Vec<[f64; 3]> {
    let rest = &geometry.mesh.positions;
    match start {
        Start::Rest => rest.clone(),
        Start::Flattened => {
            // The cage of tetrahedra reaches below the surface, and the ground lies under the surface.
            let heights = geometry.surface_at(rest).into_iter().map(|vertex| f64::from(vertex[1]));
            let ground = heights.fold(f64::INFINITY, f64::min);
            let flat = |(node, &[x, y, z]): (usize, &[f64; 3])| {
                if pins.nodes().binary_search(&node).is_ok() { [x, y, z] } else { [x, ground, z] }
            };
            rest.iter().enumerate().map(flat).collect()
        }
    }
}

/// The pulls of a scene on the nodes of a body.
struct Pulls<'a> {
    mesh: &'a TetMesh,
    height: f64,
    /// Each with its nodes and their springs' stiffness, N/m.
    pulls: Vec<(Pull, Vec<usize>, f64)>,
}

impl<'a> Pulls<'a> {
    /// `young`, Pa, is the small-strain Young's modulus of the body.
    fn of(pulls: &[Pull], mesh: &'a TetMesh, young: f64) -> Self {
        let bounds = mesh.bounds();
        let height = bounds.size()[1];
        let on_nodes = |&pull: &Pull| {
            let region = region::within(bounds, pull.region);
            let nodes: Vec<_> =
                (0..mesh.positions.len()).filter(|&node| region.contains(mesh.positions[node])).collect();
            let stiffness = GRIP * young * height / nodes.len().max(1) as f64;
            (pull, nodes, stiffness)
        };
        Self { mesh, height, pulls: pulls.iter().map(on_nodes).collect() }
    }

    /// The springs at a time.
    fn at(&self, time: f64) -> Vec<step::Pull> {
        let mut springs = Vec::new();
        for (pull, nodes, stiffness) in &self.pulls {
            let Some(share) = pull.share_at(time) else { continue };
            springs.extend(nodes.iter().map(|&node| {
                let rest = self.mesh.positions[node];
                let target = std::array::from_fn(|i| rest[i] + share * pull.by[i] * self.height);
                step::Pull::on_node(node, target, *stiffness)
            }));
        }
        springs
    }
}

/// The largest distance of a node from rest in body heights, after the best rigid motion where too few nodes are
/// pinned to rule one out.
fn distance_from_rest(mesh: &TetMesh, positions: &[[f64; 3]], pinned: usize) -> f64 {
    let distance = if pinned < 3 {
        measure::max_distance(&mesh.positions, &measure::aligned(&mesh.positions, positions))
    } else {
        measure::max_distance(&mesh.positions, positions)
    };
    distance / mesh.bounds().size()[1]
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
    stride: usize,
}

impl<'a> Recording<'a> {
    fn new(geometry: &'a Geometry, settings: &Settings, folder: Folder) -> Self {
        Self {
            geometry,
            folder,
            dt: settings.dt,
            last: settings.frames,
            min_det_f: f64::INFINITY,
            before: Vec::new(),
            path: 0.0,
            candidates: Vec::new(),
            stride: 1,
        }
    }

    fn frame(&mut self, number: usize, positions: &[[f64; 3]]) -> Result<(), Error> {
        let mesh = &self.geometry.mesh;
        self.min_det_f = self.min_det_f.min(measure::min_det_f(&mesh.positions, positions, &mesh.tets));
        self.path += measure::mean_distance(&self.before, positions);
        self.before.clear();
        self.before.extend_from_slice(positions);

        let vertices = self.geometry.surface_at(positions);
        self.folder
            .write(&frame_file(number), |file| write_ply(file, &vertices, &self.geometry.triangles))?;
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
        let picture = contact_sheet(&tiles, &self.geometry.triangles, &settings.scene.style);
        self.folder.write(PICTURE_FILE, |file| picture.write_png(file).map_err(Into::into))?;
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
