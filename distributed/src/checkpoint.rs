//! Checkpoints: the state of all nodes in one file, from which a run on any number of ranks can continue.
//!
//! The first line is JSON. The position, velocity and acceleration of each node follow in the order of the
//! mesh, little-endian. Rank 0 reads and writes the file. A new file replaces the previous checkpoint when
//! all of it is on the disk.

use std::fmt::Display;
use std::fs;
use std::path::{Path, PathBuf};

use piola_scenes::output::write_whole;
use serde::de::{DeserializeOwned, IgnoredAny};
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::portion::Homes;
use crate::simulation::Simulation;
use crate::team::Team;

/// Name and version of the format, in the header of a checkpoint.
const FORMAT: &str = "piola-mpi checkpoint 2";

/// Number of bytes of a node.
const NODE: usize = 72;

/// Header of a checkpoint.
#[derive(Serialize, Deserialize)]
struct Header<T> {
    format: String,
    nodes: usize,
    /// CRC-32 of all bytes after the header.
    checksum: u32,
    about: T,
}

/// Writes a checkpoint with the description `about`, and replaces the previous checkpoint.
///
/// # Errors
/// [`Error::OnRank`] if rank 0 cannot write; the previous checkpoint is then unchanged.
pub(crate) fn write(
    team: &Team,
    path: &Path,
    simulation: &Simulation,
    about: &impl Serialize,
) -> Result<(), Error> {
    let (share, state) = (&simulation.share, &simulation.part);
    let rows = (0..share.owned).map(|node| {
        let mut row = [share.ids[node]; 10];
        let vectors = [state.positions()[node], state.velocities()[node], state.accelerations()[node]];
        for (entry, x) in row[1..].iter_mut().zip(vectors.as_flattened()) {
            *entry = x.to_bits();
        }
        row
    });
    let mut rows = Homes::new(share.totals[0] as u64, 1).send(team, rows).concat();
    team.on_first(|| {
        rows.sort_unstable_by_key(|row| row[0]);
        let states: Vec<u8> =
            rows.iter().flat_map(|row| &row[1..]).flat_map(|bits| bits.to_le_bytes()).collect();
        let checksum = crc32fast::hash(&states);
        let header = Header { format: FORMAT.to_owned(), nodes: rows.len(), checksum, about };
        let mut bytes = serde_json::to_vec(&header).map_err(Error::usage)?;
        bytes.push(b'\n');
        bytes.extend(states);
        Ok(write_whole(path, &bytes)?)
    })
}

/// Reads a checkpoint into a simulation of the same mesh; returns the description of the checkpoint.
///
/// # Errors
/// An [`Error`], on all ranks, if the checkpoint cannot be read, is damaged, or belongs to another mesh.
pub(crate) fn read<T: DeserializeOwned>(
    team: &Team,
    path: &Path,
    simulation: &mut Simulation,
) -> Result<T, Error> {
    let share = &simulation.share;
    let nodes = share.totals[0];
    let (header, states) = team.on_first(|| load(path, nodes).map_err(|reason| refused(path, reason)))?;
    let header: Header<T> =
        serde_json::from_slice(&team.broadcast(0, header)).map_err(|error| refused(path, error))?;
    let (words, _) = states.as_chunks::<8>();
    let answers = Homes::new(nodes as u64, 1).ask(team, &share.ids, |node| -> [u64; 9] {
        std::array::from_fn(|entry| u64::from_le_bytes(words[9 * node + entry]))
    });
    let [positions, velocities, accelerations] = [0, 3, 6].map(|at: usize| -> Vec<[f64; 3]> {
        let vector = |row: &[u64; 9]| std::array::from_fn(|c| f64::from_bits(row[at + c]));
        answers.iter().map(vector).collect()
    });
    simulation.set(|part| {
        part.set_positions(&positions)?;
        part.set_velocities(&velocities)?;
        part.set_accelerations(&accelerations)
    })?;
    Ok(header.about)
}

/// Reads a checkpoint of a mesh: its header, with the end of the line, and the states of its nodes.
fn load(path: &Path, nodes: usize) -> Result<(Vec<u8>, Vec<u8>), String> {
    let mut header = fs::read(path).map_err(|error| error.to_string())?;
    let states = header.split_off(header.iter().position(|&byte| byte == b'\n').map_or(0, |end| end + 1));
    let Header::<IgnoredAny> { format, nodes: found, checksum, .. } =
        serde_json::from_slice(&header).map_err(|_| "it is not a checkpoint")?;
    if format != FORMAT {
        return Err(format!("it is not a {FORMAT}"));
    }
    if found != nodes {
        return Err(format!("it has {found} nodes, and the mesh has {nodes}"));
    }
    if states.len() != NODE * nodes || crc32fast::hash(&states) != checksum {
        return Err("it is damaged".to_owned());
    }
    Ok((header, states))
}

/// Error of a checkpoint from which a run cannot continue.
pub(crate) fn refused(path: &Path, reason: impl Display) -> Error {
    Error::usage(format!("cannot continue from {}: {reason}", path.display()))
}

/// Path of the checkpoint in the folder of a run.
#[must_use]
pub fn file_in(folder: &Path) -> PathBuf {
    folder.join("checkpoint.piola")
}
