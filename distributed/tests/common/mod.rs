//! Functions that run the program in tests.

#![allow(dead_code, reason = "each test file uses a part of it")]

use std::error::Error;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use piola_distributed::checkpoint::{self, State};
use piola_distributed::run::About;

pub(crate) type TestResult = Result<(), Box<dyn Error>>;

/// Time after which a run counts as hanging; every run of a test is shorter.
const LIMIT: Duration = Duration::from_secs(240);

/// Words of a command line without words that contain spaces.
pub(crate) fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_owned).collect()
}

/// Command that starts the program on a number of ranks, for any number of cores and any user.
pub(crate) fn command(ranks: usize, words: impl IntoIterator<Item = String>) -> Command {
    let mut command = Command::new("mpirun");
    command
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .args(["--oversubscribe", "-n", &ranks.to_string(), env!("CARGO_BIN_EXE_piola-mpi")])
        .args(words)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
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
pub(crate) fn state_after(
    ranks: usize,
    words: impl IntoIterator<Item = String>,
    folder: &Path,
) -> Result<State, Box<dyn Error>> {
    let out = ["--out".to_owned(), folder.display().to_string()];
    let output = finish(command(ranks, words.into_iter().chain(out)))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(checkpoint_in(folder)?.1)
}

/// The checkpoint in the folder of a run.
pub(crate) fn checkpoint_in(folder: &Path) -> Result<(About, State), Box<dyn Error>> {
    Ok(checkpoint::read_alone(&checkpoint::file_in(folder))?)
}
