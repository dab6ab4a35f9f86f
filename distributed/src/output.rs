//! Files of a run: a summary, and frames for ParaView, of which each rank writes its own part.

use std::fmt;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use piola_bodies::step::Integrator;
use piola_scenes::error::Error as SceneError;
use piola_scenes::material::Parameters;
use piola_scenes::output::{
    CAGES_FILE, Ended, Field, SUMMARY_FILE, StepCounts, write_pvd, write_vtu, write_whole,
};
use serde::Serialize;

use crate::error::Error;
use crate::simulation::Simulation;
use crate::team::Team;

/// Results of a run. The keys in JSON are the names of the fields. They have the same meaning as in
/// [`piola_scenes::output::Summary`] unless documented here.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    pub(crate) scene: String,
    pub(crate) material: String,
    pub(crate) parameters: Parameters,
    pub(crate) tets: usize,
    pub(crate) nodes: usize,
    /// Number of ranks.
    pub(crate) ranks: usize,
    /// Largest number of copies, on one rank, of nodes of other ranks.
    pub(crate) copies_max: usize,
    pub(crate) frames: usize,
    pub(crate) frames_wanted: usize,
    pub(crate) ended: Ended,
    /// Reasons why the run ended before its last step; none if it is finished.
    pub failures: Vec<String>,
    pub(crate) warnings: Vec<String>,
    /// Time step, s; `None` in statics.
    pub(crate) dt: Option<f64>,
    /// Time integrator; `None` in statics.
    pub(crate) integrator: Option<Integrator>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) tolerance: Option<f64>,
    pub(crate) steps: StepCounts,
    pub(crate) newton_iterations_mean: f64,
    /// Mean number of iterations of the linear solver per linear system.
    pub(crate) linear_iterations_mean: f64,
    /// Norm of the gradient relative to its norm before the first iteration, in the last step.
    pub(crate) relative_residual: f64,
    pub(crate) min_det_f: f64,
    /// Largest distance of a node from its rest position in the final frame, in body heights; `None` for
    /// bodies that can move as a whole.
    pub(crate) max_distance_from_rest: Option<f64>,
    pub(crate) energy: f64,
    pub(crate) ms_per_step_median: Option<f64>,
    pub(crate) steps_per_second: Option<f64>,
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { scene, tets, nodes, ranks, frames, frames_wanted, min_det_f, energy, .. } = self;
        write!(
            f,
            "{scene}: {tets} tetrahedra, {nodes} nodes on {ranks} ranks; {frames} of {frames_wanted} steps, {:.2} Newton \
             iterations per step, {:.1} CG iterations per linear system (means); relative residual {:.1e}, smallest det F \
             {min_det_f:.3}, elastic energy {energy:.6e} J",
            self.newton_iterations_mean, self.linear_iterations_mean, self.relative_residual,
        )
    }
}

/// Creates the folder of a run. A folder with results of another run is refused unless `may_replace`.
pub(crate) fn prepare(team: &Team, folder: &Path, may_replace: bool) -> Result<(), Error> {
    team.on_first(|| {
        fs::create_dir_all(folder).map_err(|source| SceneError::Write { path: folder.into(), source })?;
        let checkpoint = crate::checkpoint::file_in(folder);
        let results = [folder.join(SUMMARY_FILE), folder.join(CAGES_FILE), checkpoint];
        match results.iter().find(|path| path.exists()) {
            Some(path) if !may_replace => Err(Error::usage(format!(
                "{} already contains results ({}): choose another folder, or replace them with --force",
                folder.display(),
                path.file_name().unwrap_or_default().display()
            ))),
            _ => Ok(()),
        }
    })
}

/// Writes the summary.
pub(crate) fn write_summary(team: &Team, folder: &Path, summary: &Summary) -> Result<(), Error> {
    let write = |bytes: &mut Vec<u8>| {
        serde_json::to_writer_pretty(&mut *bytes, summary)?;
        writeln!(bytes)
    };
    team.on_first(|| write_file(folder.join(SUMMARY_FILE), write))
}

fn write_file(path: PathBuf, content: impl FnOnce(&mut Vec<u8>) -> io::Result<()>) -> Result<(), Error> {
    let mut bytes = Vec::new();
    content(&mut bytes).map_err(|source| SceneError::Write { path: path.clone(), source })?;
    Ok(write_whole(&path, &bytes)?)
}

/// Writes the tetrahedra of a frame: a piece for each rank, and a file that lists the pieces.
pub(crate) fn write_frame(
    team: &Team,
    folder: &Path,
    frame: usize,
    simulation: &Simulation,
) -> Result<(), Error> {
    let (share, state) = (&simulation.share, &simulation.part);
    let piece = |rank: usize| format!("frame_{frame:04}_{rank}.vtu");
    let (x, v) = (state.positions(), state.velocities());
    let tets: Vec<[usize; 4]> = share.elements.iter().map(|&(nodes, ..)| nodes).collect();
    let displacement: Vec<f64> =
        (0..x.len()).flat_map(|node| (0..3).map(move |c| x[node][c] - share.places[node].rest[c])).collect();
    let rank = vec![team.rank as f64; tets.len()];
    let nodal = [
        Field { name: "displacement", components: 3, values: &displacement },
        Field { name: "velocity", components: 3, values: v.as_flattened() },
    ];
    let elemental = [Field { name: "rank", components: 1, values: &rank }];
    let path = folder.join(piece(team.rank));
    team.agree(write_file(path, |file| write_vtu(file, x, &tets, &nodal, &elemental)))?;
    let pieces = (0..team.size).map(piece);
    team.on_first(|| write_file(folder.join(frame_file(frame)), |file| write_pvtu(file, pieces)))
}

fn write_pvtu(target: &mut impl Write, pieces: impl Iterator<Item = String>) -> io::Result<()> {
    let array = |name: &str, components: usize| {
        format!("<PDataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\"/>")
    };
    writeln!(
        target,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <PUnstructuredGrid GhostLevel=\"0\">\n\
         <PPoints>{}</PPoints>\n<PPointData>{}{}</PPointData>\n<PCellData>{}</PCellData>",
        array("points", 3),
        array("displacement", 3),
        array("velocity", 3),
        array("rank", 1)
    )?;
    for piece in pieces {
        writeln!(target, "<Piece Source=\"{piece}\"/>")?;
    }
    writeln!(target, "</PUnstructuredGrid>\n</VTKFile>")
}

/// Name of the file that lists the pieces of a frame.
fn frame_file(frame: usize) -> String {
    format!("frame_{frame:04}.pvtu")
}

/// Writes the list of all frames up to the frame `last`, at intervals of `dt`, s.
pub(crate) fn write_frames(team: &Team, folder: &Path, last: usize, dt: f64) -> Result<(), Error> {
    let frames = (0..=last).map(|frame| (frame as f64 * dt, frame_file(frame)));
    team.on_first(|| write_file(folder.join(CAGES_FILE), |file| write_pvd(file, frames)))
}
