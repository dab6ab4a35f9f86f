//! Functions that run the program in tests.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::error::Error;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use piola_distributed::checkpoint;
use piola_distributed::run::About;

pub(crate) type TestResult = Result<(), Box<dyn Error>>;

/// Time after which a run counts as hanging; every run of a test is shorter.
const LIMIT: Duration = Duration::from_secs(240);

/// Command that starts the program on a number of ranks, for any number of cores and any user, with a line of
/// arguments; quotes enclose an argument with spaces.
pub(crate) fn command(ranks: usize, arguments: &str) -> Command {
    let mut command = Command::new("mpirun");
    command
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .args(["--oversubscribe", "-n", &ranks.to_string(), env!("CARGO_BIN_EXE_piola-mpi")])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    for (index, part) in arguments.split('\'').enumerate() {
        match index % 2 {
            0 => command.args(part.split_whitespace()),
            _ => command.arg(part),
        };
    }
    command
}

/// Waits for a run to end.
pub(crate) fn finish(mut command: Command) -> Result<Output, Box<dyn Error>> {
    let mut child = command.spawn()?;
    let begun = Instant::now();
    while child.try_wait()?.is_none() {
        if begun.elapsed() > LIMIT {
            child.kill()?;
            return Err(format!("{command:?} hangs").into());
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    Ok(child.wait_with_output()?)
}

/// Runs the program with results in a folder, and reads the state in the checkpoint there.
pub(crate) fn state_after(ranks: usize, arguments: &str, folder: &Path) -> Result<State, Box<dyn Error>> {
    let output = finish(command(ranks, &format!("{arguments} --out {}", folder.display())))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    checkpoint_in(folder)
}

/// Checkpoint of a run: its description, and positions, m, and velocities, m/s, of all nodes.
pub(crate) struct State {
    pub(crate) about: About,
    pub(crate) positions: Vec<[f64; 3]>,
    pub(crate) velocities: Vec<[f64; 3]>,
}

/// The checkpoint in the folder of a run: a header in JSON, then positions, velocities and accelerations.
pub(crate) fn checkpoint_in(folder: &Path) -> Result<State, Box<dyn Error>> {
    let bytes = std::fs::read(checkpoint::file_in(folder))?;
    let (header, lists) = bytes.split_at(65536);
    let mut header: serde_json::Value = serde_json::from_slice(header)?;
    assert_eq!(header["checksum"], crc32fast::hash(lists));
    let numbers: Vec<f64> =
        lists.as_chunks::<8>().0.iter().map(|&number| f64::from_le_bytes(number)).collect();
    let vectors = numbers.as_chunks::<3>().0;
    let nodes = vectors.len() / 3;
    assert_eq!(header["nodes"], nodes);
    let [positions, velocities] = [0, nodes].map(|first| vectors[first..first + nodes].to_vec());
    Ok(State { about: serde_json::from_value(header["about"].take())?, positions, velocities })
}
