//! Checkpoints: the state of all nodes in one file, from which a run on any number of ranks can continue.
//!
//! The header is a line of JSON, padded with spaces to `HEADER` bytes. The positions, velocities and
//! accelerations of all nodes follow in the order of the mesh, little-endian. Every rank writes the nodes
//! that are at home on it into a new file. This file replaces the previous checkpoint when all of it is on
//! the disk. All ranks must be able to access the same folder.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};

use piola_scenes::error::Error as SceneError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::portion::Homes;
use crate::simulation::Simulation;
use crate::team::Team;

/// Length of the header, bytes.
const HEADER: usize = 65536;

/// Name and version of the format, in the header of a checkpoint.
const FORMAT: &str = "piola-mpi checkpoint 1";

/// Number of bytes of a node in each of the three lists.
const NODE: u64 = 24;

/// Header of a checkpoint.
#[derive(Debug, Serialize, Deserialize)]
struct Header<T> {
    format: String,
    nodes: u64,
    /// CRC-32 of all bytes after the header.
    checksum: u32,
    about: T,
}

/// Writes a checkpoint with the description `about`, and replaces the previous checkpoint.
///
/// # Errors
/// [`Error::OnRank`] with the reason of the first rank that cannot write; the previous checkpoint is then
/// unchanged.
pub(crate) fn write(
    team: &Team,
    path: &Path,
    simulation: &Simulation,
    about: &impl Serialize,
) -> Result<(), Error> {
    let (share, state) = (&simulation.share, &simulation.part);
    let homes = Homes::new(share.totals[0] as u64, team.size);
    let rows = (0..share.owned).map(|node| {
        let mut row = [share.ids[node]; 10];
        let vectors = [state.positions()[node], state.velocities()[node], state.accelerations()[node]];
        for (entry, x) in row[1..].iter_mut().zip(vectors.as_flattened()) {
            *entry = x.to_bits();
        }
        row
    });
    let mut rows = homes.send(team, rows).concat();
    rows.sort_unstable_by_key(|row| row[0]);
    let list = |at: usize| -> Vec<u8> {
        rows.iter().flat_map(|row| &row[3 * at + 1..3 * at + 4]).flat_map(|bits| bits.to_le_bytes()).collect()
    };
    let lists = [list(0), list(1), list(2)];
    let header =
        Header { format: FORMAT.to_owned(), nodes: homes.total, checksum: checksum(team, &lists), about };

    let aside = path.with_extension("part");
    let failed = |source| Error::from(SceneError::Write { path: path.into(), source });
    let begin = || -> io::Result<()> {
        let mut text = serde_json::to_vec(&header)?;
        if text.len() >= HEADER {
            return Err(io::Error::other("its header is too long"));
        }
        text.resize(HEADER - 1, b' ');
        text.push(b'\n');
        File::create(&aside)?.write_all(&text)
    };
    let put = || -> io::Result<()> {
        let file = File::options().write(true).open(&aside)?;
        for (number, list) in lists.iter().enumerate() {
            file.write_all_at(list, place(&homes, team.rank, number))?;
        }
        file.sync_all()
    };
    let finish = || -> io::Result<()> {
        fs::rename(&aside, path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        // Some file systems do not support this, and write names to the disk later.
        let _ = File::open(folder.unwrap_or(Path::new("."))).and_then(|folder| folder.sync_all());
        Ok(())
    };
    let written = team
        .on_first(|| begin().map_err(failed))
        .and_then(|()| team.agree(put().map_err(failed)))
        .and_then(|()| team.on_first(|| finish().map_err(failed)));
    if written.is_err() && team.rank == 0 {
        // An incomplete file is of no use.
        let _ = fs::remove_file(&aside);
    }
    written
}

/// Reads a checkpoint into a simulation of the same mesh; returns the description of the checkpoint.
///
/// # Errors
/// [`Error::OnRank`] if the checkpoint cannot be read, is damaged, belongs to another mesh, or is refused by
/// `check`.
pub(crate) fn read<T: DeserializeOwned>(
    team: &Team,
    path: &Path,
    simulation: &mut Simulation,
    check: impl FnOnce(&T) -> Result<(), String>,
) -> Result<T, Error> {
    let share = &simulation.share;
    let nodes = share.totals[0] as u64;
    let homes = Homes::new(nodes, team.size);
    let failed = |reason: String| Error::usage(format!("cannot continue from {}: {reason}", path.display()));
    let loaded = read_header::<T>(path).and_then(|(file, header)| {
        if header.nodes != nodes {
            return Err(format!("it has {} nodes, and the mesh has {nodes}", header.nodes));
        }
        check(&header.about)?;
        let range = homes.range(team.rank);
        let list = |number: usize| {
            let mut bytes = vec![0; ((range.end - range.start) * NODE) as usize];
            file.read_exact_at(&mut bytes, place(&homes, team.rank, number)).map(|()| bytes)
        };
        let lists = (0..3).map(list).collect::<Result<Vec<_>, _>>().map_err(|error| error.to_string())?;
        Ok((header, lists))
    });
    let (header, lists) = team.agree(loaded.map_err(failed))?;
    let is_whole = checksum(team, &lists) == header.checksum;
    let whole = is_whole.then_some(()).ok_or_else(|| failed("it is damaged".to_owned()));
    team.agree(whole)?;

    let mut order: Vec<usize> = (0..share.ids.len()).collect();
    order.sort_unstable_by_key(|&node| share.ids[node]);
    let asked: Vec<u64> = order.iter().map(|&node| share.ids[node]).collect();
    let word = |list: usize, at: usize| u64::from_le_bytes(lists[list].as_chunks::<8>().0[at]);
    let answers = homes.ask(team, &asked, |node| -> [u64; 9] {
        std::array::from_fn(|entry| word(entry / 3, 3 * node + entry % 3))
    });
    let mut vectors: [Vec<[f64; 3]>; 3] = std::array::from_fn(|_| vec![[0.0; 3]; order.len()]);
    for (&node, row) in order.iter().zip(&answers) {
        for (at, vectors) in vectors.iter_mut().enumerate() {
            vectors[node] = std::array::from_fn(|c| f64::from_bits(row[3 * at + c]));
        }
    }
    let [positions, velocities, accelerations] = vectors;
    simulation.set(|part| {
        part.set_positions(&positions)?;
        part.set_velocities(&velocities)?;
        part.set_accelerations(&accelerations)
    })?;
    Ok(header.about)
}

/// Opens a checkpoint and reads its header.
fn read_header<T: DeserializeOwned>(path: &Path) -> Result<(File, Header<T>), String> {
    let mut text = vec![0; HEADER];
    let mut file = File::open(path).map_err(|error| error.to_string())?;
    file.read_exact(&mut text).map_err(|_| "it is not a checkpoint".to_owned())?;
    let header: Header<T> = serde_json::from_slice(&text).map_err(|_| "it is not a checkpoint".to_owned())?;
    if header.format == FORMAT { Ok((file, header)) } else { Err(format!("it is not a {FORMAT}")) }
}

/// Position, in the file, of the nodes at home on a rank in one of the lists.
fn place(homes: &Homes, rank: usize, list: usize) -> u64 {
    HEADER as u64 + NODE * (list as u64 * homes.total + homes.range(rank).start)
}

/// Checksum of three consecutive lists, of each of which every rank has a part.
fn checksum(team: &Team, lists: &[Vec<u8>]) -> u32 {
    let mut sum = crc32fast::Hasher::new();
    for list in lists {
        let (sums, lengths) = (team.all(crc32fast::hash(list) as usize), team.all(list.len()));
        for (part, length) in sums.into_iter().zip(lengths) {
            sum.combine(&crc32fast::Hasher::new_with_initial_len(part as u32, length as u64));
        }
    }
    sum.finalize()
}

/// Path of the checkpoint in the folder of a run.
#[must_use]
pub fn file_in(folder: &Path) -> PathBuf {
    folder.join("checkpoint.piola")
}
